#include "voxelcore/Lattice/ImageGeometry.h"

#include "VoxelCoreTesting/Random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace voxelcore
{
namespace
{

// A rotation by three angles; its last axis turned round when `mirrored`.
std::array<double, 9>
Rotation(double a, double b, double c, bool mirrored)
{
  const double s = mirrored ? -1.0 : 1.0;
  return { std::cos(b) * std::cos(c),
           std::sin(a) * std::sin(b) * std::cos(c) - std::cos(a) * std::sin(c),
           s * (std::cos(a) * std::sin(b) * std::cos(c) + std::sin(a) * std::sin(c)),
           std::cos(b) * std::sin(c),
           std::sin(a) * std::sin(b) * std::sin(c) + std::cos(a) * std::cos(c),
           s * (std::cos(a) * std::sin(b) * std::sin(c) - std::sin(a) * std::cos(c)),
           -std::sin(b),
           std::sin(a) * std::cos(b),
           s * std::cos(a) * std::cos(b) };
}

TEST(ImageGeometry, TheCentreOfTheFirstVoxelIsTheOrigin)
{
  ImageGeometry geometry;
  geometry.origin = { -90.5, 126.25, 72.0 };
  geometry.spacing = { 0.5, 0.25, 3.0 };
  geometry.direction = Rotation(0.3, -0.2, 1.1, false);
  EXPECT_EQ(LatticeToPhysical(geometry, { 0.5, 0.5, 0.5 }), geometry.origin);
}

TEST(ImageGeometry, LatticeCornersLieHalfAVoxelBeforeTheIndex)
{
  ImageGeometry geometry;
  geometry.origin = { 10, 20, 30 };
  geometry.spacing = { 1, 2, 4 };
  EXPECT_EQ(LatticeToPhysical(geometry, { 0, 0, 0 }), (Vector3{ 9.5, 19, 28 }));
  EXPECT_EQ(LatticeToPhysical(geometry, { 3, 1, 2 }), (Vector3{ 12.5, 21, 36 }));
}

TEST(ImageGeometry, ColumnsOfTheDirectionAreTheAxes)
{
  ImageGeometry geometry;
  // Axis i points along +y, j along +z, k along +x.
  geometry.direction = { 0, 0, 1, 1, 0, 0, 0, 1, 0 };
  geometry.spacing = { 2, 3, 5 };
  EXPECT_EQ(LatticeToPhysical(geometry, { 1.5, 0.5, 0.5 }), (Vector3{ 0, 2, 0 }));
  EXPECT_EQ(LatticeToPhysical(geometry, { 0.5, 1.5, 0.5 }), (Vector3{ 0, 0, 3 }));
  EXPECT_EQ(LatticeToPhysical(geometry, { 0.5, 0.5, 1.5 }), (Vector3{ 5, 0, 0 }));
  EXPECT_FALSE(IsLeftHanded(geometry));
}

TEST(ImageGeometry, ThereAndBackIsTheSamePointObliqueOrMirrored)
{
  testing::Random random(41);
  for (int round = 0; round < 500; ++round)
  {
    const auto    angle = [&] { return 2.0 * std::numbers::pi * random.Unit(); };
    const bool    mirrored = random.Chance(0.5);
    ImageGeometry geometry;
    geometry.direction = Rotation(angle(), angle(), angle(), mirrored);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      geometry.spacing[axis] = 0.05 + 4.0 * random.Unit();
      geometry.origin[axis] = 400.0 * (random.Unit() - 0.5);
    }
    EXPECT_EQ(IsLeftHanded(geometry), mirrored) << round;
    EXPECT_LT(OrthonormalityDeviationDegrees(geometry), 1e-10);
    const Vector3 lattice{ 512 * random.Unit(), 512 * random.Unit(), 512 * random.Unit() };
    const Vector3 back = PhysicalToLattice(geometry, LatticeToPhysical(geometry, lattice));
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(back[axis], lattice[axis], 1e-9) << round;
    }
  }
}

TEST(ImageGeometry, ThereAndBackHoldsForShearedAxesToo)
{
  ImageGeometry geometry;
  geometry.direction = { 1, 0.2, 0.1, 0, 0.9, -0.3, 0.05, 0, 1.1 };
  geometry.spacing = { 0.7, 1.3, 2.9 };
  geometry.origin = { 5, -6, 7 };
  const Vector3 lattice{ 12.25, 0, 77.5 };
  const Vector3 back = PhysicalToLattice(geometry, LatticeToPhysical(geometry, lattice));
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(back[axis], lattice[axis], 1e-12);
  }
}

TEST(ImageGeometry, HandednessIsTheSignOfTheDirection)
{
  ImageGeometry geometry;
  EXPECT_FALSE(IsLeftHanded(geometry));
  geometry.direction = { -1, 0, 0, 0, -1, 0, 0, 0, 1 }; // LPS to RAS
  EXPECT_FALSE(IsLeftHanded(geometry));
  geometry.direction = { 1, 0, 0, 0, 1, 0, 0, 0, -1 };
  EXPECT_TRUE(IsLeftHanded(geometry));
  geometry.direction = { 0, 1, 0, 1, 0, 0, 0, 0, 1 };
  EXPECT_TRUE(IsLeftHanded(geometry));
}

TEST(ImageGeometry, DeviationFromOrthonormalIsInDegrees)
{
  ImageGeometry geometry;
  EXPECT_EQ(OrthonormalityDeviationDegrees(geometry), 0.0);
  // The second axis leans one degree towards the first.
  const double lean = std::numbers::pi / 180.0;
  geometry.direction = { 1, std::sin(lean), 0, 0, std::cos(lean), 0, 0, 0, 1 };
  EXPECT_NEAR(OrthonormalityDeviationDegrees(geometry), 1.0, 1e-12);
  geometry.direction = { 1, 0, 0, 0, 1.01, 0, 0, 0, 1 };
  EXPECT_NEAR(OrthonormalityDeviationDegrees(geometry), std::asin(0.01) / lean, 1e-10);
  geometry.direction = { 1, 0, 0, 0, 1, 0, 0, 0, 0 };
  EXPECT_NEAR(OrthonormalityDeviationDegrees(geometry), 90.0, 1e-12);
  geometry.direction[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(OrthonormalityDeviationDegrees(geometry), 90.0);
}

} // namespace
} // namespace voxelcore
