#include "RefinedTolerances.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/VoxelCore/ExtractPart.h"
#include "voxelcore/VoxelCore/TolerancePruning.h"

#include <algorithm>
#include <array>
#include <compare>
#include <functional>
#include <queue>
#include <span>
#include <utility>

namespace voxelcore
{

namespace
{

bool
IsPartOf(std::span<const ElementIndex> polygon, const std::array<ElementIndex, 3> & corners)
{
  return std::all_of(corners.begin(), corners.end(), [&](ElementIndex corner) {
    return std::find(polygon.begin(), polygon.end(), corner) != polygon.end();
  });
}

/** Of connected vertices that were taken off the greatest height, given to all that hung on them. `heights`: of what
 *  was there; `isKept` by its vertices. */
void
PassOn(const CellComplex & polygons, const std::vector<std::uint8_t> & isKept, std::vector<double> & heights)
{
  UnionFind taken(polygons.vertexCount);
  for (const auto & [a, b] : polygons.edges)
  {
    if (isKept[a] == 0 && isKept[b] == 0)
    {
      taken.Unite(a, b);
    }
  }
  std::vector<double> greatest(polygons.vertexCount, 0);
  for (std::size_t vertex = 0; vertex < isKept.size(); ++vertex)
  {
    double & one = greatest[taken.Find(vertex)];
    one = std::max(one, isKept[vertex] == 0 ? heights[vertex] : 0);
  }
  for (const auto & [a, b] : polygons.edges)
  {
    if (isKept[a] != isKept[b])
    {
      const ElementIndex stays = isKept[a] != 0 ? a : b;
      heights[stays] = std::max(heights[stays], greatest[taken.Find(stays == a ? b : a)]);
    }
  }
}

/** Raises heights to those at which elements go by simple pairs, whose own heights both say so; `never`, which none of
 *  them exceeds, for what never does. */
void
RaiseToRemoval(const CellComplex & cells, double never, ToleranceValues & values)
{
  struct Pair
  {
    double       height;
    bool         isFace; ///< with an edge; else an edge with a vertex
    ElementIndex upper;
    ElementIndex lower;
    auto
    operator<=>(const Pair &) const = default;
  };
  std::vector<Cofaces>                                         edgesAt = CountVertexCofaces(cells);
  std::vector<Cofaces>                                         facesAt = CountEdgeCofaces(cells);
  std::priority_queue<Pair, std::vector<Pair>, std::greater<>> free;
  ToleranceValues                                              raised;
  raised.vertices.assign(values.vertices.size(), never);
  raised.edges.assign(values.edges.size(), never);
  raised.faces.assign(values.faces.size(), never);
  std::vector<std::uint8_t> edgeIsGone(cells.edges.size(), 0);
  const auto                add = [&](bool isFace, ElementIndex upper, ElementIndex lower) {
    const double height = isFace ? std::max(values.faces[upper], values.edges[lower])
                                                : std::max(values.edges[upper], values.vertices[lower]);
    if (height < never)
    {
      free.push({ height, isFace, upper, lower });
    }
  };
  const auto addEdge = [&](ElementIndex edge) {
    if (facesAt[edge].count == 1)
    {
      add(true, facesAt[edge].exclusiveOr, edge);
    }
  };
  const auto addVertex = [&](ElementIndex vertex) {
    const Cofaces & at = edgesAt[vertex];
    if (at.count == 1 && facesAt[at.exclusiveOr].count == 0)
    {
      add(false, at.exclusiveOr, vertex);
    }
  };
  for (ElementIndex edge = 0; edge < cells.edges.size(); ++edge)
  {
    addEdge(edge);
  }
  for (ElementIndex vertex = 0; vertex < cells.vertexCount; ++vertex)
  {
    addVertex(vertex);
  }
  const auto dropEdge = [&](ElementIndex edge, double level) {
    raised.edges[edge] = level;
    edgeIsGone[edge] = 1;
    for (const ElementIndex end : cells.edges[edge])
    {
      edgesAt[end].Remove(edge);
    }
  };
  for (double level = 0; !free.empty();)
  {
    const Pair pair = free.top();
    free.pop();
    if (pair.isFace ? facesAt[pair.lower].count != 1 : edgeIsGone[pair.upper] != 0 || edgesAt[pair.lower].count != 1)
    {
      continue;
    }
    level = std::max(level, pair.height);
    if (!pair.isFace)
    {
      dropEdge(pair.upper, level);
      raised.vertices[pair.lower] = level;
      addVertex(cells.edges[pair.upper][0] ^ cells.edges[pair.upper][1] ^ pair.lower);
      continue;
    }
    raised.faces[pair.upper] = level;
    dropEdge(pair.lower, level);
    for (const ElementIndex edge : cells.FaceEdges(pair.upper))
    {
      facesAt[edge].Remove(pair.upper);
      if (edge != pair.lower)
      {
        addEdge(edge);
      }
    }
    for (const ElementIndex edge : cells.FaceEdges(pair.upper))
    {
      std::for_each(cells.edges[edge].begin(), cells.edges[edge].end(), addVertex);
    }
  }
  values = std::move(raised);
}

} // namespace

ToleranceValues
TolerancesOfTriangles(const CellComplex &               triangles,
                      const std::vector<ElementIndex> & kept,
                      const std::vector<ElementIndex> & polygons,
                      const MedialComplex &             whole,
                      double                            height)
{
  PartElements      left;
  const CellComplex core =
    ExtractLive(whole.cells, LeftByTolerance(whole, height), left.vertices, left.edges, left.faces);
  if (kept.size() != triangles.vertexCount || (!kept.empty() && kept.back() >= core.vertexCount))
  {
    throw Error("a refined core has other vertices than its tolerance leaves");
  }
  if (polygons.size() != triangles.FaceCount())
  {
    throw Error("a refined core does not say what its triangles are parts of");
  }
  ToleranceValues           values;
  std::vector<std::uint8_t> isKept(core.vertexCount, 0);
  std::vector<double>       heights(core.vertexCount);
  for (std::size_t vertex = 0; vertex < heights.size(); ++vertex)
  {
    heights[vertex] = whole.tolerances.vertices[left.vertices[vertex]];
  }
  for (const ElementIndex vertex : kept)
  {
    isKept[vertex] = 1;
  }
  const bool isWhole = kept.size() == core.vertexCount;
  if (!isWhole)
  {
    PassOn(core, isKept, heights);
  }
  values.vertices.reserve(kept.size());
  for (const ElementIndex vertex : kept)
  {
    values.vertices.push_back(heights[vertex]);
  }
  values.faces.resize(triangles.FaceCount());
  values.edges.resize(triangles.edges.size());
  std::vector<std::uint8_t> isKnown(triangles.edges.size(), 0);
  for (std::size_t face = 0; face < values.faces.size(); ++face)
  {
    const auto         own = triangles.FaceVertices(face);
    const ElementIndex polygon = polygons[face];
    if (polygon >= core.FaceCount() ||
        !IsPartOf(core.FaceVertices(polygon), { kept[own[0]], kept[own[1]], kept[own[2]] }))
    {
      throw Error("a refined core has a triangle that is part of no face");
    }
    values.faces[face] = whole.tolerances.faces[left.faces[polygon]];
    for (const ElementIndex edge : triangles.FaceEdges(face))
    {
      values.edges[edge] = values.faces[face];
      isKnown[edge] = 1;
    }
  }
  // Those that are no cuts are edges of the core.
  std::size_t edge = 0;
  for (std::size_t own = 0; own < core.edges.size(); ++own)
  {
    const auto ends = [&] {
      return std::array<ElementIndex, 2>{ kept[triangles.edges[edge][0]], kept[triangles.edges[edge][1]] };
    };
    while (edge < values.edges.size() && ends() < core.edges[own])
    {
      ++edge;
    }
    if (edge < values.edges.size() && ends() == core.edges[own])
    {
      values.edges[edge] = whole.tolerances.edges[left.edges[own]];
      isKnown[edge] = 1;
    }
    else if (isKept[core.edges[own][0]] != 0 && isKept[core.edges[own][1]] != 0)
    {
      throw Error("a refined core lacks an edge that its tolerance leaves");
    }
  }
  if (std::find(isKnown.begin(), isKnown.end(), 0) != isKnown.end())
  {
    throw Error("a refined core has an edge that its tolerance does not leave");
  }
  if (!isWhole)
  {
    RaiseToRemoval(triangles, GreatestTolerance(whole), values);
  }
  RaiseTolerances(values, height);
  return values;
}

} // namespace voxelcore
