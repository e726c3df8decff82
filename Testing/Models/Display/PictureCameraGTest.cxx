// Where left and right, up and down of a patient are in a picture.

#include "PictureCamera.h"
#include "PictureOverlay.h"
#include "voxelcore/Lattice/Vectors.h"

#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <numbers>
#include <random>

namespace voxelcore::testing
{
namespace
{

void
ExpectNear(const Vector3 & a, const Vector3 & b)
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    EXPECT_NEAR(a[k], b[k], 1e-12);
  }
}

TEST(PictureOverlay, LettersOfDirectionsNeverOverprint)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937                     random(seed);
  std::normal_distribution<double> normal;
  for (int n = 0; n < 10000; ++n)
  {
    // Any two axes of a picture, at right angles.
    std::array<Vector3, 2> axes;
    for (Vector3 & axis : axes)
    {
      axis = { normal(random), normal(random), normal(random) };
    }
    axes[0] = AddScaled({ 0, 0, 0 }, 1 / Length(axes[0]), axes[0]);
    axes[1] = AddScaled(axes[1], -Dot(axes[0], axes[1]), axes[0]);
    axes[1] = AddScaled({ 0, 0, 0 }, 1 / Length(axes[1]), axes[1]);
    const auto                         far = PictureOverlay::LetterDistances(axes[0], axes[1], 17, 10);
    std::vector<std::array<double, 2>> letters;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double length = std::hypot(axes[0][axis], axes[1][axis]);
      for (const double side : { -1, 1 })
      {
        if (far[axis] > 0)
        {
          letters.push_back({ side * far[axis] * axes[0][axis] / length, side * far[axis] * axes[1][axis] / length });
        }
      }
      EXPECT_LT(far[axis], 17 + 7 + 30);
    }
    ASSERT_GE(letters.size(), 4U) << n;
    for (std::size_t i = 0; i < letters.size(); ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        ASSERT_GE(std::hypot(letters[i][0] - letters[j][0], letters[i][1] - letters[j][1]), 10 - 1e-9) << n;
      }
    }
  }
}

TEST(PictureCamera, SeenFromTheFrontThePatientsLeftIsOnTheRight)
{
  const PictureAxes axes = AxesOf(PictureView::Front, {});
  ExpectNear(axes.right, { 1, 0, 0 });
  ExpectNear(axes.up, { 0, 0, 1 });
  ExpectNear(axes.back, { 0, -1, 0 });
}

TEST(PictureCamera, SeenFromAboveAnteriorIsUpAndThePatientsRightOnTheRight)
{
  const PictureAxes axes = AxesOf(PictureView::Top, {});
  ExpectNear(axes.right, { -1, 0, 0 });
  ExpectNear(axes.up, { 0, -1, 0 });
  ExpectNear(axes.back, { 0, 0, 1 });
}

TEST(PictureCamera, AutoLooksAtTheBroadSideFromTheFront)
{
  PointCloud slab;
  for (float a = -10; a <= 10; ++a)
  {
    for (float b = -10; b <= 10; ++b)
    {
      slab.push_back({ a + 100, 0.1F * std::fmod(a * b, 3.0F), 2 * b });
    }
  }
  const PictureAxes axes = AxesOf(PictureView::Auto, slab);
  EXPECT_GT(-axes.back[1], 0.99);
  EXPECT_GT(axes.up[2], 0.99);
}

TEST(PictureCamera, ATurnKeepsTheVerticalAndEndsWhereItBegan)
{
  const PictureAxes axes = AxesOf(PictureView::Iso, {});
  const PictureAxes quarter = Turned(axes, std::numbers::pi / 2);
  EXPECT_NEAR(quarter.up[2], axes.up[2], 1e-12);
  EXPECT_NEAR(quarter.back[2], axes.back[2], 1e-12);
  EXPECT_NEAR(quarter.right[0] * axes.right[0] + quarter.right[1] * axes.right[1], 0, 1e-12);
  ExpectNear(Turned(axes, 2 * std::numbers::pi).back, axes.back);
}

TEST(PictureCamera, TheFrameHoldsAllPointsInEachTurn)
{
  const PointCloud  points{ { 0, 0, 0 }, { 30, 0, 0 }, { 0, 5, 8 }, { 1, 2, -3 } };
  const PictureAxes axes = AxesOf(PictureView::Front, points);
  for (const int turns : { 1, 12 })
  {
    const PictureFrame frame = FrameOf(points, axes, turns);
    for (int turn = 0; turn < turns; ++turn)
    {
      const PictureAxes now = Turned(axes, 2 * std::numbers::pi * turn / turns);
      for (const auto & p : points)
      {
        double x = 0;
        double y = 0;
        for (std::size_t k = 0; k < 3; ++k)
        {
          x += (p[k] - frame.center[k]) * now.right[k];
          y += (p[k] - frame.center[k]) * now.up[k];
        }
        EXPECT_LE(std::abs(x), frame.halfWidth + 1e-9);
        EXPECT_LE(std::abs(y), frame.halfHeight + 1e-9);
      }
    }
    if (turns == 1)
    {
      EXPECT_NEAR(frame.halfWidth, 15, 1e-9); // tight
      EXPECT_NEAR(frame.halfHeight, 5.5, 1e-9);
    }
  }
}

TEST(PictureOverlay, TicksAreRoundAndWithinTheRange)
{
  EXPECT_EQ(RoundTicks(0.9, 5.1, 5), (std::vector<double>{ 1, 2, 3, 4, 5 }));
  EXPECT_EQ(RoundTicks(2, 2, 5), (std::vector<double>{ 2 }));
  for (const double high : { 0.013, 0.7, 3.3, 88.0, 12345.0 })
  {
    const auto ticks = RoundTicks(0, high, 5);
    EXPECT_GE(ticks.size(), 3U) << high;
    EXPECT_LE(ticks.size(), 11U) << high;
    EXPECT_LE(ticks.back(), high * (1 + 1e-9));
  }
}

TEST(PictureOverlay, WhereNoNumberLiesBetweenTheEndsThereIsOneTick)
{
  for (const double low : { 1.0, -3.0, 0.013, 1e17, 5e-324 })
  {
    const double next = std::nextafter(low, 1e300);
    EXPECT_EQ(RoundTicks(low, next, 5), (std::vector<double>{ low })) << low;
  }
  const double close = 1 + 1e-14; // some tens of numbers
  const auto   ticks = RoundTicks(1, close, 5);
  EXPECT_GE(ticks.size(), 3U);
  EXPECT_LE(ticks.size(), 11U);
}

} // namespace
} // namespace voxelcore::testing
