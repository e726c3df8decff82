#include "BruteThickness.h"

#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

using testing::Box;
using testing::BruteDepth;
using testing::RandomVolume;
using testing::RandomVolumes;
using testing::ShapeCells;

ThicknessBalls
BallsOf(const ShapeCells & of)
{
  return FindThicknessBalls(of.shape, of.points, of.cells, of.weights, 1.0 / 32);
}

TEST(InscribedBalls, OfARandomShapeReachItsBoundaryAndGoNoFarther)
{
  for (const RandomVolume & volume : RandomVolumes(7100, 40))
  {
    SCOPED_TRACE(volume.Describe());
    const ShapeCells     of(volume.shape, volume.spacing);
    const ThicknessBalls balls = BallsOf(of);
    for (std::size_t i = 0; i < balls.inscribed.Count(); ++i)
    {
      const double depth = BruteDepth(of, balls.inscribed.centres[i]);
      ASSERT_NEAR(balls.inscribed.radius[i], depth, 1e-12 * depth);
      ASSERT_EQ(balls.inscribed.radius[i], balls.inscribed.value[i]);
    }
  }
}

TEST(InscribedBalls, BoundingOnesAreNoSmallerThanInscribedOnesAboutTheSameVertex)
{
  for (const RandomVolume & volume : RandomVolumes(7200, 40))
  {
    SCOPED_TRACE(volume.Describe());
    const ShapeCells     of(volume.shape, volume.spacing);
    const ThicknessBalls balls = BallsOf(of);
    ASSERT_GE(balls.bounding.Count(), of.cells.CellCount() + of.points.size());
    for (std::size_t i = 0; i < of.cells.CellCount(); ++i)
    {
      const double depth = BruteDepth(of, of.cells.centres[i]);
      ASSERT_GE(balls.bounding.value[i], depth * (1 - 1e-12));
      ASSERT_GE(balls.bounding.radius[i], depth * (1 - 1e-12));
    }
  }
}

TEST(InscribedBalls, OfASlabTouchBothSides)
{
  // Three voxels thick: vertices lie over the middles of squares, and boundary vertices are farther than the squares.
  const ThicknessBalls balls = BallsOf(ShapeCells(Box({ 20, 20, 3 }), { 1, 1, 1 }));
  const double         greatest = *std::max_element(balls.inscribed.radius.begin(), balls.inscribed.radius.end());
  EXPECT_EQ(greatest, 1.5);
  EXPECT_NEAR(*std::max_element(balls.bounding.value.begin(), balls.bounding.value.end()), 1.5, 1e-12);
  EXPECT_GT(*std::max_element(balls.bounding.radius.begin(), balls.bounding.radius.end()), 1.6);
}

TEST(InscribedBalls, OfNothingAreNone)
{
  const ThicknessBalls balls = BallsOf(ShapeCells(VoxelShape(VoxelBox{ { 0, 0, 0 }, { 4, 4, 4 } }), { 1, 1, 1 }));
  EXPECT_EQ(balls.inscribed.Count(), 0U);
  EXPECT_EQ(balls.bounding.Count(), 0U);
}

} // namespace
} // namespace voxelcore
