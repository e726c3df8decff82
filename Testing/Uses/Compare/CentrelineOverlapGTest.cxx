#include "voxelcore/Compare/CentrelineOverlap.h"

#include "CompareGraphs.h"
#include "VoxelCoreTesting/Shapes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

ImageGeometry
Grid(const Size3 & size, const Vector3 & spacing = { 1, 1, 1 })
{
  ImageGeometry geometry;
  geometry.size = { size[0], size[1], size[2] };
  geometry.spacing = spacing;
  return geometry;
}

/** Which share of a line from p to q, in voxel indices, lies in a voxel: clipped by its three slabs. */
double
ShareIn(const Vector3 & p, const Vector3 & q, const std::array<std::int32_t, 3> & voxel)
{
  double begin = 0;
  double end = 1;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double d = q[k] - p[k];
    const double low = (voxel[k] - 0.5 - p[k]) / d;
    const double high = (voxel[k] + 0.5 - p[k]) / d;
    begin = std::max(begin, std::min(low, high));
    end = std::min(end, std::max(low, high));
  }
  return std::max(end - begin, 0.0);
}

// ATM'22 by hand. The reference's tree: a trunk of 10 mm and two branches of 10 and 5 mm. The other mask holds the
// trunk, the first branch up to half a voxel behind index 18, 8.5 mm, and 2.5 mm of the second. So 21 of 25 mm are
// detected (TD 0.84), and with 85 % of the first branch and 50 % of the second, two of three branches (BD 0.667).
TEST(CentrelineOverlap, DetectedBranchesAndLengthAreThoseCountedByHand)
{
  const Vector3       fork{ 10, 10, 0 };
  const SkeletonGraph graph = GraphOf({ { { 0, 10, 0 }, fork }, { fork, { 10, 20, 0 } }, { fork, { 15, 10, 0 } } }, 1);
  const VoxelShape    own = Box({ 30, 30, 1 });
  const auto          upTo = [](int end) {
    return ShapeWhere({ 30, 30, 1 }, [=](int x, int y, int) { return (y == 10 && x <= 12) || (x == 10 && y <= end); });
  };
  const CentrelineOverlap overlap = MeasureCentreline(graph, Grid({ 30, 30, 1 }), own, upTo(18));
  EXPECT_DOUBLE_EQ(overlap.length, 25);
  EXPECT_DOUBLE_EQ(overlap.lengthInside, 21);
  EXPECT_DOUBLE_EQ(overlap.LengthShare(), 0.84);
  EXPECT_EQ(overlap.branches, 3);
  EXPECT_EQ(overlap.detected, 2);
  EXPECT_DOUBLE_EQ(overlap.BranchShare(), 2.0 / 3.0);
  EXPECT_EQ(MeasureCentreline(graph, Grid({ 30, 30, 1 }), own, upTo(17)).detected, 1); // 75 %
}

TEST(CentrelineOverlap, ABranchWithJustEightyPercentIsDetected)
{
  const SkeletonGraph graph = GraphOf({ { { 0, 9.5, 0 }, { 0, 19.5, 0 } } }, 1);
  const auto          upTo17 = ShapeWhere({ 1, 30, 1 }, [](int, int y, int) { return y <= 17; });
  const auto          overlap = MeasureCentreline(graph, Grid({ 1, 30, 1 }), Box({ 1, 30, 1 }), upTo17);
  EXPECT_DOUBLE_EQ(overlap.lengthInside, 8);
  EXPECT_EQ(overlap.detected, 1);
}

// clDice by hand: A's skeleton has 10 voxels, of which 6 are in B; B's has 8, of which 6 are in A. Precision 6/8,
// sensitivity 6/10, and their harmonic mean is 2/3.
TEST(CentrelineOverlap, ClDiceIsTheHarmonicMeanOfBothShares)
{
  const SkeletonGraph lineA = GraphOf({ { { 0, 0, 0 }, { 9, 0, 0 } } }, 1);
  const SkeletonGraph lineB = GraphOf({ { { 4, 0, 0 }, { 11, 0, 0 } } }, 1);
  const VoxelShape    a = Box({ 10, 1, 1 });
  const VoxelShape    b = Box({ 8, 1, 1 }, { 4, 0, 0 });
  const auto          ofA = MeasureCentreline(lineA, Grid({ 20, 1, 1 }), a, b);
  const auto          ofB = MeasureCentreline(lineB, Grid({ 20, 1, 1 }), b, a);
  EXPECT_EQ(ofA.voxels, 10U);
  EXPECT_EQ(ofA.voxelsInside, 6U);
  EXPECT_EQ(ofB.voxels, 8U);
  EXPECT_EQ(ofB.voxelsInside, 6U);
  EXPECT_DOUBLE_EQ(ClDice(ofA, ofB), 2.0 / 3.0);
  EXPECT_EQ(ClDice(ofA, ofB), ClDice(ofB, ofA));
  EXPECT_EQ(
    ClDice(MeasureCentreline(lineA, Grid({ 20, 1, 1 }), a, a), MeasureCentreline(lineA, Grid({ 20, 1, 1 }), a, a)),
    1);
}

TEST(CentrelineOverlap, RandomLinesEqualClippingByEachVoxel)
{
  constexpr std::uint64_t seed = 6907;
  std::cout << "seeds from " << seed << '\n';
  for (int test = 0; test < 50; ++test)
  {
    SCOPED_TRACE("seed " + std::to_string(seed + static_cast<std::uint64_t>(test)));
    Random              random(seed + static_cast<std::uint64_t>(test));
    const Size3         size{ 12, 9, 10 };
    const ImageGeometry grid = Grid(size, TestSpacings()[static_cast<std::size_t>(test) % TestSpacings().size()]);
    std::vector<std::vector<Vector3>>        lines;
    std::vector<std::pair<Vector3, Vector3>> inVoxels;
    for (int line = 0; line < 4; ++line)
    {
      std::array<Vector3, 2> ends{};
      std::array<Vector3, 2> placed{};
      for (std::size_t end = 0; end < 2; ++end)
      {
        for (std::size_t k = 0; k < 3; ++k)
        {
          ends[end][k] = random.Unit() * (size[k] - 1);
          placed[end][k] = ends[end][k] * grid.spacing[k];
        }
      }
      inVoxels.emplace_back(ends[0], ends[1]);
      lines.push_back({ placed[0], placed[1] });
    }
    const SkeletonGraph graph = GraphOf(lines, 1);
    const VoxelShape    own = RandomShape(random, size, 0.9);
    const VoxelShape    other = RandomShape(random, size, 0.6);
    CentrelineOverlap   brute;
    for (std::int32_t z = 0; z < size[2]; ++z)
    {
      for (std::int32_t y = 0; y < size[1]; ++y)
      {
        for (std::int32_t x = 0; x < size[0]; ++x)
        {
          bool isPassed = false;
          for (std::size_t line = 0; line < lines.size() && own.Contains(x, y, z); ++line)
          {
            const double share = ShareIn(inVoxels[line].first, inVoxels[line].second, { x, y, z });
            double       length = 0;
            for (std::size_t k = 0; k < 3; ++k)
            {
              length += std::pow(lines[line][1][k] - lines[line][0][k], 2);
            }
            isPassed |= share > 1e-12;
            brute.length += share * std::sqrt(length);
            brute.lengthInside += other.Contains(x, y, z) ? share * std::sqrt(length) : 0;
          }
          brute.voxels += isPassed ? 1 : 0;
          brute.voxelsInside += isPassed && other.Contains(x, y, z) ? 1 : 0;
        }
      }
    }
    const CentrelineOverlap found = MeasureCentreline(graph, grid, own, other);
    EXPECT_EQ(found.voxels, brute.voxels);
    EXPECT_EQ(found.voxelsInside, brute.voxelsInside);
    EXPECT_NEAR(found.length, brute.length, 1e-9);
    EXPECT_NEAR(found.lengthInside, brute.lengthInside, 1e-9);
    EXPECT_EQ(SkeletonVoxels(graph, grid, own).size(), brute.voxels);
  }
}

TEST(CentrelineOverlap, LoopWhoseLineLeavesTheOtherMaskIsTold)
{
  // Two squares with a side in common: the loops of the shortest sides are the squares themselves.
  const std::vector<std::vector<Vector3>> squares{
    { { 5, 0, 0 }, { 5, 5, 0 } },
    { { 5, 0, 0 }, { 0, 0, 0 }, { 0, 5, 0 }, { 5, 5, 0 } },
    { { 5, 0, 0 }, { 11, 0, 0 }, { 11, 5, 0 }, { 5, 5, 0 } },
  };
  const SkeletonGraph graph = GraphOf(squares, 1);
  const ImageGeometry grid = Grid({ 12, 6, 1 });
  const VoxelShape    whole = Box({ 12, 6, 1 });
  EXPECT_TRUE(FindLeavingLoops(graph, grid, whole, PartChange::Missed).empty());
  const VoxelShape cut = ShapeWhere({ 12, 6, 1 }, [](int x, int y, int) { return !(x == 11 && (y == 2 || y == 3)); });
  const auto       loops = FindLeavingLoops(graph, grid, cut, PartChange::Missed);
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_EQ(loops[0].kind, PartKind::Loop);
  EXPECT_EQ(loops[0].voxels, 2U);
  EXPECT_EQ(loops[0].place[0], 11);
}

TEST(CentrelineOverlap, WithoutASkeletonThereIsNoShare)
{
  const CentrelineOverlap none = MeasureCentreline({}, Grid({ 5, 5, 5 }), Box({ 5, 5, 5 }), Box({ 5, 5, 5 }));
  EXPECT_TRUE(std::isnan(none.VoxelShare()));
  EXPECT_TRUE(std::isnan(none.LengthShare()));
  EXPECT_TRUE(std::isnan(none.BranchShare()));
  EXPECT_TRUE(std::isnan(ClDice(none, none)));
}

} // namespace
} // namespace voxelcore::testing
