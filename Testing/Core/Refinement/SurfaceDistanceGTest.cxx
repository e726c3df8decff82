#include "voxelcore/Refinement/SurfaceDistance.h"

#include "VoxelCoreTesting/Random.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/BoundaryVertices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace voxelcore
{
namespace
{

constexpr double kRadius = 9.3; // mm

/** A ball about (20, 20, 20) mm. */
class Ball : public SurfaceEstimate
{
public:
  SurfacePoint
  Project(const Vector3 & place, double reach) const override
  {
    const Vector3 away = Minus(place, { 20, 20, 20 });
    const double  length = Length(away);
    if (length == 0 || std::abs(length - kRadius) > reach)
    {
      return {};
    }
    const Vector3 normal = AddScaled({}, 1 / length, away);
    return { AddScaled({ 20, 20, 20 }, kRadius, normal), normal, true };
  }
};

class Unknown : public SurfaceEstimate
{
public:
  SurfacePoint
  Project(const Vector3 &, double) const override
  {
    return {};
  }
};

VoxelShape
VoxelsOfBall(const Vector3 & spacing)
{
  const auto size = [&](std::size_t axis) { return static_cast<std::int32_t>(40 / spacing[axis]); };
  VoxelShape shape({ { 0, 0, 0 }, { size(0), size(1), size(2) } });
  for (std::int32_t k = 0; k < size(2); ++k)
  {
    for (std::int32_t j = 0; j < size(1); ++j)
    {
      for (std::int32_t i = 0; i < size(0); ++i)
      {
        if (Distance(Times({ i + 0.5, j + 0.5, k + 0.5 }, spacing), { 20, 20, 20 }) < kRadius)
        {
          shape.Insert(i, j, k);
        }
      }
    }
  }
  return shape;
}

TEST(SurfaceDistance, FromAnywhereInABallIsToItsSurface)
{
  constexpr std::uint64_t seed = 90133;
  testing::Random         random(seed);
  for (const Vector3 & spacing : { Vector3{ 1, 1, 1 }, Vector3{ 1, 1, 2.5 } })
  {
    const VoxelShape      shape = VoxelsOfBall(spacing);
    const SurfaceDistance distance(std::make_shared<Ball>(), BoundaryVertices(shape), spacing);
    for (int round = 0; round < 300; ++round)
    {
      Vector3 place{};
      do
      {
        place = { random.Unit(), random.Unit(), random.Unit() };
        place = AddScaled({ 20 - kRadius, 20 - kRadius, 20 - kRadius }, 2 * kRadius, place);
      } while (Distance(place, { 20, 20, 20 }) > kRadius);
      ASSERT_NEAR(distance.From(Over(place, spacing)), kRadius - Distance(place, { 20, 20, 20 }), 2e-3)
        << "seed " << seed << ", round " << round;
    }
  }
}

TEST(SurfaceDistance, WhereNothingIsKnownOfTheSurfaceIsToTheNearestBoundaryVertex)
{
  const Vector3         spacing{ 1, 1, 2.5 };
  const auto            boundary = BoundaryVertices(VoxelsOfBall(spacing));
  const SurfaceDistance distance(std::make_shared<Unknown>(), boundary, spacing);
  for (const Vector3 & place : { Vector3{ 20, 20, 8 }, Vector3{ 13.2, 22, 7.1 }, Vector3{ 20, 28.4, 8.5 } })
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (const LatticePoint & p : boundary)
    {
      nearest = std::min(nearest, Length(Times(Minus(place, { p.x + 0.0, p.y + 0.0, p.z + 0.0 }), spacing)));
    }
    EXPECT_NEAR(distance.From(place), nearest, 1e-12);
  }
  EXPECT_EQ(SurfaceDistance(std::make_shared<Unknown>(), {}, spacing).From({ 1, 1, 1 }),
            std::numeric_limits<double>::infinity());
}

} // namespace
} // namespace voxelcore
