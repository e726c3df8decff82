#pragma once
// Delaunay tetrahedralization of lattice points by incremental insertion (Bowyer 1981, Watson 1981), exact.

#include "Tetrahedra.h"

#include <functional>

namespace voxelcore
{

/** What another thread may do beside so many points being added. */
using Meanwhile = std::function<void(std::size_t points)>;

/** The Delaunay tetrahedra of distinct points that are not all in one plane; which of several that differ in
 *  cospherical points only, depends on the number of threads. `meanwhile` is called once, beside the part of the work
 *  that is one thread's, with the number of points which that one adds.
 *  A point's cavity is what its insertion strictly conflicts with: then no symbolic perturbation is needed, for a
 *  cavity face coplanar with the new point would have its outer sphere strictly contain the point too.
 *  Extents must pass ExactRangeAllows(). \throws Cancelled. */
Tetrahedra
BowyerWatson(const std::vector<LatticePoint> & points,
             const SpacingWeights &            weights,
             const Meanwhile &                 meanwhile,
             const ProgressCallback &          progress);

} // namespace voxelcore
