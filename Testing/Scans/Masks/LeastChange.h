#pragma once
// Grey phantoms whose least change is known, or one near it, by code that shares nothing with VoxelCore's own: whole
// volumes at once, where VoxelCore grows candidates and looks into windows.

#include "GreyCase.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace voxelcore::testing
{

struct LeastChangeCase
{
  GreyCase        grey;
  TopologyRequest request;
  std::int64_t    numbers = 1; ///< pieces, loops and cavities wanted, together
  std::uint64_t   least = 0;   ///< known
};

/** - a neck between two balls, to be cut: the least vertex cut between them, by maximal flow;
 *  - a gap between two balls, to be bridged: the cheapest way over faces;
 *  - a ring with a weak arc, to be cut there: the least vertex cut across the arc;
 *  - a cavity, to be opened or filled: the cheapest way out over corners, or all of it; ways of one or two voxels are
 *    looked at one by one, as they may open more than one hole. */
std::vector<std::pair<const char *, LeastChangeCase (*)(std::uint64_t seed)>>
LeastChangeKinds();

/** Nothing in the kernel is taken out, nothing beyond the neighbourhood put in. */
bool
StaysBetween(const GreyCase & grey, const VoxelShape & result);

} // namespace voxelcore::testing
