#pragma once
// Trees of other programs: SWC, RSML and GraphML, read.

#include "voxelcore/Models/SkeletonModel.h"

#include <cstddef>
#include <filesystem>
#include <functional>

namespace voxelcore
{

/** Whether a path names a tree: .swc, .rsml or .graphml. */
bool
IsTreePath(const std::filesystem::path & path);

/** Reads a tree as one skeleton, label 1, its branches cut where more than two lines meet. Places are taken as LPS.
 *
 *  SWC: `id type x y z radius parent`, parents first, in micrometres; in voxels where VoxelCore's head says so.
 *
 *  RSML: polylines of roots, in the unit of `<unit>` (mm, cm, m, um or pixel) with `<resolution>` 1, and radii of half
 *  the function "diameter", where there is one. A lateral hangs on that point of its parent that is nearest to its
 *  first; where they are apart, a straight line joins them.
 *
 *  GraphML: nodes with x, y and, where there is one, z and radius; edges are straight, or pass through "points" as
 *  WriteGraphMl says. In mm unless the graph's "unit" is voxels. \throws InputError */
SkeletonModel
ReadTreeFile(const std::filesystem::path & path);

/** Whether to take a branch, by the numbers of its part and its own. */
using BranchChoice = std::function<bool(std::size_t part, std::size_t branch)>;

/** The same lines as one skeleton, whatever label they are of, cut where more than two meet. With `choice` those
 *  branches alone, and no isolated points. */
SkeletonGraph
MergedGraph(const SkeletonModel & model, const BranchChoice & choice = {});

} // namespace voxelcore
