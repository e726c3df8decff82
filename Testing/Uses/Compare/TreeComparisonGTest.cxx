#include "voxelcore/Compare/TreeComparison.h"

#include "CompareGraphs.h"
#include "VoxelCoreTesting/Random.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <numbers>

namespace voxelcore::testing
{
namespace
{

using Line = std::vector<Vector3>;

/** A trunk along x and two branches off its end. */
std::vector<Line>
Fork(double scale = 1)
{
  const Vector3 fork{ 20 * scale, 0, 0 };
  return { { { 0, 0, 0 }, fork }, { fork, { 30 * scale, 10 * scale, 0 } }, { fork, { 30 * scale, -10 * scale, 0 } } };
}

std::array<int, 3>
Counted(const std::vector<PlaceMatch> & places)
{
  std::array<int, 3> count{}; // found, missed, invented
  for (const PlaceMatch & place : places)
  {
    ++count[place.inA && place.inB ? 0 : place.inA ? 1 : 2];
  }
  return count;
}

TEST(TreeComparison, ATreeIsAllFoundInItself)
{
  const SkeletonGraph  tree = GraphOf(Fork(), 1);
  const TreeComparison same = CompareTrees(tree, tree, {});
  for (const auto * branches : { &same.a, &same.b })
  {
    const BranchTotals totals = TotalsOf(*branches);
    EXPECT_EQ(totals.branches, 3);
    EXPECT_EQ(totals.found, 3);
    EXPECT_DOUBLE_EQ(totals.length, 20 + 2 * std::sqrt(200));
    EXPECT_DOUBLE_EQ(totals.foundLength, totals.length);
  }
  EXPECT_EQ(Counted(same.tips), (std::array<int, 3>{ 3, 0, 0 }));
  EXPECT_EQ(Counted(same.bifurcations), (std::array<int, 3>{ 1, 0, 0 }));
  EXPECT_NEAR(same.all.max, 0, 1e-12);
  EXPECT_NEAR(same.radiusBias, 0, 1e-12);
}

TEST(TreeComparison, ALineOfAnyLengthIsCutIntoWhatMemoryHolds)
{
  for (const double length : { 1e9, 1e14 })
  {
    const SkeletonGraph far = GraphOf({ { { 0, 0, 0 }, { length, 0, 0 } } }, 1);
    const SkeletonGraph near = GraphOf({ { { 0, 0, 0 }, { 40, 0, 0 } } }, 1);
    EXPECT_EQ(TotalsOf(CompareTrees(near, far, {}).a).found, 1) << length;
    EXPECT_EQ(TotalsOf(CompareTrees(far, far, {}).a).found, 1) << length;
  }
  const SkeletonGraph beyond = GraphOf({ { { 0, 0, 0 }, { 1e300, 0, 0 } } }, 1);
  EXPECT_THROW(CompareTrees(beyond, beyond, {}), InputError);
}

TEST(TreeComparison, AShiftedLineIsOffByItsShift)
{
  const SkeletonGraph  a = GraphOf({ { { 0, 0, 0 }, { 40, 0, 0 } } }, 1);
  const SkeletonGraph  b = GraphOf({ { { 0, 0.6, 0 }, { 40, 0.6, 0 } } }, 1);
  const TreeComparison compared = CompareTrees(a, b, {});
  for (const AxisDistances & distances : { compared.axis, compared.all })
  {
    EXPECT_NEAR(distances.mean, 0.6, 1e-12);
    EXPECT_NEAR(distances.percentile95, 0.6, 1e-12);
    EXPECT_NEAR(distances.max, 0.6, 1e-12);
  }
  EXPECT_EQ(Counted(compared.tips), (std::array<int, 3>{ 2, 0, 0 }));
  EXPECT_NEAR(compared.tips[0].distance, 0.6, 1e-12);
  EXPECT_EQ(TotalsOf(compared.a).found, 1);
  // Farther than a radius nothing is found; with a greater tolerance all is.
  const SkeletonGraph far = GraphOf({ { { 0, 1.2, 0 }, { 40, 1.2, 0 } } }, 1);
  EXPECT_EQ(TotalsOf(CompareTrees(a, far, {}).a).foundLength, 0);
  EXPECT_EQ(TotalsOf(CompareTrees(a, far, { 1.2 }).a).foundLength, 40);
  EXPECT_TRUE(std::isnan(CompareTrees(a, far, {}).axis.mean));
}

// Cut at 13 mm, the line's end still finds what is within the radius of 1 beyond it: 14 of 20 mm.
TEST(TreeComparison, ACutLineIsFoundUpToARadiusBeyondTheCut)
{
  const SkeletonGraph  a = GraphOf({ { { 0, 0, 0 }, { 20, 0, 0 } } }, 1);
  const SkeletonGraph  b = GraphOf({ { { 0, 0, 0 }, { 13, 0, 0 } } }, 1);
  const TreeComparison compared = CompareTrees(a, b, {});
  EXPECT_NEAR(TotalsOf(compared.a).foundLength, 14, 1e-7);
  EXPECT_NEAR(compared.a[0].share, 14 / 20.0, 0.25 / 20);
  EXPECT_EQ(TotalsOf(compared.a).found, 0); // 70 % are less than 80
  EXPECT_NEAR(TotalsOf(compared.b).foundLength, 13, 1e-12);
  EXPECT_EQ(Counted(compared.tips), (std::array<int, 3>{ 1, 1, 1 }));
  EXPECT_NEAR(compared.all.max, 7, 1e-12);
  // Grown instead: all of A is found, and B's last 7 mm but one radius are invented.
  const TreeComparison back = CompareTrees(b, a, {});
  EXPECT_NEAR(TotalsOf(back.a).foundLength, 13, 1e-12);
  EXPECT_NEAR(TotalsOf(back.b).length - TotalsOf(back.b).foundLength, 6, 1e-7);
  EXPECT_EQ(back.all.max, compared.all.max);
  EXPECT_EQ(back.all.mean, compared.all.mean);
  EXPECT_EQ(back.all.percentile95, compared.all.percentile95);
}

// ATM'22 by hand: of a trunk of 20 mm and two branches of 14.14 mm the other tree has the trunk and the first branch.
// Two of three branches are detected (BD 0.667). Of the second branch, which leaves at 45 degrees, what is within 1 mm
// of the trunk's end or of the first branch (at 90 degrees to it) is found, too: 1 mm. TD = (20 + 14.14 + 1) / 48.28.
TEST(TreeComparison, BranchesAndLengthDetectedAreThoseCountedByHand)
{
  const SkeletonGraph  a = GraphOf(Fork(), 1);
  const auto           lines = Fork();
  const SkeletonGraph  b = GraphOf({ lines[0], lines[1] }, 1);
  const TreeComparison compared = CompareTrees(a, b, {});
  const BranchTotals   found = TotalsOf(compared.a);
  EXPECT_EQ(found.branches, 3);
  EXPECT_EQ(found.found, 2);
  EXPECT_NEAR(found.foundLength / found.length, (21 + std::sqrt(200)) / (20 + 2 * std::sqrt(200)), 1e-8);
  EXPECT_EQ(TotalsOf(compared.b).found, TotalsOf(compared.b).branches);
  EXPECT_EQ(Counted(compared.tips), (std::array<int, 3>{ 2, 1, 0 }));
  EXPECT_EQ(Counted(compared.bifurcations), (std::array<int, 3>{ 0, 1, 0 }));
  EXPECT_EQ(Counted(CompareTrees(b, a, {}).tips), (std::array<int, 3>{ 2, 0, 1 }));
}

TEST(TreeComparison, AScaledTreeIsOffByTheDistanceOfItsTips)
{
  const TreeComparison compared = CompareTrees(GraphOf(Fork(), 2), GraphOf(Fork(1.05), 2), {});
  // The tips at (30, 10) and (31.5, 10.5): along the branch, with the forks 1 apart, sqrt(1.5^2 + 0.5^2) of them.
  EXPECT_EQ(Counted(compared.tips), (std::array<int, 3>{ 3, 0, 0 }));
  EXPECT_NEAR(compared.tips[1].distance, std::sqrt(2.5), 1e-12);
  EXPECT_NEAR(compared.bifurcations[0].distance, 1, 1e-12);
  // Branches at 45 degrees from forks 1 apart are 1 / sqrt(2) apart, and B's tip is beyond A's: sqrt(2.5) away.
  EXPECT_NEAR(compared.all.max, std::sqrt(2.5), 1e-12);
}

// Ten pieces of a line that run side by side with it are near everywhere, and yet none follows it.
TEST(TreeComparison, ABranchIsFoundByOneConnectedRunAndNotByNearPieces)
{
  const SkeletonGraph a = GraphOf({ { { 0, 0, 0 }, { 20, 0, 0 } } }, 1);
  std::vector<Line>   crossings;
  for (double x = 1; x < 20; x += 2)
  {
    crossings.push_back({ { x, -5, 0 }, { x, 5, 0 } });
  }
  const TreeComparison crossed = CompareTrees(a, GraphOf(crossings, 1), {});
  EXPECT_NEAR(TotalsOf(crossed.a).foundLength, 20, 1e-7);
  EXPECT_EQ(TotalsOf(crossed.a).found, 0);
  EXPECT_LE(crossed.a[0].share, 0.15);
  // The same line in two branches that meet in a fork hangs together.
  const SkeletonGraph whole =
    GraphOf({ { { 0, 0, 0 }, { 9, 0, 0 } }, { { 9, 0, 0 }, { 20, 0, 0 } }, { { 9, 0, 0 }, { 9, 9, 0 } } }, 1);
  EXPECT_EQ(TotalsOf(CompareTrees(a, whole, {}).a).found, 1);
}

TEST(TreeComparison, RadiiAreComparedWhereTheTreeIsFound)
{
  const SkeletonGraph  a = GraphOf({ { { 0, 0, 0 }, { 20, 0, 0 } } }, 2);
  const SkeletonGraph  b = GraphOf({ { { 0, 0, 0 }, { 20, 0, 0 } } }, 1.5);
  const TreeComparison compared = CompareTrees(a, b, {});
  EXPECT_NEAR(compared.radiusBias, -0.5, 1e-12);
  EXPECT_NEAR(compared.radiusError, 0.5, 1e-12);
  EXPECT_NEAR(CompareTrees(b, a, {}).radiusBias, 0.5, 1e-12);
}

// A circle and one of 5 % more: everywhere the difference of their radii apart, but for the chords of their polygons.
TEST(TreeComparison, AnglesDifferByWhatABranchIsTurned)
{
  // A fork whose branches leave at 45 degrees to either side, against one of which the first leaves at `turned`; bent
  // beyond two radii, which is not seen.
  for (const double turned : { 45.0, 50.0, 25.0 })
  {
    const double        rad = turned * std::numbers::pi / 180;
    const Vector3       fork{ 20, 0, 0 };
    const Vector3       knee{ 20 + 4 * std::cos(rad), 4 * std::sin(rad), 0 };
    const SkeletonGraph a = GraphOf(Fork(), 1);
    const SkeletonGraph b = GraphOf(
      { { { 0, 0, 0 }, fork }, { { 30, 10, 0 }, { knee[0], knee[1], 3 }, knee, fork }, { fork, { 30, -10, 0 } } },
      1);
    const TreeComparison compared = CompareTrees(a, b, {});
    ASSERT_EQ(Counted(compared.bifurcations), (std::array<int, 3>{ 1, 0, 0 }));
    // Of three angles the one between trunk and second branch stays; the others change by as much each.
    EXPECT_NEAR(compared.bifurcations[0].angleError, 2 * std::abs(turned - 45) / 3, 1e-9);
    EXPECT_TRUE(std::isnan(compared.tips[0].angleError));
  }
}

TEST(TreeComparison, ConcentricCirclesAreApartByTheDifferenceOfTheirRadii)
{
  const auto circle = [](double radius) {
    Line line;
    for (int i = 0; i <= 720; ++i)
    {
      const double angle = std::numbers::pi * (i % 720) / 360;
      line.push_back({ radius * std::cos(angle), radius * std::sin(angle), 0 });
    }
    return GraphOf({ line }, 1);
  };
  const TreeComparison compared = CompareTrees(circle(10), circle(10.5), {});
  EXPECT_NEAR(compared.axis.mean, 0.5, 1e-4);
  EXPECT_NEAR(compared.axis.max, 0.5, 2e-4); // sagitta of the polygon: 10.5 (1 - cos(pi / 720)) = 1e-4
  EXPECT_EQ(compared.tips.size(), 0U);
  EXPECT_EQ(TotalsOf(compared.a).found, 1);
}

TEST(TreeComparison, RandomTreesAreNoFartherOneWayThanTheOther)
{
  constexpr std::uint64_t seed = 6911;
  std::cout << "seeds from " << seed << '\n';
  for (std::uint64_t test = 0; test < 20; ++test)
  {
    SCOPED_TRACE("seed " + std::to_string(seed + test));
    Random     random(seed + test);
    const auto tree = [&] {
      std::vector<Line>    lines;
      std::vector<Vector3> ends{ { 0, 0, 0 } };
      for (int i = 0; i < 6; ++i)
      {
        const Vector3 from = ends[static_cast<std::size_t>(random.Between(0, std::ssize(ends) - 1))];
        ends.push_back(AddScaled(from, 10, { random.Unit() - 0.5, random.Unit() - 0.5, random.Unit() - 0.5 }));
        lines.push_back({ from, ends.back() });
      }
      return GraphOf(lines, 0.5 + random.Unit());
    };
    const SkeletonGraph  a = tree();
    const SkeletonGraph  b = tree();
    const TreeComparison there = CompareTrees(a, b, {});
    const TreeComparison back = CompareTrees(b, a, {});
    EXPECT_EQ(there.all.max, back.all.max);
    EXPECT_EQ(there.all.mean, back.all.mean);
    EXPECT_EQ(there.all.percentile95, back.all.percentile95);
    for (const auto * branches : { &there.a, &there.b })
    {
      for (const BranchMatch & branch : *branches)
      {
        EXPECT_GE(branch.length, branch.found - 1e-9);
        EXPECT_LE(branch.share, 1 + 1e-9);
      }
    }
    const auto tips = Counted(there.tips);
    EXPECT_EQ(tips[0] + tips[1], std::ranges::count(a.nodeKinds, NodeKind::Tip));
    EXPECT_EQ(tips[0] + tips[2], std::ranges::count(b.nodeKinds, NodeKind::Tip));
  }
}

TEST(TreeComparison, OfNothingAllIsMissedOrInvented)
{
  const SkeletonGraph  tree = GraphOf(Fork(), 1);
  const TreeComparison missed = CompareTrees(tree, {}, {});
  EXPECT_EQ(TotalsOf(missed.a).found, 0);
  EXPECT_EQ(TotalsOf(missed.a).foundLength, 0);
  EXPECT_EQ(Counted(missed.tips), (std::array<int, 3>{ 0, 3, 0 }));
  EXPECT_TRUE(std::isnan(missed.axis.max));
  const TreeComparison invented = CompareTrees({}, tree, {});
  EXPECT_EQ(TotalsOf(invented.b).found, 0);
  EXPECT_EQ(TotalsOf(invented.b).branches, 3);
  EXPECT_EQ(Counted(invented.tips), (std::array<int, 3>{ 0, 0, 3 }));
  EXPECT_TRUE(CompareTrees({}, {}, {}).tips.empty());
}

TEST(TreeComparison, AReferenceWithoutRadiiNeedsATolerance)
{
  const SkeletonGraph thin = GraphOf({ { { 0, 0, 0 }, { 20, 0, 0 } } }, 0);
  EXPECT_THROW(CompareTrees(thin, thin, {}), InputError);
  EXPECT_EQ(TotalsOf(CompareTrees(thin, thin, { 0.5 }).a).found, 1);
}

} // namespace
} // namespace voxelcore::testing
