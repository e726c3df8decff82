// Curve skeletons of shapes whose answer is known, scored.

#include "../Core/Skeleton/HandShape.h"
#include "../Uses/Roots/RootScore.h"
#include "VoxelCoreTesting/SurfaceNoise.h"

#include "voxelcore/Masks/ShapeSmoothing.h"
#include "voxelcore/Skeleton/BranchTable.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace voxelcore::testing
{

namespace
{

void
ScoreRoots(std::uint64_t seeds, std::int32_t greatest)
{
  std::printf("\nroots, %d seeds       true tips  missed  found  spurious %%  length off %%: mean  worst  radius off\n",
              static_cast<int>(seeds));
  for (const double slice : { 1.0, 2.0 })
  {
    for (const std::int32_t size : { 96, 160, 256 })
    {
      if (size > greatest)
      {
        continue;
      }
      Score score;
      for (std::uint64_t seed = 1; seed <= seeds; ++seed)
      {
        CompareRoot(size, slice, seed, score);
      }
      std::printf("%4d, 1:1:%.0f           %8zu %7zu %6zu %11.2f %19.2f %6.2f %11.2f\n",
                  size,
                  slice,
                  score.expected,
                  score.missed,
                  score.found,
                  100.0 * static_cast<double>(score.spurious) / static_cast<double>(score.found),
                  100 * score.sumOfLengths / static_cast<double>(seeds),
                  100 * score.worstLength,
                  score.worstRadius);
    }
  }
}

double
Change(double value, double expected)
{
  return value == expected ? 0 : std::abs(value - expected) / std::max(expected, 1.0);
}

struct Invariance
{
  int    pairs = 0;
  int    topology = 0; ///< pairs with other components or cycles
  int    same = 0;     ///< pairs with the same tips and junctions
  double tips = 0;     ///< greatest change, part of the whole
  double junctions = 0;
  double length = 0;
};

void
ScoreRotations(std::uint64_t seeds)
{
  std::printf(
    "\n24 rotations          pairs  b0, b1 lost  tips, junctions same %%  worst %%: tips  junctions  length\n");
  for (const char * kind : { "root", "gyroid", "torus", "tanglecube", "porous", "ellipsoid" })
  {
    const std::int32_t n = std::strcmp(kind, "root") == 0 ? 96 : 32;
    const bool         isSeeded = std::strcmp(kind, "root") == 0 || std::strcmp(kind, "porous") == 0;
    Invariance         score;
    for (std::uint64_t seed = 1; seed <= (isSeeded ? seeds : 1); ++seed)
    {
      const VoxelShape      shape = PhantomShape(kind, n, seed);
      const SkeletonNumbers expected = MeasureBranches(GraphOf(shape)).numbers;
      ForRotations(shape, n, [&](const VoxelShape & turned) {
        const SkeletonNumbers numbers = MeasureBranches(GraphOf(turned)).numbers;
        ++score.pairs;
        score.topology += numbers.components != expected.components || numbers.cycles != expected.cycles;
        score.same += numbers.tips == expected.tips && numbers.junctions == expected.junctions;
        const auto change = [](auto now, auto before) {
          return Change(static_cast<double>(now), static_cast<double>(before));
        };
        score.tips = std::max(score.tips, change(numbers.tips, expected.tips));
        score.junctions = std::max(score.junctions, change(numbers.junctions, expected.junctions));
        score.length = std::max(score.length, change(numbers.totalLength, expected.totalLength));
      });
    }
    std::printf("%-20s %6d %12d %23.1f %14.1f %10.1f %7.2f\n",
                kind,
                score.pairs,
                score.topology,
                100.0 * score.same / score.pairs,
                100 * score.tips,
                100 * score.junctions,
                100 * score.length);
  }
}

/** Clean, flipped, and flipped and set right: with any flips mended first, for they tear and pierce what is thin. */
void
ScoreNoise(std::uint64_t seeds)
{
  std::printf(
    "\n5 %% of boundary voxels flipped      branches  with noise  change %%  set right  change %%   cycles: "
    "clean  noise  set right\n");
  for (const bool simple : { true, false })
  {
    for (const std::int32_t n : { 96, 160 })
    {
      std::array<SkeletonNumbers, 3> sums;
      for (std::uint64_t seed = 1; seed <= seeds; ++seed)
      {
        const auto add = [](const VoxelShape & shape, SkeletonNumbers & sum) {
          const SkeletonNumbers numbers = MeasureBranches(GraphOf(shape)).numbers;
          sum.branches += numbers.branches;
          sum.cycles += numbers.cycles;
        };
        const VoxelShape shape = PhantomShape("root", n, seed);
        const VoxelShape flipped = Flipped(shape, n, seed, simple);
        add(shape, sums[0]);
        add(flipped, sums[1]);
        add(SmoothShape(simple ? flipped : MendShape(flipped).shape).shape, sums[2]);
      }
      const auto change = [&](std::size_t i) {
        return 100 * Change(static_cast<double>(sums[i].branches), static_cast<double>(sums[0].branches));
      };
      std::printf("root %3d, %s %14lld %11lld %9.1f %10lld %9.1f %15lld %6lld %10lld\n",
                  n,
                  simple ? "topology kept" : "any voxels   ",
                  static_cast<long long>(sums[0].branches),
                  static_cast<long long>(sums[1].branches),
                  change(1),
                  static_cast<long long>(sums[2].branches),
                  change(2),
                  static_cast<long long>(sums[0].cycles),
                  static_cast<long long>(sums[1].cycles),
                  static_cast<long long>(sums[2].cycles));
    }
  }
}

/** The graph of what tolerance leaves of a core, in the fire of all of it. */
SkeletonGraph
GraphAtToleranceOf(const VoxelShape & shape, const Spacing3 & spacing, double diagonals)
{
  MedialComplex core = CoreWithTolerancesOf(shape, spacing);
  for (auto & position : core.positions)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      position[axis] *= spacing[axis];
    }
  }
  const LiveElements left = LeftByTolerance(core, diagonals * Distance(spacing, { 0, 0, 0 }));
  return GraphOfSurface(core, spacing, &left);
}

/** Tips of the hand that no tip of the skeleton comes near to, and tips beyond them. */
void
CompareHand(double scale, int turn, const GraphMaker & graphOf, Score & score)
{
  std::vector<Spacing3> ends;
  const VoxelShape      shape = Voxels(MakeHand(), scale, 0.9 * turn, 0.55 * turn, ends);
  const SkeletonGraph   graph = graphOf(shape, { 1, 1, 1 });
  std::size_t           met = 0;
  for (const Spacing3 & end : ends)
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t node = 0; node < graph.nodePoints.size(); ++node)
    {
      if (graph.nodeKinds[node] == NodeKind::Tip)
      {
        nearest = std::min(nearest, Distance(graph.positions[graph.nodePoints[node]], end));
      }
    }
    met += nearest <= 3 + 3 * scale ? 1 : 0;
  }
  const auto tips = static_cast<std::size_t>(std::count(graph.nodeKinds.begin(), graph.nodeKinds.end(), NodeKind::Tip));
  score.expected += ends.size();
  score.missed += ends.size() - met;
  score.found += tips;
  score.spurious += tips - std::min(tips, met);
}

/** Skeletons of the whole core beside those of a surface that was pruned before it was burnt. */
void
ScoreSurfaces(std::uint64_t seeds)
{
  const std::vector<std::pair<const char *, GraphMaker>> makers{
    { "whole core", GraphOf },
    { "lambda 1.5vox",
      [](const VoxelShape & shape, const Spacing3 & spacing) {
        const double voxel = std::min({ spacing[0], spacing[1], spacing[2] });
        return GraphOfSurface(SurfaceOf(shape, spacing, 1.5 * voxel), spacing);
      } },
    { "tolerance 1.2diag",
      [](const VoxelShape & shape, const Spacing3 & spacing) { return GraphAtToleranceOf(shape, spacing, 1.2); } },
  };
  std::printf(
    "\nskeletons of surfaces, %d seeds   true tips  missed  found  spurious  length off %%: mean  worst  "
    "radius off\n",
    static_cast<int>(seeds));
  for (const auto & [name, graphOf] : makers)
  {
    for (const auto & [size, slice] : std::vector<std::pair<int, double>>{ { 96, 1.0 }, { 160, 1.0 }, { 160, 2.0 } })
    {
      Score score;
      for (std::uint64_t seed = 1; seed <= seeds; ++seed)
      {
        CompareRoot(size, slice, seed, score, graphOf);
      }
      std::printf("%-14s root %3d, 1:1:%.0f %15zu %7zu %6zu %9zu %19.2f %6.2f %11.2f\n",
                  name,
                  size,
                  slice,
                  score.expected,
                  score.missed,
                  score.found,
                  score.spurious,
                  100 * score.sumOfLengths / static_cast<double>(seeds),
                  100 * score.worstLength,
                  score.worstRadius);
    }
    Score score;
    for (const double scale : { 0.4, 0.6, 0.9 })
    {
      for (int turn = 0; turn < 4; ++turn)
      {
        CompareHand(scale, turn, graphOf, score);
      }
    }
    std::printf("%-14s hands %22zu %7zu %6zu %9zu\n", name, score.expected, score.missed, score.found, score.spurious);
    std::fflush(stdout);
  }
}

} // namespace

} // namespace voxelcore::testing

int
main(int argc, char ** argv)
{
  std::uint64_t seeds = 20;
  std::int32_t  greatest = 256;
  std::string   only;
  for (int i = 1; i < argc; ++i)
  {
    const bool hasValue = i + 1 < argc;
    if (hasValue && std::strcmp(argv[i], "--seeds") == 0 && std::atoi(argv[i + 1]) > 0)
    {
      seeds = static_cast<std::uint64_t>(std::atoi(argv[++i]));
    }
    else if (hasValue && std::strcmp(argv[i], "--greatest") == 0 && std::atoi(argv[i + 1]) >= 96)
    {
      greatest = std::atoi(argv[++i]);
    }
    else if (hasValue && std::strcmp(argv[i], "--only") == 0)
    {
      only = argv[++i];
    }
    else
    {
      std::fprintf(stderr,
                   "usage: %s [--seeds N] [--greatest 96|160|256] [--only rotations|noise|surfaces|roots]\n",
                   argv[0]);
      return 2;
    }
  }
  const auto wants = [&](const char * what) { return only.empty() || only == what; };
  if (wants("rotations"))
  {
    voxelcore::testing::ScoreRotations(std::min<std::uint64_t>(seeds, 5));
  }
  std::fflush(stdout);
  if (wants("noise"))
  {
    voxelcore::testing::ScoreNoise(seeds);
  }
  std::fflush(stdout);
  if (wants("surfaces"))
  {
    voxelcore::testing::ScoreSurfaces(std::min<std::uint64_t>(seeds, 5));
  }
  if (wants("roots"))
  {
    voxelcore::testing::ScoreRoots(seeds, greatest);
  }
  return 0;
}
