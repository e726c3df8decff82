#include "voxelcore/Models/TextFile.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Models/SkeletonModel.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace voxelcore
{

namespace
{

const char *
KindName(NodeKind kind)
{
  switch (kind)
  {
    case NodeKind::Tip:
      return "tip";
    case NodeKind::Junction:
      return "junction";
    case NodeKind::Loop:
      return "loop";
    case NodeKind::Isolated:
      return "isolated";
    case NodeKind::Surface:
      return "surface";
    case NodeKind::Contact:
      return "contact";
  }
  return "";
}

// What SWC's types mean: www.neuronland.org/NLMorphologyConverter/MorphologyFormats/SWC/Spec.html
constexpr std::size_t kSomaType = 1;
constexpr std::size_t kAxonType = 2;
constexpr std::size_t kDendriteType = 3;
constexpr std::size_t kApicalType = 4;
constexpr std::size_t kFirstSwcType = 5; // lower ones mean parts of neurons

/** A name in a comment. */
std::string
SingleLine(std::string text)
{
  ranges::replace_if(
    text,
    [](char c) { return static_cast<unsigned char>(c) < 0x20U; },
    ' ');
  return text;
}

std::int64_t
LabelOfBranch(const SkeletonPart & part, std::size_t branch)
{
  return part.network ? part.graph.BranchLabel(branch) : part.label;
}

/** Of each part, where it has one. */
std::vector<std::optional<Soma>>
SomasOf(const SkeletonModel & model, const std::optional<SomaChoice> & choice)
{
  std::vector<std::optional<Soma>> somas(model.parts.size());
  std::size_t                      nearest = 0;
  double                           least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; choice && i < somas.size(); ++i)
  {
    somas[i] = FindSoma(model.parts[i].graph, choice->place);
    if (choice->place && somas[i])
    {
      const double beyond = Distance(somas[i]->centre, *choice->place) - somas[i]->radius;
      nearest = beyond < least ? i : nearest;
      least = std::min(beyond, least);
    }
  }
  for (std::size_t i = 0; choice && choice->place && i < somas.size(); ++i)
  {
    if (i != nearest)
    {
      somas[i].reset();
    }
  }
  return somas;
}

std::size_t
SwcType(const SkeletonPart & part, const SkeletonGraph & graph, ElementIndex point, bool hasSoma)
{
  if (!part.network)
  {
    return hasSoma ? kDendriteType : 0;
  }
  const auto & labels = part.network->labels;
  const auto   own = ranges::find(labels, graph.labels[point], &NetworkLabel::value);
  if (hasSoma && own != labels.end())
  {
    const std::string name = LowerCase(own->name);
    for (const auto & [word, type] :
         { std::pair("apical", kApicalType), std::pair("axon", kAxonType), std::pair("dendrite", kDendriteType) })
    {
      if (name.find(word) != std::string::npos)
      {
        return type;
      }
    }
  }
  return kFirstSwcType + static_cast<std::size_t>(own - labels.begin());
}

void
WriteSwcHead(TextFile & file, const SkeletonPart & part, bool hasSoma)
{
  if (!part.network)
  {
    file << "# label " << part.label << "\n";
  }
  else
  {
    file << "# network of labels; the type is " << kFirstSwcType << " and the label's place in this list\n";
    for (const NetworkLabel & label : part.network->labels)
    {
      file << "# label " << label.value << " " << SingleLine(label.name) << "\n";
    }
  }
  if (hasSoma)
  {
    file << "# the soma is type " << kSomaType << "; branches begin at its surface, with type " << kDendriteType
         << (part.network ? " or, by the names of labels, 2 (axon), 3 (dendrite), 4 (apical)\n" : "\n");
  }
}

/** Branches of a forest with whether their last point is nearer to the root, each after the one it hangs on: from the
 *  soma's point on, then those that do not reach it, by their hierarchy. */
std::vector<std::pair<ElementIndex, bool>>
BranchesOutwards(const SkeletonGraph & graph, ElementIndex somaPoint, const MeasureOptions & options)
{
  std::vector<std::pair<ElementIndex, bool>> branches;
  std::vector<std::uint8_t>                  isTaken(graph.BranchCount(), 0);
  std::vector<std::vector<ElementIndex>>     at(graph.nodePoints.size());
  for (ElementIndex branch = 0; branch < graph.BranchCount(); ++branch)
  {
    at[graph.branchNodes[branch][0]].push_back(branch);
    at[graph.branchNodes[branch][1]].push_back(branch);
  }
  std::vector<ElementIndex> nodes;
  for (ElementIndex node = 0; node < graph.nodePoints.size(); ++node)
  {
    if (graph.nodePoints[node] == somaPoint)
    {
      nodes.push_back(node);
    }
  }
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    const ElementIndex node = nodes[i];
    for (const ElementIndex branch : at[node])
    {
      if (!std::exchange(isTaken[branch], 1))
      {
        const auto [first, last] = graph.branchNodes[branch];
        branches.emplace_back(branch, first != node);
        nodes.push_back(first == node ? last : first);
      }
    }
  }
  const auto                table = MeasureBranches(graph, options);
  std::vector<ElementIndex> order(graph.BranchCount());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](ElementIndex a, ElementIndex b) {
    return table.branches[a].centrifugal < table.branches[b].centrifugal;
  });
  for (const ElementIndex branch : order)
  {
    if (!isTaken[branch])
    {
      branches.emplace_back(branch, table.branches[branch].baseIsLast);
    }
  }
  return branches;
}

} // namespace

void
WriteSwc(const std::filesystem::path &     path,
         const SkeletonModel &             model,
         const MeasureOptions &            options,
         const std::optional<SomaChoice> & soma)
{
  const bool    inVoxels = model.unit == SpatialUnit::Voxels;
  const double  scale = inVoxels ? 1 : 1000;
  TextFile      file(path, 9);
  std::uint64_t next = 1;
  const auto    somas = SomasOf(model, soma);
  file << "# VoxelCore curve skeleton\n# " << (inVoxels ? "voxels" : "micrometres")
       << ", LPS axes; radii of round cross-sections\n";
  for (std::size_t i = 0; i < model.parts.size(); ++i)
  {
    const SkeletonPart &       part = model.parts[i];
    const bool                 hasSoma = somas[i].has_value();
    SomaTree                   tree = hasSoma ? CutAtSoma(part.graph, *somas[i]) : SomaTree{ part.graph, 0, {} };
    SkeletonGraph &            graph = tree.graph;
    const ElementIndex         somaPoint = hasSoma ? graph.nodePoints[tree.root] : kNoBranch;
    std::vector<LoopCut>       cuts = std::move(tree.cuts);
    const std::vector<LoopCut> others = CutLoops(graph);
    cuts.insert(cuts.end(), others.begin(), others.end());
    WriteSwcHead(file, part, hasSoma);
    for (const LoopCut & cut : cuts)
    {
      file << "# a cycle was cut at " << scale * cut.position[0] << " " << scale * cut.position[1] << " "
           << scale * cut.position[2] << "\n";
    }
    std::vector<std::uint64_t> ids(graph.positions.size(), 0);
    const auto                 write = [&](ElementIndex point, std::uint64_t parent) {
      ids[point] = next++;
      file << ids[point] << " " << (point == somaPoint ? kSomaType : SwcType(part, graph, point, hasSoma));
      for (const double coordinate : graph.positions[point])
      {
        file << " " << scale * coordinate;
      }
      file << " " << scale * SectionRadii(graph)[point] << " ";
      if (parent == 0)
      {
        file << "-1\n";
      }
      else
      {
        file << parent << "\n";
      }
    };
    if (hasSoma)
    {
      write(somaPoint, 0);
    }
    for (std::size_t node = 0; node < graph.nodePoints.size(); ++node)
    {
      if (graph.nodeKinds[node] == NodeKind::Isolated && ids[graph.nodePoints[node]] == 0)
      {
        write(graph.nodePoints[node], 0);
      }
    }
    for (const auto & [branch, isBackwards] : BranchesOutwards(graph, somaPoint, options))
    {
      std::vector<ElementIndex> points(graph.Branch(branch).begin(), graph.Branch(branch).end());
      if (isBackwards)
      {
        std::reverse(points.begin(), points.end());
      }
      if (ids[points[0]] == 0)
      {
        write(points[0], 0);
      }
      for (std::size_t k = 1; k < points.size(); ++k)
      {
        write(points[k], ids[points[k - 1]]);
      }
    }
  }
  file.Finish();
}

void
WriteMarkups(const std::filesystem::path & path, const SkeletonModel & model)
{
  const std::string unit = UnitName(model.unit);
  TextFile          file(path, 9);
  file << "{\n  \"@schema\": "
          "\"https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/"
          "markups-schema-v1.0.3.json#\",\n  \"markups\": [";
  bool first = true;
  for (const SkeletonPart & part : model.parts)
  {
    for (std::size_t branch = 0; branch < part.graph.BranchCount(); ++branch)
    {
      file << (first ? "\n" : ",\n") << "    {\"type\": \"Curve\", \"name\": \"label " << LabelOfBranch(part, branch)
           << " branch " << branch << "\", \"coordinateSystem\": \"LPS\", \"coordinateUnits\": \"" << unit
           << "\",\n     \"controlPoints\": [";
      first = false;
      std::uint64_t id = 0;
      for (const ElementIndex point : part.graph.Branch(branch))
      {
        const auto & p = part.graph.positions[point];
        file << (id > 0 ? ",\n       " : "\n       ") << "{\"id\": \"" << id + 1
             << "\", \"label\": \"\", \"position\": [" << p[0] << ", " << p[1] << ", " << p[2]
             << "], \"positionStatus\": \"defined\"}";
        ++id;
      }
      file << "],\n     \"measurements\": [{\"name\": \"Radius\", \"enabled\": true, \"units\": \"" << unit
           << "\", "
              "\"controlPointValues\": [";
      bool firstValue = true;
      for (const ElementIndex point : part.graph.Branch(branch))
      {
        file << (firstValue ? "" : ", ") << SectionRadii(part.graph)[point];
        firstValue = false;
      }
      file << "]}]}";
    }
  }
  file << "\n  ]\n}\n";
  file.Finish();
}

void
WriteGraphMl(const std::filesystem::path & path, const SkeletonModel & model)
{
  TextFile file(path, 9);
  file << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n";
  const auto key = [&](const char * id, const char * of, const char * type) {
    file << "  <key id=\"" << id << "\" for=\"" << of << "\" attr.name=\"" << id << "\" attr.type=\"" << type
         << "\"/>\n";
  };
  for (const char * name : { "x", "y", "z", "radius", "ball_radius" })
  {
    key(name, "node", "double");
  }
  key("kind", "node", "string");
  key("label", "all", "long");
  for (const char * name :
       { "length", "chord", "mean_radius", "min_radius", "max_radius", "mean_ball_radius", "volume", "surface" })
  {
    key(name, "edge", "double");
  }
  for (const char * name : { "branch_id", "strahler", "level" })
  {
    key(name, "edge", "int");
  }
  key("points", "edge", "string");
  key("unit", "graph", "string");
  file << "  <graph id=\"skeleton\" edgedefault=\"undirected\">\n    <data key=\"unit\">"
       << std::string_view(UnitName(model.unit)) << "</data>\n";
  for (std::size_t p = 0; p < model.parts.size(); ++p)
  {
    const SkeletonPart & part = model.parts[p];
    const auto           data = [&](const char * name, auto value) {
      file << "<data key=\"" << name << "\">" << value << "</data>";
    };
    for (std::size_t node = 0; node < part.graph.nodePoints.size(); ++node)
    {
      const ElementIndex point = part.graph.nodePoints[node];
      file << "    <node id=\"p" << p << "n" << node << "\">";
      data("x", part.graph.positions[point][0]);
      data("y", part.graph.positions[point][1]);
      data("z", part.graph.positions[point][2]);
      data("radius", SectionRadii(part.graph)[point]);
      data("ball_radius", part.graph.radius[point]);
      data("kind", std::string_view(KindName(part.graph.nodeKinds[node])));
      data("label", part.network ? part.graph.labels[point] : part.label);
      file << "</node>\n";
    }
    for (std::size_t branch = 0; branch < part.graph.BranchCount(); ++branch)
    {
      const BranchRecord & record = part.table.branches[branch];
      file << "    <edge source=\"p" << p << "n" << part.graph.branchNodes[branch][0] << "\" target=\"p" << p << "n"
           << part.graph.branchNodes[branch][1] << "\">";
      data("label", LabelOfBranch(part, branch));
      data("length", record.length);
      data("chord", record.chord);
      data("mean_radius", record.meanRadius);
      data("min_radius", record.minRadius);
      data("max_radius", record.maxRadius);
      data("mean_ball_radius", record.meanBallRadius);
      data("volume", record.volume);
      data("surface", record.surface);
      data("branch_id", branch);
      data("strahler", record.strahler);
      data("level", record.level);
      const auto points = part.graph.Branch(branch);
      file << "<data key=\"points\">";
      for (std::size_t i = 1; i + 1 < points.size(); ++i)
      {
        const Vector3 & place = part.graph.positions[points[i]];
        file << std::string_view(i > 1 ? " " : "") << place[0] << " " << place[1] << " " << place[2] << " "
             << SectionRadii(part.graph)[points[i]];
      }
      file << "</data></edge>\n";
    }
  }
  file << "  </graph>\n</graphml>\n";
  file.Finish();
}

void
WriteSkeletonObj(const std::filesystem::path & path, const SkeletonModel & model)
{
  TextFile file(path, 9);
  file << "# VoxelCore curve skeleton, " << std::string_view(model.unit == SpatialUnit::Voxels ? "voxels" : "mm")
       << "\n# SPACE=LPS\n";
  std::uint64_t before = 1; // OBJ counts from 1, over all objects
  for (const SkeletonPart & part : model.parts)
  {
    file << "o label_" << part.label;
    if (part.component > 0)
    {
      file << "_" << part.component;
    }
    file << "\n";
    for (const auto & p : part.graph.positions)
    {
      file << "v " << p[0] << " " << p[1] << " " << p[2] << "\n";
    }
    for (std::size_t branch = 0; branch < part.graph.BranchCount(); ++branch)
    {
      file << "g branch_" << branch << "\nl";
      for (const ElementIndex point : part.graph.Branch(branch))
      {
        file << " " << before + point;
      }
      file << "\n";
    }
    for (std::size_t node = 0; node < part.graph.nodePoints.size(); ++node)
    {
      if (part.graph.nodeKinds[node] == NodeKind::Isolated)
      {
        file << "p " << before + part.graph.nodePoints[node] << "\n";
      }
    }
    before += part.graph.positions.size();
  }
  file.Finish();
}

} // namespace voxelcore
