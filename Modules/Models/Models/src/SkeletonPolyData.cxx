#include "voxelcore/Models/AppendedVtp.h"
#include "ModelSource.h"
#include "UnfitFile.h"

#include "voxelcore/Base/Text.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Models/SkeletonModel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <type_traits>
#include <utility>

namespace voxelcore
{

namespace
{

std::vector<std::vector<ElementIndex>>
CellsOf(const VtpCells & cells, std::size_t pointCount)
{
  std::vector<std::vector<ElementIndex>> lists;
  std::int64_t                           from = 0;
  for (const std::int64_t end : cells.offsets)
  {
    RequireFit(end > from && static_cast<std::uint64_t>(end) <= cells.points.size(), "its cells are damaged");
    lists.emplace_back();
    for (; from < end; ++from)
    {
      const std::int64_t point = cells.points[static_cast<std::size_t>(from)];
      RequireFit(point >= 0 && static_cast<std::uint64_t>(point) < pointCount, "its cells are damaged");
      lists.back().push_back(static_cast<ElementIndex>(point));
    }
  }
  RequireFit(static_cast<std::uint64_t>(from) == cells.points.size(), "its cells are damaged");
  return lists;
}

/** Lives and names came line by line, and branches may stand in another order, turned round: each is the line that has
 *  its first piece. */
void
PutInOrder(SkeletonPart & part, const std::vector<std::vector<ElementIndex>> & lines)
{
  if (part.lives.empty() && part.names.empty())
  {
    return;
  }
  std::map<std::pair<ElementIndex, ElementIndex>, std::size_t> lineOf;
  for (std::size_t line = 0; line < lines.size(); ++line)
  {
    for (std::size_t i = 1; i < lines[line].size(); ++i)
    {
      lineOf.try_emplace(std::minmax(lines[line][i - 1], lines[line][i]), line);
    }
  }
  const auto put = [&](auto & values) {
    std::decay_t<decltype(values)> inOrder;
    for (std::size_t branch = 0; branch < part.graph.BranchCount() && !values.empty(); ++branch)
    {
      const auto points = part.graph.Branch(branch);
      inOrder.push_back(values[lineOf.at(std::minmax(points[0], points[1]))]);
    }
    values = std::move(inOrder);
  };
  put(part.lives);
  put(part.names);
}

/** Of a field array with lines "cell name". */
std::map<std::size_t, std::string>
ReadBranchNames(ModelSource & file, std::size_t count)
{
  std::map<std::size_t, std::string> names;
  for (const std::string & line : SplitText(file.ReadText("FieldData", "BranchNames"), '\n'))
  {
    const std::size_t blank = line.find(' ');
    const auto        cell = ParseInteger(std::string_view(line).substr(0, blank));
    RequireFit(line.empty() || (cell && *cell >= 0 && static_cast<std::size_t>(*cell) < count && blank != line.npos),
               "its BranchNames are damaged");
    if (!line.empty())
    {
      names[static_cast<std::size_t>(*cell)] = line.substr(blank + 1);
    }
  }
  return names;
}

SkeletonModel
ReadSkeleton(ModelSource & file)
{
  const auto unit = UnitNamed(file.ReadText("FieldData", "Units"));
  RequireFit(file.ReadText("FieldData", "SPACE") == "LPS" && unit, "it is not in LPS mm or voxels");
  RequireFit(file.Has("PointData", "ErosionThickness") && file.Has("CellData", "BranchId"), "it holds no skeleton");
  const std::vector<double> positions = file.Read<double>("Points", "Points", 3);
  // Of 0.2: Radius was that of the ball.
  const bool isOld = file.Has("PointData", "SectionRadius");
  RequireFit(isOld || file.Has("PointData", "BallRadius"), "an older version wrote it; make it anew");
  const std::vector<double> radius = file.Read<double>("PointData", isOld ? "Radius" : "BallRadius");
  const std::vector<double> sections = file.Read<double>("PointData", isOld ? "SectionRadius" : "Radius");
  const std::vector<double> thickness = file.Read<double>("PointData", "ErosionThickness");
  const auto                labels = file.Read<std::int64_t>("CellData", "Label");
  const auto                components = file.Read<std::int64_t>("CellData", "Component");
  const auto                closed = file.Read<std::int64_t>("CellData", "Closed");
  const std::size_t         count = positions.size() / 3;
  RequireFit(radius.size() == count && sections.size() == count && thickness.size() == count && count < 0xFFFFFFFFU,
             "its arrays differ in length");
  const auto areLengths = [](const std::vector<double> & values, double most) {
    return std::all_of(values.begin(), values.end(), [&](double value) { return value >= 0 && value <= most; });
  };
  constexpr double largest = std::numeric_limits<double>::max();
  RequireFit(std::all_of(positions.begin(), positions.end(), [](double x) { return std::isfinite(x); }),
             "a coordinate is no finite number");
  RequireFit(areLengths(radius, largest) && areLengths(sections, largest),
             "a Radius or BallRadius is below 0 or no finite number");
  // Of closed surfaces it is infinite.
  RequireFit(areLengths(thickness, std::numeric_limits<double>::infinity()),
             "an ErosionThickness is below 0 or no number");
  const auto read = [&](const char * section) {
    return CellsOf({ file.ReadIndices(section, "offsets"), file.ReadIndices(section, "connectivity") }, count);
  };
  const auto verts = read("Verts");
  const auto lines = read("Lines");
  const auto polys = read("Polys");
  RequireFit(labels.size() == verts.size() + lines.size() + polys.size() && components.size() == labels.size() &&
               closed.size() == labels.size(),
             "its arrays differ in length");

  // Of a network all is one part, whatever label.
  const bool                isNetwork = file.Has("PointData", "Label") && file.Has("PointData", "Contact");
  std::vector<std::int64_t> pointLabels;
  std::vector<std::int64_t> contacts;
  if (isNetwork)
  {
    pointLabels = file.Read<std::int64_t>("PointData", "Label");
    contacts = file.Read<std::int64_t>("PointData", "Contact");
    RequireFit(pointLabels.size() == count && contacts.size() == count, "its arrays differ in length");
  }
  const auto keyOf = [&](std::size_t cell) {
    return std::pair(isNetwork ? std::int64_t{ 1 } : labels[cell], components[cell]);
  };

  // A point belongs to the part of its cells.
  SkeletonModel model;
  model.unit = *unit;
  std::map<std::pair<std::int64_t, std::int64_t>, std::size_t> partOf;
  for (std::size_t cell = 0; cell < labels.size(); ++cell)
  {
    partOf.try_emplace(keyOf(cell), 0);
  }
  for (auto & [key, index] : partOf)
  {
    index = model.parts.size();
    model.parts.emplace_back();
    model.parts.back().label = key.first;
    model.parts.back().component = key.second;
  }
  std::vector<ElementIndex> number(count, 0xFFFFFFFFU);
  std::vector<std::size_t>  owner(count, 0);
  const auto                forCells = [&](auto && visit) {
    std::size_t cell = 0;
    for (const auto * list : { &verts, &lines, &polys })
    {
      for (const auto & points : *list)
      {
        visit(list, points, cell, partOf.at(keyOf(cell)));
        ++cell;
      }
    }
  };
  std::vector<std::uint8_t> used(count, 0);
  forCells([&](auto, const auto & points, std::size_t, std::size_t part) {
    for (const ElementIndex point : points)
    {
      RequireFit(!used[point] || owner[point] == part, "a point belongs to two labels");
      used[point] = 1;
      owner[point] = part;
    }
  });
  for (std::size_t point = 0; point < count; ++point)
  {
    RequireFit(used[point] != 0, "a point is on no cell");
    SkeletonGraph & graph = model.parts[owner[point]].graph;
    number[point] = static_cast<ElementIndex>(graph.positions.size());
    graph.positions.push_back({ positions[3 * point], positions[3 * point + 1], positions[3 * point + 2] });
    graph.radius.push_back(radius[point]);
    graph.sectionRadius.push_back(sections[point]);
    graph.erosionThickness.push_back(thickness[point]);
    if (isNetwork)
    {
      graph.labels.push_back(pointLabels[point]);
      graph.contact.push_back(contacts[point] != 0 ? 1 : 0);
    }
  }
  std::vector<double> lowest;
  std::vector<double> highest;
  if (file.Has("CellData", "LowestThreshold") && file.Has("CellData", "HighestThreshold"))
  {
    lowest = file.Read<double>("CellData", "LowestThreshold");
    highest = file.Read<double>("CellData", "HighestThreshold");
    RequireFit(lowest.size() == labels.size() && highest.size() == labels.size(), "its arrays differ in length");
    RequireFit(areLengths(lowest, 1) && areLengths(highest, 1), "a threshold of a branch is not within 0 and 1");
  }
  const auto names =
    file.Has("FieldData", "BranchNames") ? ReadBranchNames(file, labels.size()) : std::map<std::size_t, std::string>();
  std::vector<std::vector<std::vector<ElementIndex>>> branches(model.parts.size());
  forCells([&](const auto * list, const auto & points, std::size_t cell, std::size_t part) {
    std::vector<ElementIndex> own;
    std::transform(points.begin(), points.end(), std::back_inserter(own), [&](ElementIndex p) { return number[p]; });
    SkeletonGraph & graph = model.parts[part].graph;
    if (list == &lines)
    {
      RequireFit(own.size() >= 2, "a line has a single point");
      if (!lowest.empty())
      {
        model.parts[part].lives.push_back({ lowest[cell], highest[cell] });
      }
      if (!names.empty())
      {
        const auto name = names.find(cell);
        model.parts[part].names.push_back(name == names.end() ? std::string() : name->second);
      }
      branches[part].push_back(std::move(own));
    }
    else if (list == &polys)
    {
      graph.faceVertices.insert(graph.faceVertices.end(), own.begin(), own.end());
      graph.faceOffsets.push_back(graph.faceVertices.size());
      graph.closedFace.push_back(closed[cell] != 0 ? 1 : 0);
    }
  });
  for (std::size_t part = 0; part < model.parts.size(); ++part)
  {
    SortBranches(model.parts[part].graph, branches[part], false);
    PutInOrder(model.parts[part], branches[part]);
  }
  if (file.Has("FieldData", "Provenance"))
  {
    model.provenance = file.ReadText("FieldData", "Provenance");
  }
  return model;
}

} // namespace

bool
HasLives(const SkeletonModel & model)
{
  return std::any_of(model.parts.begin(), model.parts.end(), [](const SkeletonPart & part) {
    return !part.lives.empty();
  });
}

bool
HasNames(const SkeletonModel & model)
{
  return std::any_of(model.parts.begin(), model.parts.end(), [](const SkeletonPart & part) {
    return !part.names.empty();
  });
}

std::vector<double>
PointConfidence(const SkeletonPart & part)
{
  std::vector<double> confidence(part.lives.empty() ? 0 : part.graph.positions.size(), 0);
  for (std::size_t branch = 0; branch < part.lives.size(); ++branch)
  {
    for (const ElementIndex point : part.graph.Branch(branch))
    {
      confidence[point] = std::max(confidence[point], part.lives[branch].highest);
    }
  }
  return confidence;
}

void
WriteSkeletonVtp(const std::filesystem::path & path, const SkeletonModel & model)
{
  std::vector<double> positions;
  std::vector<double> radius;
  std::vector<double> sections;
  std::vector<double> thickness;
  VtpContent          content;
  auto &              cells = content.cells;
  struct CellData
  {
    std::vector<std::int64_t> branchId, label, component, closed, level, strahler;
    std::vector<double>       length, tortuosity, lowest, highest, persistence;
  };
  CellData   data[3];
  const auto add = [&](int                  kind,
                       const SkeletonPart & part,
                       std::int64_t         firstPoint,
                       auto &&              points,
                       std::int64_t         closed,
                       std::int64_t         id) {
    const SkeletonGraph & graph = part.graph;
    const std::int64_t    label = !part.network ? part.label
                                  : id >= 0     ? graph.BranchLabel(static_cast<std::size_t>(id))
                                                : graph.labels[*std::begin(points)];
    for (const ElementIndex point : points)
    {
      cells[kind].points.push_back(firstPoint + point);
    }
    cells[kind].offsets.push_back(static_cast<std::int64_t>(cells[kind].points.size()));
    CellData & to = data[kind];
    to.branchId.push_back(id);
    to.label.push_back(label);
    to.component.push_back(part.component);
    to.closed.push_back(closed);
    const BranchRecord * branch = id >= 0 ? &part.table.branches[static_cast<std::size_t>(id)] : nullptr;
    to.level.push_back(branch ? branch->level : 0);
    to.strahler.push_back(branch ? branch->strahler : 0);
    to.length.push_back(branch ? branch->length : 0);
    to.tortuosity.push_back(branch ? branch->tortuosity : 0);
    const BranchLife life = id >= 0 && !part.lives.empty() ? part.lives[static_cast<std::size_t>(id)] : BranchLife();
    to.lowest.push_back(life.lowest);
    to.highest.push_back(life.highest);
    to.persistence.push_back(life.Persistence());
  };
  std::int64_t              firstPoint = 0;
  std::vector<std::int64_t> pointLabels;
  std::vector<std::int64_t> contacts;
  std::string               names;
  std::vector<std::string>  branchNames; // behind those of verts, of which all come first
  for (const SkeletonPart & part : model.parts)
  {
    const SkeletonGraph & graph = part.graph;
    if (part.network)
    {
      pointLabels.insert(pointLabels.end(), graph.labels.begin(), graph.labels.end());
      contacts.insert(contacts.end(), graph.contact.begin(), graph.contact.end());
      for (const NetworkLabel & label : part.network->labels)
      {
        names += std::to_string(label.value) + " " + label.name + "\n";
      }
    }
    for (const auto & position : graph.positions)
    {
      positions.insert(positions.end(), position.begin(), position.end());
    }
    radius.insert(radius.end(), graph.radius.begin(), graph.radius.end());
    const auto & widths = SectionRadii(graph);
    sections.insert(sections.end(), widths.begin(), widths.end());
    thickness.insert(thickness.end(), graph.erosionThickness.begin(), graph.erosionThickness.end());
    for (std::size_t node = 0; node < graph.nodePoints.size(); ++node)
    {
      if (graph.nodeKinds[node] == NodeKind::Isolated)
      {
        add(0, part, firstPoint, std::array{ graph.nodePoints[node] }, 0, -1);
      }
    }
    for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
    {
      add(1, part, firstPoint, graph.Branch(branch), 0, static_cast<std::int64_t>(branch));
      branchNames.push_back(part.names.empty() ? std::string() : part.names[branch]);
    }
    for (std::size_t face = 0; face < graph.FaceCount(); ++face)
    {
      const std::span<const ElementIndex> corners{ graph.faceVertices.data() + graph.faceOffsets[face],
                                                   graph.faceVertices.data() + graph.faceOffsets[face + 1] };
      add(2, part, firstPoint, corners, graph.closedFace[face], -1);
    }
    firstPoint += static_cast<std::int64_t>(graph.positions.size());
  }

  content.texts = { { "SPACE", "LPS" }, { "Units", UnitName(model.unit) }, { "Provenance", model.provenance } };
  content.positions = std::move(positions);
  content.pointArrays = { { "Radius", sections },
                          { "BallRadius", radius },
                          { "MaximumInscribedSphereRadius", radius },
                          { "ErosionThickness", thickness } };
  if (!pointLabels.empty())
  {
    content.texts.emplace_back("LabelNames", names);
    content.pointArrays.emplace_back("Label", std::move(pointLabels));
    content.pointArrays.emplace_back("Contact", std::move(contacts));
  }
  if (HasNames(model))
  {
    std::string lines;
    for (std::size_t branch = 0; branch < branchNames.size(); ++branch)
    {
      lines += branchNames[branch].empty()
                 ? ""
                 : std::to_string(data[0].branchId.size() + branch) + " " + branchNames[branch] + "\n";
    }
    content.texts.emplace_back("BranchNames", lines);
  }
  const auto addCells = [&](const char * name, auto member) {
    auto all = data[0].*member;
    for (const int kind : { 1, 2 })
    {
      all.insert(all.end(), (data[kind].*member).begin(), (data[kind].*member).end());
    }
    content.cellArrays.emplace_back(name, std::move(all));
  };
  addCells("BranchId", &CellData::branchId);
  addCells("Label", &CellData::label);
  addCells("Component", &CellData::component);
  addCells("Closed", &CellData::closed);
  addCells("Level", &CellData::level);
  addCells("Strahler", &CellData::strahler);
  addCells("Length", &CellData::length);
  addCells("Tortuosity", &CellData::tortuosity);
  if (HasLives(model))
  {
    addCells("LowestThreshold", &CellData::lowest);
    addCells("HighestThreshold", &CellData::highest);
    addCells("Persistence", &CellData::persistence);
  }
  WriteVtp(path, std::move(content));
}

SkeletonModel
ReadSkeletonVtp(const std::filesystem::path & path)
{
  SkeletonModel model;
  std::string   rounded =
    ReadFrom(path, Precision::AsSaved, "skeleton", [&](ModelSource & source) { model = ReadSkeleton(source); });
  model.rounded = std::move(rounded);
  return model;
}

std::optional<SkeletonModel>
ReadSkeletonIfAny(const std::filesystem::path & path)
{
  bool isSkeleton = false;
  try
  {
    ReadFrom(path, Precision::AsSaved, "skeleton", [&](ModelSource & source) {
      isSkeleton = source.Has("CellData", "BranchId");
    });
  }
  catch (const InputError &)
  {}
  return isSkeleton ? std::optional(ReadSkeletonVtp(path)) : std::nullopt;
}

} // namespace voxelcore
