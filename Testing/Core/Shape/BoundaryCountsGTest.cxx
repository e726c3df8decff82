#include "voxelcore/Shape/BoundaryCounts.h"

#include "VoxelCoreTesting/Shapes.h"
#include "voxelcore/Shape/BoundaryVertices.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

using testing::Box;
using testing::Random;
using testing::ShapeWhere;

/** Whether a corner of the lattice is a boundary vertex. */
bool
OnBoundary(const VoxelShape & shape, int x, int y, int z)
{
  int in = 0;
  for (int i = 0; i < 8; ++i)
  {
    in += shape.Contains(x - 1 + (i & 1), y - 1 + (i >> 1 & 1), z - 1 + (i >> 2));
  }
  return in > 0 && in < 8;
}

/** A voxel's corners on the boundary. */
std::vector<std::array<int, 3>>
BoundaryCorners(const VoxelShape & shape, int x, int y, int z)
{
  std::vector<std::array<int, 3>> corners;
  for (int i = 0; i < 8; ++i)
  {
    const std::array<int, 3> corner{ i & 1, i >> 1 & 1, i >> 2 };
    if (OnBoundary(shape, x + corner[0], y + corner[1], z + corner[2]))
    {
      corners.push_back(corner);
    }
  }
  return corners;
}

bool
SpanSpace(const std::vector<std::array<int, 3>> & points)
{
  const auto from = [&](std::size_t i, std::size_t k) { return points[i][k] - points[0][k]; };
  for (std::size_t a = 1; a < points.size(); ++a)
  {
    for (std::size_t b = a + 1; b < points.size(); ++b)
    {
      for (std::size_t c = b + 1; c < points.size(); ++c)
      {
        const int determinant = from(a, 0) * (from(b, 1) * from(c, 2) - from(b, 2) * from(c, 1)) -
                                from(a, 1) * (from(b, 0) * from(c, 2) - from(b, 2) * from(c, 0)) +
                                from(a, 2) * (from(b, 0) * from(c, 1) - from(b, 1) * from(c, 0));
        if (determinant != 0)
        {
          return true;
        }
      }
    }
  }
  return false;
}

/** The side that is all of a voxel's boundary: 2 * axis, 1 more for the upper one; -1 where there is none such. */
int
FlatSide(const VoxelShape & shape, int x, int y, int z)
{
  const auto corners = BoundaryCorners(shape, x, y, z);
  if (!shape.Contains(x, y, z) || corners.size() != 4)
  {
    return -1;
  }
  for (int side = 0; side < 6; ++side)
  {
    const auto on = [&](const auto & corner) { return corner[static_cast<std::size_t>(side / 2)] == side % 2; };
    if (std::all_of(corners.begin(), corners.end(), on))
    {
      return side;
    }
  }
  return -1;
}

bool
IsEven(const VoxelShape & shape, int x, int y, int z)
{
  const int side = FlatSide(shape, x, y, z);
  for (int i = 0; side >= 0 && i < 9; ++i)
  {
    std::array<int, 3> at{ x, y, z };
    at[static_cast<std::size_t>((side / 2 + 1) % 3)] += i % 3 - 1;
    at[static_cast<std::size_t>((side / 2 + 2) % 3)] += i / 3 - 1;
    if (FlatSide(shape, at[0], at[1], at[2]) != side)
    {
      return false;
    }
  }
  return side >= 0;
}

bool
CubeFits(const VoxelShape & shape, int x, int y, int z, int side)
{
  for (int i = 0; i < side * side * side; ++i)
  {
    if (!shape.Contains(x + i % side, y + i / side % side, z + i / (side * side)))
    {
      return false;
    }
  }
  return true;
}

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
        counts.vertices += OnBoundary(shape, x, y, z);
        if (!shape.Contains(x, y, z))
        {
          continue;
        }
        const auto corners = BoundaryCorners(shape, x, y, z);
        const bool spansSpace = SpanSpace(corners);
        ++counts.voxels;
        counts.borderVoxels += !corners.empty();
        counts.cellVoxels += spansSpace;
        counts.fullVoxels += corners.size() == 8;
        counts.flatVoxels += corners.size() == 4 && !spansSpace;
        counts.evenVoxels += IsEven(shape, x, y, z);
        counts.cubes15 += CubeFits(shape, x, y, z, 15);
        counts.cubes17 += CubeFits(shape, x, y, z, 17);
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
  EXPECT_EQ(found.cellVoxels, expected.cellVoxels);
  EXPECT_EQ(found.fullVoxels, expected.fullVoxels);
  EXPECT_EQ(found.flatVoxels, expected.flatVoxels);
  EXPECT_EQ(found.evenVoxels, expected.evenVoxels);
  EXPECT_EQ(found.cubes15, expected.cubes15);
  EXPECT_EQ(found.cubes17, expected.cubes17);
}

TEST(BoundaryCounts, OfNothingAreZero)
{
  ExpectEqual(CountBoundary(VoxelShape()), {});
  ExpectEqual(CountBoundary(VoxelShape(VoxelBox{ { 1, 2, 3 }, { 65, 4, 4 } })), {});
}

TEST(BoundaryCounts, OfABlockAreItsShellAndSides)
{
  // 7^3 voxels around 5^3 inner ones; 8^3 corners around 6^3. Twelve edges of five voxels and eight corners have cells
  // of their own; on each side 5^2 voxels are flat, 3^2 of them amid such.
  ExpectEqual(CountBoundary(Box({ 7, 7, 7 }, { -3, 0, 7 })),
              { 343, 343 - 125, 512 - 216, 12 * 5 + 8, 0, 6 * 25, 6 * 9, 0, 0 });
}

TEST(BoundaryCounts, OfASheetOfOneVoxelAreFull)
{
  ExpectEqual(CountBoundary(Box({ 70, 9, 1 })), { 630, 630, 71 * 10 * 2, 630, 630, 0, 0, 0, 0 });
}

TEST(BoundaryCounts, OfThickPartsArePlacesOfCubes)
{
  const BoundaryCounts counts = CountBoundary(Box({ 80, 20, 16 }, { 5, 5, -5 }));
  EXPECT_EQ(counts.cubes15, 66U * 6 * 2);
  EXPECT_EQ(counts.cubes17, 0U);
  EXPECT_EQ(CountBoundary(Box({ 17, 17, 17 })).cubes17, 1U);
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

// Boxes put together have flat parts, edges and thick parts, with gaps between.
TEST(BoundaryCounts, OfBoxesPutTogetherAreThoseCountedOneByOne)
{
  Random random(2029);
  for (int round = 0; round < 12; ++round)
  {
    SCOPED_TRACE("seed 2029, round " + std::to_string(round));
    VoxelShape shape(VoxelBox{ { -7, 3, 0 }, { 30 + 40 * (round % 2), 26, 44 } });
    for (int box = 0; box < 4; ++box)
    {
      std::array<int, 3> from{};
      std::array<int, 3> to{};
      for (std::size_t k = 0; k < 3; ++k)
      {
        const int size = shape.Box().size[k];
        const int side = static_cast<int>(std::min<std::int64_t>(size, random.Between(2, 24)));
        from[k] = shape.Box().lower[k] + static_cast<int>(random.Between(0, size - side));
        to[k] = from[k] + side;
      }
      for (int z = from[2]; z < to[2]; ++z)
      {
        for (int y = from[1]; y < to[1]; ++y)
        {
          for (int x = from[0]; x < to[0]; ++x)
          {
            shape.Insert(x, y, z);
          }
        }
      }
    }
    ExpectEqual(CountBoundary(shape), CountOneByOne(shape));
  }
}

} // namespace
} // namespace voxelcore
