#pragma once
// Images and watchers for tests of the ITK filters.

#include "itkImage.h"
#include "itkImageSource.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace voxelcore::testing
{

using ImageIndex = itk::Index<3>;
using ImageRegion = itk::ImageRegion<3>;

/** Places an image somewhere: what a test does not set is index 0, 1 mm, no turn. */
struct Placement
{
  ImageIndex            start{ { 0, 0, 0 } };
  std::array<double, 3> spacing{ 1, 1, 1 };
  std::array<double, 3> origin{ 0, 0, 0 };
  std::array<double, 9> direction{ 1, 0, 0, 0, 1, 0, 0, 0, 1 };
};

template <typename TImage>
void
Place(TImage & image, const Placement & placement)
{
  typename TImage::DirectionType direction;
  for (unsigned row = 0; row < 3; ++row)
  {
    for (unsigned axis = 0; axis < 3; ++axis)
    {
      direction(row, axis) = placement.direction[3 * row + axis];
    }
  }
  image.SetSpacing(placement.spacing.data());
  image.SetOrigin(placement.origin.data());
  image.SetDirection(direction);
}

/** The value of a voxel counted from the first. */
using VoxelFunction = std::function<double(int x, int y, int z)>;

/** An image made on request, region by region; it writes down which regions. */
template <typename TImage>
class SpySource : public itk::ImageSource<TImage>
{
public:
  using Self = SpySource;
  using Superclass = itk::ImageSource<TImage>;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);
  itkTypeMacro(SpySource, ImageSource);

  itk::Size<3>             size{ { 1, 1, 1 } };
  Placement                placement;
  VoxelFunction            value;
  bool                     allAtOnce = false; ///< makes the whole image whatever is asked for
  int                      failAt = -1;       ///< throws at this request
  bool                     failInformation = false;
  bool                     failEnlarging = false;
  bool                     oneSliceLess = false; ///< makes less than it was asked for
  std::vector<ImageRegion> regions;              ///< as they were made
  std::size_t              mostPixels = 0;       ///< in the buffer at any time

protected:
  void
  GenerateOutputInformation() override
  {
    if (failInformation)
    {
      itkExceptionMacro("the source has no information");
    }
    TImage * image = this->GetOutput();
    image->SetLargestPossibleRegion(ImageRegion(placement.start, size));
    Place(*image, placement);
  }
  void
  EnlargeOutputRequestedRegion(itk::DataObject * output) override
  {
    if (failEnlarging)
    {
      itkExceptionMacro("the source has no more");
    }
    if (allAtOnce)
    {
      output->SetRequestedRegionToLargestPossibleRegion();
    }
  }
  void
  GenerateData() override
  {
    if (failAt == static_cast<int>(regions.size()))
    {
      itkExceptionMacro("the source failed");
    }
    TImage *    image = this->GetOutput();
    ImageRegion region = image->GetRequestedRegion();
    region.SetSize(2, region.GetSize(2) - (oneSliceLess ? 1 : 0));
    image->SetBufferedRegion(region);
    image->Allocate();
    auto * pixel = image->GetBufferPointer();
    for (itk::SizeValueType n = 0; n < region.GetNumberOfPixels(); ++n, ++pixel)
    {
      const ImageIndex index = image->ComputeIndex(static_cast<itk::OffsetValueType>(n));
      const auto       at = [&](unsigned axis) { return static_cast<int>(index[axis] - placement.start[axis]); };
      *pixel = static_cast<typename TImage::PixelType>(value(at(0), at(1), at(2)));
    }
    regions.push_back(region);
    mostPixels = std::max<std::size_t>(mostPixels, region.GetNumberOfPixels());
  }
};

/** A whole image in memory. */
template <typename TPixel>
typename itk::Image<TPixel, 3>::Pointer
MakeImage(const itk::Size<3> & size, const VoxelFunction & value, const Placement & placement = {})
{
  auto spy = SpySource<itk::Image<TPixel, 3>>::New();
  spy->size = size;
  spy->value = value;
  spy->placement = placement;
  spy->Update();
  typename itk::Image<TPixel, 3>::Pointer image = spy->GetOutput();
  image->DisconnectPipeline();
  return image;
}

/** What a filter tells its observers. */
class Watcher
{
public:
  explicit Watcher(itk::ProcessObject * filter)
  {
    filter->AddObserver(itk::StartEvent(), [this](const itk::EventObject &) { ++starts; });
    filter->AddObserver(itk::EndEvent(), [this](const itk::EventObject &) { ++ends; });
    filter->AddObserver(itk::AbortEvent(), [this](const itk::EventObject &) { ++aborts; });
    filter->AddObserver(itk::ProgressEvent(), [this, filter](const itk::EventObject &) {
      progress.push_back(filter->GetProgress());
      if (abortAt >= 0 && filter->GetProgress() >= abortAt)
      {
        filter->AbortGenerateDataOn();
      }
    });
  }
  Watcher(const Watcher &) = delete;
  Watcher &
  operator=(const Watcher &) = delete;

  void
  ExpectMonotoneFrom0To1() const
  {
    ASSERT_GE(progress.size(), 3U);
    EXPECT_EQ(progress.front(), 0.0F);
    EXPECT_EQ(progress.back(), 1.0F);
    for (std::size_t i = 1; i < progress.size(); ++i)
    {
      EXPECT_GE(progress[i], progress[i - 1]) << i;
    }
  }

  int                starts = 0;
  int                ends = 0;
  int                aborts = 0;
  float              abortAt = -1; ///< asks to abort when progress has come so far
  std::vector<float> progress;
};

/** The description of the exception that `work` throws; empty, and a failure, when it throws none. */
template <typename TException = itk::ExceptionObject, typename TWork>
std::string
ThrownBy(const TWork & work)
{
  try
  {
    work();
  }
  catch (const TException & error)
  {
    return error.GetDescription();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

template <typename TObject>
std::string
Printed(const TObject & object)
{
  std::ostringstream text;
  object.Print(text);
  return text.str();
}

} // namespace voxelcore::testing
