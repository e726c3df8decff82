#include "voxelcore/Verification/StandOutCheck.h"

#include "VoxelCoreTesting/Shapes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <limits>
#include <vector>

namespace voxelcore
{
namespace
{

using Places = std::vector<std::array<double, 3>>;
using testing::Size3;
using testing::Spacing3;

const SpacingWeights kCubes = ComputeSpacingWeights({ 1, 1, 1 });

/** A tube of radius 4 along x from 0 to 60, with an arm of radius 4 that reaches so far up from its axis. */
VoxelShape
TubeWithAnArm(double height)
{
  return testing::ShapeWhere({ 60, 60, 60 }, [&](int x, int y, int z) {
    const double dy = y + 0.5 - 10;
    const double dz = z + 0.5 - 30;
    const double dx = x + 0.5 - 30;
    const double above = std::max(dy - height + 4, 0.0);
    return dy * dy + dz * dz < 16 || (dy > 0 && dx * dx + dz * dz + above * above < 16);
  });
}

Places
Axis()
{
  Places places;
  for (int x = 1; x < 60; ++x)
  {
    places.push_back({ static_cast<double>(x), 10, 30 });
  }
  return places;
}

std::optional<BallOutside>
Outside(const VoxelShape & shape, const Places & places, double reach, double standOut)
{
  return BallStandingOut(shape, kCubes, places, std::vector<double>(places.size(), reach), standOut);
}

/** The same by a look at every ball, place and boundary vertex. */
std::optional<BallOutside>
OutsideOneByOne(const VoxelShape &          shape,
                const Spacing3 &            spacing,
                const Places &              places,
                const std::vector<double> & reach,
                double                      standOut)
{
  const auto [lower, size] = shape.Box();
  const auto way = [&](const std::array<double, 3> & a, const std::array<double, 3> & b) {
    return std::hypot(spacing[0] * (a[0] - b[0]), spacing[1] * (a[1] - b[1]), spacing[2] * (a[2] - b[2]));
  };
  Places boundary;
  for (int z = 0; z <= size[2]; ++z)
  {
    for (int y = 0; y <= size[1]; ++y)
    {
      for (int x = 0; x <= size[0]; ++x)
      {
        const unsigned around = shape.Around(lower[0] + x, lower[1] + y, lower[2] + z);
        if (around != 0 && around != 255)
        {
          boundary.push_back({ 1.0 * lower[0] + x, 1.0 * lower[1] + y, 1.0 * lower[2] + z });
        }
      }
    }
  }
  const double               half = 0.5 * std::hypot(spacing[0], spacing[1], spacing[2]);
  std::optional<BallOutside> worst;
  for (int z = lower[2]; z < lower[2] + size[2]; ++z)
  {
    for (int y = lower[1]; y < lower[1] + size[1]; ++y)
    {
      for (int x = lower[0]; x < lower[0] + size[0]; ++x)
      {
        if (!shape.Contains(x, y, z))
        {
          continue;
        }
        const std::array<double, 3> middle{ x + 0.5, y + 0.5, z + 0.5 };
        double                      radius = std::numeric_limits<double>::infinity();
        for (const auto & vertex : boundary)
        {
          radius = std::min(radius, way(middle, vertex));
        }
        double beyond = std::numeric_limits<double>::infinity();
        double corner = beyond;
        for (std::size_t i = 0; i < places.size(); ++i)
        {
          beyond = std::min(beyond, way(middle, places[i]) + radius - reach[i]);
          corner = std::min(corner, way(middle, places[i]) + 2 * (radius - reach[i]));
        }
        if (beyond > standOut + half && corner > half && (!worst || beyond > worst->beyond))
        {
          worst = { beyond, { x, y, z }, radius };
        }
      }
    }
  }
  return worst;
}

TEST(StandOutCheck, FindsWhatALookAtEveryBallFinds)
{
  constexpr std::uint64_t firstSeed = 6301;
  std::cout << "seeds from " << firstSeed << '\n';
  int outside = 0;
  for (std::uint64_t seed = firstSeed; seed < firstSeed + 20; ++seed)
  {
    testing::Random  random(seed);
    const Spacing3 & spacing = testing::TestSpacings()[seed % testing::TestSpacings().size()];
    const auto       side = [&] { return static_cast<std::int32_t>(random.Between(4, 26)); };
    const Size3      size{ side(), side(), side() };
    const Size3      lower{ -5, 3, static_cast<std::int32_t>(random.Between(0, 70)) };
    // Thick bodies as well as thin ones: all of the box but balls, or none of it but balls.
    const bool                                            isThick = random.Chance(0.5);
    std::vector<std::pair<std::array<double, 3>, double>> balls;
    for (int i = 0; i < 4; ++i)
    {
      const auto at = [&](std::size_t a) { return static_cast<double>(random.Between(0, size[a])); };
      balls.push_back({ { at(0), at(1), at(2) }, static_cast<double>(random.Between(2, isThick ? 6 : 15)) });
    }
    const VoxelShape shape = testing::ShapeWhere(
      size,
      [&](int x, int y, int z) {
        return isThick != std::ranges::any_of(balls, [&](const auto & ball) {
                 const auto & [at, radius] = ball;
                 return std::hypot(x + 0.5 - at[0], y + 0.5 - at[1], z + 0.5 - at[2]) < radius;
               });
      },
      lower);
    if (shape.CountVoxels() == 0)
    {
      continue;
    }
    Places              places;
    std::vector<double> reach;
    for (const auto & [at, radius] : balls)
    {
      places.push_back({ lower[0] + at[0], lower[1] + at[1], lower[2] + at[2] });
      reach.push_back((isThick ? 8 : radius) * spacing[0]);
    }
    const double standOut = static_cast<double>(random.Between(0, 4)) * spacing[0];
    const auto   expected = OutsideOneByOne(shape, spacing, places, reach, standOut);
    const auto   found = BallStandingOut(shape, ComputeSpacingWeights(spacing), places, reach, standOut);
    ASSERT_EQ(found.has_value(), expected.has_value()) << "seed " << seed;
    if (expected)
    {
      ++outside;
      EXPECT_NEAR(found->beyond, expected->beyond, 1e-6 * expected->beyond) << "seed " << seed;
      EXPECT_NEAR(found->radius, expected->radius, 1e-6 * expected->radius) << "seed " << seed;
    }
  }
  EXPECT_GT(outside, 3);
  EXPECT_LT(outside, 17);
}

TEST(StandOutCheck, AnArmThatStandsOutNeedsABranch)
{
  // The arm's last ball stands out of the tube's by its middle's way from the axis.
  EXPECT_FALSE(Outside(TubeWithAnArm(4 + 2), Axis(), 4, 3));
  const auto outside = Outside(TubeWithAnArm(4 + 8), Axis(), 4, 3);
  ASSERT_TRUE(outside);
  EXPECT_NEAR(outside->beyond, 8, 1.5);
  EXPECT_NEAR(outside->voxel[0], 29.5, 4);
  EXPECT_GT(outside->voxel[1], 12);
  EXPECT_FALSE(Outside(TubeWithAnArm(4 + 8), Axis(), 4, 9));
  Places both = Axis();
  for (double y = 10; y <= 18; ++y)
  {
    both.push_back({ 30, y, 30 });
  }
  EXPECT_FALSE(Outside(TubeWithAnArm(4 + 8), both, 4, 3));
}

TEST(StandOutCheck, CornersOfBoxesAreNoBranches)
{
  const VoxelShape cube = testing::Box({ 40, 40, 40 });
  EXPECT_FALSE(Outside(cube, { { 20, 20, 20 } }, 20, 3)); // a corner of it is 14.6 beyond
  EXPECT_TRUE(Outside(testing::Box({ 80, 40, 40 }), { { 20, 20, 20 } }, 20, 3));
}

TEST(StandOutCheck, ADomeIsNoCorner)
{
  const VoxelShape dome = testing::ShapeWhere({ 60, 60, 60 }, [](int x, int y, int z) {
    const double dy = y + 0.5 - 10;
    const double dz = z + 0.5 - 30;
    return dy * dy + dz * dz < 9 || std::pow(x + 0.5 - 30, 2) + std::pow(dy - 10.5, 2) + dz * dz < 81;
  });
  const auto       outside = Outside(dome, Axis(), 3, 3);
  ASSERT_TRUE(outside);
  EXPECT_NEAR(outside->beyond, 16.5, 1.5);
}

TEST(StandOutCheck, MeasuresInMillimetres)
{
  const VoxelShape     shape = TubeWithAnArm(4 + 8);
  const SpacingWeights weights = ComputeSpacingWeights({ 0.5, 0.5, 0.5 });
  const Places         places = Axis();
  const auto           outside = BallStandingOut(shape, weights, places, std::vector<double>(places.size(), 2), 1.5);
  const auto           inVoxels = Outside(shape, places, 4, 3);
  ASSERT_TRUE(outside);
  EXPECT_NEAR(2 * outside->beyond, inVoxels->beyond, 1e-9);
  EXPECT_EQ(outside->voxel, inVoxels->voxel);
}

} // namespace
} // namespace voxelcore
