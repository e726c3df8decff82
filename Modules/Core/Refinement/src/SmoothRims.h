#pragma once
// Rims that are curves.

#include "KeepCovered.h"

#include "voxelcore/Refinement/Refinement.h"

#include <vector>

namespace voxelcore
{

/** Moves the vertices along rims of sheets, within these: cells are taken or left as a whole, so that a rim runs along
 *  their zigzag. Each goes towards the middle of the next two on the rim, a few times over, and then on where the rim
 *  still turns by more than 60 degrees. None leaves the shape or goes farther than a voxel from where it was before
 *  refinement, and no triangle turns over. Radii are left as they are. Returns what has moved, ascending. */
std::vector<ElementIndex>
SmoothRims(const RefinementInput & input, const FormerBalls & former, RefinedCore & refined);

} // namespace voxelcore
