#pragma once
// From a shape to its whole core, before anything is pruned, refined or burned.

#include "RefinedResults.h"
#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Certified/Certified.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

namespace voxelcore
{

/** A whole core, and what must be kept of its making before the points and the cells go. */
struct WholeCore
{
  CertifiedCore    core;    ///< in LPS mm; with its tolerances where the request has some
  RefinementParts  kept;    ///< where there is something to refine
  ThicknessBracket bracket; ///< where the request needs one
};

/** Frees the points and the cells as soon as it can. Stages of `plan`: shape to tolerances. Notes in `result` what it
 *  finds out about the shape, and the seconds.
 *  \param result  its shape has its name, box and geometry
 *  \param lambdaMm  what is pruned before any tolerance
 *  \throws CertificateError where a vertex lies outside the shape, or the engines differ; Cancelled */
WholeCore
MakeWholeCore(const VoxelShape &       voxels,
              const CertifiedRequest & request,
              const SpacingWeights &   weights,
              double                   lambdaMm,
              CoreUse                  use,
              StagePlan &              plan,
              CertifiedResult &        result);

} // namespace voxelcore
