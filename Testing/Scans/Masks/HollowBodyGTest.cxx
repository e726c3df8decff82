// Tubes and shells look hollow; bodies, rings and sponges do not.

#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Masks/HollowBody.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voxelcore::testing
{
namespace
{

constexpr std::array<std::int64_t, 3> kCubes{ 1, 1, 1 };

/** A tube of outer radius 8 and a wall of 2 along a direction, its middle at the middle of 64^3 voxels, open at its
 *  ends; with `holes`, a hole of radius 1.7 through the wall at every 6 voxels of its length. */
VoxelShape
Tube(std::array<double, 3> way, double halfLength, bool holes)
{
  const double length = std::hypot(way[0], way[1], way[2]);
  return ShapeWhere({ 64, 64, 64 }, [&](int x, int y, int z) {
    const std::array<double, 3> at{ x - 31.5, y - 31.5, z - 31.5 };
    double                      along = 0;
    double                      squared = 0;
    for (std::size_t a = 0; a < 3; ++a)
    {
      along += at[a] * way[a] / length;
      squared += at[a] * at[a];
    }
    const double away = std::sqrt(std::max(squared - along * along, 0.0));
    const double sideways = at[0] - along * way[0] / length;
    const double off = along - 6 * std::round(along / 6);
    const bool   isHole = holes && sideways > 5 && std::hypot(off, std::sqrt(away * away - sideways * sideways)) < 1.7;
    return std::abs(along) < halfLength && away < 8 && away >= 6 && !isHole;
  });
}

TEST(HollowBody, TubesLookHollowHoweverTheyRun)
{
  for (const std::array<double, 3> & way :
       std::initializer_list<std::array<double, 3>>{ { 0, 0, 1 }, { 1, 0, 0 }, { 1, 1, 0 }, { 1, 2, 3 }, { 1, 1, 1 } })
  {
    for (const bool holes : { false, true })
    {
      const auto body = FindHollowBody(Tube(way, 26, holes), kCubes);
      ASSERT_TRUE(body) << way[0] << way[1] << way[2] << holes;
      EXPECT_GT(body->share, 0.5); // 36 : 28 without holes
      EXPECT_LT(body->share, 1.9);
      EXPECT_NE(HollowText(*body).find("looks hollow"), std::string::npos);
    }
  }
}

TEST(HollowBody, SolidThingsRingsAndSlicesOfTubesDoNot)
{
  EXPECT_FALSE(FindHollowBody(Ellipsoid(64), kCubes));
  EXPECT_FALSE(FindHollowBody(Box({ 20, 30, 10 }), kCubes));
  EXPECT_FALSE(FindHollowBody(VoxelShape(), kCubes));
  EXPECT_FALSE(FindHollowBody(Tube({ 0, 0, 1 }, 3, false), kCubes)) << "a ring";
  const auto ring = ShapeWhere({ 64, 64, 20 }, [](int x, int y, int z) {
    const double away = std::hypot(x - 31.5, y - 31.5) - 22;
    return away * away + (z - 9.5) * (z - 9.5) < 64;
  });
  EXPECT_FALSE(FindHollowBody(ring, kCubes));
}

TEST(HollowBody, AShellIsHollowUnlessALabelFillsIt)
{
  const auto isInside = [](int x, int y, int z) { return x >= 3 && x < 17 && y >= 3 && y < 17 && z >= 3 && z < 17; };
  const auto shell = ShapeWhere({ 20, 20, 20 }, [&](int x, int y, int z) { return !isInside(x, y, z); }, { 5, -7, 60 });
  const auto filling = ShapeWhere({ 20, 20, 20 }, isInside, { 5, -7, 60 });
  const auto body = FindHollowBody(shell, kCubes);
  ASSERT_TRUE(body);
  EXPECT_EQ(body->voxels, 14U * 14 * 14);
  EXPECT_DOUBLE_EQ(body->share, 2744.0 / 5256);
  const std::array<const VoxelShape *, 1> others{ &filling };
  EXPECT_FALSE(FindHollowBody(shell, kCubes, others));
}

TEST(HollowBody, GreatBodiesAreLookedAtInLongerVoxelsWhereverTheirBoxBegins)
{
  for (const std::array<std::int32_t, 3> & lower :
       std::initializer_list<std::array<std::int32_t, 3>>{ { 0, 0, 0 }, { 1, -3, 7 }, { -128, 64, -1 } })
  {
    for (const double lumen : { 0.0, 14.0 })
    {
      // A tube of outer radius 20 between opposite corners of a box of more than 2^24 voxels.
      const auto tube = ShapeWhere(
        { 290, 290, 290 },
        [&](int x, int y, int z) {
          const double along = (x + y + z) / std::sqrt(3.0);
          const double squared = static_cast<double>(x) * x + static_cast<double>(y) * y + static_cast<double>(z) * z;
          const double away = std::sqrt(std::max(squared - along * along, 0.0));
          return along > 30 && along < 470 && away < 20 && away >= lumen;
        },
        lower);
      const auto body = FindHollowBody(tube, kCubes);
      ASSERT_EQ(body.has_value(), lumen > 0) << lower[0];
      if (body)
      {
        EXPECT_NEAR(body->share, 196.0 / 204, 0.15);
      }
    }
  }
}

TEST(HollowBody, ALabyrinthIsNot)
{
  // Two systems of channels, either side of a gyroid's sheet, open at the border of the box.
  const auto sheet = ShapeWhere({ 60, 60, 60 }, [](int x, int y, int z) {
    const double s = 2 * std::acos(-1.0) / 20;
    return std::abs(std::sin(s * x) * std::cos(s * y) + std::sin(s * y) * std::cos(s * z) +
                    std::sin(s * z) * std::cos(s * x)) < 0.4;
  });
  EXPECT_FALSE(FindHollowBody(sheet, kCubes));
}

} // namespace
} // namespace voxelcore::testing
