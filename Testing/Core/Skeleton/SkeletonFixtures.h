#pragma once
// Surfaces made by hand, and skeletons of shapes, for tests.

#include "VoxelCoreTesting/Cores.h"

#include "voxelcore/Complex/ComplexTopology.h"
#include "voxelcore/Phantom/Phantom.h"
#include "voxelcore/Skeleton/CurveSkeleton.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"

#include <map>

namespace voxelcore::testing
{

/** Makes a surface from points and polygons of them; edges come from the polygons and from `curves`. */
class SurfaceBuilder
{
public:
  ElementIndex
  Point(double x, double y, double z, double radius = 1)
  {
    const auto [found, isNew] =
      m_Points.try_emplace({ x, y, z }, static_cast<ElementIndex>(m_Surface.positions.size()));
    if (isNew)
    {
      m_Surface.positions.push_back({ x, y, z });
      m_Surface.radius.push_back(radius);
      m_Surface.vertexLambda.push_back(radius);
      m_Surface.cells.vertexCount++;
    }
    return found->second;
  }

  ElementIndex
  Edge(ElementIndex a, ElementIndex b)
  {
    const auto [found, isNew] =
      m_Edges.try_emplace({ std::min(a, b), std::max(a, b) }, static_cast<ElementIndex>(m_Surface.cells.edges.size()));
    if (isNew)
    {
      m_Surface.cells.edges.push_back(found->first);
      m_Surface.edgeLambda.push_back(1);
    }
    return found->second;
  }

  void
  Face(const std::vector<ElementIndex> & corners)
  {
    CellComplex & cells = m_Surface.cells;
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      cells.faceVertices.push_back(corners[i]);
      cells.faceEdges.push_back(Edge(corners[i], corners[(i + 1) % corners.size()]));
    }
    cells.faceOffsets.push_back(cells.faceVertices.size());
    m_Surface.faceLambda.push_back(1);
  }

  /** A sheet of unit squares origin + i u + j v, 0 <= i <= m, 0 <= j <= n. */
  void
  Sheet(const Spacing3 & origin, const Spacing3 & u, const Spacing3 & v, int m, int n, double radius = 1)
  {
    const auto at = [&](int i, int j) {
      return Point(origin[0] + i * u[0] + j * v[0],
                   origin[1] + i * u[1] + j * v[1],
                   origin[2] + i * u[2] + j * v[2],
                   radius);
    };
    for (int i = 0; i < m; ++i)
    {
      for (int j = 0; j < n; ++j)
      {
        Face({ at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1) });
      }
    }
  }

  const MedialComplex &
  Surface() const
  {
    return m_Surface;
  }

private:
  MedialComplex                                       m_Surface;
  std::map<Spacing3, ElementIndex>                    m_Points;
  std::map<std::array<ElementIndex, 2>, ElementIndex> m_Edges;
};

/** The core of a shape with its vertices in mm (lattice axes), pruned to `lambda` mm. */
inline MedialComplex
SurfaceOf(const VoxelShape & shape, const Spacing3 & spacing = { 1, 1, 1 }, double lambda = 0)
{
  MedialComplex surface = CoreOf(shape, spacing);
  for (auto & position : surface.positions)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      position[axis] *= spacing[axis];
    }
  }
  return lambda > 0 ? std::move(PruneByLambda(surface, { lambda }).front()) : surface;
}

inline CurveSkeleton
SkeletonOf(const MedialComplex & surface,
           double                branchThreshold,
           double                plateThreshold = std::numeric_limits<double>::infinity(),
           double                voxel = 1,
           double                side = 0,
           const LiveElements *  part = nullptr)
{
  CurveOptions options;
  options.branchThreshold = branchThreshold;
  options.plateThreshold = plateThreshold;
  options.sampling = 1.5 * voxel;
  options.voxel = side > 0 ? side : voxel;
  return ComputeCurveSkeleton(surface, part, options);
}

/** Number of edges at each vertex. */
inline std::vector<int>
Degrees(const CellComplex & cells)
{
  std::vector<int> degrees(cells.vertexCount, 0);
  for (const auto & edge : cells.edges)
  {
    ++degrees[edge[0]];
    ++degrees[edge[1]];
  }
  return degrees;
}

inline std::size_t
CountDegree(const CurveSkeleton & skeleton, int degree)
{
  const auto degrees = Degrees(skeleton.complex.cells);
  return static_cast<std::size_t>(std::count(degrees.begin(), degrees.end(), degree));
}

inline double
Distance(const Spacing3 & a, const Spacing3 & b)
{
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

inline VoxelShape
PhantomShape(const std::string & kind, std::int32_t size, std::uint64_t seed = 1)
{
  PhantomOptions options;
  options.kind = kind;
  options.size = { size, size, size };
  options.seed = seed;
  return MakePhantom(options);
}

} // namespace voxelcore::testing
