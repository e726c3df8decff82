#pragma once
// The open shape around a skeleton: which places lie in it, and how far its boundary is.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/VoxelShape.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"

namespace voxelcore
{

/** Of places in LPS mm. The shape and its geometry must outlive it. */
class OpenShape
{
public:
  OpenShape(const VoxelShape & shape, const ImageGeometry & geometry)
    : m_Shape(&shape)
    , m_Geometry(&geometry)
  {}

  bool
  Holds(const Vector3 & place) const;

  /** mm */
  double
  VoxelDiagonal() const
  {
    return Length(m_Geometry->spacing);
  }

  /** Whether all of a segment lies in the shape. */
  bool
  HoldsSegment(const Vector3 & a, const Vector3 & b) const;

  /** `to` where it lies in the shape, else a place on the way there that does, near where the way leaves it; `from`
   *  where none does. */
  Vector3
  Towards(const Vector3 & from, const Vector3 & to) const;

  /** mm to the nearest boundary vertices, when these are no nearer than `least` and no farther than `most`. */
  double
  DistanceToBoundary(const Vector3 & place, double least, double most) const;

private:
  /** DistanceToBoundary(), which looks as far as `most` at once. */
  double
  DistanceWithin(const Vector3 & place, double least, double most) const;

  const VoxelShape *    m_Shape;
  const ImageGeometry * m_Geometry;
};

/** FitBranches() within the shape: each point goes so far on its way from the medial surface that it lies in it, as do
 *  the segments at it where those between their places on the medial surface do. */
void
FitBranches(SkeletonGraph & graph, double window, const VoxelReach & reach, const OpenShape & inside);

/** Measures the radii anew of points that do not lie where they were measured, which is `before`, one place per point;
 *  of tips up to `ends` mm from there. A radius changes by no more than a point moves. */
void
MeasureBallsAnew(SkeletonGraph & graph, const std::vector<Vector3> & before, double ends, const OpenShape & shape);

} // namespace voxelcore
