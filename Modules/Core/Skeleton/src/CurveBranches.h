#pragma once
// The branches of a collapsed surface as fire along its curves leaves them: which stand out, and where they end.

#include "CurveFire.h"

#include <vector>

namespace voxelcore
{

/** A branch: from the end where its fire began to where that lost to fire that had come a longer way. One that wins
 *  wherever it meets others runs on as far as fire goes; in a component without cycles two do. What a branch is does
 *  not depend on which others are kept. */
struct CurveBranch
{
  std::vector<ElementIndex> path;     ///< vertices from its end on, the one where it lost or fire ended included
  std::size_t               end = 0;  ///< the body ends so much of the way from this vertex of the path to the next;
  double                    part = 0; ///< the last one when nowhere
};

/** Lengths in mm. */
struct BranchScale
{
  double window = 0; ///< over ways so long the curve's zigzag over edges of the surface does not count
  double voxel = 0;  ///< as CurveOptions has it
};

/** The branches whose fire falls behind the surface's by `standOut` at some time and that run along the middle of the
 *  surface somewhere, and those they spring from: a higher threshold gives a part of them. In the order of their
 *  ends' fire. */
std::vector<CurveBranch>
StandingBranches(const MedialComplex &       surface,
                 const CurveFire &           fire,
                 const std::vector<double> & surfaceTime,
                 const BranchScale &         scale,
                 double                      standOut);

} // namespace voxelcore
