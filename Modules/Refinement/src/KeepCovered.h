#pragma once
// What pruning by tolerance promises of the boundary, kept when what is left is refined.

#include "PointTree.h"

#include "voxelcore/Refinement.h"

#include <vector>

namespace voxelcore
{

/** Where the balls of a part were before they were refined. */
struct FormerBalls
{
  std::vector<Vector3> positions; ///< lattice coordinates
  std::vector<double>  radius;    ///< mm
};

/** Takes back of moves and radii what leaves a boundary vertex farther than `height` mm from all balls that lay within
 *  it of a ball before. Of the balls that kept it the one goes back that has least to, in sixteenths of its way; radii
 *  stay within half a voxel's diagonal of the distance of the nearest boundary vertex, vertices in the shape, triangles
 *  unturned. Returns the vertices that have gone back, ascending. The same bits for every number of threads. */
std::vector<ElementIndex>
KeepBoundaryCovered(const RefinementInput & input,
                    const PointTree &       boundary,
                    double                  height,
                    const FormerBalls &     former,
                    RefinedCore &           refined);

} // namespace voxelcore
