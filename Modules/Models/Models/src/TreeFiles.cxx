#include "voxelcore/Models/TreeFiles.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParseReal.h"
#include "voxelcore/Base/XmlWalk.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <sstream>

namespace voxelcore
{

namespace
{

constexpr std::size_t kMostTreePoints = std::size_t{ 1 } << 30; ///< numbers of points have 32 bits

std::string
ReadText(const std::filesystem::path & path)
{
  std::ifstream     file(path, std::ios::binary);
  const std::string text{ std::istreambuf_iterator<char>(file), {} };
  if (!file)
  {
    throw InputError(path.string() + ": cannot read this file; check its name and permissions");
  }
  return text;
}

/** Points and the lines between two of them. */
struct Edges
{
  std::vector<Vector3>                     positions;
  std::vector<double>                      radius;
  std::vector<std::array<ElementIndex, 2>> edges;
};

/** Branches from points where not just two edges meet, then closed curves. */
SkeletonGraph
GraphOfEdges(Edges given)
{
  std::vector<std::vector<std::size_t>> at(given.positions.size());
  for (std::size_t edge = 0; edge < given.edges.size(); ++edge)
  {
    at[given.edges[edge][0]].push_back(edge);
    at[given.edges[edge][1]].push_back(edge);
  }
  std::vector<std::vector<ElementIndex>> lines;
  std::vector<std::uint8_t>              isTaken(given.edges.size(), 0);
  const auto                             follow = [&](ElementIndex from, std::size_t edge) {
    std::vector<ElementIndex> line{ from };
    while (isTaken[edge] == 0)
    {
      isTaken[edge] = 1;
      const auto [one, two] = given.edges[edge];
      line.push_back(one == line.back() ? two : one);
      const auto & next = at[line.back()];
      if (next.size() != 2)
      {
        break;
      }
      edge = next[0] == edge ? next[1] : next[0];
    }
    lines.push_back(std::move(line));
  };
  for (const bool closed : { false, true })
  {
    for (ElementIndex point = 0; point < at.size(); ++point)
    {
      for (const std::size_t edge : at[point])
      {
        if (isTaken[edge] == 0 && (closed || at[point].size() != 2))
        {
          follow(point, edge);
        }
      }
    }
  }
  SkeletonGraph graph;
  graph.positions = std::move(given.positions);
  graph.erosionThickness.assign(graph.positions.size(), 0);
  graph.radius = std::move(given.radius);
  SortBranches(graph, lines, false);
  return graph;
}

// ---- SWC

SkeletonModel
ReadSwc(const std::filesystem::path & path)
{
  const auto unfit = [&](std::size_t number, const std::string & what) {
    return InputError(path.string() + ", line " + std::to_string(number) + ": " + what);
  };
  std::istringstream                   text(ReadText(path));
  Edges                                edges;
  SkeletonModel                        model;
  double                               scale = 1e-3; // micrometres
  std::map<std::int64_t, ElementIndex> known;
  std::string                          line;
  for (std::size_t number = 1; std::getline(text, line); ++number)
  {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos)
    {
      continue;
    }
    if (line[begin] == '#')
    {
      if (edges.positions.empty() && line.starts_with("# voxels, LPS axes"))
      {
        model.unit = SpatialUnit::Voxels;
        scale = 1;
      }
      continue;
    }
    std::istringstream    words(line);
    std::array<double, 7> values{};
    std::string           word;
    for (double & value : values)
    {
      const auto read = words >> word ? ParseReal(word) : std::nullopt;
      if (!read || !std::isfinite(*read) || std::abs(*read) > 1e15)
      {
        throw unfit(number, "expected seven numbers: id, type, x, y, z, radius, parent");
      }
      value = *read;
    }
    const auto id = static_cast<std::int64_t>(values[0]);
    const auto parent = static_cast<std::int64_t>(values[6]);
    const auto point = static_cast<ElementIndex>(edges.positions.size());
    if (values[5] < 0 || point >= kMostTreePoints || !known.emplace(id, point).second)
    {
      throw unfit(number, values[5] < 0 ? "a radius is below 0" : "its id was given already");
    }
    edges.positions.push_back({ scale * values[2], scale * values[3], scale * values[4] });
    edges.radius.push_back(scale * values[5]);
    if (parent >= 0)
    {
      const auto found = known.find(parent);
      if (found == known.end() || found->second == point)
      {
        throw unfit(number, "its parent must come before it");
      }
      edges.edges.push_back({ found->second, point });
    }
  }
  if (edges.positions.empty())
  {
    throw InputError(path.string() + ": holds no point of a tree; give the file of another, or export it anew");
  }
  model.parts.emplace_back();
  model.parts[0].graph = GraphOfEdges(std::move(edges));
  return model;
}

/** Why a tree is refused, without its file. */
struct TreeRefused
{
  std::string what;
};

/** A pass over an XML file that holds a tree. */
class TreeWalk : protected XmlWalk
{
public:
  std::string wrong; ///< with the file; empty: nothing

protected:
  void
  Take(std::string_view text)
  {
    try
    {
      wrong = Walk([&](char * to, std::size_t most) {
        const std::size_t size = text.copy(to, most);
        text.remove_prefix(size);
        return size;
      });
    }
    catch (const TreeRefused & refused)
    {
      wrong = refused.what;
    }
  }
};

// ---- RSML

struct Root
{
  std::vector<Vector3> points;
  std::vector<double>  diameters;
  std::size_t          parent = std::numeric_limits<std::size_t>::max();
};

/** Reads the roots out of the tags. */
class RsmlWalk : public TreeWalk
{
public:
  explicit RsmlWalk(std::string_view text)
  {
    Take(text);
  }

  std::vector<Root> roots;
  std::string       unit;
  std::string       resolution;

private:
  void
  Begin(const std::string & name, const XmlAttributes & attributes, const std::string & above) override
  {
    m_Text.clear();
    if (name == "root")
    {
      roots.emplace_back();
      if (!m_Open.empty())
      {
        roots.back().parent = m_Open.back();
      }
      m_Open.push_back(roots.size() - 1);
    }
    else if (name == "function")
    {
      m_IsDiameter = AttributeOf(attributes, "name") == "diameter";
    }
    else if (name == "point" && above == "polyline" && !m_Open.empty())
    {
      Vector3 place{};
      for (std::size_t k = 0; k < 3; ++k)
      {
        const auto number = ParseReal(AttributeOf(attributes, k == 0 ? "x" : k == 1 ? "y" : "z", k == 2 ? "0" : ""));
        if (!number || !std::isfinite(*number))
        {
          throw TreeRefused{ "a point of a polyline has no x, y or z that is a number" };
        }
        place[k] = *number;
      }
      roots[m_Open.back()].points.push_back(place);
    }
    const auto found = attributes.find("value");
    m_Value = found == attributes.end() ? std::nullopt : std::optional(found->second);
  }

  void
  End(const std::string & name, const std::string & above) override
  {
    if (name == "root")
    {
      m_Open.pop_back();
    }
    else if (name == "sample" && m_IsDiameter && !m_Open.empty())
    {
      const auto number = ParseReal(m_Value.value_or(m_Text));
      if (!number || !(*number >= 0) || !std::isfinite(*number))
      {
        throw TreeRefused{ "a diameter is no number from 0 on" };
      }
      roots[m_Open.back()].diameters.push_back(*number);
    }
    else if (above == "metadata" && (name == "unit" || name == "resolution"))
    {
      (name == "unit" ? unit : resolution) = m_Text;
    }
  }

  void
  Text(std::string_view text, const std::string &) override
  {
    m_Text.append(text);
  }

  std::vector<std::size_t>   m_Open; ///< roots within each other
  std::string                m_Text;
  std::optional<std::string> m_Value;
  bool                       m_IsDiameter = false;
};

SkeletonModel
ReadRsml(const std::filesystem::path & path)
{
  const RsmlWalk walk(ReadText(path));
  const auto     refuse = [&](const std::string & what) {
    throw InputError(path.string() + ": " + what + "; export it anew from the program that made it");
  };
  if (!walk.wrong.empty())
  {
    refuse(walk.wrong);
  }
  static const std::map<std::string, double> scales{ { "mm", 1 },
                                                     { "cm", 10 },
                                                     { "m", 1000 },
                                                     { "um", 1e-3 },
                                                     { "pixel", 1 } };
  const auto                                 scale = scales.find(walk.unit);
  if (scale == scales.end() || !(walk.resolution.empty() || ParseReal(walk.resolution) == 1.0))
  {
    refuse("its unit is '" + walk.unit + "' with the resolution '" + walk.resolution +
           "'; expected mm, cm, m, um or pixel with the resolution 1");
  }
  SkeletonModel model;
  model.unit = walk.unit == "pixel" ? SpatialUnit::Voxels : SpatialUnit::Millimetres;
  Edges                                  edges;
  std::vector<std::vector<ElementIndex>> pointsOf(walk.roots.size());
  for (std::size_t number = 0; number < walk.roots.size(); ++number)
  {
    const Root & root = walk.roots[number];
    if (!root.diameters.empty() && root.diameters.size() != root.points.size())
    {
      refuse("a root has another number of diameters than of points");
    }
    std::vector<ElementIndex> & points = pointsOf[number];
    for (std::size_t i = 0; i < root.points.size(); ++i)
    {
      const Vector3 place{ scale->second * root.points[i][0],
                           scale->second * root.points[i][1],
                           scale->second * root.points[i][2] };
      ElementIndex  before = i > 0 ? points.back() : kNoBranch;
      if (i == 0 && root.parent < number && !pointsOf[root.parent].empty())
      {
        before = *ranges::min_element(pointsOf[root.parent], {}, [&](ElementIndex point) {
          return Distance(edges.positions[point], place);
        });
        if (edges.positions[before] == place)
        {
          points.push_back(before);
          continue;
        }
      }
      points.push_back(static_cast<ElementIndex>(edges.positions.size()));
      edges.positions.push_back(place);
      edges.radius.push_back(root.diameters.empty() ? 0 : scale->second * root.diameters[i] / 2);
      if (before != kNoBranch)
      {
        edges.edges.push_back({ before, points.back() });
      }
    }
  }
  if (edges.positions.empty())
  {
    refuse("holds no root with points");
  }
  model.parts.emplace_back();
  model.parts[0].graph = GraphOfEdges(std::move(edges));
  return model;
}

// ---- GraphML

/** Points and edges, as the tags have them. */
class GraphMlWalk : public TreeWalk
{
public:
  explicit GraphMlWalk(std::string_view text)
  {
    Take(text);
  }

  Edges       edges;
  std::string unit; ///< empty where it is not said

private:
  struct Link
  {
    std::string source;
    std::string target;
    std::string points;
  };

  void
  Begin(const std::string & name, const XmlAttributes & attributes, const std::string & /*within*/) override
  {
    m_Text.clear();
    if (name == "key")
    {
      m_NameOf[AttributeOf(attributes, "id")] = AttributeOf(attributes, "attr.name");
    }
    else if (name == "node")
    {
      if (edges.positions.size() >= kMostPoints ||
          !m_PointOf.emplace(AttributeOf(attributes, "id"), static_cast<ElementIndex>(edges.positions.size())).second)
      {
        throw TreeRefused{ "two nodes have the id '" + AttributeOf(attributes, "id") + "'" };
      }
      edges.positions.push_back({ kUnset, kUnset, 0 });
      edges.radius.push_back(0);
    }
    else if (name == "edge")
    {
      m_Links.push_back({ AttributeOf(attributes, "source"), AttributeOf(attributes, "target"), "" });
    }
    else if (name == "data")
    {
      const auto found = m_NameOf.find(AttributeOf(attributes, "key"));
      m_Data = found == m_NameOf.end() ? std::string() : found->second;
    }
  }

  void
  End(const std::string & name, const std::string & within) override
  {
    if (name == "node" && !(edges.positions.back()[0] < kUnset && edges.positions.back()[1] < kUnset))
    {
      throw TreeRefused{ "a node has no data named x and y" };
    }
    if (name == "graphml")
    {
      ranges::for_each(m_Links, [&](const Link & link) { AddLink(link); });
    }
    if (name != "data")
    {
      return;
    }
    if (within == "graph" && m_Data == "unit")
    {
      unit = m_Text;
    }
    else if (within == "edge" && m_Data == "points")
    {
      m_Links.back().points = m_Text;
    }
    else if (within == "node")
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        if (m_Data == std::array{ "x", "y", "z" }[k])
        {
          edges.positions.back()[k] = Number(m_Text);
        }
      }
      if (m_Data == "radius")
      {
        edges.radius.back() = Radius(m_Text);
      }
    }
  }

  void
  Text(std::string_view text, const std::string & /*tag*/) override
  {
    m_Text.append(text);
  }

  static double
  Number(const std::string & text)
  {
    const auto number = ParseReal(text);
    if (!number || !(std::abs(*number) < kUnset))
    {
      throw TreeRefused{ "'" + text.substr(0, 40) + "' of a node or of points is no number" };
    }
    return *number;
  }

  static double
  Radius(const std::string & text)
  {
    const double radius = Number(text);
    if (radius < 0)
    {
      throw TreeRefused{ "a radius is below 0" };
    }
    return radius;
  }

  /** An edge's points, and the pieces between them. */
  void
  AddLink(const Link & link)
  {
    const auto from = m_PointOf.find(link.source);
    const auto to = m_PointOf.find(link.target);
    if (from == m_PointOf.end() || to == m_PointOf.end())
    {
      throw TreeRefused{ "an edge has an end that is no node's id: '" +
                         (from == m_PointOf.end() ? link.source : link.target) + "'" };
    }
    ElementIndex             last = from->second;
    std::istringstream       words(link.points);
    std::vector<std::string> four(4);
    while (words >> four[0])
    {
      if (!(words >> four[1] >> four[2] >> four[3]) || edges.positions.size() >= kMostPoints)
      {
        throw TreeRefused{ "points of an edge are not four numbers each: x y z radius" };
      }
      const auto next = static_cast<ElementIndex>(edges.positions.size());
      edges.positions.push_back({ Number(four[0]), Number(four[1]), Number(four[2]) });
      edges.radius.push_back(Radius(four[3]));
      edges.edges.push_back({ last, next });
      last = next;
    }
    if (last != to->second)
    {
      edges.edges.push_back({ last, to->second });
    }
  }

  static constexpr double kUnset = 1e300;

  std::map<std::string, std::string>  m_NameOf; ///< of data, by their keys
  std::map<std::string, ElementIndex> m_PointOf;
  std::vector<Link>                   m_Links;
  std::string                         m_Data; ///< the open one's name
  std::string                         m_Text;
};

SkeletonModel
ReadGraphMl(const std::filesystem::path & path)
{
  GraphMlWalk walk(ReadText(path));
  if (walk.wrong.empty() && walk.edges.positions.empty())
  {
    walk.wrong = "holds no node of a graph";
  }
  if (walk.wrong.empty() && !(walk.unit.empty() || walk.unit == UnitName(SpatialUnit::Millimetres) ||
                              walk.unit == UnitName(SpatialUnit::Voxels)))
  {
    walk.wrong = "its unit is '" + walk.unit + "'; expected mm or voxels";
  }
  if (!walk.wrong.empty())
  {
    throw InputError(path.string() + ": " + walk.wrong + "; export it anew from the program that made it");
  }
  SkeletonModel model;
  model.unit = walk.unit == UnitName(SpatialUnit::Voxels) ? SpatialUnit::Voxels : SpatialUnit::Millimetres;
  model.parts.emplace_back();
  model.parts[0].graph = GraphOfEdges(std::move(walk.edges));
  return model;
}

} // namespace

bool
IsTreePath(const std::filesystem::path & path)
{
  return path.extension() == ".swc" || path.extension() == ".rsml" || path.extension() == ".graphml";
}

SkeletonModel
ReadTreeFile(const std::filesystem::path & path)
{
  SkeletonModel model = path.extension() == ".swc"    ? ReadSwc(path)
                        : path.extension() == ".rsml" ? ReadRsml(path)
                                                      : ReadGraphMl(path);
  model.parts[0].label = 1;
  model.parts[0].name = path.stem().string();
  return model;
}

SkeletonGraph
MergedGraph(const SkeletonModel & model, const BranchChoice & choice)
{
  Edges all;
  for (std::size_t part = 0; part < model.parts.size(); ++part)
  {
    const SkeletonGraph &     graph = model.parts[part].graph;
    std::vector<ElementIndex> numbers(graph.positions.size(), kNoBranch);
    const auto                numberOf = [&](ElementIndex point) {
      if (numbers[point] == kNoBranch)
      {
        numbers[point] = static_cast<ElementIndex>(all.positions.size());
        all.positions.push_back(graph.positions[point]);
        all.radius.push_back(SectionRadii(graph)[point]);
      }
      return numbers[point];
    };
    for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
    {
      const auto points = graph.Branch(branch);
      for (std::size_t i = 1; i < points.size() && (!choice || choice(part, branch)); ++i)
      {
        const ElementIndex first = numberOf(points[i - 1]);
        all.edges.push_back({ first, numberOf(points[i]) });
      }
    }
    for (std::size_t node = 0; node < graph.nodePoints.size() && !choice; ++node)
    {
      numberOf(graph.nodePoints[node]);
    }
  }
  return GraphOfEdges(std::move(all));
}

} // namespace voxelcore
