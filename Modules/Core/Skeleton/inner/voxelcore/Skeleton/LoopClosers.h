#pragma once
// Which branches of a skeleton close loops.

#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace voxelcore
{

/** Per branch the radius of its least ball, mm. */
std::vector<double>
LeastRadii(const SkeletonGraph & graph);

/** Per branch whether it closes a loop when branches are put in one by one, the thickest first, of equals the first:
 *  the others are a forest of the thickest (Kruskal 1956). `nodeOf`: per node a number below that of nodes, the same
 *  for those that count as one. */
std::vector<std::uint8_t>
FindLoopClosers(const SkeletonGraph &             graph,
                const std::vector<ElementIndex> & nodeOf,
                const std::vector<double> &       thickness);

/** Of the loops through a branch the thickest: the branch that closes it. None where no loop passes. */
std::optional<std::size_t>
FindCloserOf(const SkeletonGraph & graph, std::size_t branch);

} // namespace voxelcore
