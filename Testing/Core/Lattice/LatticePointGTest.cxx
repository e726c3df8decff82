#include "VoxelCoreTesting/Random.h"

#include "voxelcore/Lattice/LatticePoint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <iostream>
#include <vector>

namespace voxelcore::testing
{
namespace
{

/** x, then y, then z, in one number that grows with them. */
unsigned __int128
Rank(const LatticePoint & p)
{
  const auto shifted = [](std::int32_t at) {
    return static_cast<unsigned __int128>(static_cast<std::uint32_t>(at) ^ 0x80000000U);
  };
  return (shifted(p.x) << 64U) | (shifted(p.y) << 32U) | shifted(p.z);
}

TEST(LatticePoint, OrderIsByXThenYThenZAlsoAtTheEndsOfTheRange)
{
  constexpr std::uint64_t seed = 20261122;
  std::cout << "seed " << seed << '\n';
  Random                                random(seed);
  constexpr std::array<std::int32_t, 6> ends{ INT32_MIN, INT32_MIN + 1, -1, 0, 1, INT32_MAX };
  const auto                            coordinate = [&] {
    return random.Chance(0.5) ? ends[static_cast<std::size_t>(random.Between(0, 5))]
                                                         : static_cast<std::int32_t>(random.Between(-2, 2));
  };
  std::vector<LatticePoint> points;
  for (int i = 0; i < 300; ++i)
  {
    points.push_back({ coordinate(), coordinate(), coordinate() });
  }
  for (const LatticePoint & a : points)
  {
    for (const LatticePoint & b : points)
    {
      ASSERT_EQ(a < b, Rank(a) < Rank(b));
      ASSERT_EQ(a == b, Rank(a) == Rank(b));
      ASSERT_EQ(a > b, Rank(a) > Rank(b));
    }
  }
}

TEST(LatticePoint, CornersOfAVoxelInOrderRunAlongZFirst)
{
  std::vector<LatticePoint> corners;
  for (int x : { 1, 0 })
  {
    for (int y : { 1, 0 })
    {
      for (int z : { 1, 0 })
      {
        corners.push_back({ 4 + x, -1 + y, z });
      }
    }
  }
  std::sort(corners.begin(), corners.end());
  EXPECT_EQ(corners,
            (std::vector<LatticePoint>{ { 4, -1, 0 },
                                        { 4, -1, 1 },
                                        { 4, 0, 0 },
                                        { 4, 0, 1 },
                                        { 5, -1, 0 },
                                        { 5, -1, 1 },
                                        { 5, 0, 0 },
                                        { 5, 0, 1 } }));
}

} // namespace
} // namespace voxelcore::testing
