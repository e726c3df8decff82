// What ITK writes is read with the same voxels in the same place; what a pixel type cannot hold is refused.

#include "itkImageFileWriter.h"
#include "itkImageRegionConstIterator.h"
#include "itkLabelScanReader.h"
#include "itkTestingMacros.h"

#include <array>

int
itkLabelScanReaderTest(int argc, char * argv[])
{
  if (argc != 2)
  {
    std::cerr << "usage: " << itkNameOfTestExecutableMacro(argv) << " SCAN" << std::endl;
    return EXIT_FAILURE;
  }
  using ImageType = itk::Image<unsigned short, 3>;
  auto image = ImageType::New();
  image->SetRegions(ImageType::SizeType{ { 7, 6, 5 } });
  image->SetSpacing(std::array{ 0.5, 0.75, 2.0 }.data());
  image->SetOrigin(std::array{ -12.0, 30.5, 7.25 }.data());
  image->Allocate();
  for (itk::OffsetValueType n = 0; n < 7 * 6 * 5; ++n)
  {
    image->SetPixel(image->ComputeIndex(n), static_cast<unsigned short>(3 * n));
  }
  ITK_TRY_EXPECT_NO_EXCEPTION(itk::WriteImage(image, argv[1]));

  auto reader = itk::LabelScanReader<ImageType>::New();
  ITK_EXERCISE_BASIC_OBJECT_METHODS(reader, LabelScanReader, ImageSource);
  reader->SetFileName(argv[1]);
  ITK_TRY_EXPECT_NO_EXCEPTION(reader->Update());
  ITK_TEST_EXPECT_EQUAL(reader->GetOutput()->GetSpacing(), image->GetSpacing());
  ITK_TEST_EXPECT_EQUAL(reader->GetOutput()->GetOrigin(), image->GetOrigin());
  ITK_TEST_EXPECT_EQUAL(reader->GetOutput()->GetDirection(), image->GetDirection());
  itk::ImageRegionConstIterator<ImageType> read(reader->GetOutput(), image->GetLargestPossibleRegion());
  for (; !read.IsAtEnd(); ++read)
  {
    ITK_TEST_EXPECT_EQUAL(read.Get(), image->GetPixel(read.GetIndex()));
  }
  auto narrow = itk::LabelScanReader<itk::Image<unsigned char, 3>>::New();
  narrow->SetFileName(argv[1]);
  ITK_TRY_EXPECT_EXCEPTION(narrow->Update());
  return EXIT_SUCCESS;
}
