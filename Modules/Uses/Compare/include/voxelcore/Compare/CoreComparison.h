#pragma once
// Two medial surfaces against each other.

#include "voxelcore/VoxelCore/MedialComplex.h"

namespace voxelcore
{

/** From each vertex of either to the nearest place of the other's faces, edges and vertices, mm; all are NaN where one
 *  has no vertex. None but the coverages depends on the order, and these change places. */
struct CoreComparison
{
  double hausdorff = 0;    ///< the greatest of all
  double percentile95 = 0; ///< the greater of both directions' 95th percentiles
  double mean = 0;         ///< over the vertices of both
  double coverageA = 0;    ///< share of A's vertices no more than `within` from B
  double coverageB = 0;    ///< share of B's vertices no more than `within` from A
};

/** Positions in LPS mm. Polygons are taken as the triangles from their first corners. */
CoreComparison
CompareCores(const MedialComplex & a, const MedialComplex & b, double within);

} // namespace voxelcore
