#include "voxelcore/Compare/CoreComparison.h"

#include <cmath>
#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

/** A square of 10 mm in the plane z, its first corner at (x, 0). */
MedialComplex
Square(double x, double z)
{
  MedialComplex core;
  core.positions = { { x, 0, z }, { x + 10, 0, z }, { x + 10, 10, z }, { x, 10, z } };
  core.cells.vertexCount = 4;
  core.cells.edges = { { 0, 1 }, { 0, 3 }, { 1, 2 }, { 2, 3 } };
  core.cells.faceVertices = { 0, 1, 2, 3 };
  core.cells.faceEdges = { 0, 2, 3, 1 };
  core.cells.faceOffsets = { 0, 4 };
  return core;
}

TEST(CoreComparison, ParallelSquaresAreApartByTheirDistance)
{
  const CoreComparison found = CompareCores(Square(0, 0), Square(0, 1.5), 1);
  EXPECT_DOUBLE_EQ(found.hausdorff, 1.5);
  EXPECT_DOUBLE_EQ(found.percentile95, 1.5);
  EXPECT_DOUBLE_EQ(found.mean, 1.5);
  EXPECT_EQ(found.coverageA, 0);
  EXPECT_EQ(CompareCores(Square(0, 0), Square(0, 1.5), 1.5).coverageB, 1);
}

TEST(CoreComparison, AShiftedSquareCoversTheCornersThatLieInIt)
{
  // Of either, two corners lie in the other square, and two are 4 mm off it.
  const CoreComparison found = CompareCores(Square(0, 0), Square(4, 0), 0.1);
  EXPECT_DOUBLE_EQ(found.hausdorff, 4);
  EXPECT_DOUBLE_EQ(found.mean, 2);
  EXPECT_EQ(found.coverageA, 0.5);
  EXPECT_EQ(found.coverageB, 0.5);
}

TEST(CoreComparison, ASingleVertexIsComparedWithFaces)
{
  MedialComplex point;
  point.cells.vertexCount = 1;
  point.positions = { { 5, 5, 3 } };
  const CoreComparison there = CompareCores(point, Square(0, 0), 3);
  const CoreComparison back = CompareCores(Square(0, 0), point, 3);
  EXPECT_DOUBLE_EQ(there.hausdorff, std::sqrt(25 + 25 + 9)); // from a corner to the point, which is 3 off the face
  EXPECT_DOUBLE_EQ(there.mean, (3 + 4 * std::sqrt(59)) / 5);
  EXPECT_EQ(there.coverageA, 1);
  EXPECT_EQ(there.coverageB, 0);
  EXPECT_EQ(back.hausdorff, there.hausdorff);
  EXPECT_EQ(back.mean, there.mean);
  EXPECT_EQ(back.coverageA, there.coverageB);
}

TEST(CoreComparison, NothingIsCoveredByNothing)
{
  EXPECT_TRUE(std::isnan(CompareCores({}, Square(0, 0), 1).hausdorff));
  EXPECT_TRUE(std::isnan(CompareCores(Square(0, 0), {}, 1).coverageA));
}

} // namespace
} // namespace voxelcore::testing
