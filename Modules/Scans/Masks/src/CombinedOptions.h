#pragma once
// One option of each cluster, so that the whole has the numbers of pieces, loops and cavities that are wanted.

#include "ClusterChoices.h"

#include <vector>

namespace voxelcore
{

/** The options whose sum is nearest to `wanted`, of these the cheapest; step by step where all combinations are too
 *  many. Each cluster has an option that changes nothing. */
std::vector<const ClusterOption *>
CombineTowards(const std::vector<ClusterOptions> & all, const TopologyShift & wanted);

/** Of each cluster the option with the fewest pieces, loops and cavities, then the cheapest. */
std::vector<const ClusterOption *>
CombineFewest(const std::vector<ClusterOptions> & all);

} // namespace voxelcore
