#pragma once
// How a body has moved from one scan to the next, told by its skeletons.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <array>

namespace voxelcore
{

/** p -> rotation * p + shift */
struct RigidMotion
{
  std::array<double, 9> rotation{ 1, 0, 0, 0, 1, 0, 0, 0, 1 }; ///< row-major
  Vector3               shift{};                               ///< mm

  Vector3
  operator()(const Vector3 & place) const;
  RigidMotion
  Inverse() const;
  /** By how much it turns, degrees. */
  double
  Turn() const;
};

/** How well a motion brings a skeleton onto another. A place is found where the other's lines pass within its radius,
 *  or `least` mm where that is more. */
struct FoundMotion
{
  RigidMotion motion;
  double      found = 0; ///< share of the length that is found
  double      rms = 0;   ///< of the distances of found places to the other's lines, mm
  /** By how much a place may be off, times rms: the greatest standard deviation that follows from a distance's, where
   *  places a diameter apart count as independent. Great where lines could slide or turn in themselves. */
  double spread = 0;
};

/** The motion that brings the places of `from` onto the lines of `to`, which may have more: trimmed iterations of
 *  nearest points, with distances across the lines alone, so that what grew pulls at nothing. They begin at no motion,
 *  at the four turns that bring principal axes onto each other, and where triangles of junctions are alike; the one
 *  that leaves least is taken. Both must have branches. */
FoundMotion
FindMotion(const SkeletonGraph & from, const SkeletonGraph & to, double least);

/** The same of a motion that is known. */
FoundMotion
MeasureMotion(const SkeletonGraph & from, const SkeletonGraph & to, const RigidMotion & motion, double least);

} // namespace voxelcore
