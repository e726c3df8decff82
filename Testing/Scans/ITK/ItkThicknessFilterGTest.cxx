#include "ItkPipelineFixtures.h"
#include "VoxelCoreTesting/Threads.h"

#include "itkLabelImageToVoxelShapeFilter.h"
#include "itkLocalThicknessImageFilter.h"

#include "voxelcore/Certified/Certified.h"

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

using MapType = itk::LocalThicknessImageFilter::OutputImageType;

itk::LocalThicknessImageFilter::Pointer
FilterOf(const itk::VoxelShapeObject * shapes)
{
  auto filter = itk::LocalThicknessImageFilter::New();
  filter->SetInput(shapes);
  return filter;
}

/** The value at a voxel counted from the first. */
float
At(const MapType & map, std::int32_t x, std::int32_t y, std::int32_t z)
{
  const auto first = map.GetLargestPossibleRegion().GetIndex();
  return map.GetPixel({ { first[0] + x, first[1] + y, first[2] + z } });
}

} // namespace

TEST(ItkThicknessFilter, HasTheMapOfARequestForEachLabelAndZeroOutside)
{
  auto shapes = TwoShapes();
  auto labels = shapes->GetLabels();
  // Where both are, the second would write over the first.
  for (const bool refine : { true, false })
  {
    for (const LabelShape & label : labels)
    {
      SCOPED_TRACE(label.value);
      shapes->SetLabels({ label });
      auto filter = FilterOf(shapes);
      filter->SetRefine(refine);
      filter->SetTolerance("1diag");
      filter->Update();
      CertifiedRequest request;
      request.lambdas = { Lambda() };
      request.tolerances = { ParseTolerance("1diag") };
      if (!refine)
      {
        request.surface = SurfaceSource();
      }
      request.thickness = ThicknessRequest{};
      const CertifiedResult asked = ComputeCertified(label.shape, shapes->GetGeometry(), request);
      const VoxelRanks      ranks(label.shape);
      std::uint64_t         in = 0;
      for (std::int32_t z = 0; z < 24; ++z)
      {
        for (std::int32_t y = 0; y < 24; ++y)
        {
          for (std::int32_t x = 0; x < 24; ++x)
          {
            const bool isIn = label.shape.Contains(x, y, z);
            in += isIn ? 1 : 0;
            ASSERT_EQ(At(*filter->GetOutput(), x, y, z), isIn ? asked.thickness->map.values[ranks.At(x, y, z)] : 0.0F);
          }
        }
      }
      EXPECT_EQ(in, label.voxels);
    }
  }
}

TEST(ItkThicknessFilter, ThereAndBackTheGridIsTheImages)
{
  using ImageType = itk::Image<std::uint8_t, 3>;
  Placement placement;
  placement.start = { { 7, -3, 2 } };
  placement.spacing = { 0.5, 0.75, 2 };
  placement.origin = { 10, -20, 30 };
  placement.direction = { 0, -1, 0, 1, 0, 0, 0, 0, 1 };
  const auto inside = [](int x, int y, int z) { return x > 2 && x < 57 && y > 1 && y < 39 && z > 0 && z < 4 ? 1 : 0; };
  const auto image = MakeImage<std::uint8_t>({ { 60, 41, 6 } }, inside, placement);
  auto       shapes = itk::LabelImageToVoxelShapeFilter<ImageType>::New();
  shapes->SetInput(image);
  auto          filter = FilterOf(shapes->GetOutput());
  const Watcher watcher(filter);
  filter->Update();
  watcher.ExpectMonotoneFrom0To1();
  const MapType & map = *filter->GetOutput();
  EXPECT_EQ(map.GetLargestPossibleRegion(), image->GetLargestPossibleRegion());
  EXPECT_EQ(map.GetSpacing(), image->GetSpacing());
  EXPECT_EQ(map.GetDirection(), image->GetDirection());
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(map.GetOrigin()[axis], image->GetOrigin()[axis], 1e-12);
  }
  for (int z = 0; z < 6; ++z)
  {
    for (int x = 0; x < 60; ++x)
    {
      EXPECT_EQ(At(map, x, 20, z) > 0, inside(x, 20, z) == 1);
    }
  }
  EXPECT_NEAR(At(map, 30, 20, 2), 6, 0.25); // three slices
}

TEST(ItkThicknessFilter, RunsAgainOnlyWhenSomethingChanged)
{
  auto          filter = FilterOf(TwoShapes());
  const Watcher watcher(filter);
  filter->Update();
  filter->Update();
  EXPECT_EQ(watcher.starts, 1);
  filter->SetTolerance("1.2diag");
  filter->RefineOn();
  filter->Update();
  EXPECT_EQ(watcher.starts, 1);
  filter->RefineOff();
  filter->Update();
  EXPECT_EQ(watcher.starts, 2);
}

TEST(ItkThicknessFilter, IsTheSameForEveryNumberOfThreads)
{
  const auto mapOf = [](unsigned threads) {
    auto filter = FilterOf(TwoShapes());
    filter->GetMultiThreader()->SetMaximumNumberOfThreads(threads);
    filter->SetNumberOfWorkUnits(threads);
    filter->Update();
    const float * first = filter->GetOutput()->GetBufferPointer();
    return std::vector<float>(first, first + 24 * 24 * 24);
  };
  EXPECT_EQ(mapOf(1), mapOf(4));
}

TEST(ItkThicknessFilter, StopsWhenAskedAndRefusesInOneLine)
{
  auto    filter = FilterOf(TwoShapes());
  Watcher watcher(filter);
  watcher.abortAt = 0.3F;
  EXPECT_THROW(filter->Update(), itk::ProcessAborted);
  watcher.abortAt = -1;
  filter->AbortGenerateDataOff();
  filter->Update();
  EXPECT_GT(At(*filter->GetOutput(), 12, 12, 12), 0);

  EXPECT_FALSE(ThrownBy([&] { filter->SetTolerance("wide"); }).empty());
  EXPECT_EQ(filter->GetTolerance(), kUsualTolerance);
  EXPECT_THROW(itk::LocalThicknessImageFilter::New()->Update(), itk::ExceptionObject); // no input
  EXPECT_NE(Printed(*filter).find("Tolerance: 1.2diag"), std::string::npos);
}

TEST(ItkThicknessFilter, RefusesShapesBeyondTheirImage)
{
  const auto    shapes = TwoShapes();
  ImageGeometry smaller = shapes->GetGeometry();
  smaller.size = { 5, 5, 5 }; // set after the labels, which do not lie in it
  shapes->SetGeometry(smaller);
  const auto filter = FilterOf(shapes);
  EXPECT_NE(ThrownBy([&] { filter->Update(); }).find("reaches beyond the image"), std::string::npos);
}
