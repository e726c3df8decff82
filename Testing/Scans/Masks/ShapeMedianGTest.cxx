// A median filter against counting voxel by voxel.

#include "voxelcore/Base/Error.h"
#include "voxelcore/Masks/ShapeMedian.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace voxelcore::testing
{
namespace
{

std::vector<std::array<std::int32_t, 3>>
VoxelsIn(const VoxelShape & shape, const VoxelBox & box)
{
  std::vector<std::array<std::int32_t, 3>> voxels;
  for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
  {
    for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
    {
      for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
      {
        if (shape.Contains(x, y, z))
        {
          voxels.push_back({ x, y, z });
        }
      }
    }
  }
  return voxels;
}

VoxelShape
CountedMedian(const VoxelShape & shape, std::int32_t reach)
{
  VoxelShape   median(shape.Box());
  const auto   side = 2 * reach + 1;
  const auto & box = shape.Box();
  for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
  {
    for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
    {
      for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
      {
        int count = 0;
        for (std::int32_t k = 0; k < side * side * side; ++k)
        {
          count += shape.Contains(x + k % side - reach, y + k / side % side - reach, z + k / (side * side) - reach);
        }
        if (2 * count > side * side * side)
        {
          median.Insert(x, y, z);
        }
      }
    }
  }
  return median;
}

TEST(MedianShape, IsTheMajorityOfEachCube)
{
  const std::uint64_t seed = std::random_device{}();
  std::mt19937_64     generator(seed);
  for (int run = 0; run < 30; ++run)
  {
    const auto     side = [&](std::int32_t most) { return static_cast<std::int32_t>(generator() % most + 1); };
    const VoxelBox box{ { -3, 70, 5 }, { side(150), side(12), side(12) } };
    VoxelShape     shape(box);
    const double   part = 0.2 + 0.6 * static_cast<double>(generator() % 100) / 100;
    std::bernoulli_distribution in(part);
    for (std::int32_t z = 0; z < box.size[2]; ++z)
    {
      for (std::int32_t y = 0; y < box.size[1]; ++y)
      {
        for (std::int32_t x = 0; x < box.size[0]; ++x)
        {
          if (in(generator))
          {
            shape.Insert(box.lower[0] + x, box.lower[1] + y, box.lower[2] + z);
          }
        }
      }
    }
    for (const std::int32_t reach : { 1, 2, 7 })
    {
      const EditedShape median = MedianShape(shape, MedianWidth{ 2 * reach + 1 });
      const VoxelShape  expected = CountedMedian(shape, reach);
      ASSERT_EQ(VoxelsIn(median.shape, box), VoxelsIn(expected, box)) << "seed " << seed << ", run " << run;
      EXPECT_EQ(static_cast<std::int64_t>(median.voxelsAdded - median.voxelsRemoved),
                static_cast<std::int64_t>(expected.CountVoxels() - shape.CountVoxels()));
    }
  }
}

TEST(MedianShape, TakesSpecksAwayAndLeavesASlabFourVoxelsThick)
{
  VoxelShape shape({ { 0, 0, 0 }, { 20, 20, 20 } });
  for (std::int32_t z = 8; z < 12; ++z)
  {
    for (std::int32_t k = 0; k < 400; ++k)
    {
      shape.Insert(k % 20, k / 20, z);
    }
  }
  const std::uint64_t slab = shape.CountVoxels();
  shape.Insert(3, 3, 3);
  const EditedShape median = MedianShape(shape, { 3 });
  // Only the slab's edges go: those about its two sides, and what these leave of the four across.
  constexpr std::uint64_t edges = 2 * (4 * 18 + 4) + 4 * 2;
  EXPECT_EQ(median.voxelsRemoved, 1 + edges);
  EXPECT_EQ(median.shape.CountVoxels(), slab - edges);
  EXPECT_EQ(median.voxelsAdded, 0U);
}

TEST(MedianShape, RefusesWidthsWithoutAMiddle)
{
  for (const std::int32_t width : { -3, 0, 1, 2, 4, 17 })
  {
    EXPECT_THROW(MedianShape(VoxelShape(), { width }), UsageError);
    EXPECT_THROW(ParseMedianWidth(std::to_string(width)), UsageError);
  }
  for (const char * text : { "", "3vox", "3.0", "x", "99999999999" })
  {
    EXPECT_THROW(ParseMedianWidth(text), UsageError) << text;
  }
  EXPECT_EQ(ParseMedianWidth("15").voxels, 15);
  EXPECT_EQ(MedianShape(VoxelShape(), { 3 }).shape.CountVoxels(), 0U);
}

} // namespace
} // namespace voxelcore::testing
