#include "voxelcore/Verification/Verification.h"

#include "Core/Verification/DamagedCores.h"
#include "voxelcore/Lattice/ImageGeometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <random>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

constexpr std::array<std::array<double, 3>, 4> kSpacings{
  { { 1, 1, 1 }, { 1, 1, 2 }, { 3, 3, 7 }, { 0.48828125, 0.48828125, 2.5 } }
};

void
ExpectPasses(const VerificationCase & subject)
{
  const VerificationReport report = Verify(subject);
  EXPECT_TRUE(report.passed) << Summary(report);
  EXPECT_EQ(report.checks.size(), 29U);
  EXPECT_EQ(report.shapeTopology, report.complexTopology);
  for (const VerificationCheck & check : report.checks)
  {
    EXPECT_TRUE(check.offenders == 0 && check.firstOffender.empty()) << check.name;
  }
}

/** A row of voxels along x, by hand: a vertex in the middle of each, an edge between neighbours. */
VerificationCase
HandmadeRod(std::int32_t length, const std::array<double, 3> & spacing)
{
  VerificationCase subject{ SolidBox({ length, 1, 1 }), ComputeSpacingWeights(spacing), {}, std::nullopt };
  subject.spacing = spacing;
  const double halfDiagonal = std::hypot(spacing[0], spacing[1], spacing[2]) / 2;
  const double halfSection = std::hypot(spacing[1], spacing[2]) / 2;
  subject.core.cells.vertexCount = static_cast<std::size_t>(length);
  for (std::int32_t i = 0; i < length; ++i)
  {
    subject.core.positions.push_back({ i + 0.5, 0.5, 0.5 });
    subject.core.radius.push_back(halfDiagonal);
    subject.core.vertexLambda.push_back(halfDiagonal);
    if (i > 0)
    {
      subject.core.cells.edges.push_back({ static_cast<ElementIndex>(i - 1), static_cast<ElementIndex>(i) });
      subject.core.edgeLambda.push_back(halfSection);
    }
  }
  return subject;
}

/** Positions as a file would give them back: through LPS mm. */
void
SendThroughMillimetres(VerificationCase & subject, const ImageGeometry & geometry)
{
  for (auto & position : subject.core.positions)
  {
    position = PhysicalToLattice(geometry, LatticeToPhysical(geometry, position));
  }
  subject.positionTolerance = PositionTolerance(geometry);
  if (IsLeftHanded(geometry))
  {
    for (std::size_t f = 0; f < subject.core.cells.FaceCount(); ++f)
    {
      ReversePolygon(subject.core.cells, f);
    }
    subject.polygonsReversed = true;
  }
}

void
ForgetEdgesOnFaces(VerificationCase & subject)
{
  for (const ElementIndex edge : subject.core.cells.faceEdges)
  {
    subject.core.edgeLambda[edge] = std::numeric_limits<double>::quiet_NaN();
  }
}

} // namespace

TEST(Verification, AHandmadeCoreOfARodPasses)
{
  for (const auto & spacing : kSpacings)
  {
    for (const std::int32_t length : { 1, 2, 7, 70 })
    {
      ExpectPasses(HandmadeRod(length, spacing));
    }
  }
}

TEST(Verification, AnEmptyShapeHasAnEmptyCore)
{
  ExpectPasses({ VoxelShape(), SpacingWeights{}, {}, std::nullopt });
}

TEST(Verification, AnEmptyComplexIsNoCoreOfAVoxel)
{
  const VerificationReport report = Verify({ SolidBox({ 1, 1, 1 }), SpacingWeights{}, {}, std::nullopt });
  EXPECT_EQ(FailedChecks(report), std::vector<std::string>{ "topology" });
}

TEST(Verification, ACoreOfAnotherShapeFails)
{
  VerificationCase subject = HandmadeRod(3, { 1, 1, 1 });
  subject.shape = SolidBox({ 3, 1, 2 });
  EXPECT_FALSE(Verify(subject).passed);
}

TEST(Verification, CoresOfSimpleShapesPass)
{
  const auto ring = [](std::int32_t x, std::int32_t y, std::int32_t) { return x < 2 || x > 5 || y < 2 || y > 5; };
  const auto shell = [](std::int32_t x, std::int32_t y, std::int32_t z) {
    return std::max({ std::abs(x - 4), std::abs(y - 4), std::abs(z - 4) }) > 1;
  };
  const auto twoByAnEdge = [](std::int32_t x, std::int32_t y, std::int32_t) { return x == y; };
  for (const auto & spacing : kSpacings)
  {
    SCOPED_TRACE(::testing::PrintToString(spacing));
    for (const double threshold : { 0.0, 1.5 * spacing[0] })
    {
      ExpectPasses(MakeCase(SolidBox({ 1, 1, 1 }), spacing, threshold));
      ExpectPasses(MakeCase(SolidBox({ 1, 1, 9 }), spacing, threshold));
      ExpectPasses(MakeCase(SolidBox({ 8, 7, 1 }), spacing, threshold));
      ExpectPasses(MakeCase(SolidBox({ 12, 11, 3 }), spacing, threshold));
      ExpectPasses(MakeCase(SolidBox({ 6, 5, 4 }), spacing, threshold));
      ExpectPasses(MakeCase(MakeShape({ 8, 8, 2 }, ring), spacing, threshold));
      ExpectPasses(MakeCase(MakeShape({ 9, 9, 9 }, shell), spacing, threshold));
      ExpectPasses(MakeCase(MakeShape({ 2, 2, 1 }, twoByAnEdge), spacing, threshold));
      ExpectPasses(MakeCase(EllipsoidWithRod(), spacing, threshold));
    }
  }
  const VerificationReport report = Verify(MakeCase(MakeShape({ 9, 9, 9 }, shell), { 1, 1, 1 }));
  EXPECT_EQ(report.complexTopology, (TopologyNumbers{ 2, { 1, 0, 1 } }));
}

TEST(Verification, CoresOfRandomVolumesPass)
{
  std::cout << "seeds 1 to 160\n";
  for (std::uint32_t seed = 1; seed <= 160; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto &     spacing = kSpacings[seed % 4];
    const auto       side = [&](unsigned step) { return static_cast<std::int32_t>(2 + (seed * step) % 9); };
    const VoxelShape shape = RandomShape(seed, { side(3), side(5), side(7) }, 5 + seed * 13 % 91);
    VerificationCase subject = MakeCase(shape, spacing, seed % 3 == 0 ? 0.0 : (1 + seed % 4) * 0.5 * spacing[0]);
    if (seed % 2 == 0)
    {
      ForgetEdgesOnFaces(subject);
    }
    ExpectPasses(subject);
    ASSERT_FALSE(::testing::Test::HasFailure());
  }
}

TEST(Verification, PositionsBackFromMillimetresPass)
{
  std::cout << "seeds 1 to 24\n";
  for (std::uint32_t seed = 1; seed <= 24; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto &  spacing = kSpacings[seed % 4];
    ImageGeometry geometry;
    geometry.size = { 24, 12, 9 };
    geometry.spacing = spacing;
    geometry.origin = { -812.25 + seed, 1033.7, seed % 5 == 0 ? 1e5 / 3 : 71.3 };
    // A rotation about an oblique axis, mirrored every other time.
    const double angle = 0.37 * seed;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double mirror = seed % 2 == 0 ? -1 : 1;
    geometry.direction = { c, -s * 0.6, mirror * s * 0.8, s, c * 0.6, -mirror * c * 0.8, 0, 0.8, mirror * 0.6 };
    VerificationCase subject = MakeCase(seed < 13 ? EllipsoidWithRod() : RandomShape(seed, { 24, 12, 9 }, 60),
                                        spacing,
                                        seed % 3 == 0 ? spacing[0] : 0.0);
    SendThroughMillimetres(subject, geometry);
    ForgetEdgesOnFaces(subject);
    EXPECT_EQ(subject.polygonsReversed, seed % 2 == 0);
    ExpectPasses(subject);
    if (subject.core.cells.FaceCount() > 0)
    {
      subject.polygonsReversed = !subject.polygonsReversed;
      EXPECT_EQ(FailedChecks(Verify(subject)), std::vector<std::string>{ "faces oriented" });
    }
  }
}

TEST(Verification, TheToleranceOfPositionsFollowsTheLargestCoordinate)
{
  ImageGeometry geometry;
  geometry.size = { 512, 512, 300 };
  geometry.spacing = { 0.5, 0.5, 1.0 };
  EXPECT_LT(PositionTolerance(geometry), 2e-10); // half a step of places is 1.2e-10
  const double near = PositionTolerance(geometry);
  geometry.origin = { 0, -1e6, 0 };
  EXPECT_GT(PositionTolerance(geometry), 100 * near);
  EXPECT_LT(PositionTolerance(geometry), 1e-6);
}

TEST(Verification, ProgressIsToldAndCanCancel)
{
  const VerificationCase  subject = HandmadeRod(3, { 1, 1, 1 });
  const VerificationInput input = InputOf(subject);
  double                  last = -1;
  EXPECT_TRUE(VerifyComplex(input, [&](std::string_view, double fraction) {
                EXPECT_GE(fraction, last);
                last = fraction;
                return true;
              }).passed);
  EXPECT_EQ(last, 1.0);
  EXPECT_THROW(VerifyComplex(input, [](std::string_view, double fraction) { return fraction < 0.5; }), Cancelled);
}

TEST(Verification, ShapesBeyondTheExactRangeAreRefused)
{
  VerificationCase subject = HandmadeRod(1, { 1, 1, 1 });
  subject.weights.weight = { 4096, 4096, 1 };
  subject.shape = VoxelShape({ { 0, 0, 0 }, { 1 << 20, 1, 1 } });
  EXPECT_THROW(Verify(subject), InputError);
}

TEST(HeavyVerification, LargeCoresPass)
{
  const auto ellipsoid = [](std::int32_t x, std::int32_t y, std::int32_t z) {
    const double a = (x + 0.5 - 64) / (0.45 * 128);
    const double b = (y + 0.5 - 64) / (0.30 * 128);
    const double c = (z + 0.5 - 64) / (0.20 * 128);
    return a * a + b * b + c * c <= 1;
  };
  ExpectPasses(MakeCase(MakeShape({ 128, 128, 128 }, ellipsoid), { 1, 1, 1 }));
  ExpectPasses(MakeCase(MakeShape({ 128, 128, 128 }, ellipsoid), { 0.48828125, 0.48828125, 2.5 }, 2.0));
  for (std::uint32_t seed = 1; seed <= 12; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto & spacing = kSpacings[seed % 4];
    ExpectPasses(MakeCase(RandomShape(seed, { 40, 40, 40 }, 5 + seed * 8), spacing, seed % 2 * 1.5 * spacing[0]));
  }
}
