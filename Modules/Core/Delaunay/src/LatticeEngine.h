#pragma once
// The engine made for voxel shapes: small cells by tracing from the boundary, the deep rest likewise, by a tree.

#include "voxelcore/Delaunay/DelaunayCells.h"

namespace voxelcore
{

/** Merged Delaunay cells inside the shape, not yet in canonical order. Uses all OpenMP threads; the cells do not depend
 *  on their number. Where facets on the boundary are not asked for, most are noted in voxelSides instead, and facets
 *  without a cell may stand among the others. \throws Cancelled. */
DelaunayCells
LatticeCells(const VoxelShape &                shape,
             const std::vector<LatticePoint> & points,
             const SpacingWeights &            weights,
             const ProgressCallback &          progress,
             Facets                            facets);

} // namespace voxelcore
