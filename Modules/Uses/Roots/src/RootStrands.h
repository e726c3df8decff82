#pragma once
// The ways of roots through a place where they touch.

#include "voxelcore/Roots/RootHierarchy.h"

#include <span>
#include <utility>
#include <vector>

namespace voxelcore
{

/** The part of a root that goes through a contact. */
struct Strand
{
  ElementIndex         axis = 0;
  std::size_t          first = 0; ///< of its points, those in the contact
  std::size_t          last = 0;
  double               radius = 0; ///< where it is a root by itself
  std::vector<Vector3> line;
  std::size_t          curveFrom = 0; ///< of `line`, the curve within the contact
  std::size_t          curveTo = 0;
};

/** The roots that go through a meeting, each as often as it does. Within the contact they follow smooth curves between
 *  their arms, and those that come too near to each other are moved apart. */
std::vector<Strand>
TraceStrands(const SkeletonGraph & graph, const RootHierarchy & roots, const RootMeeting & meeting);

/** Whether one springs from the other within the contact. */
bool
AreKin(const RootHierarchy & roots, const Strand & a, const Strand & b);

/** The square of the distance from a place to a line. */
double
SquaredDistance(const Vector3 & place, std::span<const Vector3> line);

} // namespace voxelcore
