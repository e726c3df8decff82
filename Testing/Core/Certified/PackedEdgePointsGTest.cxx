#include "PackedEdgePoints.h"

#include <gtest/gtest.h>

#include <random>

namespace voxelcore
{
namespace
{

void
ExpectBack(const EdgePoints & plain)
{
  const EdgePoints back = PackedEdgePoints(plain).Take();
  EXPECT_EQ(back.offsets, plain.offsets);
  EXPECT_EQ(back.points, plain.points);
}

TEST(PackedEdgePoints, ComeBackFromBothEndsOfTheirRange)
{
  ExpectBack({ { 0, 3, 3, 7 }, { 0, 0xFFFFFFFFU, 1, 0x7FFFFFFFU, 0x80000000U, 0xFFFFFFFEU, 0 } });
}

TEST(PackedEdgePoints, ComeBackWhereAnEdgeHasThousands)
{
  std::mt19937 random(20);
  EdgePoints   plain;
  for (const std::uint32_t count : { 3U, 127U, 128U, 20000U, 4U })
  {
    for (std::uint32_t i = 0; i < count; ++i)
    {
      plain.points.push_back(static_cast<std::uint32_t>(random()) >> random() % 32);
    }
    plain.offsets.push_back(static_cast<std::uint32_t>(plain.points.size()));
  }
  ExpectBack(plain);
}

TEST(PackedEdgePoints, OfNoEdgesAreNone)
{
  ExpectBack({});
  const EdgePoints back = PackedEdgePoints().Take();
  EXPECT_EQ(back.offsets, (std::vector<std::uint32_t>{ 0 }));
}

} // namespace
} // namespace voxelcore
