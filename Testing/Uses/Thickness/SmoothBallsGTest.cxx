#include "BruteThickness.h"
#include "VoxelCoreTesting/Threads.h"

#include "voxelcore/Thickness/CoreThickness.h"
#include "voxelcore/Thickness/FineBracket.h"
#include "voxelcore/Thickness/SmoothBalls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace voxelcore
{
namespace
{

using testing::RandomVolume;
using testing::RandomVolumes;
using testing::ShapeWhere;

struct Body
{
  VoxelShape     shape;
  SpacingWeights weights;
};

/** Where a function of mm from the middle is below 0; the middle lies off a voxel's. */
template <typename TInside>
Body
BodyWhere(double side, const Vector3 & spacing, TInside depth)
{
  std::array<std::int32_t, 3> size{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    size[axis] = static_cast<std::int32_t>(std::ceil(side / spacing[axis]));
  }
  const auto at = [&](int index, std::size_t axis) {
    return (index + 0.5) * spacing[axis] - 0.5 * side + 0.13 * static_cast<double>(axis + 1);
  };
  return { CropToVoxels(ShapeWhere(size,
                                   [&](int x, int y, int z) {
                                     return depth(Vector3{ at(x, 0), at(y, 1), at(z, 2) }) < 0;
                                   })),
           ComputeSpacingWeights(spacing) };
}

VoxelValues
MapOf(const Body & body)
{
  const PaintingBalls balls = SmoothBalls(body.shape, body.weights);
  return SmoothThicknessOf(body.shape, body.weights, balls, OwnersAmong(balls, body.shape, body.weights));
}

struct Errors
{
  double bias = 0;
  double mean = 0; ///< of what is off, either way
  double most = 0; ///< above
};

Errors
ErrorsOf(const VoxelValues & map, double truth)
{
  Errors errors;
  for (const float value : map.values)
  {
    errors.bias += (value - truth) / static_cast<double>(map.values.size());
    errors.mean += std::abs(value - truth) / static_cast<double>(map.values.size());
    errors.most = std::max(errors.most, value - truth);
  }
  return errors;
}

const std::array<Vector3, 2> kTwoSpacings{ Vector3{ 1, 1, 1 }, Vector3{ 1, 1, 2.5 } };

// Of single bodies, in longest sides; over many the bias is a third of that (Testing/Performance/Thickness).
constexpr double kMostBias = 0.2;

TEST(SmoothBalls, AreAsThickAsBallsAndShells)
{
  for (const Vector3 & spacing : kTwoSpacings)
  {
    for (const double radius : { 3.0, 5.0, 8.0 })
    {
      const Errors errors = ErrorsOf(
        MapOf(BodyWhere(40, spacing, [&](const Vector3 & p) { return std::hypot(p[0], p[1], p[2]) - radius; })),
        2 * radius);
      EXPECT_LT(std::abs(errors.bias), kMostBias * spacing[2]) << radius << " at " << spacing[2];
      EXPECT_LT(errors.mean, 0.25 * spacing[2]) << radius << " at " << spacing[2];
    }
    for (const double thickness : { 2.5, 4.0, 6.0 })
    {
      const Errors errors =
        ErrorsOf(MapOf(BodyWhere(
                   40,
                   spacing,
                   [&](const Vector3 & p) { return std::abs(std::hypot(p[0], p[1], p[2]) - 13) - thickness / 2; })),
                 thickness);
      EXPECT_LT(std::abs(errors.bias), kMostBias * spacing[2]) << thickness << " at " << spacing[2];
      EXPECT_LT(errors.mean, 0.25 * spacing[2]) << thickness << " at " << spacing[2];
    }
  }
}

// The ball that lies in an elliptic tube is as thick as its small axis, whatever the circle of its area.
TEST(SmoothBalls, AreNoThickerThanAnEllipticTubesSmallAxis)
{
  for (const double half : { 2.5, 4.0 })
  {
    for (const double ratio : { 1.25, 2.0, 3.0 })
    {
      const Body   body = BodyWhere(44, { 1, 1, 1 }, [&](const Vector3 & p) {
        const double across = (p[0] + p[1]) / std::sqrt(2.0); // askew to the grid
        const double other = (p[0] - p[1]) / std::sqrt(2.0);
        return std::max(std::hypot(across / (ratio * half), other / half) - 1, std::abs(p[2]) - 18);
      });
      const Errors errors = ErrorsOf(MapOf(body), 2 * half);
      EXPECT_LT(errors.most, 0.4) << half << " x " << ratio;
      EXPECT_LT(errors.bias, 0) << "near the ends of its great axis balls are small";
    }
  }
}

TEST(SmoothBalls, LieInTheVoxelsButForWhatASurfaceMayBeOff)
{
  for (const RandomVolume & volume : RandomVolumes(8400, 20))
  {
    SCOPED_TRACE(volume.Describe());
    const SpacingWeights weights = ComputeSpacingWeights(volume.spacing);
    PaintingBalls        balls = SmoothBalls(volume.shape, weights);
    ASSERT_GT(balls.Count(), 0U);
    EXPECT_TRUE(LieInVoxels(balls, volume.shape, weights));
    balls.radius.back() += 2.1 * MostBeyondVoxels(weights);
    EXPECT_FALSE(LieInVoxels(balls, volume.shape, weights));
  }
}

// The bounds know nothing of the balls, and nothing widens them for the map.
TEST(SmoothBalls, MakeNoVoxelThinnerOrThickerThanLabelsAllow)
{
  for (const RandomVolume & volume : RandomVolumes(8410, 20))
  {
    SCOPED_TRACE(volume.Describe());
    const Body             body{ volume.shape, ComputeSpacingWeights(volume.spacing) };
    const VoxelValues      map = MapOf(body);
    const ThicknessBracket bracket = SmoothBracket(body.shape, body.weights);
    for (std::size_t i = 0; i < map.values.size(); ++i)
    {
      ASSERT_LE(bracket.lower.values[i], map.values[i]) << i;
      ASSERT_LE(map.values[i], bracket.upper.values[i]) << i;
    }
  }
}

// A spike holds no place of the ball it sits on: the ball next to it had given it 16.
TEST(SmoothBalls, DoNotMakeASpikeAsThickAsWhatItSitsOn)
{
  for (const Vector3 & spacing : kTwoSpacings)
  {
    const Body        body = BodyWhere(40, spacing, [](const Vector3 & p) {
      const bool isSpike = std::abs(p[0]) < 0.5 && std::abs(p[1]) < 0.5 && p[2] > 0 && p[2] < 15;
      return isSpike ? -1 : std::hypot(p[0], p[1], p[2]) - 8;
    });
    const VoxelValues map = MapOf(body);
    // The last two voxels in scan order stick out of the ball.
    for (std::size_t i = 1; i <= 2; ++i)
    {
      EXPECT_LT(map.values[map.values.size() - i], 4 * spacing[2]) << "at " << spacing[2];
    }
  }
}

TEST(SmoothBalls, AreTheSameForEveryNumberOfThreads)
{
  const Body    body = BodyWhere(30, { 1, 1, 2.5 }, [](const Vector3 & p) { return std::hypot(p[0], p[1] / 2) - 4; });
  PaintingBalls one;
  {
    const testing::Threads threads(1);
    one = SmoothBalls(body.shape, body.weights);
  }
  const testing::Threads threads(4);
  const PaintingBalls    four = SmoothBalls(body.shape, body.weights);
  EXPECT_EQ(one.centres, four.centres);
  EXPECT_EQ(one.radius, four.radius);
}

TEST(SmoothBalls, OfSingleVoxelsAreTheirOwn)
{
  const Body body{ testing::Box({ 1, 1, 1 }), ComputeSpacingWeights({ 1, 1, 1 }) };
  EXPECT_EQ(MapOf(body).values, std::vector<float>{ 1 });
  EXPECT_EQ(SmoothBalls(VoxelShape(), body.weights).Count(), 0U);
}

TEST(SmoothBracket, HoldsTheThicknessOfBallsAndShells)
{
  for (const Vector3 & spacing : kTwoSpacings)
  {
    const auto expectHeld = [&](const Body & body, double truth) {
      const ThicknessBracket bracket = SmoothBracket(body.shape, body.weights);
      for (std::size_t i = 0; i < bracket.lower.values.size(); ++i)
      {
        ASSERT_LE(bracket.lower.values[i], truth) << "at " << spacing[2];
        ASSERT_GE(bracket.upper.values[i], truth) << "at " << spacing[2];
      }
    };
    expectHeld(BodyWhere(20, spacing, [](const Vector3 & p) { return std::hypot(p[0], p[1], p[2]) - 6.2; }), 12.4);
    expectHeld(BodyWhere(24, spacing, [](const Vector3 & p) { return std::abs(std::hypot(p[0], p[1], p[2]) - 8) - 2; }),
               4);
  }
}

TEST(SmoothBalls, StopWhenAsked)
{
  const Body body = BodyWhere(30, { 1, 1, 1 }, [](const Vector3 & p) { return std::hypot(p[0], p[1], p[2]) - 9; });
  EXPECT_THROW(SmoothBalls(body.shape, body.weights, nullptr, [](std::string_view, double) { return false; }),
               Cancelled);
}

} // namespace
} // namespace voxelcore
