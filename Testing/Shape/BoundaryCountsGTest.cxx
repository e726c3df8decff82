#include "voxelcore/BoundaryCounts.h"

#include "VoxelCoreTesting/Shapes.h"
#include "voxelcore/BoundaryVertices.h"

#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

using testing::Box;
using testing::Random;
using testing::ShapeWhere;

/** By asking each voxel and each corner of the box. */
BoundaryCounts
CountOneByOne(const VoxelShape & shape)
{
  BoundaryCounts counts;
  const auto &   lower = shape.Box().lower;
  const auto &   size = shape.Box().size;
  for (std::int32_t z = lower[2]; z <= lower[2] + size[2]; ++z)
  {
    for (std::int32_t y = lower[1]; y <= lower[1] + size[1]; ++y)
    {
      for (std::int32_t x = lower[0]; x <= lower[0] + size[0]; ++x)
      {
        int in = 0;
        int lowerSide[3] = { 0, 0, 0 };
        for (int i = 0; i < 8; ++i)
        {
          const bool voxel = shape.Contains(x - 1 + (i & 1), y - 1 + (i >> 1 & 1), z - 1 + (i >> 2));
          in += voxel;
          for (int axis = 0; axis < 3; ++axis)
          {
            lowerSide[axis] += voxel && (i >> axis & 1) == 0;
          }
        }
        counts.vertices += in > 0 && in < 8;
        counts.flatVertices += in == 4 && (lowerSide[0] % 4 == 0 || lowerSide[1] % 4 == 0 || lowerSide[2] % 4 == 0);
        if (!shape.Contains(x, y, z))
        {
          continue;
        }
        int neighbours = 0;
        for (int i = 0; i < 27; ++i)
        {
          neighbours += shape.Contains(x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1);
        }
        ++counts.voxels;
        counts.borderVoxels += neighbours < 27;
      }
    }
  }
  return counts;
}

void
ExpectEqual(const BoundaryCounts & found, const BoundaryCounts & expected)
{
  EXPECT_EQ(found.voxels, expected.voxels);
  EXPECT_EQ(found.borderVoxels, expected.borderVoxels);
  EXPECT_EQ(found.vertices, expected.vertices);
  EXPECT_EQ(found.flatVertices, expected.flatVertices);
}

TEST(BoundaryCounts, OfNothingAreZero)
{
  ExpectEqual(CountBoundary(VoxelShape()), {});
  ExpectEqual(CountBoundary(VoxelShape(VoxelBox{ { 1, 2, 3 }, { 65, 4, 4 } })), {});
}

TEST(BoundaryCounts, OfABlockAreItsShellAndSides)
{
  // 5^3 voxels around 3^3 inner ones; 6^3 corners around 4^3; on each side 4^2 corners amid flat boundary.
  ExpectEqual(CountBoundary(Box({ 5, 5, 5 }, { -3, 0, 7 })), { 125, 125 - 27, 216 - 64, 6 * 16 });
}

TEST(BoundaryCounts, AreThoseCountedOneByOne)
{
  Random random(2028);
  for (const std::int32_t width : { 1, 2, 63, 64, 65, 127, 128, 130 })
  {
    for (int round = 0; round < 12; ++round)
    {
      const double     density = 0.05 + 0.94 * random.Unit();
      const VoxelShape shape = ShapeWhere({ width, 4, 5 }, [&](int, int, int) { return random.Chance(density); });
      SCOPED_TRACE("seed 2028, width " + std::to_string(width) + ", round " + std::to_string(round));
      ExpectEqual(CountBoundary(shape), CountOneByOne(shape));
      EXPECT_EQ(CountBoundary(shape).vertices, CountBoundaryVertices(shape));
    }
  }
}

} // namespace
} // namespace voxelcore
