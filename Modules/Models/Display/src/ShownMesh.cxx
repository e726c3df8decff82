#include "ShownMesh.h"

#include "ComplexClustering.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace voxelcore
{

namespace
{

/** Drops points on nothing. */
void
Compact(ShownMesh & mesh)
{
  constexpr std::uint32_t    kUnused = 0xFFFFFFFFU;
  std::vector<std::uint32_t> number(mesh.points.size(), kUnused);
  ShownMesh                  small;
  const auto                 take = [&](std::uint32_t & point) {
    if (number[point] == kUnused)
    {
      number[point] = static_cast<std::uint32_t>(small.points.size());
      small.points.push_back(mesh.points[point]);
      if (!mesh.origin.empty())
      {
        small.origin.push_back(mesh.origin[point]);
      }
    }
    point = number[point];
  };
  const auto takeAll = [&take](auto & elements) {
    for (auto & element : elements)
    {
      std::for_each(element.begin(), element.end(), take);
    }
  };
  takeAll(mesh.triangles);
  takeAll(mesh.segments);
  takeAll(mesh.lines);
  std::for_each(mesh.dots.begin(), mesh.dots.end(), take);
  mesh.points = std::move(small.points);
  mesh.origin = std::move(small.origin);
}

ShownMesh
WithPoints(const std::vector<std::array<double, 3>> & positions)
{
  ShownMesh shown;
  for (const auto & p : positions)
  {
    shown.points.push_back({ static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]) });
  }
  shown.origin.resize(shown.points.size());
  std::iota(shown.origin.begin(), shown.origin.end(), 0U);
  return shown;
}

/** Polygons become fans. */
template <typename TCorners>
void
AddFan(ShownMesh & shown, const TCorners & corners)
{
  for (std::size_t k = 2; k < corners.size(); ++k)
  {
    shown.triangles.push_back({ corners[0], corners[k - 1], corners[k] });
  }
}

std::vector<std::uint32_t>
FacesOfEdges(const CellComplex & cells)
{
  std::vector<std::uint32_t> faces(cells.edges.size(), 0);
  for (const ElementIndex edge : cells.faceEdges)
  {
    ++faces[edge];
  }
  return faces;
}

} // namespace

ComplexSize
SizeOf(const CellComplex & cells)
{
  const std::vector<std::uint32_t> faces = FacesOfEdges(cells);
  return { cells.faceVertices.size() - 2 * cells.FaceCount(),
           static_cast<std::size_t>(std::count(faces.begin(), faces.end(), 0U)) };
}

ShownMesh
SimplifiedSurface(const LabelSurfaceMesh & mesh, std::size_t most)
{
  ShownMesh shown;
  shown.points = mesh.points;
  shown.triangles = mesh.triangles;
  if (mesh.triangles.size() > most)
  {
    static_assert(sizeof(mesh.points[0]) == 3 * sizeof(float) && sizeof(mesh.triangles[0]) == 3 * sizeof(unsigned));
    constexpr float kAnyError = std::numeric_limits<float>::max();
    const auto      corners = meshopt_simplify(shown.triangles[0].data(),
                                          mesh.triangles[0].data(),
                                          3 * mesh.triangles.size(),
                                          mesh.points[0].data(),
                                          mesh.points.size(),
                                          sizeof(mesh.points[0]),
                                          3 * most,
                                          kAnyError,
                                          0,
                                          nullptr);
    shown.triangles.resize(corners / 3);
    Compact(shown);
  }
  return shown;
}

ShownMesh
SimplifiedComplex(const MedialComplex & complex, std::size_t most)
{
  const CellComplex &                       cells = complex.cells;
  ShownMesh                                 shown = WithPoints(complex.positions);
  const std::vector<std::uint32_t>          faces = FacesOfEdges(cells);
  std::vector<std::array<std::uint32_t, 3>> rims;
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    const auto corners = cells.FaceVertices(face);
    const auto edges = cells.FaceEdges(face);
    AddFan(shown, corners);
    for (std::size_t k = 0; k < corners.size(); ++k)
    {
      if (faces[edges[k]] == 1)
      {
        rims.push_back({ corners[k], corners[(k + 1) % corners.size()], corners[(k + 2) % corners.size()] });
      }
    }
  }
  std::vector<bool> onEdge(cells.vertexCount, false);
  for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
  {
    const auto & ends = cells.edges[edge];
    onEdge[ends[0]] = onEdge[ends[1]] = true;
    if (faces[edge] == 0)
    {
      shown.segments.push_back({ ends[0], ends[1] });
    }
  }
  for (std::size_t vertex = 0; vertex < cells.vertexCount; ++vertex)
  {
    if (!onEdge[vertex])
    {
      shown.dots.push_back(static_cast<std::uint32_t>(vertex));
    }
  }
  if (shown.triangles.size() + shown.segments.size() > most)
  {
    shown = ClusteredMesh(shown, rims, most);
  }
  Compact(shown);
  return shown;
}

ShownMesh
ShownCurves(const SkeletonGraph & curves)
{
  ShownMesh         shown = WithPoints(curves.positions);
  std::vector<bool> onSomething(shown.points.size(), false);
  for (std::size_t branch = 0; branch < curves.BranchCount(); ++branch)
  {
    const auto points = curves.Branch(branch);
    shown.lines.emplace_back(points.begin(), points.end());
    for (const ElementIndex point : points)
    {
      onSomething[point] = true;
    }
  }
  for (std::size_t face = 0; face < curves.FaceCount(); ++face)
  {
    const std::span<const ElementIndex> corners(curves.faceVertices.data() + curves.faceOffsets[face],
                                                curves.faceVertices.data() + curves.faceOffsets[face + 1]);
    AddFan(shown, corners);
    for (const ElementIndex corner : corners)
    {
      onSomething[corner] = true;
    }
  }
  for (std::size_t point = 0; point < shown.points.size(); ++point)
  {
    if (!onSomething[point])
    {
      shown.dots.push_back(static_cast<std::uint32_t>(point));
    }
  }
  return shown;
}

} // namespace voxelcore
