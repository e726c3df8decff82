#include "voxelcore/Models/TableColumns.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Models/SkeletonModel.h"

#include <algorithm>
#include <array>
#include <span>

namespace voxelcore
{

namespace
{

// skan's names where it has the number.
constexpr auto kBranchColumns = std::to_array<Column>({
  kLabelColumn,
  kNameColumn,
  kPartColumn,
  kBranchIdColumn,
  { "skeleton_id", "", "connected component of the skeleton, from 1" },
  { "node_id_src", "", "node at its first point" },
  { "node_id_dst", "", "node at its last point" },
  { "branch_type", "", "0 tip to tip, 1 tip to junction, 2 junction to junction, 3 cycle" },
  { "branch_distance", "mm", "length along the branch" },
  { "euclidean_distance", "mm", "distance between its ends" },
  { "tortuosity", "1", "branch_distance / euclidean_distance; empty for a closed branch" },
  { "free_length", "mm", "length outside the balls at its junctions" },
  { "mean_radius", "mm", "mean over its free length of the radius of a round tube with the body's cross-section area" },
  { "min_radius", "mm", "least of these radii" },
  { "max_radius", "mm", "greatest of these radii" },
  { "sd_radius", "mm", "standard deviation of these radii" },
  { "mean_ball_radius",
    "mm",
    "mean over its free length of the radius of the largest ball inside; half the least width" },
  { "min_ball_radius", "mm", "least of these radii" },
  { "max_ball_radius", "mm", "greatest of these radii" },
  { "volume", "mm^3", "of a round tube with the radii of mean_radius, over its free length" },
  { "surface", "mm^2", "lateral area of that tube" },
  { "parent_branch", "", "branch it springs from; empty at the root" },
  { "parent_angle", "deg", "between its direction and its parent's" },
  { "strahler", "", "Strahler order" },
  { "centrifugal", "", "centrifugal order: junctions to the root, plus 1" },
  { "level", "", "0 the axis from the root, 1 its laterals, 2 theirs" },
  { "axis", "", "number of its axis: branches that continue each other" },
  { "closes_loop", "", "1: the thinnest branch of a cycle" },
  { "coord_src_x", "mm", "first point, LPS" },
  { "coord_src_y", "mm", "" },
  { "coord_src_z", "mm", "" },
  { "coord_dst_x", "mm", "last point, LPS" },
  { "coord_dst_y", "mm", "" },
  { "coord_dst_z", "mm", "" },
});

// Of a map of probabilities, behind these.
constexpr auto kLifeColumns = std::to_array<Column>({
  { "lowest_threshold", "", "lowest threshold of the map of probabilities at which the branch is there" },
  { "highest_threshold", "", "highest one, without a gap between them" },
  { "persistence", "", "the difference" },
});

// Where a person gave some, behind all others.
constexpr auto kNameColumns = std::to_array<Column>({
  { "branch_name", "", "given to the branch by --edits" },
});

// AnalyzeSkeleton's names where it has the number.
constexpr auto kSummaryColumns = std::to_array<Column>({
  kLabelColumn,
  kNameColumn,
  kPartColumn,
  { "level", "", "level of the hierarchy, or 'all'" },
  { "count", "", "axes of this level; for 'all' branches (# Branches)" },
  { "total_length", "mm", "sum of their lengths; a lateral begins at its parent's surface" },
  { "mean_length", "mm", "Average Branch Length" },
  { "mean_radius", "mm", "mean of mean_radius, weighted by length" },
  { "mean_tortuosity", "1", "mean over axes" },
  { "mean_emergence_angle", "deg", "between the parent's direction and the lateral's at its base" },
  { "mean_midpoint_angle", "deg", "between the parent's direction and the way to its middle" },
  { "mean_tip_angle", "deg", "between the parent's direction and the way to its tip" },
  { "mean_children", "", "mean number of laterals on each" },
  { "skeletons", "", "connected components that are points or have branches" },
  { "end_points", "", "# End-points" },
  { "junctions", "", "# Junctions" },
  { "triple_points", "", "# Triple points" },
  { "quadruple_points", "", "# Quadruple points" },
  { "cycles", "", "independent cycles of branches" },
  { "isolated_loops", "", "closed curves without junctions" },
  { "isolated_points", "", "components that are a point" },
  { "closed_faces", "", "faces of closed surfaces, which cannot become curves" },
  { "plate_faces", "", "faces that stay as plates" },
  { "max_length", "mm", "Maximum Branch Length" },
  { "volume", "mm^3", "sum over branches" },
  { "surface", "mm^2", "sum over branches" },
});

constexpr auto kContactColumns = std::to_array<Column>({
  { "contact_id", "", "number of the contact, from 1; empty where labels follow each other without touching" },
  { "label_a", "", "value of one label" },
  { "name_a", "", "its name" },
  { "label_b", "", "value of the other" },
  { "name_b", "", "its name" },
  { "area", "mm^2", "of the voxel faces between them; 0 if only edges and corners touch" },
  { "faces", "", "number of these faces" },
  { "voxels", "", "voxels of both that touch the other over faces, edges or corners" },
  { "centre_x", "mm", "middle of the contact, LPS" },
  { "centre_y", "mm", "" },
  { "centre_z", "mm", "" },
  { "nodes", "", "nodes where their branches meet there; 0: the network does not pass" },
  { "node_id", "", "the node; a row for each if there are several" },
  { "radius", "mm", "of a round cross-section there" },
  { "node_x", "mm", "the node, LPS" },
  { "node_y", "mm", "" },
  { "node_z", "mm", "" },
});

void
AddSummary(TextFile & file, const SkeletonPart & part)
{
  const SkeletonNumbers & n = part.table.numbers;
  const auto head = [&] { file << part.label << "," << CsvField(part.name) << "," << part.component << ","; };
  head();
  file << "all," << n.branches << "," << n.totalLength << "," << n.meanLength << "," << n.meanRadius << ",,,,,,"
       << n.components << "," << n.tips << "," << n.junctions << "," << n.triplePoints << "," << n.quadruplePoints
       << "," << n.cycles << "," << n.isolatedLoops << "," << n.isolatedPoints << "," << n.closedFaces << ","
       << n.plateFaces << "," << n.maxLength << "," << n.volume << "," << n.surface << "\n";
  for (const LevelRecord & level : part.table.levels)
  {
    head();
    file << level.level << "," << level.count << "," << level.totalLength << "," << level.meanLength << ","
         << level.meanRadius << "," << level.meanTortuosity << "," << level.meanEmergenceAngle << ","
         << level.meanMidpointAngle << "," << level.meanTipAngle << "," << level.meanChildren << ",,,,,,,,,,,,,\n";
  }
}

} // namespace

std::string
CsvField(const std::string & given)
{
  // What a spreadsheet would take for a formula becomes text.
  const bool  isFormula = !given.empty() && (std::string_view("=+-@").find(given[0]) != std::string_view::npos ||
                                            static_cast<unsigned char>(given[0]) < 0x20U);
  std::string text = (isFormula ? "'" : "") + given;
  if (text.find_first_of(",\"\n\r") == std::string::npos)
  {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text)
  {
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  }
  return quoted + "\"";
}

void
WriteBranchCsv(const std::filesystem::path & path, const SkeletonModel & model, HeadUnits units)
{
  TextFile    file(path, tableDigits);
  const bool  hasLives = HasLives(model);
  const bool  hasNames = HasNames(model);
  std::string head = HeadLine(kBranchColumns, units);
  const auto  widen = [&](const std::string & further) { head.replace(head.size() - 1, 1, "," + further); };
  if (hasLives)
  {
    widen(HeadLine(kLifeColumns, units));
  }
  if (hasNames)
  {
    widen(HeadLine(kNameColumns, units));
  }
  file << head;
  for (const SkeletonPart & part : model.parts)
  {
    for (std::size_t branch = 0; branch < part.table.branches.size(); ++branch)
    {
      const BranchRecord & r = part.table.branches[branch];
      const auto &         nodes = part.graph.branchNodes[branch];
      const std::int64_t   label = part.network ? part.graph.BranchLabel(branch) : part.label;
      const std::string    name = part.network ? part.network->NameOf(label) : part.name;
      file << label << "," << CsvField(name) << "," << part.component << "," << branch << "," << r.component << ","
           << nodes[0] << "," << nodes[1] << "," << static_cast<int>(r.type) << "," << r.length << "," << r.chord << ","
           << r.tortuosity << "," << r.freeLength << "," << r.meanRadius << "," << r.minRadius << "," << r.maxRadius
           << "," << r.sdRadius << "," << r.meanBallRadius << "," << r.minBallRadius << "," << r.maxBallRadius << ","
           << r.volume << "," << r.surface << ",";
      if (r.parent != kNoBranch)
      {
        file << r.parent;
      }
      file << "," << r.parentAngle << "," << r.strahler << "," << r.centrifugal << "," << r.level << "," << r.axis
           << "," << (r.closesLoop ? 1 : 0);
      for (const ElementIndex point : { part.graph.Branch(branch).front(), part.graph.Branch(branch).back() })
      {
        for (const double coordinate : part.graph.positions[point])
        {
          file << "," << coordinate;
        }
      }
      if (hasLives)
      {
        const BranchLife & life = part.lives[branch];
        file << "," << life.lowest << "," << life.highest << "," << life.Persistence();
      }
      if (hasNames)
      {
        file << "," << CsvField(part.names.empty() ? std::string() : part.names[branch]);
      }
      file << "\n";
    }
  }
  file.Finish();
}

void
WriteSummaryCsv(const std::filesystem::path & path, const SkeletonModel & model, HeadUnits units)
{
  TextFile file(path, tableDigits);
  file << HeadLine(kSummaryColumns, units);
  for (const SkeletonPart & part : model.parts)
  {
    if (!part.network)
    {
      AddSummary(file, part);
      continue;
    }
    SkeletonPart whole;
    whole.name = "network";
    whole.table = part.table;
    AddSummary(file, whole);
    for (const SkeletonPart & label : PartsByLabel(part))
    {
      AddSummary(file, label);
    }
  }
  file.Finish();
}

void
WriteContactsCsv(const std::filesystem::path & path, const SkeletonModel & model, HeadUnits units)
{
  TextFile file(path, tableDigits);
  file << HeadLine(kContactColumns, units);
  const auto addPlace = [&](const std::array<double, 3> & place) {
    for (const double coordinate : place)
    {
      file << "," << coordinate;
    }
  };
  for (const SkeletonPart & part : model.parts)
  {
    if (!part.network)
    {
      continue;
    }
    const auto addLabels = [&](const std::array<std::int64_t, 2> & labels) {
      for (const std::int64_t label : labels)
      {
        file << "," << label << "," << CsvField(part.network->NameOf(label));
      }
    };
    const auto addNode = [&](const std::array<double, 3> & place) {
      const auto & points = part.graph.nodePoints;
      const auto   node = ranges::find_if(points, [&](ElementIndex point) {
        return part.graph.contact[point] && part.graph.positions[point] == place;
      });
      if (node == points.end()) // pruned
      {
        file << ",,";
      }
      else
      {
        file << "," << node - points.begin() << "," << SectionRadii(part.graph)[*node];
      }
      addPlace(place);
      file << "\n";
    };
    std::size_t number = 0;
    for (const NetworkContact & contact : part.network->contacts)
    {
      ++number;
      const auto addContact = [&] {
        file << number;
        addLabels(contact.labels);
        file << "," << contact.areaMm2 << "," << contact.faces << "," << contact.voxels;
        addPlace(contact.centre);
        file << "," << contact.places.size();
      };
      if (contact.places.empty())
      {
        addContact();
        file << ",,,,,\n";
      }
      for (const auto & place : contact.places)
      {
        addContact();
        addNode(place);
      }
    }
    for (const NetworkGap & gap : part.network->gaps)
    {
      addLabels(gap.labels);
      file << ",0,0,0,,,,1";
      addNode(gap.place);
    }
  }
  file.Finish();
}

std::string
SkeletonColumnsJson(SpatialUnit unit, bool network, bool lives, bool names)
{
  std::vector<Column> further(kLifeColumns.begin(), kLifeColumns.begin() + (lives ? kLifeColumns.size() : 0));
  further.insert(further.end(), kNameColumns.begin(), kNameColumns.begin() + (names ? kNameColumns.size() : 0));

  std::vector<std::pair<const char *, std::string>> tables{ { "branches", ColumnsJson(kBranchColumns, unit, further) },
                                                            { "summary", ColumnsJson(kSummaryColumns, unit) } };
  if (network)
  {
    tables.emplace_back("contacts", ColumnsJson(kContactColumns, unit));
  }
  return TablesJson(tables);
}

} // namespace voxelcore
