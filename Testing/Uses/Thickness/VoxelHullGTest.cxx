#include "voxelcore/Thickness/VoxelHull.h"

#include "voxelcore/Lattice/ConvexHull.h"

#include <gtest/gtest.h>

#include <random>

namespace voxelcore::testing
{
namespace
{

using Point = std::array<std::int64_t, 3>;

VoxelShape
ShapeOf(const VoxelBox & box, const std::vector<Point> & voxels)
{
  VoxelShape shape(box);
  for (const Point & at : voxels)
  {
    shape.Insert(static_cast<std::int32_t>(at[0]), static_cast<std::int32_t>(at[1]), static_cast<std::int32_t>(at[2]));
  }
  return shape;
}

TEST(VoxelHull, HasTheVoxelsOnTheInnerSideOfEveryFacet)
{
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (int run = 0; run < 60; ++run)
  {
    const VoxelBox                  box{ { 50, -3, 7 }, { run % 2 == 0 ? 8 : 90, 9, 7 } };
    std::vector<Point>              voxels(4 + static_cast<std::size_t>(run % 20));
    std::uniform_int_distribution<> part(0, 1000);
    for (Point & voxel : voxels)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        voxel[axis] = box.lower[axis] + part(random) % box.size[axis];
      }
    }
    const std::vector<Point>     some(voxels.begin(), voxels.begin() + 2);
    const std::vector<Point>     others(voxels.begin() + 2, voxels.end());
    const VoxelShape             hull = HullOfVoxels({ ShapeOf(box, some), ShapeOf(box, others) });
    const std::vector<HullFacet> facets = ConvexHull(voxels);
    for (std::int32_t z = box.lower[2] - 1; z <= box.lower[2] + box.size[2]; ++z)
    {
      for (std::int32_t y = box.lower[1] - 1; y <= box.lower[1] + box.size[1]; ++y)
      {
        for (std::int32_t x = box.lower[0] - 1; x <= box.lower[0] + box.size[0]; ++x)
        {
          bool isIn = !facets.empty();
          for (const HullFacet & facet : facets)
          {
            const Point & a = voxels[facet.corners[0]];
            const Point & n = facet.normal;
            isIn = isIn && n[0] * (x - a[0]) + n[1] * (y - a[1]) + n[2] * (z - a[2]) <= 0;
          }
          ASSERT_EQ(hull.Contains(x, y, z), isIn) << "run " << run << " at " << x << " " << y << " " << z;
        }
      }
    }
  }
}

TEST(VoxelHull, OfAConvexBodyIsThatBody)
{
  const VoxelBox box{ { 0, 0, 0 }, { 21, 21, 21 } };
  VoxelShape     ball(box);
  for (std::int32_t i = 0; i < 21 * 21 * 21; ++i)
  {
    const std::int32_t x = i % 21;
    const std::int32_t y = i / 21 % 21;
    const std::int32_t z = i / 441;
    if ((x - 10) * (x - 10) + (y - 10) * (y - 10) + (z - 10) * (z - 10) <= 100)
    {
      ball.Insert(x, y, z);
    }
  }
  const std::uint64_t           voxels = ball.CountVoxels();
  const std::vector<VoxelShape> shapes{ std::move(ball) };
  EXPECT_EQ(HullOfVoxels(shapes).CountVoxels(), voxels);
}

TEST(VoxelHull, OfVoxelsInAPlaneIsEmpty)
{
  EXPECT_EQ(HullOfVoxels({}).CountVoxels(), 0U);
  EXPECT_EQ(
    HullOfVoxels({ ShapeOf({ { 0, 0, 0 }, { 4, 4, 1 } }, { { 0, 0, 0 }, { 3, 0, 0 }, { 0, 3, 0 } }) }).CountVoxels(),
    0U);
}

} // namespace
} // namespace voxelcore::testing
