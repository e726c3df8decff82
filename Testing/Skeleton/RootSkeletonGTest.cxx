// The skeleton of a root against the centre lines it was grown along.

#include "TubeShapes.h"

#include "voxelcore/BranchTable.h"

#include <algorithm>
#include <bit>
#include <iostream>

namespace voxelcore::testing
{

namespace
{

struct Tip
{
  Spacing3 position{};
  double   radius = 0;
  double   protrudes = 0; ///< how far beyond the surface of the branch it springs from, mm
};

std::vector<Tip>
TrueTips(const PhantomOptions & options)
{
  const std::vector<CentreLinePoint> lines = RootCentreLines(options);
  const auto                         place = [&](const CentreLinePoint & point) {
    return Spacing3{ point.position[0] * options.spacing[0],
                     point.position[1] * options.spacing[1],
                     point.position[2] * options.spacing[2] };
  };
  std::vector<Tip> tips{ { place(lines[0]), lines[0].radius, 1e9 } };
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    if (i + 1 < lines.size() && lines[i + 1].branch == lines[i].branch)
    {
      continue;
    }
    Tip         tip{ place(lines[i]), lines[i].radius, 1e9 };
    std::size_t first = i;
    while (lines[first].parent >= 0 && lines[static_cast<std::size_t>(lines[first].parent)].branch == lines[i].branch)
    {
      first = static_cast<std::size_t>(lines[first].parent);
    }
    if (lines[first].parent >= 0)
    {
      const std::int32_t parent = lines[static_cast<std::size_t>(lines[first].parent)].branch;
      for (const CentreLinePoint & point : lines)
      {
        if (point.branch == parent)
        {
          tip.protrudes = std::min(tip.protrudes, Distance(place(point), tip.position) - point.radius);
        }
      }
    }
    tips.push_back(tip);
  }
  return tips;
}

struct Score
{
  std::size_t expected = 0;
  std::size_t missed = 0;
  std::size_t found = 0;
  std::size_t spurious = 0;
};

void
Compare(std::int32_t size, double slice, std::uint64_t seed, Score & score)
{
  PhantomOptions options;
  options.kind = "root";
  options.spacing = { 1, 1, slice };
  options.size = { size, size, static_cast<std::int32_t>(size / slice) };
  options.seed = seed;
  const CurveSkeleton   skeleton = SkeletonOf(SurfaceOf(MakePhantom(options), options.spacing), 3);
  const auto            degrees = Degrees(skeleton.complex.cells);
  std::vector<Spacing3> ends;
  for (std::size_t v = 0; v < degrees.size(); ++v)
  {
    if (degrees[v] == 1)
    {
      ends.push_back(skeleton.complex.positions[v]);
    }
  }
  std::vector<std::uint8_t> used(ends.size(), 0);
  for (const Tip & tip : TrueTips(options))
  {
    std::size_t nearest = 0;
    for (std::size_t end = 1; end < ends.size(); ++end)
    {
      nearest = Distance(ends[end], tip.position) < Distance(ends[nearest], tip.position) ? end : nearest;
    }
    const bool found = Distance(ends[nearest], tip.position) <= tip.radius + 3 * slice;
    used[nearest] |= found ? 1 : 0;
    if (tip.protrudes > 6)
    {
      ++score.expected;
      score.missed += found ? 0 : 1;
    }
  }
  score.found += ends.size();
  score.spurious += static_cast<std::size_t>(std::count(used.begin(), used.end(), std::uint8_t{ 0 }));
}

TEST(RootSkeleton, HasTheTrueTipsAndNoOthers)
{
  Score score;
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
  {
    Compare(96, 1, seed, score);
    Compare(96, 2, seed, score);
  }
  ASSERT_GT(score.expected, 50U);
  EXPECT_EQ(score.missed, 0U);
  EXPECT_LE(static_cast<double>(score.spurious), 0.02 * static_cast<double>(score.found));
}

TEST(RootSkeleton, HasTheTrueLength)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
  {
    PhantomOptions options;
    options.kind = "root";
    options.size = { 96, 96, 96 };
    options.seed = seed;
    const auto lines = RootCentreLines(options);
    double     length = 0;
    for (const CentreLinePoint & point : lines)
    {
      length += point.parent < 0 ? 0 : Distance(point.position, lines[static_cast<std::size_t>(point.parent)].position);
    }
    EXPECT_NEAR(TotalLength(GraphOf(MakePhantom(options))), length, 0.03 * length) << "seed " << seed;
  }
}

TEST(RootSkeleton, IsTheSameInAllRotationsOfTheGrid)
{
  const std::int32_t    n = 96;
  const VoxelShape      shape = PhantomShape("root", n, 2);
  const SkeletonNumbers expected = MeasureBranches(GraphOf(shape)).numbers;
  EXPECT_GT(expected.tips, 8);
  Size3 axes{ 0, 1, 2 };
  int   rotations = 0;
  do
  {
    const int odd = (axes[0] > axes[1]) + (axes[0] > axes[2]) + (axes[1] > axes[2]);
    for (unsigned mirrored = 0; mirrored < 8; ++mirrored)
    {
      if ((odd + std::popcount(mirrored)) % 2 != 0)
      {
        continue; // a reflection
      }
      const VoxelShape      turned = ShapeWhere({ n, n, n }, [&](int x, int y, int z) {
        Size3       from{};
        const Size3 to{ x, y, z };
        for (std::size_t k = 0; k < 3; ++k)
        {
          from[static_cast<std::size_t>(axes[k])] = (mirrored >> k) % 2 == 1 ? n - 1 - to[k] : to[k];
        }
        return shape.Contains(from[0], from[1], from[2]);
      });
      const SkeletonNumbers numbers = MeasureBranches(GraphOf(turned)).numbers;
      EXPECT_EQ(numbers.components, expected.components);
      EXPECT_EQ(numbers.cycles, expected.cycles);
      EXPECT_EQ(numbers.tips, expected.tips);
      EXPECT_EQ(numbers.junctions, expected.junctions);
      EXPECT_NEAR(numbers.totalLength, expected.totalLength, 0.01 * expected.totalLength);
      ++rotations;
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  EXPECT_EQ(rotations, 24);
}

TEST(HeavyRootSkeleton, HasTheTrueTipsOverSeedsAndResolutions)
{
  for (const double slice : { 1.0, 2.0 })
  {
    for (const std::int32_t size : { 96, 160, 256 })
    {
      Score score;
      for (std::uint64_t seed = 1; seed <= 20; ++seed)
      {
        Compare(size, slice, seed, score);
      }
      std::cout << size << ", slices " << slice << ": " << score.expected << " true tips, " << score.missed
                << " missed, " << score.spurious << " of " << score.found << " spurious\n";
      // Known to be missed: 4 of 264 at worst, where a tip is taken off too far or the phantom's voxels touch.
      EXPECT_LE(static_cast<double>(score.missed), 0.02 * static_cast<double>(score.expected));
      EXPECT_LE(static_cast<double>(score.spurious), 0.05 * static_cast<double>(score.found));
    }
  }
}

} // namespace

} // namespace voxelcore::testing
