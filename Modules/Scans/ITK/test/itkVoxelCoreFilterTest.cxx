// A pipeline from labels to surfaces, meshes and thickness: a brick of 9 x 15 x 21 voxels of 1 x 1 x 1 mm.

#include "itkImageRegionIterator.h"
#include "itkLabelImageToVoxelShapeFilter.h"
#include "itkLambdaPruningFilter.h"
#include "itkLocalThicknessImageFilter.h"
#include "itkMedialComplexToMeshFilter.h"
#include "itkTestingMacros.h"
#include "itkVoxelCoreFilter.h"

int
itkVoxelCoreFilterTest(int, char *[])
{
  using ImageType = itk::Image<unsigned char, 3>;
  auto                        image = ImageType::New();
  const ImageType::RegionType brick({ { 2, 3, 4 } }, { { 9, 15, 21 } });
  image->SetRegions(ImageType::RegionType({ { 0, 0, 0 } }, { { 13, 21, 29 } }));
  image->Allocate(true);
  for (itk::ImageRegionIterator<ImageType> pixel(image, brick); !pixel.IsAtEnd(); ++pixel)
  {
    pixel.Set(7);
  }

  auto shapes = itk::LabelImageToVoxelShapeFilter<ImageType>::New();
  ITK_EXERCISE_BASIC_OBJECT_METHODS(shapes, LabelImageToVoxelShapeFilter, ImageSink);
  shapes->SetInput(image);
  auto core = itk::VoxelCoreFilter::New();
  ITK_EXERCISE_BASIC_OBJECT_METHODS(core, VoxelCoreFilter, MedialComplexSource);
  ITK_TEST_SET_GET_BOOLEAN(core, Refine, true);
  ITK_TRY_EXPECT_EXCEPTION(core->SetTolerance("wide"));
  ITK_TRY_EXPECT_EXCEPTION(core->Update()); // it has no input
  core->SetInput(shapes->GetOutput());
  ITK_TRY_EXPECT_NO_EXCEPTION(core->Update());
  ITK_TEST_EXPECT_EQUAL(core->GetOutput()->GetParts().size(), 1U);
  const auto & part = core->GetOutput()->GetPart(7);
  ITK_TEST_EXPECT_EQUAL(part.origin.voxels, brick.GetNumberOfPixels());
  ITK_TEST_EXPECT_EQUAL(part.origin.shape.euler, 1);
  ITK_TEST_EXPECT_TRUE(part.core->numbers.complex.topology == part.origin.shape);
  ITK_TRY_EXPECT_EXCEPTION(core->GetOutput()->GetPart(8));

  core->WholeCoreOn();
  auto pruned = itk::LambdaPruningFilter::New();
  ITK_EXERCISE_BASIC_OBJECT_METHODS(pruned, LambdaPruningFilter, MedialComplexSource);
  pruned->SetInput(core->GetOutput());
  pruned->SetLambda("4vox");
  auto mesh = itk::MedialComplexToMeshFilter<>::New();
  ITK_EXERCISE_BASIC_OBJECT_METHODS(mesh, MedialComplexToMeshFilter, MeshSource);
  mesh->SetInput(pruned->GetOutput());
  ITK_TRY_EXPECT_NO_EXCEPTION(mesh->Update());
  ITK_TEST_EXPECT_TRUE(mesh->GetOutput()->GetNumberOfCells() > 0);
  ITK_TEST_EXPECT_TRUE(pruned->GetOutput()->GetPart(7).core->numbers.complex.faces <
                       core->GetOutput()->GetPart(7).core->numbers.complex.faces);
  for (itk::SizeValueType point = 0; point < mesh->GetOutput()->GetNumberOfPoints(); ++point)
  {
    ImageType::IndexType index;
    ITK_TEST_EXPECT_TRUE(image->TransformPhysicalPointToIndex(mesh->GetOutput()->GetPoint(point), index));
    ITK_TEST_EXPECT_TRUE(brick.IsInside(index));
  }

  auto thickness = itk::LocalThicknessImageFilter::New();
  ITK_EXERCISE_BASIC_OBJECT_METHODS(thickness, LocalThicknessImageFilter, ImageSource);
  thickness->SetInput(shapes->GetOutput());
  thickness->SetRefine(false);
  ITK_TRY_EXPECT_NO_EXCEPTION(thickness->Update());
  // The largest ball in the middle of the brick is as thick as the brick.
  ITK_TEST_EXPECT_EQUAL(thickness->GetOutput()->GetPixel({ { 6, 10, 14 } }), 9.0F);
  ITK_TEST_EXPECT_EQUAL(thickness->GetOutput()->GetPixel({ { 0, 0, 0 } }), 0.0F);
  return EXIT_SUCCESS;
}
