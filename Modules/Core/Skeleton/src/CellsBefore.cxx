#include "TurnedSurface.h"

#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <numeric>

namespace voxelcore
{

namespace
{

/** Puts a turned face where it was: `vertices` and `edges` name what it has now by what that was. */
void
PutFace(const TurnedSurface &             turned,
        std::size_t                       face,
        const std::vector<ElementIndex> & vertices,
        const std::vector<ElementIndex> & edges,
        std::uint64_t                     first,
        CellComplex &                     cells)
{
  const auto corners = turned.surface.cells.FaceVertices(face);
  const auto sides = turned.surface.cells.FaceEdges(face);
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const PlaceBefore at(i, corners.size(), turned.starts[face] / 2, turned.starts[face] % 2 != 0);
    cells.faceVertices[first + at.corner] = vertices[corners[i]];
    cells.faceEdges[first + at.side] = edges[sides[i]];
  }
}

} // namespace

CellComplex
CellsBefore(const TurnedSurface & turned)
{
  const CellComplex & from = turned.surface.cells;
  const std::size_t   faceCount = from.FaceCount();
  const bool          worthIt = faceCount > 10000;
  CellComplex         cells;
  cells.vertexCount = from.vertexCount;
  cells.edges.resize(from.edges.size());
  RunInParts(worthIt, from.edges.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t edge = first; edge < last; ++edge)
    {
      const auto [a, b] = std::minmax(turned.vertices[from.edges[edge][0]], turned.vertices[from.edges[edge][1]]);
      cells.edges[turned.edges[edge]] = { a, b };
    }
  });
  cells.faceOffsets.resize(faceCount + 1);
  for (std::size_t face = 0; face < faceCount; ++face)
  {
    cells.faceOffsets[turned.faces[face] + std::size_t{ 1 }] = from.faceOffsets[face + 1] - from.faceOffsets[face];
  }
  std::partial_sum(cells.faceOffsets.begin(), cells.faceOffsets.end(), cells.faceOffsets.begin());
  cells.faceVertices.resize(from.faceVertices.size());
  cells.faceEdges.resize(from.faceEdges.size());
  RunInParts(worthIt, faceCount, [&](std::size_t first, std::size_t last) {
    for (std::size_t face = first; face < last; ++face)
    {
      PutFace(turned, face, turned.vertices, turned.edges, cells.faceOffsets[turned.faces[face]], cells);
    }
  });
  return cells;
}

CellComplex
CellsBefore(const TurnedSurface & turned, const LiveElements & left, PartElements & elements)
{
  const CellComplex & from = turned.surface.cells;
  // What is left, by turned index, in the order it had before.
  const auto inOrder = [](const std::vector<std::uint8_t> & flags,
                          const std::vector<ElementIndex> & before,
                          std::vector<ElementIndex> &       indices) {
    std::vector<ElementIndex> order;
    for (std::size_t i = 0; i < flags.size(); ++i)
    {
      if (flags[i] != 0)
      {
        order.push_back(static_cast<ElementIndex>(i));
      }
    }
    std::sort(order.begin(), order.end(), [&](ElementIndex a, ElementIndex b) { return before[a] < before[b]; });
    indices.clear();
    for (const ElementIndex i : order)
    {
      indices.push_back(before[i]);
    }
    return order;
  };
  const auto numbersOf = [](const std::vector<ElementIndex> & order, std::size_t count) {
    std::vector<ElementIndex> numbers(count, 0);
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      numbers[order[i]] = static_cast<ElementIndex>(i);
    }
    return numbers;
  };
  const auto                      vertices = inOrder(left.vertices, turned.vertices, elements.vertices);
  const auto                      edges = inOrder(left.edges, turned.edges, elements.edges);
  const auto                      faces = inOrder(left.faces, turned.faces, elements.faces);
  const std::vector<ElementIndex> vertexNumber = numbersOf(vertices, left.vertices.size());
  const std::vector<ElementIndex> edgeNumber = numbersOf(edges, left.edges.size());

  CellComplex cells;
  cells.vertexCount = vertices.size();
  for (const ElementIndex edge : edges)
  {
    const auto [a, b] = std::minmax(vertexNumber[from.edges[edge][0]], vertexNumber[from.edges[edge][1]]);
    cells.edges.push_back({ a, b });
  }
  for (const ElementIndex face : faces)
  {
    const std::uint64_t first = cells.faceOffsets.back();
    const std::uint64_t end = first + from.FaceVertices(face).size();
    cells.faceOffsets.push_back(end);
    cells.faceVertices.resize(end);
    cells.faceEdges.resize(end);
    PutFace(turned, face, vertexNumber, edgeNumber, first, cells);
  }
  return cells;
}

} // namespace voxelcore
