#include "CertifiedFixtures.h"

#include "voxelcore/Certified/CertifiedThickness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace voxelcore
{
namespace
{

CertifiedRequest
ThicknessOfAll(bool bounds, bool refined)
{
  CertifiedRequest request;
  request.thickness = ThicknessRequest{ bounds };
  request.surface = SurfaceSource(); // nothing is refined
  if (refined)
  {
    request.surface = [](const VoxelShape & shape, const ProgressCallback & progress) {
      return std::shared_ptr<const SurfaceEstimate>(SurfaceFromLabels(shape, { 1, 1, 1 }, progress));
    };
  }
  return request;
}

/** At the middle of a box that begins at (2, 3, 4). */
float
AtTheMiddle(const CertifiedThickness & found, const VoxelValues & map, std::int32_t x, std::int32_t y, std::int32_t z)
{
  return map.values[VoxelRanks(found.shape).At(2 + x / 2, 3 + y / 2, 4 + z / 2)];
}

TEST(CertifiedThickness, OfASlabIsItsThicknessRefinedOrNot)
{
  for (const bool refined : { false, true })
  {
    const CertifiedResult result = ComputeCertified(Box(30, 30, 6), Grid({ 1, 1, 1 }), ThicknessOfAll(true, refined));
    ASSERT_TRUE(result.thickness.has_value());
    const CertifiedThickness & found = *result.thickness;
    EXPECT_EQ(found.map.values.size(), 30U * 30 * 6);
    EXPECT_NEAR(AtTheMiddle(found, found.map, 30, 30, 6), 6, refined ? 0.1 : 1e-6);
    // A smooth slab may be a voxel thinner or thicker than the voxels; parts of them are a sixth wider on either side.
    EXPECT_NEAR(AtTheMiddle(found, found.bracket.lower, 30, 30, 6), refined ? 6 - 4.0 / 3 : 6, 1e-6);
    EXPECT_NEAR(AtTheMiddle(found, found.bracket.upper, 30, 30, 6), refined ? 6 + 4.0 / 3 : 6, 0.1);
    EXPECT_EQ(found.atVertices.size(), result.cores[0].core.core.cells.vertexCount);
    EXPECT_EQ(found.owners.values.size(), found.map.values.size());
  }
}

TEST(CertifiedThickness, WithoutRefinementIsOfInscribedBallsAndBoundsAreFoundOnlyWhenAsked)
{
  const CertifiedResult both = ComputeCertified(Box(9, 7, 5), Grid({ 1, 1, 2 }), ThicknessOfAll(true, false));
  const CertifiedResult one = ComputeCertified(Box(9, 7, 5), Grid({ 1, 1, 2 }), ThicknessOfAll(false, false));
  EXPECT_EQ(one.thickness->map.values, both.thickness->map.values);
  EXPECT_TRUE(one.thickness->bracket.upper.values.empty());
  for (std::size_t i = 0; i < both.thickness->map.values.size(); ++i)
  {
    ASSERT_LE(both.thickness->map.values[i], both.thickness->bracket.lower.values[i]);
    ASSERT_LE(both.thickness->bracket.lower.values[i], both.thickness->bracket.upper.values[i]);
  }
}

TEST(CertifiedThickness, NoVoxelLiesOutsideTheBoundsNorDoTheyChangeTheMap)
{
  for (const auto & size : { std::array{ 21, 17, 5 }, std::array{ 3, 3, 12 }, std::array{ 1, 1, 1 } })
  {
    const VoxelShape      shape = Box(size[0], size[1], size[2]);
    const CertifiedResult with = ComputeCertified(shape, Grid({ 1, 1, 2 }), ThicknessOfAll(true, true));
    const CertifiedResult without = ComputeCertified(shape, Grid({ 1, 1, 2 }), ThicknessOfAll(false, true));
    const auto &          map = with.thickness->map.values;
    EXPECT_EQ(map, without.thickness->map.values);
    for (std::size_t i = 0; i < map.size(); ++i)
    {
      ASSERT_LE(with.thickness->bracket.lower.values[i], map[i]);
      ASSERT_LE(map[i], with.thickness->bracket.upper.values[i]);
    }
  }
}

TEST(CertifiedThickness, DoesNotAskHowCoresArePruned)
{
  CertifiedRequest little = ThicknessOfAll(false, true);
  little.tolerances = { ParseTolerance("0.1diag") };
  const auto usual = ComputeCertified(Box(14, 9, 8), Grid({ 1, 1, 2 }), ThicknessOfAll(false, true));
  EXPECT_EQ(ComputeCertified(Box(14, 9, 8), Grid({ 1, 1, 2 }), little).thickness->map.values,
            usual.thickness->map.values);
}

TEST(CertifiedThickness, AloneIsTheSameMapWithoutACore)
{
  CertifiedRequest smooth = ThicknessOfAll(false, true);
  const auto       beside = ComputeCertified(Box(14, 9, 8), Grid({ 1, 1, 2 }), smooth);
  smooth.thickness->alone = true;
  const auto only = ComputeCertified(Box(14, 9, 8), Grid({ 1, 1, 2 }), smooth);
  EXPECT_TRUE(only.cores.empty());
  EXPECT_EQ(only.thickness->map.values, beside.thickness->map.values);
  CertifiedRequest request = ThicknessOfAll(true, false);
  const auto       with = ComputeCertified(Box(14, 9, 8), Grid({ 1, 1, 2 }), request);
  request.thickness->alone = true;
  const auto alone = ComputeCertified(Box(14, 9, 8), Grid({ 1, 1, 2 }), request);
  EXPECT_TRUE(alone.cores.empty());
  EXPECT_EQ(alone.thickness->map.values, with.thickness->map.values);
  EXPECT_EQ(alone.thickness->owners.values, with.thickness->owners.values);
  EXPECT_EQ(alone.thickness->balls.centres, with.thickness->balls.centres);
  EXPECT_EQ(alone.thickness->bracket.lower.values, with.thickness->bracket.lower.values);
  EXPECT_EQ(alone.thickness->bracket.upper.values, with.thickness->bracket.upper.values);
  EXPECT_EQ(alone.thickness->parts, with.thickness->parts);
}

TEST(CertifiedThickness, EachValueIsTheDiameterOfTheBallThatHoldsTheVoxel)
{
  const CertifiedResult      result = ComputeCertified(Box(14, 9, 8), Grid({ 1, 1, 1 }), ThicknessOfAll(false, false));
  const CertifiedThickness & found = *result.thickness;
  std::size_t                at = 0;
  for (std::int32_t z = 0; z < 8; ++z)
  {
    for (std::int32_t y = 0; y < 9; ++y)
    {
      for (std::int32_t x = 0; x < 14; ++x, ++at)
      {
        const std::uint32_t owner = found.owners.values[at];
        ASSERT_GT(owner, 0U);
        const Vector3 & centre = found.balls.centres[owner - 1];
        ASSERT_LE(std::hypot(centre[0] - x - 2.5, centre[1] - y - 3.5, centre[2] - z - 4.5),
                  found.balls.radius[owner - 1] + 1e-9);
        ASSERT_EQ(found.map.values[at], static_cast<float>(2 * found.balls.radius[owner - 1]));
      }
    }
  }
}

TEST(CertifiedThickness, LeavesTheCoresAsTheyAre)
{
  CertifiedRequest plain;
  plain.surface = SurfaceSource();
  const CertifiedResult with = ComputeCertified(Box(12, 9, 7), Grid({ 1, 1, 1 }), ThicknessOfAll(true, false));
  const CertifiedResult without = ComputeCertified(Box(12, 9, 7), Grid({ 1, 1, 1 }), plain);
  EXPECT_EQ(with.cores[0].core.core.positions, without.cores[0].core.core.positions);
  EXPECT_EQ(with.cores[0].core.core.radius, without.cores[0].core.core.radius);
}

TEST(CertifiedThickness, BoundsThatContradictEachOtherAreRefused)
{
  const CertifiedResult result = ComputeCertified(Box(9, 7, 5), Grid({ 1, 1, 1 }), ThicknessOfAll(true, false));
  CertifiedThickness    found = *result.thickness;
  CertifiedShape        shape = result.shape;
  found.bracket.balls = found.balls;
  found.bracket.owners = found.owners;
  EXPECT_NO_THROW(ThicknessOf(shape, found.shape, found.bracket));
  ThicknessBracket wrong = found.bracket;
  wrong.upper.values[17] = 0.5F * wrong.lower.values[17];
  EXPECT_THROW(ThicknessOf(shape, found.shape, wrong), CertificateError);
  wrong = found.bracket;
  wrong.lower.values[17] = 0;
  EXPECT_THROW(ThicknessOf(shape, found.shape, wrong), CertificateError);
}

} // namespace
} // namespace voxelcore
