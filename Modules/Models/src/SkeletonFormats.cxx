#include "TextFile.h"

#include "voxelcore/SkeletonModel.h"

#include <algorithm>
#include <numeric>

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

constexpr std::size_t kFirstSwcType = 5; // lower ones mean parts of neurons

/** A name in a comment. */
std::string
SingleLine(std::string text)
{
  std::ranges::replace_if(
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

} // namespace

void
WriteSwc(const std::filesystem::path & path, const SkeletonModel & model, const MeasureOptions & options)
{
  const bool    inVoxels = model.unit == SpatialUnit::Voxels;
  const double  scale = inVoxels ? 1 : 1000;
  TextFile      file(path, 9);
  std::uint64_t next = 1;
  file << "# VoxelCore curve skeleton\n# " << (inVoxels ? "voxels" : "micrometres")
       << ", LPS axes; radii of round cross-sections\n";
  for (const SkeletonPart & part : model.parts)
  {
    SkeletonGraph graph = part.graph;
    const auto    cuts = CutLoops(graph);
    const auto    table = MeasureBranches(graph, options);
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
    const auto typeOf = [&](ElementIndex point) -> std::size_t {
      if (!part.network)
      {
        return 0;
      }
      const auto & labels = part.network->labels;
      const auto   own = std::ranges::find(labels, graph.labels[point], &NetworkLabel::value);
      return kFirstSwcType + static_cast<std::size_t>(own - labels.begin());
    };
    for (const LoopCut & cut : cuts)
    {
      file << "# a cycle was cut at " << scale * cut.position[0] << " " << scale * cut.position[1] << " "
           << scale * cut.position[2] << "\n";
    }
    std::vector<std::uint64_t> ids(graph.positions.size(), 0);
    const auto                 write = [&](ElementIndex point, std::uint64_t parent) {
      ids[point] = next++;
      file << ids[point] << " " << typeOf(point);
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
    for (std::size_t node = 0; node < graph.nodePoints.size(); ++node)
    {
      if (graph.nodeKinds[node] == NodeKind::Isolated)
      {
        write(graph.nodePoints[node], 0);
      }
    }
    std::vector<ElementIndex> order(graph.BranchCount());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](ElementIndex a, ElementIndex b) {
      return table.branches[a].centrifugal < table.branches[b].centrifugal;
    });
    for (const ElementIndex branch : order)
    {
      std::vector<ElementIndex> points(graph.Branch(branch).begin(), graph.Branch(branch).end());
      if (table.branches[branch].baseIsLast)
      {
        std::reverse(points.begin(), points.end());
      }
      if (ids[points[0]] == 0)
      {
        write(points[0], 0);
      }
      for (std::size_t i = 1; i < points.size(); ++i)
      {
        write(points[i], ids[points[i - 1]]);
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
  file << "  <graph id=\"skeleton\" edgedefault=\"undirected\">\n";
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
      file << "</edge>\n";
    }
  }
  file << "  </graph>\n</graphml>\n";
  file.Finish();
}

} // namespace voxelcore
