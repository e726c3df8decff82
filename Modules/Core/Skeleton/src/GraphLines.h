#pragma once
// A graph's branches as lists of points, to be cut and joined; SortBranches() makes branches of them again.

#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <cstdint>
#include <vector>

namespace voxelcore
{

using GraphLines = std::vector<std::vector<ElementIndex>>;

GraphLines
LinesOf(const SkeletonGraph & graph);

/** A new point at the same place. */
ElementIndex
CopyPoint(SkeletonGraph & graph, ElementIndex point);

/** Keeps the branches with a flag, and all faces and isolated points; what then meets in twos is joined. */
void
KeepBranches(SkeletonGraph & graph, const std::vector<std::uint8_t> & stays);

/** Keeps the points with a flag, in their order. */
void
KeepPoints(SkeletonGraph & graph, GraphLines & lines, const std::vector<std::uint8_t> & keep);

} // namespace voxelcore
