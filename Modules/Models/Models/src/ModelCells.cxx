#include "ModelCells.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Models/MedialModel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace voxelcore
{

std::vector<ElementIndex>
IsolatedVertices(const CellComplex & cells)
{
  std::vector<std::uint8_t> onEdge(cells.vertexCount, 0);
  for (const auto & edge : cells.edges)
  {
    onEdge[edge[0]] = 1;
    onEdge[edge[1]] = 1;
  }
  std::vector<ElementIndex> isolated;
  for (std::size_t v = 0; v < cells.vertexCount; ++v)
  {
    if (!onEdge[v])
    {
      isolated.push_back(static_cast<ElementIndex>(v));
    }
  }
  return isolated;
}

std::vector<std::uint8_t>
EdgesOnFaces(const CellComplex & cells)
{
  std::vector<std::uint8_t> onFace(cells.edges.size(), 0);
  for (const ElementIndex edge : cells.faceEdges)
  {
    onFace[edge] = 1;
  }
  return onFace;
}

void
RequireEdgeMeasures(const MedialComplex & core)
{
  const std::vector<std::uint8_t> onFace = EdgesOnFaces(core.cells);
  for (std::size_t edge = 0; edge < onFace.size(); ++edge)
  {
    if (onFace[edge] && std::isnan(core.edgeLambda[edge]))
    {
      throw UsageError(
        "the measures of the edges on faces are not known (the model was read from a file written "
        "without --keep-edges), so they cannot be written");
    }
  }
}

namespace
{

/** Raises, per element, what its cofaces have at most. */
void
Raise(std::vector<double> & most, std::span<const ElementIndex> elements, double value)
{
  for (const ElementIndex element : elements)
  {
    most[element] = std::max(most[element], value);
  }
}

/** Elements on no coface (of which `most` is below all heights) or higher than all of them. */
std::vector<ElementIndex>
Outlasting(const std::vector<double> & most, const std::vector<double> & heights)
{
  std::vector<ElementIndex> cells;
  for (std::size_t i = 0; i < most.size(); ++i)
  {
    if (most[i] < 0 || (!heights.empty() && heights[i] > most[i]))
    {
      cells.push_back(static_cast<ElementIndex>(i));
    }
  }
  return cells;
}

} // namespace

std::vector<ElementIndex>
VertexCells(const MedialComplex & core)
{
  std::vector<double> most(core.cells.vertexCount, -1.0);
  for (std::size_t edge = 0; edge < core.cells.edges.size(); ++edge)
  {
    Raise(most, core.cells.edges[edge], core.HasTolerances() ? core.tolerances.edges[edge] : 0.0);
  }
  return Outlasting(most, core.tolerances.vertices);
}

std::vector<ElementIndex>
LineCells(const MedialComplex & core)
{
  std::vector<double> most(core.cells.edges.size(), -1.0);
  for (std::size_t face = 0; face < core.cells.FaceCount(); ++face)
  {
    Raise(most, core.cells.FaceEdges(face), core.HasTolerances() ? core.tolerances.faces[face] : 0.0);
  }
  return Outlasting(most, core.tolerances.edges);
}

void
BuildEdges(CellComplex & cells, std::span<const std::array<ElementIndex, 2>> looseEdges)
{
  // Buckets by the smaller vertex instead of one great sort: each holds a handful of second vertices.
  const auto forEachEdge = [&](auto && visit) {
    for (std::size_t face = 0; face < cells.FaceCount(); ++face)
    {
      const auto corners = cells.FaceVertices(face);
      for (std::size_t i = 0; i < corners.size(); ++i)
      {
        const ElementIndex next = corners[i + 1 < corners.size() ? i + 1 : 0];
        visit(std::min(corners[i], next), std::max(corners[i], next), cells.faceOffsets[face] + i);
      }
    }
  };

  std::vector<std::uint64_t> starts(cells.vertexCount + 1, 0);
  forEachEdge([&](ElementIndex first, ElementIndex, std::uint64_t) { ++starts[first + std::size_t{ 1 }]; });
  for (const auto & edge : looseEdges)
  {
    ++starts[std::min(edge[0], edge[1]) + std::size_t{ 1 }];
  }
  for (std::size_t v = 0; v < cells.vertexCount; ++v)
  {
    starts[v + 1] += starts[v];
  }
  std::vector<ElementIndex>  seconds(starts[cells.vertexCount]);
  std::vector<std::uint64_t> next(starts.begin(), starts.end() - 1);
  forEachEdge([&](ElementIndex first, ElementIndex second, std::uint64_t) { seconds[next[first]++] = second; });
  for (const auto & edge : looseEdges)
  {
    seconds[next[std::min(edge[0], edge[1])]++] = std::max(edge[0], edge[1]);
  }

  cells.edges.clear();
  std::uint64_t kept = 0;
  for (std::size_t v = 0; v < cells.vertexCount; ++v)
  {
    const auto begin = seconds.begin() + static_cast<std::ptrdiff_t>(starts[v]);
    const auto end = seconds.begin() + static_cast<std::ptrdiff_t>(starts[v + 1]);
    std::sort(begin, end);
    starts[v] = kept;
    for (auto second = begin; second != end; ++second)
    {
      if (second == begin || *second != *(second - 1))
      {
        cells.edges.push_back({ static_cast<ElementIndex>(v), *second });
        ++kept;
      }
    }
  }
  starts[cells.vertexCount] = kept;
  if (kept >= std::numeric_limits<ElementIndex>::max())
  {
    throw Error("a complex has more edges than 2^32 - 2");
  }

  cells.faceEdges.resize(cells.faceVertices.size());
  forEachEdge([&](ElementIndex first, ElementIndex second, std::uint64_t corner) {
    // A file of others may have all its edges at one vertex.
    const auto begin = cells.edges.begin();
    const auto edge = std::lower_bound(begin + static_cast<std::ptrdiff_t>(starts[first]),
                                       begin + static_cast<std::ptrdiff_t>(starts[first + std::size_t{ 1 }]),
                                       std::array<ElementIndex, 2>{ first, second });
    cells.faceEdges[corner] = static_cast<ElementIndex>(edge - begin);
  });
}

MedialComplex
Triangulated(const MedialComplex & core)
{
  MedialComplex result;
  result.tolerances.vertices = core.tolerances.vertices;
  result.positions = core.positions;
  result.radius = core.radius;
  result.vertexLambda = core.vertexLambda;
  result.cells.vertexCount = core.cells.vertexCount;
  for (std::size_t face = 0; face < core.cells.FaceCount(); ++face)
  {
    const auto corners = core.cells.FaceVertices(face);
    for (std::size_t i = 2; i < corners.size(); ++i)
    {
      result.cells.faceVertices.insert(result.cells.faceVertices.end(), { corners[0], corners[i - 1], corners[i] });
      result.cells.faceOffsets.push_back(result.cells.faceVertices.size());
      result.faceLambda.push_back(core.faceLambda[face]);
      if (core.HasTolerances())
      {
        result.tolerances.faces.push_back(core.tolerances.faces[face]);
      }
    }
  }

  const std::vector<std::uint8_t>          onFace = EdgesOnFaces(core.cells);
  std::vector<std::array<ElementIndex, 2>> loose;
  for (std::size_t edge = 0; edge < onFace.size(); ++edge)
  {
    if (!onFace[edge])
    {
      loose.push_back(core.cells.edges[edge]);
    }
  }
  BuildEdges(result.cells, loose);

  result.edgeLambda.assign(result.cells.edges.size(), 0);
  for (std::size_t corner = 0; corner < result.cells.faceEdges.size(); ++corner)
  {
    result.edgeLambda[result.cells.faceEdges[corner]] = result.faceLambda[corner / 3];
  }
  if (core.HasTolerances())
  {
    result.tolerances.edges.assign(result.cells.edges.size(), 0);
    for (std::size_t corner = 0; corner < result.cells.faceEdges.size(); ++corner)
    {
      result.tolerances.edges[result.cells.faceEdges[corner]] = result.tolerances.faces[corner / 3];
    }
  }
  // Both lists are sorted, and every old edge is among the new ones.
  for (std::size_t old = 0, edge = 0; old < core.cells.edges.size(); ++old)
  {
    while (result.cells.edges[edge] != core.cells.edges[old])
    {
      ++edge;
    }
    result.edgeLambda[edge] = core.edgeLambda[old];
    if (core.HasTolerances())
    {
      result.tolerances.edges[edge] = core.tolerances.edges[old];
    }
  }
  return result;
}

} // namespace voxelcore
