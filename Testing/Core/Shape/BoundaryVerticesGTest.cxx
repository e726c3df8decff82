#include "voxelcore/Shape/BoundaryVertices.h"

#include "VoxelCoreTesting/BruteShape.h"
#include "VoxelCoreTesting/Shapes.h"

#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

using testing::Box;
using testing::BruteBoundaryVertices;
using testing::Random;
using testing::RandomShape;
using testing::ShapeWhere;

TEST(BoundaryVertices, OfNothingAreNone)
{
  EXPECT_TRUE(BoundaryVertices(VoxelShape()).empty());
  EXPECT_TRUE(BoundaryVertices(VoxelShape(VoxelBox{ { 1, 2, 3 }, { 65, 4, 4 } })).empty());
  EXPECT_EQ(CountBoundaryVertices(VoxelShape()), 0U);
}

TEST(BoundaryVertices, OfAVoxelAreItsEightCornersInScanOrder)
{
  const std::vector<LatticePoint> expected{ { 4, 5, 6 }, { 5, 5, 6 }, { 4, 6, 6 }, { 5, 6, 6 },
                                            { 4, 5, 7 }, { 5, 5, 7 }, { 4, 6, 7 }, { 5, 6, 7 } };
  EXPECT_EQ(BoundaryVertices(Box({ 1, 1, 1 }, { 4, 5, 6 })), expected);
}

TEST(BoundaryVertices, OfABlockAreAllButTheInnerCorners)
{
  // 4^3 voxels: 5^3 corners, of which 3^3 have all eight voxels in.
  EXPECT_EQ(CountBoundaryVertices(Box({ 4, 4, 4 })), 125U - 27U);
  for (const std::int32_t width : { 1, 2, 63, 64, 65, 127, 128, 129 })
  {
    EXPECT_EQ(CountBoundaryVertices(Box({ width, 3, 2 })),
              static_cast<std::uint64_t>((width + 1) * 12 - (width - 1) * 2))
      << width;
  }
}

TEST(BoundaryVertices, AreThoseWithVoxelsInAndOut)
{
  Random random(31);
  for (const std::int32_t width : { 1, 2, 5, 63, 64, 65, 127, 128, 130 })
  {
    for (int round = 0; round < 24; ++round)
    {
      const auto           height = static_cast<std::int32_t>(random.Between(1, 5));
      const auto           depth = static_cast<std::int32_t>(random.Between(1, 5));
      const double         density = 0.05 + 0.9 * random.Unit();
      const testing::Size3 lower{ -64, 0, 9 };
      const VoxelShape     shape = ShapeWhere(
        { width, height, depth },
        [&](int, int, int) { return random.Chance(density); },
        lower);
      SCOPED_TRACE("width " + std::to_string(width) + ", round " + std::to_string(round));
      const auto points = BoundaryVertices(shape);
      ASSERT_EQ(points, BruteBoundaryVertices(shape)); // the reference runs in scan order too
      ASSERT_EQ(CountBoundaryVertices(shape), points.size());
    }
  }
}

TEST(BoundaryVertices, OfTheEllipsoidAreAsManyAsOtherProgramsFound)
{
  EXPECT_EQ(CountBoundaryVertices(testing::Ellipsoid(64)), 7354U);
  EXPECT_EQ(CountBoundaryVertices(testing::Ellipsoid(256)), 117410U);
}

} // namespace
} // namespace voxelcore
