#include "voxelcore/Masks/TopologySimplification.h"

#include "LeastChange.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>

namespace voxelcore::testing
{
namespace
{

using Betti = std::array<std::int64_t, 3>;

/** Of what is changed, nothing lies in the kernel or outside the neighbourhood. */
void
ExpectBetween(const GreyCase & grey, const VoxelShape & result)
{
  for (std::int32_t z = 0; z < grey.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < grey.size[1]; ++y)
    {
      for (std::int32_t x = 0; x < grey.size[0]; ++x)
      {
        const std::uint32_t value = grey.At(x, y, z);
        ASSERT_TRUE(value < grey.levels[2] || result.Contains(x, y, z));
        ASSERT_TRUE(value >= grey.levels[0] || !result.Contains(x, y, z));
      }
    }
  }
}

std::uint64_t
CostOf(const GreyCase & grey, const VoxelShape & before, const VoxelShape & after)
{
  std::uint64_t cost = 0;
  for (std::int32_t z = 0; z < grey.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < grey.size[1]; ++y)
    {
      for (std::int32_t x = 0; x < grey.size[0]; ++x)
      {
        cost += before.Contains(x, y, z) != after.Contains(x, y, z) ? grey.Cost(x, y, z) : 0;
      }
    }
  }
  return cost;
}

/** Two balls joined by a neck: kernel in the balls, neck of low value. */
GreyCase
TwoBalls(std::uint32_t neck)
{
  GreyCase grey{ { 25, 11, 11 }, {}, { 50, 100, 200 } };
  for (std::int32_t z = 0; z < 11; ++z)
  {
    for (std::int32_t y = 0; y < 11; ++y)
    {
      for (std::int32_t x = 0; x < 25; ++x)
      {
        const bool isBall = std::hypot(x - 5, y - 5, z - 5) <= 4.2 || std::hypot(x - 19, y - 5, z - 5) <= 4.2;
        const bool isNeck = std::abs(y - 5) <= 1 && std::abs(z - 5) <= 1;
        grey.grey.push_back(isBall ? 250 : isNeck ? neck + static_cast<std::uint32_t>(std::abs(x - 12)) : 10);
      }
    }
  }
  return grey;
}

TEST(TopologySimplification, CutsAThinNeckWhereItIsWeakest)
{
  const GreyCase grey = TwoBalls(110);
  EXPECT_EQ(grey.Run().cost, 0U) << "one piece already";
  TopologyRequest two;
  two.pieces = 2;
  const auto result = grey.Run(two);
  EXPECT_EQ(result.after.betti, (Betti{ 2, 0, 0 }));
  EXPECT_TRUE(result.asAsked);
  ASSERT_EQ(result.changes.size(), 1U);
  EXPECT_EQ(result.changes[0].voxels, 9U);
  EXPECT_EQ(result.changes[0].cost, 9U * 11U);
  EXPECT_EQ(result.changes[0].centre, (std::array<double, 3>{ 12, 5, 5 }));
  EXPECT_EQ(result.changes[0].difference, (Betti{ 1, 0, 0 }));
  EXPECT_FALSE(result.changes[0].isFill);
}

TEST(TopologySimplification, JoinsTwoPiecesByOneLineOfVoxels)
{
  const GreyCase grey = TwoBalls(80);
  const auto     result = grey.Run();
  EXPECT_EQ(result.before.betti, (Betti{ 2, 0, 0 }));
  EXPECT_EQ(result.after.betti, (Betti{ 1, 0, 0 }));
  ASSERT_EQ(result.changes.size(), 1U);
  EXPECT_TRUE(result.changes[0].isFill);
  EXPECT_EQ(result.changes[0].voxels, 5U) << "between the balls";
  EXPECT_EQ(result.changes[0].difference, (Betti{ -1, 0, 0 }));
}

/** A ring about z with a weak place of the given value at x > 0; the hole holds another value. */
GreyCase
Ring(std::uint32_t weak, std::uint32_t hole)
{
  GreyCase grey{ { 23, 23, 7 }, {}, { 50, 100, 200 } };
  for (std::int32_t z = 0; z < 7; ++z)
  {
    for (std::int32_t y = 0; y < 23; ++y)
    {
      for (std::int32_t x = 0; x < 23; ++x)
      {
        const double        radius = std::hypot(x - 11, y - 11);
        const bool          isRing = std::hypot(radius - 8, z - 3) <= 2.2;
        const std::uint32_t far = static_cast<std::uint32_t>(std::abs(y - 11));
        grey.grey.push_back(isRing ? (x > 11 && far < 4 ? weak + far : 250) : z == 3 && radius < 8 ? hole : 10);
      }
    }
  }
  return grey;
}

TEST(TopologySimplification, CutsOrFillsALoopWhicheverIsCheaper)
{
  const auto cut = Ring(110, 10).Run();
  EXPECT_EQ(cut.after.betti, (Betti{ 1, 0, 0 }));
  EXPECT_EQ(cut.voxelsAdded, 0U);
  // The cross section where the ring is weakest has 13 voxels at 11. The outermost one has no neighbour from y = 3 on,
  // so that a wall which leans towards it goes around it, with 12: (6, 0), (7, 0), (8, 1), (9, 2) from the axis on in
  // the middle, (7, 0), (8, 0), (9, 1) above and below it, and (8, 0) beyond.
  EXPECT_EQ(cut.voxelsRemoved, 12U);
  EXPECT_EQ(cut.cost, 12U * 11U + 1 + 2 + 2 * 1);
  const auto fill = Ring(180, 99).Run();
  EXPECT_EQ(fill.after.betti, (Betti{ 1, 0, 0 }));
  EXPECT_EQ(fill.voxelsRemoved, 0U);
  EXPECT_GT(fill.voxelsAdded, 50U);
  EXPECT_EQ(fill.cost, fill.voxelsAdded) << "one level each";
  TopologyRequest kept;
  kept.loops = 1;
  EXPECT_EQ(Ring(110, 10).Run(kept).cost, 0U);
  const auto neither = Ring(250, 10).Run();
  EXPECT_EQ(neither.after.betti, (Betti{ 1, 1, 0 })) << "all kernel, and nothing to fill";
  TopologyRequest none;
  none.loops = 0;
  EXPECT_FALSE(Ring(250, 10).Run(none).asAsked);
}

TEST(TopologySimplification, FillsACavityOrOpensIt)
{
  GreyCase grey{ { 11, 11, 11 }, {}, { 50, 100, 200 } };
  for (std::int32_t z = 0; z < 11; ++z)
  {
    for (std::int32_t y = 0; y < 11; ++y)
    {
      for (std::int32_t x = 0; x < 11; ++x)
      {
        const double radius = std::hypot(x - 5, y - 5, z - 5);
        grey.grey.push_back(radius > 5 ? 10 : radius > 2 ? 150 : 60);
      }
    }
  }
  const auto opened = grey.Run();
  EXPECT_EQ(opened.before.betti, (Betti{ 1, 0, 1 }));
  EXPECT_EQ(opened.after.betti, (Betti{ 1, 0, 0 }));
  EXPECT_EQ(opened.voxelsAdded, 0U) << "a hole through the wall at 51 a voxel, not 33 voxels at 40";
  EXPECT_LE(opened.voxelsRemoved, 3U) << "no wider than one voxel";
}

TEST(TopologySimplification, AChangeIsOneAndCostsAtMostATenthMoreThanTheLeastKnown)
{
  for (const auto & [name, make] : LeastChangeKinds())
  {
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
    {
      const LeastChangeCase one = make(seed);
      const SimplifiedShape result = one.grey.Run(one.request);
      const auto [pieces, loops, cavities] = ComputeShapeTopology(result.shape).betti;
      ASSERT_EQ(pieces + loops + cavities, one.numbers) << name << " " << seed;
      EXPECT_TRUE(StaysBetween(one.grey, result.shape)) << name << " " << seed;
      EXPECT_LE(10 * result.cost, 11 * one.least) << name << " " << seed;
      EXPECT_EQ(result.cost, CostOf(one.grey, one.grey.Level(1), result.shape)) << name << " " << seed;
      EXPECT_EQ(result.changes.size(), 1U) << name << " " << seed;
    }
  }
}

TEST(TopologySimplification, RefusesWhatIsNotNested)
{
  const VoxelShape small = Box({ 3, 3, 3 });
  const VoxelShape large = Box({ 5, 5, 5 });
  const auto       one = [](int, int, int) { return 1U; };
  EXPECT_THROW(SimplifyTopology(large, small, large, one), InputError);
  EXPECT_THROW(SimplifyTopology(small, large, small, one), InputError);
  TopologyRequest request;
  request.loops = -1;
  EXPECT_THROW(SimplifyTopology(small, small, large, one, request), InputError);
}

TEST(TopologySimplification, StopsWhenAsked)
{
  const GreyCase grey = TwoBalls(110);
  EXPECT_THROW(SimplifyTopology(
                 grey.Level(2),
                 grey.Level(1),
                 grey.Level(0),
                 [&](int x, int y, int z) { return grey.Cost(x, y, z); },
                 {},
                 [](std::string_view, double) { return false; }),
               Cancelled);
}

TEST(TopologySimplification, OfRandomGreyValuesIsValidAndNeverWorse)
{
  const std::uint64_t fresh = std::random_device{}();
  std::int64_t        better = 0;
  for (std::uint64_t k = 1; k <= 24; ++k)
  {
    const std::uint64_t seed = k <= 12 ? k : fresh + k;
    const GreyCase      grey = RandomGrey(seed, 24);
    const VoxelShape    shape = grey.Level(1);
    const auto          result = grey.Run();
    ASSERT_EQ(ComputeShapeTopology(result.shape), result.after) << "seed " << seed;
    ExpectBetween(grey, result.shape);
    ASSERT_EQ(CostOf(grey, shape, result.shape), result.cost) << "seed " << seed;
    const auto sum = [](const TopologyNumbers & n) { return n.betti[0] + n.betti[1] + n.betti[2]; };
    ASSERT_LE(sum(result.after), sum(result.before)) << "seed " << seed;
    better += sum(result.before) - sum(result.after);
    TopologyRequest request;
    request.pieces = 1;
    request.loops = 0;
    request.cavities = 0;
    const auto asked = grey.Run(request);
    const bool reached = asked.after.betti == Betti{ 1, 0, 0 };
    ASSERT_EQ(reached, asked.asAsked) << "seed " << seed;
    ASSERT_EQ(sum(asked.after), sum(result.after)) << "fewest and (1, 0, 0) are the same here; seed " << seed;
  }
  EXPECT_GT(better, 100);
}

struct Best
{
  std::int64_t  numbers = 0; ///< pieces, loops and cavities together
  std::uint64_t cost = 0;

  friend auto
  operator<=>(const Best &, const Best &) = default;
};

/** The fewest numbers, and the least cost of them, over all sets of voxels that may change. */
Best
BestByTrying(const GreyCase & grey, VoxelShape shape)
{
  std::vector<std::array<std::int32_t, 3>> open;
  for (std::int32_t z = 0; z < grey.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < grey.size[1]; ++y)
    {
      for (std::int32_t x = 0; x < grey.size[0]; ++x)
      {
        if (grey.At(x, y, z) >= grey.levels[0] && grey.At(x, y, z) < grey.levels[2])
        {
          open.push_back({ x, y, z });
        }
      }
    }
  }
  const VoxelShape before = shape;
  Best             best{ std::numeric_limits<std::int64_t>::max(), 0 };
  // Each code differs from the one before in one voxel (Gray).
  for (std::uint32_t turn = 0; turn < std::uint32_t{ 1 } << open.size(); ++turn)
  {
    if (turn > 0)
    {
      const auto [x, y, z] = open[static_cast<std::size_t>(std::countr_zero(turn))];
      const auto & lower = shape.Box().lower;
      shape.Row(y - lower[1], z - lower[2])[static_cast<std::size_t>(x - lower[0]) / 64] ^=
        std::uint64_t{ 1 } << (static_cast<unsigned>(x - lower[0]) % 64);
    }
    const auto [pieces, loops, cavities] = ComputeShapeTopology(shape).betti;
    if (pieces > 0 && pieces + loops + cavities <= best.numbers)
    {
      best = std::min(best, Best{ pieces + loops + cavities, CostOf(grey, before, shape) });
    }
  }
  return best;
}

TEST(TopologySimplification, OfSmallRandomVolumesIsAsGoodAsTheBestOfAllChanges)
{
  const std::uint64_t fresh = std::random_device{}();
  int                 volumes = 0;
  int                 fewest = 0;
  int                 near = 0;
  for (std::uint64_t k = 1; k <= 120; ++k)
  {
    const std::uint64_t seed = k <= 60 ? k : fresh + k;
    GreyCase            grey = RandomGrey(seed, 6);
    auto                sorted = grey.grey;
    std::ranges::sort(sorted);
    const std::size_t middle = sorted.size() * 45 / 100;
    grey.levels[0] = sorted[middle - 6];
    grey.levels[1] = sorted[middle];
    grey.levels[2] = sorted[middle + 6];
    // Room for all that may be filled.
    VoxelShape shape({ { 0, 0, 0 }, grey.size });
    const auto tight = grey.Level(1);
    for (std::int32_t z = 0; z < grey.size[2]; ++z)
    {
      for (std::int32_t y = 0; y < grey.size[1]; ++y)
      {
        for (std::int32_t x = 0; x < grey.size[0]; ++x)
        {
          if (tight.Contains(x, y, z))
          {
            shape.Insert(x, y, z);
          }
        }
      }
    }
    const Best best = BestByTrying(grey, shape);
    const auto result = grey.Run();
    const auto [pieces, loops, cavities] = result.after.betti;
    ASSERT_GE((Best{ pieces + loops + cavities, result.cost }), best) << "seed " << seed;
    ++volumes;
    const bool isFewest = pieces + loops + cavities == best.numbers;
    fewest += isFewest ? 1 : 0;
    near += isFewest && 10 * result.cost <= 11 * best.cost ? 1 : 0;
  }
  EXPECT_GE(100 * fewest, 95 * volumes);
  EXPECT_GE(100 * near, 95 * volumes) << "fewest numbers, at most a tenth above the least cost";
}

} // namespace
} // namespace voxelcore::testing
