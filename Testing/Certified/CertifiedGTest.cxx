#include "voxelcore/Certified.h"

#include "RefinedResults.h"
#include "voxelcore/Error.h"
#include "voxelcore/Refinement.h"

#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <random>

namespace voxelcore
{
namespace
{

VoxelShape
Box(std::int32_t x, std::int32_t y, std::int32_t z)
{
  VoxelShape shape(VoxelBox{ { 2, 3, 4 }, { x, y, z } });
  for (std::int32_t k = 0; k < z; ++k)
  {
    for (std::int32_t j = 0; j < y; ++j)
    {
      for (std::int32_t i = 0; i < x; ++i)
      {
        shape.Insert(2 + i, 3 + j, 4 + k);
      }
    }
  }
  return shape;
}

ImageGeometry
Grid(const Vector3 & spacing)
{
  ImageGeometry geometry;
  geometry.size = { 40, 40, 40 };
  geometry.spacing = spacing;
  return geometry;
}

CertifiedRequest
Lambdas(const std::vector<std::string> & texts)
{
  CertifiedRequest request;
  request.lambdas.clear();
  for (const std::string & text : texts)
  {
    request.lambdas.push_back(ParseLambda(text));
  }
  return request;
}

SkeletonRequest
Skeleton()
{
  SkeletonRequest request;
  request.standOut = ParseLambda("3vox");
  request.smooth = ParseLambda("6vox");
  return request;
}

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

TEST(Certified, SeveralLambdasAndPruningLaterGiveWhatEachGivesAlone)
{
  const ImageGeometry            grid = Grid({ 1, 1, 2 });
  const std::vector<std::string> texts{ "2mm", "0", "1.5vox", "1.5mm", "100mm" };
  const CertifiedResult          together = ComputeCertified(Box(9, 7, 5), grid, Lambdas(texts));
  const CertifiedResult          whole = ComputeCertified(Box(9, 7, 5), grid, Lambdas({ "0" }));
  for (std::size_t i = 0; i < texts.size(); ++i)
  {
    const CertifiedResult alone = ComputeCertified(Box(9, 7, 5), grid, Lambdas({ texts[i] }));
    const auto            later = PruneCertified(whole.cores[0], whole.shape, { ParseLambda(texts[i]) });
    for (const CertifiedCore & other : { alone.cores[0], later[0] })
    {
      EXPECT_EQ(other.core.core.positions, together.cores[i].core.core.positions) << texts[i];
      EXPECT_EQ(other.core.core.cells.faceVertices, together.cores[i].core.core.cells.faceVertices) << texts[i];
      EXPECT_EQ(other.numbers.lambdaMm, together.cores[i].numbers.lambdaMm) << texts[i];
      EXPECT_EQ(other.numbers.complex.areaMm2, together.cores[i].numbers.complex.areaMm2) << texts[i];
    }
  }
  EXPECT_EQ(together.cores[4].numbers.complex.vertices, 1U) << "all of a box prunes to a point";
}

TEST(Certified, PruningLaterByToleranceGivesWhatAskingForItGives)
{
  const ImageGeometry grid = Grid({ 1, 1, 1.5 });
  CertifiedRequest    request = Lambdas({ "0" });
  request.tolerances = { ParseTolerance("0") };
  const CertifiedResult whole = ComputeCertified(Box(12, 9, 7), grid, request);
  EXPECT_EQ(whole.covered, true);
  request.tolerances = { ParseTolerance("1diag") };
  const CertifiedResult asked = ComputeCertified(Box(12, 9, 7), grid, request);
  const auto            later = PruneCertified(whole.cores[0], whole.shape, request.tolerances);
  EXPECT_EQ(later[0].core.core.positions, asked.cores[0].core.core.positions);
  EXPECT_EQ(later[0].core.core.tolerances.faces, asked.cores[0].core.core.tolerances.faces);
  EXPECT_TRUE(asked.cores[0].numbers.tolerance->boundaryGapMm.has_value());
  EXPECT_THROW(PruneCertified(asked.cores[0], asked.shape, { ParseTolerance("0.5diag") }), UsageError);
  EXPECT_THROW(PruneCertified(asked.cores[0], asked.shape, { ParseLambda("2vox") }), UsageError);
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
    request = Lambdas({ "1.5vox" });
    request.surface = [&](const VoxelShape & voxels, const ProgressCallback & progress) {
      return std::shared_ptr<const SurfaceEstimate>(SurfaceFromLabels(voxels, grid.spacing, progress));
    };
    EXPECT_LE(ComputeCertified(shape, grid, request).cores[0].numbers.refined->maxDisplacement, 1);
  }
}

TEST(Certified, ARequestThatContradictsItselfIsRefused)
{
  EXPECT_THROW(ComputeCertified(Box(2, 2, 2), Grid({ 1, 1, 1 }), Lambdas({})), UsageError);
  CertifiedRequest two = Lambdas({ "0", "1vox" });
  two.tolerances = { ParseTolerance("1diag") };
  EXPECT_THROW(ComputeCertified(Box(2, 2, 2), Grid({ 1, 1, 1 }), two), UsageError);
  CertifiedRequest other = Lambdas({ "1vox" });
  other.skeleton = Skeleton();
  other.skeleton->lambda = ParseLambda("2vox");
  EXPECT_THROW(ComputeCertified(Box(2, 2, 2), Grid({ 1, 1, 1 }), other), UsageError);
}

TEST(Certified, AVertexOnTheBoundaryOrOutsideIsSeen)
{
  const VoxelShape shape = Box(2, 1, 1); // [2,4] x [3,4] x [4,5]
  MedialComplex    core;
  const auto       at = [&](double x, double y, double z) {
    core.positions = { { x, y, z } };
    return IsEnclosed(core, shape);
  };
  EXPECT_TRUE(at(2.5, 3.5, 4.5));
  EXPECT_TRUE(at(3, 3.5, 4.5)) << "on the inner face";
  EXPECT_FALSE(at(2, 3.5, 4.5)) << "on an outer face";
  EXPECT_FALSE(at(3, 3, 4.5)) << "on an outer edge";
  EXPECT_FALSE(at(4, 4, 5)) << "on a corner";
  EXPECT_FALSE(at(1.5, 3.5, 4.5)) << "outside";
  EXPECT_FALSE(at(2.5, -3.5, 4.5)) << "outside";
}

} // namespace
} // namespace voxelcore
