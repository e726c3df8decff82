#pragma once
// Pruned cores refined from the labels.

#include "voxelcore/Refinement/Refinement.h"

#include <vector>

namespace voxelcore::evaluation
{

/** `input` without its surface: what each lambda leaves, then what each height leaves (both mm), refined. */
std::vector<RefinedCore>
RefineAll(RefinementInput input, const std::vector<double> & lambdas, const std::vector<double> & heights);

/** The same with moves and changes of radii that fade out from 4 to 2 voxels (sides of the cube with the same diagonal)
 *  of radius in the whole core. */
MedialComplex
RefinedWhereThick(const RefinedCore & refined, const MedialComplex & whole, const Vector3 & spacing);

} // namespace voxelcore::evaluation
