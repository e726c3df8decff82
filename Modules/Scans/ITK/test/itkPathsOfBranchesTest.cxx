// The curve of a rod along y, in an image that starts at an index of its own, turned, with unequal spacings.

#include "itkLabelImageToVoxelShapeFilter.h"
#include "itkMedialComplexToMeshFilter.h"
#include "itkTestingMacros.h"

#include "voxelcore/Certified/Certified.h"

#include <array>
#include <cmath>

int
itkPathsOfBranchesTest(int, char *[])
{
  using ImageType = itk::Image<unsigned char, 3>;
  auto                 image = ImageType::New();
  ImageType::IndexType start{ { -4, 10, 5 } };
  image->SetRegions(ImageType::RegionType(start, { { 15, 60, 11 } }));
  image->SetSpacing(std::array{ 0.5, 0.75, 0.6 }.data());
  image->SetOrigin(std::array{ -12.0, 30.5, 7.25 }.data());
  ImageType::DirectionType turned;
  turned.Fill(0);
  turned(0, 1) = turned(1, 2) = turned(2, 0) = 1;
  image->SetDirection(turned);
  image->Allocate(true);
  const auto inRod = [](const ImageType::IndexType & at) {
    return std::hypot(0.5 * static_cast<double>(at[0] - 3), 0.6 * static_cast<double>(at[2] - 10)) < 2.3 &&
           at[1] > 13 && at[1] < 66;
  };
  for (itk::OffsetValueType n = 0; n < 15 * 60 * 11; ++n)
  {
    const auto at = image->ComputeIndex(n);
    image->SetPixel(at, inRod(at) ? 1 : 0);
  }

  auto shapes = itk::LabelImageToVoxelShapeFilter<ImageType>::New();
  shapes->SetInput(image);
  ITK_TRY_EXPECT_NO_EXCEPTION(shapes->Update());
  voxelcore::CertifiedRequest request;
  request.lambdas = { voxelcore::Lambda() };
  request.skeleton.emplace().standOut = voxelcore::ParseLambda("3vox");
  const auto & label = shapes->GetOutput()->GetLabel(1);
  const auto   result = voxelcore::ComputeCertified(label.shape, shapes->GetOutput()->GetGeometry(), request);
  const auto & graph = result.skeleton->skeleton.graph;
  const auto   paths = itk::PathsOfBranches(graph, *shapes->GetOutput());

  ITK_TEST_EXPECT_EQUAL(paths.size(), 1U);
  const auto & path = *paths.front();
  ITK_TEST_EXPECT_EQUAL(path.EndOfInput() + 1, static_cast<double>(graph.Branch(0).size()));
  for (double at = path.StartOfInput(); at <= path.EndOfInput(); ++at)
  {
    const auto point = image->TransformContinuousIndexToPhysicalPoint<double>(path.Evaluate(at));
    const auto place = graph.positions[graph.Branch(0)[static_cast<std::size_t>(at)]];
    ITK_TEST_EXPECT_TRUE(point.EuclideanDistanceTo(itk::Point<double, 3>(place.data())) < 1e-9);
    ITK_TEST_EXPECT_EQUAL(static_cast<int>(image->GetPixel(path.EvaluateToIndex(at))), 1);
  }
  // From end to end, but for the rod's radius.
  const double along = std::abs(path.Evaluate(path.EndOfInput())[1] - path.Evaluate(path.StartOfInput())[1]);
  ITK_TEST_EXPECT_TRUE(along > 52 - 2 * 2.3 / 0.75 && along <= 52);
  return EXIT_SUCCESS;
}
