#pragma once
// The convex hull of lattice points, exactly.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** A triangle of a hull. */
struct HullFacet
{
  std::array<std::size_t, 3>  corners{ 0, 0, 0 }; ///< points, counter-clockwise seen from outside
  std::array<std::int64_t, 3> normal{ 0, 0, 0 };  ///< outwards, (b - a) x (c - a), never 0
};

/** The triangles of the convex hull of points, whose coordinates lie within +-2^29; none where all of them lie in one
 *  plane. A point is in the hull when no facet's normal points towards it from the facet's plane. Every sign is exact,
 *  also of points in one plane and on one line. Takes points times facets. */
std::vector<HullFacet>
ConvexHull(const std::vector<std::array<std::int64_t, 3>> & points);

} // namespace voxelcore
