// Lives of branches, looked at again without what CompareTrees() uses to find its way.

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Compare/BranchLives.h"
#include "voxelcore/Compare/CentrelineOverlap.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace voxelcore
{

namespace
{

struct Piece
{
  ElementIndex a = 0;
  ElementIndex b = 0;
};

struct Sample
{
  Vector3 place{};
  double  radius = 0;
};

/** How strictly to look. CompareTrees() looks at places a quarter of a radius apart, and this at others: where a run
 *  begins and ends, each may be off by one. The strict look must be beyond doubt, the lenient one come close. */
struct Look
{
  double reach;  ///< times the radius
  double margin; ///< to kDetectedShare, besides places
  bool   cuts;   ///< runs break within pieces, too
};
constexpr Look   kLenient{ 1.02, -0.02, false };
constexpr Look   kStrict{ 0.98, 0.02, true };
constexpr double kStep = 0.25; ///< of the smaller median radius, between places
constexpr double kPlaces = 2;  ///< at the ends of a run

constexpr std::size_t kSamples = 200; ///< of a branch: one is half a hundredth of it
constexpr int         kCuts = 8;      ///< of a piece, which is about a voxel long and no thinner than half of one

Vector3
Along(const Vector3 & from, const Vector3 & to, double share)
{
  return AddScaled(from, share, Minus(to, from));
}

/** The points of a branch outside the balls at its junctions, with all between them. */
std::vector<ElementIndex>
FreePoints(const SkeletonGraph & tree, std::size_t branch)
{
  const auto  all = tree.Branch(branch);
  std::size_t first = all.size();
  std::size_t last = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    bool isFree = true;
    for (const ElementIndex node : tree.branchNodes[branch])
    {
      const ElementIndex at = tree.nodePoints[node];
      isFree = isFree && (tree.nodeKinds[node] != NodeKind::Junction ||
                          Distance(tree.positions[at], tree.positions[all[i]]) > tree.radius[at]);
    }
    first = isFree ? std::min(first, i) : first;
    last = isFree ? i : last;
  }
  const bool isNone = first >= last;
  return { all.begin() + (isNone ? 0 : static_cast<std::ptrdiff_t>(first)),
           isNone ? all.end() : all.begin() + static_cast<std::ptrdiff_t>(last) + 1 };
}

double
LengthOf(const SkeletonGraph & tree, const std::vector<ElementIndex> & points)
{
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    length += Distance(tree.positions[points[i - 1]], tree.positions[points[i]]);
  }
  return length;
}

std::vector<Sample>
SamplesOf(const SkeletonGraph & tree, const std::vector<ElementIndex> & points)
{
  const auto &        radii = SectionRadii(tree);
  std::vector<Sample> samples;
  const double        step = LengthOf(tree, points) / kSamples;
  double              arc = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    const Vector3 & from = tree.positions[points[i - 1]];
    const Vector3 & to = tree.positions[points[i]];
    const double    length = Distance(from, to);
    for (double next = (static_cast<double>(samples.size()) + 0.5) * step;
         next <= arc + length && samples.size() < kSamples;
         next += step)
    {
      const double share = length > 0 ? (next - arc) / length : 0;
      samples.push_back(
        { Along(from, to, share), radii[points[i - 1]] + share * (radii[points[i]] - radii[points[i - 1]]) });
    }
    arc += length;
  }
  return samples;
}

std::vector<Piece>
PiecesOf(const SkeletonGraph & tree)
{
  std::vector<Piece> pieces;
  for (std::size_t branch = 0; branch < tree.BranchCount(); ++branch)
  {
    const auto points = tree.Branch(branch);
    for (std::size_t i = 1; i < points.size(); ++i)
    {
      pieces.push_back({ points[i - 1], points[i] });
    }
  }
  return pieces;
}

double
MedianOfRadii(const SkeletonGraph & tree)
{
  std::vector<double> radii = SectionRadii(tree);
  if (radii.empty())
  {
    return 0;
  }
  const auto middle = radii.begin() + std::ssize(radii) / 2;
  std::nth_element(radii.begin(), middle, radii.end());
  return *middle;
}

/** Whether one connected run of `there` follows so much of the samples, by the radii of `there` or of the samples. */
bool
IsThere(const std::vector<Sample> & samples,
        const SkeletonGraph &       there,
        const std::vector<Piece> &  pieces,
        bool                        byThere,
        const Look &                look,
        double                      least)
{
  const auto & radii = SectionRadii(there);
  const int    cuts = look.cuts ? kCuts : 1;
  Vector3      low;
  Vector3      high;
  double       widest = 0;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const Sample & sample : samples)
  {
    widest = std::max(widest, sample.radius * look.reach);
    for (std::size_t k = 0; k < 3; ++k)
    {
      low[k] = std::min(low[k], sample.place[k]);
      high[k] = std::max(high[k], sample.place[k]);
    }
  }
  // What is near a sample, in cuts of pieces: ends of cuts are nodes that cuts are joined at.
  using Node = std::pair<std::size_t, int>; // a point, or a place within a piece
  std::map<Node, std::vector<std::size_t>> cutsAt;
  std::vector<std::array<Node, 2>>         ends;
  std::vector<std::vector<std::uint16_t>>  near; // samples of each cut
  for (std::size_t piece = 0; piece < pieces.size(); ++piece)
  {
    const auto [a, b] = pieces[piece];
    const Vector3 & from = there.positions[a];
    const Vector3 & to = there.positions[b];
    const double    most = byThere ? std::max(radii[a], radii[b]) * look.reach : widest;
    bool            isFar = false;
    for (std::size_t k = 0; k < 3; ++k)
    {
      isFar = isFar || std::max(from[k], to[k]) < low[k] - most || std::min(from[k], to[k]) > high[k] + most;
    }
    for (int cut = 0; cut < cuts && !isFar; ++cut)
    {
      const Vector3              begin = Along(from, to, static_cast<double>(cut) / cuts);
      const Vector3              way = Minus(Along(from, to, (cut + 1.0) / cuts), begin);
      const double               squared = Dot(way, way);
      std::vector<std::uint16_t> found;
      for (std::size_t i = 0; i < samples.size(); ++i)
      {
        const double share = squared > 0 ? std::clamp(Dot(Minus(samples[i].place, begin), way) / squared, 0.0, 1.0) : 0;
        const double radius = byThere ? radii[a] + (cut + share) / cuts * (radii[b] - radii[a]) : samples[i].radius;
        if (Distance(AddScaled(begin, share, way), samples[i].place) <= radius * look.reach)
        {
          found.push_back(static_cast<std::uint16_t>(i));
        }
      }
      if (!found.empty())
      {
        const Node first = cut == 0 ? Node{ a, 0 } : Node{ piece, cut };
        const Node last = cut + 1 == cuts ? Node{ b, 0 } : Node{ piece, cut + 1 };
        cutsAt[first].push_back(near.size());
        cutsAt[last].push_back(near.size());
        ends.push_back({ first, last });
        near.push_back(std::move(found));
      }
    }
  }
  std::vector<std::uint8_t> isSeen(near.size(), 0);
  for (std::size_t seed = 0; seed < near.size(); ++seed)
  {
    std::vector<std::uint8_t> followed(samples.size(), 0);
    std::vector<std::size_t>  waiting(isSeen[seed] == 0 ? 1 : 0, seed);
    isSeen[seed] = 1;
    while (!waiting.empty())
    {
      const std::size_t cut = waiting.back();
      waiting.pop_back();
      for (const std::uint16_t sample : near[cut])
      {
        followed[sample] = 1;
      }
      for (const Node & end : ends[cut])
      {
        for (const std::size_t next : cutsAt[end])
        {
          if (std::exchange(isSeen[next], 1) == 0)
          {
            waiting.push_back(next);
          }
        }
      }
    }
    if (static_cast<double>(ranges::count(followed, 1)) >= least * static_cast<double>(samples.size()))
    {
      return true;
    }
  }
  return false;
}

} // namespace

std::size_t
FindWrongLife(const SkeletonGraph &       tree,
              std::size_t                 own,
              const TreesOfThresholds &   all,
              std::span<const BranchLife> lives)
{
  std::vector<std::vector<Piece>> pieces;
  std::vector<double>             radius;
  for (const SkeletonGraph & there : all.trees)
  {
    pieces.push_back(PiecesOf(there));
    radius.push_back(MedianOfRadii(there));
  }
  const double             ownRadius = MedianOfRadii(tree);
  std::atomic<std::size_t> wrong = tree.BranchCount();
  RunEach(tree.BranchCount(), [&](std::size_t branch) {
    const auto   points = FreePoints(tree, branch);
    const auto   samples = SamplesOf(tree, points);
    const double length = LengthOf(tree, points);
    const auto   check = [&](std::size_t other, bool isThere) {
      const Look & look = isThere ? kLenient : kStrict;
      const double places = kPlaces * kStep * std::min(ownRadius, radius[other]) / length;
      const double least = kDetectedShare + look.margin + (isThere ? -places : places);
      const bool   judges = least > 0 && least <= 1; // a branch of a few places may be either
      if (judges && IsThere(samples, all.trees[other], pieces[other], other > own, look, least) != isThere)
      {
        std::size_t first = wrong;
        while (branch < first && !wrong.compare_exchange_weak(first, branch))
        {}
      }
    };
    const auto number = [&](double threshold) {
      return static_cast<std::size_t>(ranges::find(all.thresholds, threshold) - all.thresholds.begin());
    };
    const std::size_t lowest = number(lives[branch].lowest);
    const std::size_t highest = number(lives[branch].highest);
    for (const std::size_t end : { lowest, highest })
    {
      if (end != own)
      {
        check(end, true);
      }
    }
    if (lowest > 0)
    {
      check(lowest - 1, false);
    }
    if (highest + 1 < all.trees.size())
    {
      check(highest + 1, false);
    }
  });
  return wrong;
}

void
RequireLives(const SkeletonGraph &       tree,
             std::size_t                 own,
             const TreesOfThresholds &   all,
             std::span<const BranchLife> lives,
             const std::string &         where)
{
  if (const std::size_t wrong = FindWrongLife(tree, own, all, lives); wrong < tree.BranchCount())
  {
    throw CertificateError(where + ": branch " + std::to_string(wrong) + " of the tree at " +
                           ShortText(all.thresholds[own]) + " does not live as was found; nothing was written");
  }
}

} // namespace voxelcore
