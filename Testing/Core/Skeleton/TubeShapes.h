#pragma once
// Tubes around curves of known length, at any angle to the grid.

#include "SkeletonFixtures.h"

#include "voxelcore/Skeleton/BranchJoints.h"
#include "voxelcore/Skeleton/BranchTips.h"
#include "voxelcore/Skeleton/CrossSections.h"

#include <functional>
#include <random>

namespace voxelcore::testing
{

/** Points along a curve, close together. */
using Curve = std::vector<Spacing3>;

inline Curve
SampleCurve(const std::function<Spacing3(double)> & at, std::size_t count)
{
  Curve curve;
  for (std::size_t i = 0; i <= count; ++i)
  {
    curve.push_back(at(static_cast<double>(i) / static_cast<double>(count)));
  }
  return curve;
}

inline double
CurveLength(const Curve & curve)
{
  double length = 0;
  for (std::size_t i = 1; i < curve.size(); ++i)
  {
    length += Distance(curve[i - 1], curve[i]);
  }
  return length;
}

/** A unit vector, every direction as likely. */
inline Spacing3
AnyDirection(std::mt19937_64 & random)
{
  std::normal_distribution<double> normal;
  const Spacing3                   v{ normal(random), normal(random), normal(random) };
  const double                     length = Distance(v, { 0, 0, 0 });
  return { v[0] / length, v[1] / length, v[2] / length };
}

/** Turns by two angles about two axes through the origin, then moves. */
inline Spacing3
Turned(const Spacing3 & p, double about, double tilt, const Spacing3 & centre)
{
  const double x = std::cos(about) * p[0] - std::sin(about) * p[1];
  const double y = std::sin(about) * p[0] + std::cos(about) * p[1];
  return { centre[0] + x,
           centre[1] + std::cos(tilt) * y - std::sin(tilt) * p[2],
           centre[2] + std::sin(tilt) * y + std::cos(tilt) * p[2] };
}

/** Voxels (of the given spacing, in a box of `sides` mm) whose centre lies within `radius` mm of the curve. */
inline VoxelShape
Tube(const Curve & curve, double radius, const Spacing3 & sides, const Spacing3 & spacing = { 1, 1, 1 })
{
  Size3 size{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    size[axis] = static_cast<std::int32_t>(sides[axis] / spacing[axis]);
  }
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, size });
  for (const Spacing3 & p : curve)
  {
    Size3 low{};
    Size3 high{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::max(0, static_cast<std::int32_t>(std::floor((p[axis] - radius) / spacing[axis])));
      high[axis] = std::min(size[axis] - 1, static_cast<std::int32_t>(std::ceil((p[axis] + radius) / spacing[axis])));
    }
    for (std::int32_t z = low[2]; z <= high[2]; ++z)
    {
      for (std::int32_t y = low[1]; y <= high[1]; ++y)
      {
        for (std::int32_t x = low[0]; x <= high[0]; ++x)
        {
          const Spacing3 centre{ (x + 0.5) * spacing[0], (y + 0.5) * spacing[1], (z + 0.5) * spacing[2] };
          if (Distance(centre, p) <= radius)
          {
            shape.Insert(x, y, z);
          }
        }
      }
    }
  }
  return shape;
}

inline double
TotalLength(const SkeletonGraph & graph)
{
  double length = 0;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    length += graph.BranchLength(branch);
  }
  return length;
}

/** Half a voxel each way, axes along the grid. */
inline VoxelReach
HalfAVoxel(const Spacing3 & spacing = { 1, 1, 1 })
{
  return { { { 2 / spacing[0], 0, 0 }, { 0, 2 / spacing[1], 0 }, { 0, 0, 2 / spacing[2] } } };
}

/** The graph of a surface's skeleton at 3 voxels, or of a part of it, fitted with the default window and reach.
 *  Positions in mm. */
inline SkeletonGraph
GraphOfSurface(const MedialComplex & surface,
               const Spacing3 &      spacing = { 1, 1, 1 },
               const LiveElements *  part = nullptr)
{
  const double  unit = std::min({ spacing[0], spacing[1], spacing[2] });
  const double  side = Distance(spacing, { 0, 0, 0 }) / std::sqrt(3.0);
  SkeletonGraph graph =
    BuildSkeletonGraph(SkeletonOf(surface, 3 * side, std::numeric_limits<double>::infinity(), unit, side, part));
  FitBranches(graph, 6 * side, HalfAVoxel(spacing));
  return graph;
}

/** A grid along the axes whose lattice corner (0, 0, 0) is at the origin. */
inline ImageGeometry
GridFromOrigin(const Spacing3 & spacing)
{
  ImageGeometry geometry;
  geometry.spacing = spacing;
  geometry.origin = { 0.5 * spacing[0], 0.5 * spacing[1], 0.5 * spacing[2] };
  return geometry;
}

/** Radii of the body around a skeleton in mm. */
inline std::vector<double>
SectionRadiiOf(const SkeletonGraph & graph, const VoxelShape & shape, const Spacing3 & spacing)
{
  return CrossSectionRadii(graph, shape, GridFromOrigin(spacing));
}

/** The same of a shape's whole core, with radii of the body, tips placed by its volume and joints by their axes. */
inline SkeletonGraph
GraphOf(const VoxelShape & shape, const Spacing3 & spacing = { 1, 1, 1 })
{
  SkeletonGraph graph = GraphOfSurface(SurfaceOf(shape, spacing), spacing);
  if (PlaceTips(graph, shape, GridFromOrigin(spacing)) > 0)
  {
    FitBranches(graph, 6 * Distance(spacing, { 0, 0, 0 }) / std::sqrt(3.0), HalfAVoxel(spacing));
  }
  if (PlaceJoints(graph, shape, GridFromOrigin(spacing)) > 0)
  {
    FitBranches(graph, 6 * Distance(spacing, { 0, 0, 0 }) / std::sqrt(3.0), HalfAVoxel(spacing));
  }
  graph.sectionRadius = SectionRadiiOf(graph, shape, spacing);
  return graph;
}

} // namespace voxelcore::testing
