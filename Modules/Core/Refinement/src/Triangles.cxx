#include "Triangles.h"

#include "voxelcore/Lattice/Vectors.h"


#include <algorithm>
#include <numeric>

namespace voxelcore
{

namespace
{

// Area over the sum of squared sides: 1 / (4 sqrt(3)) for the best.
double
Quality(const Vector3 & a, const Vector3 & b, const Vector3 & c)
{
  const Vector3 ab = Minus(b, a);
  const Vector3 ac = Minus(c, a);
  const Vector3 bc = Minus(c, b);
  const double  sides = Dot(ab, ab) + Dot(ac, ac) + Dot(bc, bc);
  return sides > 0 ? 0.5 * Length(Cross(ab, ac)) / sides : 0.0;
}

std::size_t
BestApex(const std::vector<Vector3> & positions, std::span<const ElementIndex> corners, const Vector3 & spacing)
{
  const std::size_t count = corners.size();
  const auto        at = [&](std::size_t i) { return Times(positions[corners[i % count]], spacing); };
  std::size_t       best = 0;
  double            bestWorst = -1;
  for (std::size_t apex = 0; apex < count; ++apex)
  {
    double worst = 1;
    for (std::size_t i = 1; i + 1 < count; ++i)
    {
      worst = std::min(worst, Quality(at(apex), at(apex + i), at(apex + i + 1)));
    }
    if (worst > bestWorst)
    {
      bestWorst = worst;
      best = apex;
    }
  }
  return best;
}

struct Cut
{
  std::array<ElementIndex, 3> corners{}; ///< the smallest first
  ElementIndex                polygon = 0;
};

// By corners, whatever way they are gone around.
void
SortByFirstCorner(std::size_t vertexCount, std::vector<Cut> & triangles)
{
  std::vector<std::size_t> first(vertexCount + 1, 0);
  for (const Cut & cut : triangles)
  {
    ++first[cut.corners[0] + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  std::vector<Cut>         sorted(triangles.size());
  for (const Cut & cut : triangles)
  {
    sorted[next[cut.corners[0]]++] = cut;
  }
  const auto others = [](const Cut & cut) { return std::minmax(cut.corners[1], cut.corners[2]); };
  for (std::size_t vertex = 0; vertex < vertexCount; ++vertex)
  {
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(first[vertex]),
              sorted.begin() + static_cast<std::ptrdiff_t>(first[vertex + 1]),
              [&](const Cut & a, const Cut & b) { return others(a) < others(b); });
  }
  triangles = std::move(sorted);
}

} // namespace

TriangleComplex
CutIntoTriangles(const CellComplex & cells, const std::vector<Vector3> & positions, const Vector3 & spacing)
{
  using Edge = std::array<ElementIndex, 2>;
  const std::size_t corners = cells.faceVertices.size();
  std::vector<Cut>  triangles;
  std::vector<Edge> edges;
  triangles.reserve(corners - 2 * cells.FaceCount());
  edges.reserve(cells.edges.size() + corners - 3 * cells.FaceCount());
  edges = cells.edges;
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    const auto        around = cells.FaceVertices(face);
    const std::size_t count = around.size();
    const std::size_t apex = count > 3 ? BestApex(positions, around, spacing) : 0;
    for (std::size_t i = 1; i + 1 < count; ++i)
    {
      std::array<ElementIndex, 3> triangle{ around[apex], around[(apex + i) % count], around[(apex + i + 1) % count] };
      if (i > 1)
      {
        edges.push_back({ std::min(triangle[0], triangle[1]), std::max(triangle[0], triangle[1]) });
      }
      std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
      triangles.push_back({ triangle, static_cast<ElementIndex>(face) });
    }
  }
  const auto added = edges.begin() + static_cast<std::ptrdiff_t>(cells.edges.size());
  std::sort(added, edges.end());
  std::inplace_merge(edges.begin(), added, edges.end());
  SortByFirstCorner(cells.vertexCount, triangles);
  std::vector<std::size_t> firstEdge(cells.vertexCount + 1, 0); // of those from a vertex on
  for (const Edge & edge : edges)
  {
    ++firstEdge[edge[0] + 1];
  }
  std::partial_sum(firstEdge.begin(), firstEdge.end(), firstEdge.begin());

  TriangleComplex cut;
  cut.cells.vertexCount = cells.vertexCount;
  cut.cells.edges = std::move(edges);
  cut.cells.faceVertices.reserve(3 * triangles.size());
  cut.cells.faceEdges.reserve(3 * triangles.size());
  cut.cells.faceOffsets.reserve(triangles.size() + 1);
  cut.polygons.reserve(triangles.size());
  for (const Cut & triangle : triangles)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const ElementIndex from = triangle.corners[i];
      const ElementIndex to = triangle.corners[(i + 1) % 3];
      const Edge         edge{ std::min(from, to), std::max(from, to) };
      const auto         first = cut.cells.edges.begin() + static_cast<std::ptrdiff_t>(firstEdge[edge[0]]);
      const auto         last = cut.cells.edges.begin() + static_cast<std::ptrdiff_t>(firstEdge[edge[0] + 1]);
      const auto         found = std::lower_bound(first, last, edge);
      cut.cells.faceVertices.push_back(from);
      cut.cells.faceEdges.push_back(static_cast<ElementIndex>(found - cut.cells.edges.begin()));
    }
    cut.cells.faceOffsets.push_back(cut.cells.faceVertices.size());
    cut.polygons.push_back(triangle.polygon);
  }
  return cut;
}

} // namespace voxelcore
