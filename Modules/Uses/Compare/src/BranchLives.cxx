#include "voxelcore/Compare/BranchLives.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Compare/CentrelineOverlap.h"
#include "voxelcore/Compare/TreeComparison.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace voxelcore
{

namespace
{

/** The same branches, each by itself, but for what is not free of them. */
SkeletonGraph
FreeParts(const SkeletonGraph & tree)
{
  SkeletonGraph free;
  const auto &  radii = SectionRadii(tree);
  for (std::size_t branch = 0; branch < tree.BranchCount(); ++branch)
  {
    const auto points = tree.Branch(branch);
    const auto isFree = [&](ElementIndex point) {
      const auto holds = [&](std::size_t end) {
        const ElementIndex at = end == 0 ? points.front() : points.back();
        return tree.nodeKinds[tree.branchNodes[branch][end]] == NodeKind::Junction &&
               Distance(tree.positions[point], tree.positions[at]) <= tree.radius[at];
      };
      return !holds(0) && !holds(1);
    };
    auto first = std::find_if(points.begin(), points.end(), isFree);
    auto end = std::find_if(points.rbegin(), std::make_reverse_iterator(first), isFree).base();
    if (end - first < 2)
    {
      first = points.begin();
      end = points.end();
    }
    for (auto point = first; point != end; ++point)
    {
      if (point == first || point + 1 == end)
      {
        free.nodePoints.push_back(static_cast<ElementIndex>(free.positions.size()));
        free.nodeKinds.push_back(NodeKind::Tip);
      }
      free.branchPoints.push_back(static_cast<ElementIndex>(free.positions.size()));
      free.positions.push_back(tree.positions[*point]);
      free.radius.push_back(radii[*point]);
    }
    const auto nodes = static_cast<ElementIndex>(free.nodePoints.size());
    free.branchNodes.push_back({ nodes - 2, nodes - 1 });
    free.branchOffsets.push_back(free.branchPoints.size());
  }
  return free;
}

} // namespace

std::vector<BranchLife>
LivesOf(const SkeletonGraph & tree, std::size_t own, const TreesOfThresholds & all, const ProgressCallback & progress)
{
  const std::size_t       count = tree.BranchCount();
  const SkeletonGraph     parts = FreeParts(tree);
  std::vector<BranchLife> lives(count, { all.thresholds[own], all.thresholds[own] });
  for (const bool up : { false, true })
  {
    std::vector<std::uint8_t> goesOn(count, 1);
    for (std::size_t other = own; up ? other + 1 < all.trees.size() : other > 0;)
    {
      if (ranges::count(goesOn, 1) == 0)
      {
        break;
      }
      other = up ? other + 1 : other - 1;
      ReportProgress(progress,
                     "branches",
                     (up ? 0.5 : 0) + 0.5 * static_cast<double>(other) / static_cast<double>(all.trees.size()));
      const SkeletonGraph & there = all.trees[other];
      const TreeComparison  compared = up ? CompareTrees(there, parts, {}) : CompareTrees(parts, there, {});
      const auto &          matches = up ? compared.b : compared.a;
      for (std::size_t branch = 0; branch < count; ++branch)
      {
        goesOn[branch] = goesOn[branch] != 0 && matches[branch].IsFound() ? 1 : 0;
        if (goesOn[branch] != 0)
        {
          (up ? lives[branch].highest : lives[branch].lowest) = all.thresholds[other];
        }
      }
    }
  }
  return lives;
}

std::vector<std::uint8_t>
StableOnes(std::span<const BranchLife> lives, double persistence)
{
  std::vector<std::uint8_t> stable;
  for (const BranchLife & life : lives)
  {
    // 0.3 less 0.1 is less than 0.2 in doubles.
    stable.push_back(life.Persistence() >= persistence - kLengthRounding ? 1 : 0);
  }
  return stable;
}

std::size_t
StablestThreshold(const TreesOfThresholds & all, const std::vector<std::vector<BranchLife>> & lives, double persistence)
{
  std::vector<double> kept(all.thresholds.size(), 0);
  for (std::size_t tree = 0; tree < all.trees.size(); ++tree)
  {
    const auto stable = StableOnes(lives[tree], persistence);
    for (std::size_t branch = 0; branch < stable.size(); ++branch)
    {
      for (std::size_t i = 0; i < kept.size() && stable[branch] != 0; ++i)
      {
        const BranchLife & life = lives[tree][branch];
        if (all.thresholds[i] >= life.lowest && all.thresholds[i] <= life.highest)
        {
          kept[i] += all.trees[tree].BranchLength(branch);
        }
      }
    }
  }
  const double most = ranges::max(kept);
  if (!(most > 0))
  {
    throw InputError(
      "no branch lives over so much of the probabilities; ask for less persistence, or give more "
      "thresholds");
  }
  std::size_t best = 0;
  double      nearest = 2; // more than any distance of probabilities
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    const double away = std::abs(all.thresholds[i] - 0.5);
    if (kept[i] >= kKeptShare * most && away <= nearest + kLengthRounding)
    {
      nearest = away;
      best = i;
    }
  }
  return best;
}

} // namespace voxelcore
