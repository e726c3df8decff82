#pragma once
// The heights of a core that was pruned by tolerance and then refined.

#include "voxelcore/VoxelCore/MedialComplex.h"

#include <vector>

namespace voxelcore
{

/** `triangles`: of what a height in mm leaves of `whole`, a core that has its heights, polygons cut into triangles and
 *  some of them taken off at rims, with vertices in their order there: `kept` are their numbers among those that the
 *  height leaves, `polygons` those of the faces that triangles are parts of. A triangle and its cuts have the height of
 *  their polygon, or a greater one: what remains where others were taken off stays at least as long as they would have,
 *  and each goes at the height at which it can, by simple pairs. What never can has the greatest height of `whole`.
 *  \throws Error when they are no such triangles */
ToleranceValues
TolerancesOfTriangles(const CellComplex &               triangles,
                      const std::vector<ElementIndex> & kept,
                      const std::vector<ElementIndex> & polygons,
                      const MedialComplex &             whole,
                      double                            height);

} // namespace voxelcore
