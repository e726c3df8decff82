#pragma once
// What stands out of a refined core and nothing needs.

#include "KeepCovered.h"

#include "voxelcore/Refinement/Refinement.h"

namespace voxelcore
{

/** Takes from a refined core, while each boundary vertex that a ball covers within its tolerance stays so:
 *  - hairs: lines on no face, shorter than two voxel diagonals, that end freely and hang on what is more than a line;
 *  - at rims that turn by more than 60 degrees the triangles about a corner that stands out.
 *  Each is a collapse, so that the topology stays; a sheet does not become a line. `covered` is of the same balls.
 *  Notes in the core which vertices are left and how many hairs have gone. */
void
TrimRims(const RefinementInput & input, const ToleranceAt & tolerance, CoveredBoundary covered, RefinedCore & refined);

} // namespace voxelcore
