#include "voxelcore/Follow/RigidMotion.h"

#include "GrowingLines.h"

#include <gtest/gtest.h>

#include <iostream>

namespace voxelcore::testing
{
namespace
{

constexpr double kNear = 1;

/** The greatest distance by which one motion misplaces a graph's points against another. */
double
Misplaced(const SkeletonGraph & graph, const RigidMotion & one, const RigidMotion & other)
{
  double off = 0;
  for (const Vector3 & place : graph.positions)
  {
    off = std::max(off, Distance(one(place), other(place)));
  }
  return off;
}

TEST(RigidMotion, IsUndoneByItsInverse)
{
  constexpr std::uint64_t seed = 911;
  std::cout << "seed " << seed << '\n';
  Random            random(seed);
  const RigidMotion motion = RandomMotion(random);
  const Vector3     place{ 3, -8, 5 };
  EXPECT_LT(Distance(motion.Inverse()(motion(place)), place), 1e-12);
  EXPECT_NEAR(motion.Turn(), motion.Inverse().Turn(), 1e-9);
  RigidMotion quarter;
  quarter.rotation = { 0, -1, 0, 1, 0, 0, 0, 0, 1 };
  EXPECT_NEAR(quarter.Turn(), 90, 1e-12);
  EXPECT_EQ(quarter({ 1, 0, 0 }), (Vector3{ 0, 1, 0 }));
}

TEST(RigidMotion, IsFoundWhateverGrewAndWhicheverWayItTurned)
{
  constexpr std::uint64_t seed = 4711;
  std::cout << "seeds from " << seed << '\n';
  for (std::uint64_t test = 0; test < 12; ++test)
  {
    SCOPED_TRACE("seed " + std::to_string(seed + test));
    Random              random(seed + test);
    const auto          lines = RandomTree(random, static_cast<int>(random.Between(4, 14)));
    const SkeletonGraph before = TreeOf(lines, 1);
    auto                grown = lines;
    for (Line & line : grown) // all tips go on, and others begin
    {
      const Line more = Wander(random, line.back(), Minus(line.back(), line[line.size() - 2]), 5);
      line.insert(line.end(), more.begin() + 1, more.end());
    }
    for (const Line & more : RandomTree(random, 3))
    {
      grown.push_back(Wander(random,
                             lines[0][static_cast<std::size_t>(random.Between(4, 34))],
                             { 1, 1, 0 },
                             static_cast<int>(more.size()) % 9 + 3));
    }
    const RigidMotion   truth = RandomMotion(random);
    const SkeletonGraph after = Moved(TreeOf(grown, 1), truth);
    const FoundMotion   found = FindMotion(before, after, kNear);
    EXPECT_LT(Misplaced(before, found.motion, truth), 1e-3);
    EXPECT_GT(found.found, 0.999);
    EXPECT_LT(found.rms, 1e-3);
  }
}

TEST(RigidMotion, IsFoundThoughAFifthWasLostAndPlacesAreUncertain)
{
  constexpr std::uint64_t seed = 5722;
  std::cout << "seeds from " << seed << '\n';
  for (std::uint64_t test = 0; test < 8; ++test)
  {
    SCOPED_TRACE("seed " + std::to_string(seed + test));
    Random        random(seed + test);
    auto          lines = RandomTree(random, 10);
    SkeletonGraph before = TreeOf(lines, 1);
    lines.erase(lines.end() - 2, lines.end());
    const RigidMotion truth = RandomMotion(random);
    SkeletonGraph     after = Moved(TreeOf(lines, 1), truth);
    for (Vector3 & place : after.positions)
    {
      for (double & part : place)
      {
        part += 0.4 * (random.Unit() - 0.5);
      }
    }
    const FoundMotion found = FindMotion(before, after, kNear);
    EXPECT_LT(Misplaced(before, found.motion, truth), 0.5);
    EXPECT_LT(found.found, 0.97);
    EXPECT_GT(found.found, 0.6);
    EXPECT_LT(found.spread, 1);
  }
}

TEST(RigidMotion, OfOneStraightLineIsUncertain)
{
  constexpr std::uint64_t seed = 6023;
  std::cout << "seeds from " << seed << '\n';
  for (std::uint64_t test = 0; test < 10; ++test)
  {
    SCOPED_TRACE("seed " + std::to_string(seed + test));
    Random     random(seed + test);
    const auto line = [&](int length) {
      Line points;
      for (int i = 0; i <= length; ++i)
      {
        points.push_back({ 0.1 * random.Unit(), 0.1 * random.Unit(), static_cast<double>(i) });
      }
      return TreeOf({ points }, 1);
    };
    const SkeletonGraph before = line(30);
    const FoundMotion   found = FindMotion(before, line(36), kNear);
    EXPECT_GT(found.found, 0.99);
    EXPECT_GT(found.spread, 1.5);
  }
}

TEST(RigidMotion, OfOtherTreesFindsLittle)
{
  constexpr std::uint64_t seed = 6733;
  std::cout << "seeds from " << seed << '\n';
  double most = 0;
  for (std::uint64_t test = 0; test < 8; ++test)
  {
    Random              random(seed + test);
    const SkeletonGraph one = TreeOf(RandomTree(random, 10), 1);
    const SkeletonGraph other = TreeOf(RandomTree(random, 10), 1);
    most = std::max(most, FindMotion(one, other, kNear).found);
  }
  std::cout << "found at most " << most << '\n';
  EXPECT_LT(most, 0.5);
}

TEST(RigidMotion, ThatIsKnownIsMeasured)
{
  constexpr std::uint64_t seed = 812;
  std::cout << "seed " << seed << '\n';
  Random              random(seed);
  const SkeletonGraph tree = TreeOf(RandomTree(random, 6), 1);
  const RigidMotion   truth = RandomMotion(random);
  EXPECT_LT(MeasureMotion(tree, Moved(tree, truth), truth, kNear).rms, 1e-9);
  EXPECT_LT(MeasureMotion(tree, Moved(tree, truth), {}, kNear).found, 0.5);
}

} // namespace
} // namespace voxelcore::testing
