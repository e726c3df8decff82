#include "voxelcore/Shape/VoxelShape.h"

#include "VoxelCoreTesting/BruteShape.h"
#include "VoxelCoreTesting/Shapes.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace voxelcore
{
namespace
{

using testing::Box;
using testing::Random;
using testing::RandomShape;
using testing::ShapeWhere;
using testing::Size3;

// Widths on both sides of the words' edges.
constexpr std::int32_t widths[] = { 1, 2, 63, 64, 65, 127, 128, 129, 130 };

TEST(VoxelShape, IsEmptyUntilVoxelsAreInserted)
{
  const VoxelShape none;
  EXPECT_EQ(none.CountVoxels(), 0U);
  EXPECT_FALSE(none.Contains(0, 0, 0));
  const VoxelShape shape(VoxelBox{ { 5, 6, 7 }, { 70, 2, 3 } });
  EXPECT_EQ(shape.CountVoxels(), 0U);
  EXPECT_EQ(shape.WordsPerRow(), 2U);
  EXPECT_FALSE(shape.Contains(5, 6, 7));
}

TEST(VoxelShape, HoldsExactlyWhatWasInserted)
{
  for (const std::int32_t width : widths)
  {
    SCOPED_TRACE(width);
    for (const std::int32_t at : { 0, width / 2, width - 1 })
    {
      VoxelShape shape(VoxelBox{ { -7, 3, 100 }, { width, 3, 2 } });
      shape.Insert(at - 7, 4, 101);
      shape.Insert(at - 7, 4, 101);
      EXPECT_EQ(shape.CountVoxels(), 1U);
      for (std::int32_t z = 99; z < 103; ++z)
      {
        for (std::int32_t y = 2; y < 7; ++y)
        {
          for (std::int32_t x = -2; x < width + 2; ++x)
          {
            EXPECT_EQ(shape.Contains(x - 7, y, z), x == at && y == 4 && z == 101);
          }
        }
      }
    }
  }
}

TEST(VoxelShape, AnyIndexMayBeAsked)
{
  const VoxelShape   shape = Box({ 64, 1, 1 });
  const std::int32_t least = std::numeric_limits<std::int32_t>::min();
  const std::int32_t most = std::numeric_limits<std::int32_t>::max();
  EXPECT_FALSE(shape.Contains(least, 0, 0));
  EXPECT_FALSE(shape.Contains(most, 0, 0));
  EXPECT_FALSE(shape.Contains(0, least, 0));
  EXPECT_FALSE(shape.Contains(0, 0, most));
  EXPECT_FALSE(shape.Contains(-1, 0, 0));
  EXPECT_FALSE(shape.Contains(64, 0, 0));
  EXPECT_TRUE(shape.Contains(63, 0, 0));
}

TEST(VoxelShape, CountsItsVoxels)
{
  for (const std::int32_t width : widths)
  {
    EXPECT_EQ(Box({ width, 3, 2 }).CountVoxels(), static_cast<std::uint64_t>(6 * width));
  }
}

TEST(VoxelShape, CroppingKeepsTheVoxelsAndLeavesNoMargin)
{
  Random random(9);
  for (int round = 0; round < 400; ++round)
  {
    // A random block inside a wider empty box; sparse ones crop on several sides.
    const Size3        block{ static_cast<std::int32_t>(random.Between(1, 70)),
                       static_cast<std::int32_t>(random.Between(1, 3)),
                       static_cast<std::int32_t>(random.Between(1, 3)) };
    const std::int32_t margin = static_cast<std::int32_t>(random.Between(0, 130));
    const double       density = random.Chance(0.5) ? 0.02 : 0.6;
    const Size3        lower{ static_cast<std::int32_t>(random.Between(-200, 200)), -3, 17 };
    const VoxelShape   shape = ShapeWhere(
      { block[0] + 2 * margin, block[1] + 4, block[2] + 5 },
      [&](int x, int y, int z) {
        return x >= margin && x < margin + block[0] && y >= 1 && y < 1 + block[1] && z >= 4 && z < 4 + block[2] &&
               random.Chance(density);
      },
      lower);
    const VoxelShape cropped = CropToVoxels(shape);
    SCOPED_TRACE("round " + std::to_string(round));
    ASSERT_EQ(cropped.CountVoxels(), shape.CountVoxels());
    if (shape.CountVoxels() == 0)
    {
      ASSERT_EQ(cropped.Box().size, (Size3{ 0, 0, 0 }));
      continue;
    }
    // The tight box by looking at every voxel.
    LatticePoint first{ 1 << 30, 1 << 30, 1 << 30 };
    LatticePoint last{ -(1 << 30), -(1 << 30), -(1 << 30) };
    testing::VisitCorners(shape, [&](std::int32_t x, std::int32_t y, std::int32_t z) {
      ASSERT_EQ(cropped.Contains(x, y, z), shape.Contains(x, y, z));
      if (shape.Contains(x, y, z))
      {
        first = { std::min(first.x, x), std::min(first.y, y), std::min(first.z, z) };
        last = { std::max(last.x, x), std::max(last.y, y), std::max(last.z, z) };
      }
    });
    ASSERT_EQ(cropped.Box().lower, (Size3{ first.x, first.y, first.z }));
    ASSERT_EQ(cropped.Box().size, (Size3{ last.x - first.x + 1, last.y - first.y + 1, last.z - first.z + 1 }));
    // Bits beyond the box stay 0, as whole-word users rely on.
    const std::int32_t beyond = cropped.Box().size[0] % 64;
    for (std::int32_t z = 0; beyond != 0 && z < cropped.Box().size[2]; ++z)
    {
      for (std::int32_t y = 0; y < cropped.Box().size[1]; ++y)
      {
        ASSERT_EQ(cropped.Row(y, z).back() >> beyond, 0U);
      }
    }
  }
}

TEST(VoxelShape, CroppingATightShapeChangesNothing)
{
  for (const std::int32_t width : widths)
  {
    const VoxelShape shape = Box({ width, 2, 2 }, { 3, 4, 5 });
    const VoxelShape cropped = CropToVoxels(shape);
    EXPECT_EQ(cropped.Box().lower, shape.Box().lower);
    EXPECT_EQ(cropped.Box().size, shape.Box().size);
    EXPECT_EQ(cropped.CountVoxels(), shape.CountVoxels());
  }
}

TEST(VoxelShape, AroundACornerAreItsEightVoxels)
{
  const unsigned seed = std::random_device{}();
  RecordProperty("seed", static_cast<int>(seed));
  std::mt19937 random(seed);
  VoxelShape   shape({ { -3, 5, 2 }, { 131, 11, 9 } });
  for (int i = 0; i < 5000; ++i)
  {
    shape.Insert(-3 + static_cast<std::int32_t>(random() % 131),
                 5 + static_cast<std::int32_t>(random() % 11),
                 2 + static_cast<std::int32_t>(random() % 9));
  }
  for (std::int32_t z = 0; z < 14; ++z)
  {
    for (std::int32_t y = 3; y < 19; ++y)
    {
      for (std::int32_t x = -6; x < 132; ++x)
      {
        const unsigned around = shape.Around(x, y, z);
        for (std::int32_t c = 0; c < 8; ++c)
        {
          ASSERT_EQ(around >> c & 1U, shape.Contains(x - 1 + (c & 1), y - 1 + (c >> 1 & 1), z - 1 + (c >> 2)) ? 1U : 0U)
            << "seed " << seed << ": " << x << " " << y << " " << z;
        }
      }
    }
  }
}

TEST(VoxelShape, MemoryFollowsTheBoundaryNotTheBox)
{
  // A slab that crosses a box of 1024^3, as the reader or a phantom leaves it.
  VoxelShape shape({ { 0, 0, 0 }, { 1024, 1024, 64 } });
  for (std::int32_t z = 0; z < 64; ++z)
  {
    for (std::int32_t y = 100; y < 900; ++y)
    {
      for (std::size_t word = 2; word < 14; ++word)
      {
        shape.Row(y, z)[word] = ~std::uint64_t{ 0 };
      }
    }
    shape.Compact(z & ~7, z + 1);
  }
  EXPECT_EQ(shape.CountVoxels(), std::uint64_t{ 800 } * 64 * 12 * 64);
  EXPECT_LT(shape.Bytes(), 600000U); // 8 MB as plain bits
  EXPECT_EQ(CropToVoxels(shape).CountVoxels(), shape.CountVoxels());
  EXPECT_LT(CropToVoxels(shape).Bytes(), 600000U);
}

} // namespace
} // namespace voxelcore
