#include "TurnedSurface.h"

#include <algorithm>

namespace voxelcore
{

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
    const auto          corners = from.FaceVertices(face);
    const auto          sides = from.FaceEdges(face);
    const std::uint64_t first = cells.faceOffsets.back();
    cells.faceOffsets.push_back(first + corners.size());
    cells.faceVertices.resize(first + corners.size());
    cells.faceEdges.resize(first + corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      const PlaceBefore at(i, corners.size(), turned.starts[face] / 2, turned.starts[face] % 2 != 0);
      cells.faceVertices[first + at.corner] = vertexNumber[corners[i]];
      cells.faceEdges[first + at.side] = edgeNumber[sides[i]];
    }
  }
  return cells;
}

} // namespace voxelcore
