#include "voxelcore/Lattice/GridOffset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace voxelcore;

namespace
{

/** A grid turned about z. */
ImageGeometry
Turned(double angle)
{
  ImageGeometry grid;
  grid.size = { 10, 20, 30 };
  grid.spacing = { 0.5, 0.25, 2 };
  grid.origin = { 5, -7, 11 };
  grid.direction = { std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1 };
  return grid;
}

/** The part of a grid from a voxel on. */
ImageGeometry
From(ImageGeometry grid, const std::array<std::int32_t, 3> & first)
{
  const Vector3 there =
    LatticeToPhysical(grid,
                      { static_cast<double>(first[0]), static_cast<double>(first[1]), static_cast<double>(first[2]) });
  const Vector3 here = LatticeToPhysical(grid, { 0, 0, 0 });
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    grid.origin[axis] += there[axis] - here[axis];
    grid.size[axis] = 7;
  }
  return grid;
}

} // namespace

TEST(GridOffset, IsThatOfThePartThatWasTaken)
{
  const ImageGeometry grid = Turned(0.3);
  for (const auto & first : { std::array{ 0, 0, 0 }, std::array{ 3, 4, 5 }, std::array{ -100, 2, -1 } })
  {
    EXPECT_EQ(GridOffset(grid, From(grid, first), 1e-3), first);
  }
}

TEST(GridOffset, IsNoneWhereVoxelsLieBetweenThoseOfTheGrid)
{
  const ImageGeometry grid = Turned(0.3);
  ImageGeometry       other = grid;
  other.origin[0] += 0.01;
  EXPECT_EQ(GridOffset(grid, other, 1e-3), std::nullopt);
  EXPECT_EQ(GridOffset(grid, other, 0.05), (std::array{ 0, 0, 0 }));
  other = grid;
  other.spacing[2] *= 1.001; // 0.03 of a voxel at the last slice
  EXPECT_EQ(GridOffset(grid, other, 1e-3), std::nullopt);
  EXPECT_EQ(GridOffset(grid, Turned(0.301), 1e-3), std::nullopt);
  other.origin[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(GridOffset(grid, other, 1), std::nullopt);
  other.origin[1] = 1e30;
  EXPECT_EQ(GridOffset(grid, other, 1), std::nullopt);
}

TEST(GridOffset, SameVoxelsAreThoseOfOneSizeAndUnit)
{
  const ImageGeometry grid = Turned(0.3);
  EXPECT_TRUE(HaveSameVoxels(grid, grid, 1e-3));
  EXPECT_FALSE(HaveSameVoxels(grid, From(grid, { 0, 0, 0 }), 1e-3));
  ImageGeometry other = grid;
  other.unit = SpatialUnit::Voxels;
  EXPECT_FALSE(HaveSameVoxels(grid, other, 1e-3));
  other = grid;
  other.origin[2] += grid.spacing[2];
  EXPECT_FALSE(HaveSameVoxels(grid, other, 1e-3));
}
