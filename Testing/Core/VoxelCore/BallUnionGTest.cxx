#include "voxelcore/VoxelCore/BallUnion.h"

#include "VoxelCoreTesting/Random.h"

#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

// Voxel by voxel, with balls that reach beyond the box, miss it, or hold nothing.
TEST(BallUnion, HoldsTheVoxelsWhoseCentresLieInABall)
{
  std::uint64_t total = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
  {
    SCOPED_TRACE(seed);
    testing::Random             random(seed);
    const std::array<double, 3> spacing{ 1, seed % 2 == 0 ? 1.0 : 0.7, seed % 3 == 0 ? 2.5 : 1.0 };
    const VoxelBox              box{ { -5, 3, 70 }, { static_cast<std::int32_t>(random.Between(1, 140)), 17, 21 } };
    std::vector<std::array<double, 3>> centres;
    std::vector<double>                radius;
    for (int i = 0; i < 12; ++i)
    {
      centres.push_back({ 0.25 * static_cast<double>(random.Between(-60, 560)),
                          0.25 * static_cast<double>(random.Between(-8, 100)),
                          0.5 * static_cast<double>(random.Between(130, 190)) });
      radius.push_back(0.5 * static_cast<double>(random.Between(0, 16)));
    }
    const VoxelShape shape = UnionOfBalls(box, spacing, centres, radius);
    ASSERT_EQ(shape.Box().size, box.size);
    std::uint64_t count = 0;
    for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
    {
      for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
      {
        for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
        {
          bool isIn = false;
          for (std::size_t i = 0; i < radius.size(); ++i)
          {
            const double dx = (x + 0.5 - centres[i][0]) * spacing[0];
            const double dy = (y + 0.5 - centres[i][1]) * spacing[1];
            const double dz = (z + 0.5 - centres[i][2]) * spacing[2];
            isIn = isIn || dx * dx + dy * dy + dz * dz < radius[i] * radius[i] * (1 - 1e-12);
          }
          count += isIn ? 1 : 0;
          ASSERT_TRUE(!isIn || shape.Contains(x, y, z)) << x << " " << y << " " << z;
        }
      }
    }
    total += count;
    // What lies on a sphere may fall to either side by rounding; nothing else is in.
    EXPECT_LE(shape.CountVoxels() - count, count / 50);
  }
  EXPECT_GT(total, 10000U);
}

TEST(BallUnion, OfNothingIsEmpty)
{
  EXPECT_EQ(UnionOfBalls({ { 0, 0, 0 }, { 5, 5, 5 } }, { 1, 1, 1 }, {}, {}).CountVoxels(), 0U);
}

TEST(BallUnion, CanBeCancelled)
{
  EXPECT_THROW(UnionOfBalls({ { 0, 0, 0 }, { 5, 5, 5 } }, { 1, 1, 1 }, {}, {}, [](auto, double) { return false; }),
               Cancelled);
}

} // namespace
} // namespace voxelcore
