// Linked with SeededFault.cxx: whatever a lower room gets wrong, there is no result.

#include "voxelcore/Base/Error.h"
#include "voxelcore/Certified/Certified.h"
#include "voxelcore/Complex/ComplexTopology.h"
#include "voxelcore/Shape/ShapeTopology.h"
#include "voxelcore/Verification/Enclosure.h"
#include "voxelcore/Verification/OctantScan.h"

#include <array>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

struct Stage
{
  const char *     fault;
  const char *     complex; ///< as the message names it
  CertifiedRequest request;
};

/** A plate with a rod on it: faces, lines and a skeleton of several branches. */
VoxelShape
PlateWithARod()
{
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 20, 20, 16 } });
  for (std::int32_t k = 0; k < 16; ++k)
  {
    for (std::int32_t j = 0; j < 20; ++j)
    {
      for (std::int32_t i = 0; i < 20; ++i)
      {
        if (k < 4 || (std::abs(i - 9) < 3 && std::abs(j - 9) < 3))
        {
          shape.Insert(i, j, k);
        }
      }
    }
  }
  return shape;
}

std::vector<Stage>
Stages()
{
  CertifiedRequest plain;
  plain.lambdas = { ParseLambda("1.5vox") };
  CertifiedRequest tolerance;
  tolerance.lambdas = { ParseLambda("0") };
  tolerance.tolerances = { ParseTolerance("1.2diag") };
  tolerance.surface = SurfaceSource();
  CertifiedRequest refined = plain;
  refined.surface = [](const VoxelShape & voxels, const ProgressCallback & progress) {
    return std::shared_ptr<const SurfaceEstimate>(SurfaceFromLabels(voxels, { 1, 1, 1 }, progress));
  };
  CertifiedRequest both = tolerance;
  both.surface = refined.surface;
  CertifiedRequest skeleton;
  skeleton.skeleton.emplace();
  skeleton.skeleton->standOut = ParseLambda("3vox");
  skeleton.skeleton->smooth = ParseLambda("6vox");
  CertifiedRequest curves = skeleton;
  curves.surface = refined.surface;
  curves.refineCores = false;
  curves.skeleton->refined = true;
  return { { "core", "its core", plain },
           { "pruning", "its core pruned at 1.5vox", plain },
           { "tolerance", "its core pruned at tolerance 1.2diag", tolerance },
           { "refinement", "its core refined at 1.5vox", refined },
           { "refinement", "its core refined at 1.2diag", both },
           { "skeleton", "its skeleton", skeleton },
           { "skeleton", "its skeleton", curves },
           { "refinement", "its refined skeleton", curves } };
}

TEST(SeededFaults, AreRefusedAtEveryStage)
{
  ImageGeometry geometry;
  geometry.size = { 20, 20, 16 };
  for (const Stage & stage : Stages())
  {
    unsetenv("VOXELCORE_SEEDED_FAULT");
    EXPECT_NO_THROW(ComputeCertified(PlateWithARod(), geometry, stage.request)) << stage.fault;
    setenv("VOXELCORE_SEEDED_FAULT", stage.fault, 1);
    try
    {
      ComputeCertified(PlateWithARod(), geometry, stage.request);
      ADD_FAILURE() << "a fault in the " << stage.fault << " went through";
    }
    catch (const CertificateError & error)
    {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("certificate failed")) << stage.fault;
      EXPECT_THAT(error.what(), ::testing::HasSubstr(std::string(stage.complex) + " has")) << stage.fault;
    }
  }
  unsetenv("VOXELCORE_SEEDED_FAULT");
}

/** A bar with an arm that is longer than the bar is wide. */
VoxelShape
BarWithAnArm()
{
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 40, 6, 26 } });
  for (std::int32_t k = 0; k < 26; ++k)
  {
    for (std::int32_t j = 0; j < 6; ++j)
    {
      for (std::int32_t i = 0; i < 40; ++i)
      {
        if (k < 6 || (i >= 17 && i < 23))
        {
          shape.Insert(i, j, k);
        }
      }
    }
  }
  return shape;
}

TEST(SeededFaults, InTheChoiceOfBranchesAreRefused)
{
  ImageGeometry geometry;
  geometry.size = { 40, 6, 26 };
  CertifiedRequest request;
  request.lambdas = { ParseLambda("0") };
  request.skeleton.emplace();
  request.skeleton->standOut = ParseLambda("3vox");
  request.skeleton->smooth = ParseLambda("6vox");
  unsetenv("VOXELCORE_SEEDED_FAULT");
  EXPECT_EQ(ComputeCertified(BarWithAnArm(), geometry, request).skeleton->standOut, true);
  setenv("VOXELCORE_SEEDED_FAULT", "branches", 1);
  EXPECT_THROW(ComputeCertified(BarWithAnArm(), geometry, request), CertificateError);
  unsetenv("VOXELCORE_SEEDED_FAULT");
}

TEST(SeededFaults, AreRefusedWhereACoreIsPrunedOnRefinedOrNot)
{
  ImageGeometry geometry;
  geometry.size = { 20, 20, 16 };
  CertifiedRequest request;
  request.lambdas = { ParseLambda("0") };
  request.tolerances = { ParseTolerance("0") };
  for (const bool refined : { false, true })
  {
    if (refined)
    {
      request.surface = [](const VoxelShape & voxels, const ProgressCallback & progress) {
        return std::shared_ptr<const SurfaceEstimate>(SurfaceFromLabels(voxels, { 1, 1, 1 }, progress));
      };
    }
    unsetenv("VOXELCORE_SEEDED_FAULT");
    const CertifiedResult whole = ComputeCertified(PlateWithARod(), geometry, request);
    const auto            byLambda = [&] { PruneCertified(whole.cores[0], whole.shape, { ParseLambda("1.5vox") }); };
    const auto byTolerance = [&] { PruneCertified(whole.cores[0], whole.shape, { ParseTolerance("1diag") }); };
    EXPECT_NO_THROW(byLambda());
    EXPECT_NO_THROW(byTolerance());
    setenv("VOXELCORE_SEEDED_FAULT", "pruning", 1);
    EXPECT_THROW(byLambda(), CertificateError) << refined;
    setenv("VOXELCORE_SEEDED_FAULT", "tolerance", 1);
    EXPECT_THROW(byTolerance(), CertificateError) << refined;
  }
  unsetenv("VOXELCORE_SEEDED_FAULT");
}

TEST(SeededFaults, InSharedWaysOfWorkingAreSeenByThoseWhoCheck)
{
  unsetenv("VOXELCORE_SEEDED_FAULT");
  const VoxelShape                         shape = PlateWithARod();
  const std::vector<std::array<double, 3>> places{ { 3.5, 4.5, 1.5 }, { 9.5, 9.5, 9.5 } };
  CellComplex                              edge;
  edge.vertexCount = 2;
  edge.edges = { { 0, 1 } };
  ASSERT_TRUE(LieInside(shape, places));
  ASSERT_NO_THROW(ScanOctants(shape));
  ASSERT_EQ(ComputeShapeTopology(shape), ComputeComplexTopology(edge)); // either is one piece without a hole
  setenv("VOXELCORE_SEEDED_FAULT", "parts", 1);
  EXPECT_FALSE(LieInside(shape, places));
  setenv("VOXELCORE_SEEDED_FAULT", "each", 1);
  EXPECT_THROW(ScanOctants(shape), CertificateError);
  setenv("VOXELCORE_SEEDED_FAULT", "both", 1);
  EXPECT_FALSE(ComputeShapeTopology(shape) == ComputeComplexTopology(edge));
  unsetenv("VOXELCORE_SEEDED_FAULT");
}

} // namespace
} // namespace voxelcore
