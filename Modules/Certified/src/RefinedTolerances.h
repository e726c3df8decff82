#pragma once
// The heights of a core that was pruned by tolerance and then refined.

#include "voxelcore/MedialComplex.h"

namespace voxelcore
{

/** `triangles`: what a height in mm leaves of `whole`, a core that has its heights, vertices in their order there and
 *  polygons cut into triangles. A triangle and its cuts have the height of their polygon.
 *  \throws Error when they are no such triangles */
ToleranceValues
TolerancesOfTriangles(const CellComplex & triangles, const MedialComplex & whole, double height);

} // namespace voxelcore
