#pragma once
// A map of probabilities, as networks give it, seen at several thresholds: which branches are there at which of them.
//
// The voxels of at least a threshold are a shape, and each such shape has a tree. A branch of one tree is there at
// another threshold when that tree has it, which its place along the lines tells (TreeComparison.h): one connected run
// of the other tree follows kDetectedShare of its free part at least, within the radii of the tree at the higher
// threshold, whose tubes are the thinner. It has no number to go by, and may be cut into several there, where twigs
// spring from it. The free part runs from the first to the last of its points that are outside the largest balls at
// its junctions: how a line finds its way through what it springs from says nothing of it. Where there are no two such
// points, all of it counts.
//
// A branch lives at the unbroken row of thresholds, its own among them, at which it is there. Its persistence is how
// far they reach: the highest less the lowest. It is stable when that is at least what is asked. What lies between two
// thresholds is not looked at: a branch that is there at 0.4 and not at 0.5 ends somewhere between them.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Skeleton/MeasuredSkeleton.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace voxelcore
{

/** Trees at rising thresholds; without points where the shape has no voxels. */
struct TreesOfThresholds
{
  std::vector<double>        thresholds;
  std::vector<SkeletonGraph> trees;
};

/** Of each branch of `tree` its life, where `tree` is one at number `own` of the thresholds. \throws Cancelled */
std::vector<BranchLife>
LivesOf(const SkeletonGraph &     tree,
        std::size_t               own,
        const TreesOfThresholds & all,
        const ProgressCallback &  progress = {});

/** Whether these are stable, as 0 or 1. */
std::vector<std::uint8_t>
StableOnes(std::span<const BranchLife> lives, double persistence);

/** The threshold whose tree keeps what is stable. Each stable branch of each tree counts with its length for all
 *  thresholds at which it lives. Of thresholds that keep kKeptShare of the most there is, the one nearest to 0.5 is
 *  taken, where the map is as sure of a voxel as of none; of two, the higher. `lives` are those of all trees.
 *  \throws InputError when nothing is stable */
std::size_t
StablestThreshold(const TreesOfThresholds &                    all,
                  const std::vector<std::vector<BranchLife>> & lives,
                  double                                       persistence);

/** Voxels are rounded, and tips recede with each threshold: a hundredth of the length is no reason to take another. */
inline constexpr double kKeptShare = 0.99;

/** Looks again, by other means than LivesOf(), whether branches are there at the ends of their lives, and are not there
 *  at the thresholds next to these: places along each branch against all pieces of lines near it, one by one.
 *  \returns the first branch that is not as told; BranchCount() where all are */
std::size_t
FindWrongLife(const SkeletonGraph &       tree,
              std::size_t                 own,
              const TreesOfThresholds &   all,
              std::span<const BranchLife> lives);

/** \throws CertificateError, naming the map `where`, when there is one */
void
RequireLives(const SkeletonGraph &       tree,
             std::size_t                 own,
             const TreesOfThresholds &   all,
             std::span<const BranchLife> lives,
             const std::string &         where);

} // namespace voxelcore
