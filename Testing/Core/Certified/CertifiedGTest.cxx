#include "CertifiedFixtures.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Refinement/Refinement.h"

#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <random>

namespace voxelcore
{
namespace
{

TEST(Certified, ASingleVoxelHasOneVertexInItsMiddle)
{
  const CertifiedResult result = ComputeCertified(Box(1, 1, 1), Grid({ 2, 2, 2 }), Lambdas({ "0", "1.5vox" }));
  EXPECT_EQ(result.boundaryVertices, 8U);
  EXPECT_EQ(result.whole.vertices, 1U);
  EXPECT_DOUBLE_EQ(result.whole.maxRadiusMm, std::sqrt(3.0));
  ASSERT_EQ(result.cores.size(), 2U);
  // Voxel (2,3,4) of a scan with 2 mm voxels at the origin.
  EXPECT_EQ(result.cores[0].core.core.positions[0], (std::array<double, 3>{ 4, 6, 8 }));
  EXPECT_EQ(result.shape.topology, result.cores[1].numbers.complex.topology);
}

TEST(Certified, RandomShapesPassInEveryWay)
{
  const std::uint64_t seed = std::random_device{}();
  RecordProperty("seed", std::to_string(seed));
  std::cout << "seed " << seed << "\n";
  std::mt19937_64 random(seed);
  for (int round = 0; round < 40; ++round)
  {
    const auto                       side = static_cast<std::int32_t>(3 + random() % 7);
    std::uniform_real_distribution<> uniform(0, 1);
    const double                     density = uniform(random);
    VoxelShape                       shape(VoxelBox{ { 5, 0, 1 }, { side, side, side } });
    for (std::int32_t v = 0; v < side * side * side; ++v)
    {
      if (v == 0 || uniform(random) < density)
      {
        shape.Insert(5 + v % side, v / side % side, 1 + v / side / side);
      }
    }
    const ImageGeometry grid = Grid({ 3, 3, 7 });
    CertifiedRequest    request = Lambdas({ "0", "1vox", "2vox", "50%" });
    request.skeleton = Skeleton();
    const CertifiedResult result = ComputeCertified(shape, grid, request);
    EXPECT_EQ(result.cores[0].numbers.complex.faces, result.whole.faces);
    EXPECT_LE(result.cores[2].numbers.complex.faces, result.cores[1].numbers.complex.faces);
    EXPECT_EQ(result.skeleton->topology, result.shape.topology);
    request = Lambdas({ "0" });
    request.tolerances = { ParseTolerance("1.2diag") };
    EXPECT_EQ(ComputeCertified(shape, grid, request).covered, true);
    request.surface = SurfaceSource();
    EXPECT_EQ(ComputeCertified(shape, grid, request).covered, true);
    request = Lambdas({ "1.5vox" });
    request.surface = [&](const VoxelShape & voxels, const ProgressCallback & progress) {
      return std::shared_ptr<const SurfaceEstimate>(SurfaceFromLabels(voxels, grid.spacing, progress));
    };
    EXPECT_LE(ComputeCertified(shape, grid, request).cores[0].numbers.refined->maxDisplacement, 1);
  }
}

TEST(Certified, ARequestThatSaysNothingIsPrunedAtTheUsualToleranceAndRefinedFromLabels)
{
  CertifiedRequest said;
  said.lambdas = { ParseLambda("0") };
  said.tolerances = { ParseTolerance(kUsualTolerance) };
  said.surface = [](const VoxelShape & voxels, const ProgressCallback & progress) {
    return std::shared_ptr<const SurfaceEstimate>(SurfaceFromLabels(voxels, { 1, 1, 2 }, progress));
  };
  const CertifiedResult asked = ComputeCertified(Box(9, 8, 7), Grid({ 1, 1, 2 }), said);
  const CertifiedResult silent = ComputeCertified(Box(9, 8, 7), Grid({ 1, 1, 2 }), {});
  ASSERT_EQ(silent.cores.size(), 1U);
  EXPECT_EQ(silent.cores[0].numbers.tolerance->height, kUsualTolerance);
  EXPECT_EQ(silent.cores[0].core.core.positions, asked.cores[0].core.core.positions);
  EXPECT_EQ(silent.cores[0].core.core.cells.faceVertices, asked.cores[0].core.core.cells.faceVertices);
  EXPECT_TRUE(silent.covered.value_or(false));
  EXPECT_GT(silent.cores[0].numbers.refined->maxDisplacement, 0);
  // A box along the grid may be a voxel thicker and thinner.
  EXPECT_EQ(silent.cores[0].core.radiusMargin.size(), silent.cores[0].core.core.positions.size());
  EXPECT_GT(silent.cores[0].numbers.refined->radiusMargin.value().max, 0.4);
}

TEST(Certified, WhatWasPrunedByLambdaFirstIsPromisedNothing)
{
  for (const double spacing : { 1.0, 0.01 })
  {
    CertifiedRequest request = Lambdas({ "3vox" });
    request.tolerances = { ParseTolerance("0.1diag") };
    request.surface = SurfaceSource();
    const CertifiedResult result = ComputeCertified(Box(14, 11, 8), Grid({ spacing, spacing, spacing }), request);
    const auto &          tolerance = *result.cores[0].numbers.tolerance;
    EXPECT_FALSE(result.covered.has_value());
    EXPECT_GT(tolerance.boundaryGapMm.value(), tolerance.heightMm);
    // A whole core is, however small its voxels are.
    request.lambdas = { ParseLambda("0") };
    EXPECT_TRUE(ComputeCertified(Box(14, 11, 8), Grid({ spacing, spacing, spacing }), request).covered.value_or(false));
  }
}

TEST(Certified, TheMarginOfACoreWithoutFacesIsANumber)
{
  const CertifiedResult result = ComputeCertified(Box(1, 1, 1), Grid({ 1, 1, 1 }), {});
  ASSERT_EQ(result.cores[0].core.core.cells.FaceCount(), 0U);
  ASSERT_TRUE(result.cores[0].numbers.refined.has_value());
  EXPECT_EQ(result.cores[0].numbers.refined->radiusMargin.value().mean, 0);
}

TEST(Certified, WhatIsAskedForByLambdaOrToBePrunedOnStaysExact)
{
  CertifiedRequest lambda = Lambdas({ "1.5vox" });
  CertifiedRequest whole;
  whole.tolerances = { ParseTolerance("0"), ParseTolerance("1diag") };
  CertifiedRequest exact;
  exact.surface = SurfaceSource();
  for (const CertifiedRequest & request : { lambda, whole, exact })
  {
    for (const CertifiedCore & core : ComputeCertified(Box(9, 8, 7), Grid({ 1, 1, 2 }), request).cores)
    {
      EXPECT_FALSE(core.numbers.refined.has_value());
      EXPECT_TRUE(core.core.displacement.empty());
    }
  }
}

TEST(Certified, ARequestThatContradictsItselfIsRefused)
{
  CertifiedRequest two = Lambdas({ "0", "1vox" });
  two.tolerances = { ParseTolerance("1diag") };
  EXPECT_THROW(ComputeCertified(Box(2, 2, 2), Grid({ 1, 1, 1 }), two), UsageError);
  CertifiedRequest other = Lambdas({ "1vox" });
  other.skeleton = Skeleton();
  other.skeleton->lambda = ParseLambda("2vox");
  EXPECT_THROW(ComputeCertified(Box(2, 2, 2), Grid({ 1, 1, 1 }), other), UsageError);
}

} // namespace
} // namespace voxelcore
