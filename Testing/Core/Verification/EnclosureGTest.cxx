#include "voxelcore/Verification/Enclosure.h"

#include "VoxelCoreTesting/Shapes.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace voxelcore
{
namespace
{

// All there is: each of the 256 ways in which eight voxels are in or out, each half of a voxel in and around them.
TEST(Enclosure, IsThatEveryVoxelThatHoldsThePlaceIsIn)
{
  const testing::Size3 lower{ -1, 3, 63 };
  for (unsigned pattern = 0; pattern < 256; ++pattern)
  {
    const auto isIn = [&](int x, int y, int z) {
      return x >= 0 && x < 2 && y >= 0 && y < 2 && z >= 0 && z < 2 && (pattern >> (x + 2 * y + 4 * z) & 1U) != 0;
    };
    const VoxelShape shape = testing::ShapeWhere({ 2, 2, 2 }, isIn, lower);
    for (int place = 0; place < 343; ++place)
    {
      const std::array<int, 3> at{ place % 7 - 1, place / 7 % 7 - 1, place / 49 - 1 }; // halves of a voxel
      bool                     expected = true;
      for (int voxel = 0; voxel < 64; ++voxel)
      {
        const std::array<int, 3> v{ voxel % 4 - 1, voxel / 4 % 4 - 1, voxel / 16 - 1 };
        bool                     holds = true;
        for (std::size_t a = 0; a < 3; ++a)
        {
          holds = holds && 2 * v[a] <= at[a] && at[a] <= 2 * v[a] + 2;
        }
        expected = expected && (!holds || isIn(v[0], v[1], v[2]));
      }
      const std::vector<std::array<double, 3>> places{
        { lower[0] + 0.5 * at[0], lower[1] + 0.5 * at[1], lower[2] + 0.5 * at[2] }
      };
      ASSERT_EQ(LieInside(shape, places), expected) << pattern << ": " << at[0] << " " << at[1] << " " << at[2];
    }
  }
}

TEST(Enclosure, IsOfAllPlacesAndOfNumbers)
{
  const VoxelShape                   shape = testing::Box({ 2, 1, 1 });
  std::vector<std::array<double, 3>> places(20000, { 1, 0.5, 0.5 });
  EXPECT_TRUE(LieInside(shape, places));
  EXPECT_TRUE(LieInside(shape, {}));
  for (const double bad : { 2.5, 1e17, -1e300, std::numeric_limits<double>::quiet_NaN() })
  {
    places[17001][0] = bad;
    EXPECT_FALSE(LieInside(shape, places)) << bad;
  }
}

} // namespace
} // namespace voxelcore
