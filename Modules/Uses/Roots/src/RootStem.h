#pragma once
// Which way through a skeleton is the stem.

#include "RootFlow.h"

namespace voxelcore
{

/** The thickest long ways through a skeleton: of all ways in the forest of the widest branches, those with the greatest
 *  sum of length times radius to the third power. A way goes on from branch to branch as long as neither is much
 *  thinner than the other; where it may go on in several ways, those count less that turn. It ends where it is one of
 *  several roots about as thick, and thinner than the stem. The base is the end that is thicker and farther from the
 *  middle of the skeleton, or the upper one where `up` is known. `rules.stem`, `rules.stems` and `rules.up` say where,
 *  how many, and what is up. */
std::vector<StemWay>
FindStems(const RootBranches & branches, const std::optional<Vector3> & up, const RootRules & rules);

} // namespace voxelcore
