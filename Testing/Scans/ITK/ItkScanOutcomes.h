#pragma once
// A scan read by voxelcore::ReadLabelVolume, by itk::ImageFileReader with LabelScanImageIO, and by
// itk::LabelScanReader.

#include "ScanBytes.h"

#include "itkImageFileReader.h"
#include "itkLabelImageToVoxelShapeFilter.h"
#include "itkLabelScanReader.h"
#include "itkMetaImageIOFactory.h"
#include "itkNrrdImageIOFactory.h"

#include <map>
#include <string>
#include <vector>

namespace voxelcore::testing
{

using Reals = itk::Image<double, 3>;

/** Geometry and values, or why not. */
struct Outcome
{
  ImageGeometry                                     geometry;
  std::map<std::int64_t, std::vector<LatticePoint>> voxels; ///< by label
  std::string                                       refusal;
};

inline std::vector<LatticePoint>
VoxelsOf(const VoxelShape & shape)
{
  std::vector<LatticePoint> voxels;
  const VoxelBox &          box = shape.Box();
  for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
  {
    for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
    {
      for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
      {
        if (shape.Contains(x, y, z))
        {
          voxels.push_back({ x, y, z });
        }
      }
    }
  }
  return voxels;
}

inline Outcome
Of(const ImageGeometry & geometry, const std::vector<LabelShape> & labels)
{
  Outcome outcome{ geometry, {}, {} };
  for (const LabelShape & label : labels)
  {
    outcome.voxels[label.value] = VoxelsOf(label.shape);
  }
  return outcome;
}

inline Outcome
ByLibrary(const std::filesystem::path & path, const ReadOptions & options)
{
  try
  {
    const LabelMap map = ReadLabelVolume(path, options);
    return Of(map.geometry, map.labels);
  }
  catch (const InputError & error)
  {
    return { {}, {}, error.what() };
  }
}

/** What a reader's image gives in three slabs. */
template <typename TReader>
Outcome
ByPipeline(TReader & reader, const std::filesystem::path & path)
{
  using Image = typename TReader::OutputImageType;
  reader.SetFileName(path.string());
  auto shapes = itk::LabelImageToVoxelShapeFilter<Image>::New();
  shapes->SetInput(reader.GetOutput());
  shapes->SetNumberOfStreamDivisions(3);
  try
  {
    shapes->Update();
    return Of(shapes->GetOutput()->GetGeometry(), shapes->GetOutput()->GetLabels());
  }
  catch (const itk::ExceptionObject & error)
  {
    std::string       text = error.GetDescription();
    const std::string image = "the input image:";
    if (text.starts_with(image))
    {
      text.replace(0, image.size(), path.string() + ":");
    }
    return { {}, {}, text };
  }
}

/** What is wrong, without what to do about it. "(after scaling)" is lost on the way through a pipeline. */
inline std::string
Fault(const std::string & refusal)
{
  std::string fault = refusal.substr(0, refusal.find(';'));
  const auto  scaling = fault.find("(after scaling) ");
  return scaling == std::string::npos ? fault : fault.erase(scaling, 16);
}

inline void
ExpectSame(const Outcome & expected, const Outcome & found)
{
  EXPECT_EQ(Fault(found.refusal), Fault(expected.refusal));
  EXPECT_EQ(found.refusal.find('\n'), std::string::npos);
  EXPECT_EQ(found.geometry.size, expected.geometry.size);
  EXPECT_EQ(found.geometry.spacing, expected.geometry.spacing);
  EXPECT_EQ(found.geometry.origin, expected.geometry.origin);
  for (std::size_t i = 0; i < 9; ++i)
  {
    EXPECT_NEAR(found.geometry.direction[i], expected.geometry.direction[i], 1e-15) << i;
  }
  EXPECT_EQ(found.voxels, expected.voxels);
}

/** Reads scans by all three. */
class ScanByAllReaders : public ::testing::Test
{
protected:
  static void
  SetUpTestSuite()
  {
    // Others that know the formats are there already.
    itk::MetaImageIOFactory::RegisterOneFactory();
    itk::NrrdImageIOFactory::RegisterOneFactory();
    itk::LabelScanImageIO::RegisterInFront();
    itk::LabelScanImageIO::RegisterInFront();
  }

  /** The same three times; `word`, where given, is in the refusal. Returns what it is. */
  Outcome
  ExpectSameByAll(const std::filesystem::path & path, const std::string & word = "", const ReadOptions & options = {})
  {
    SCOPED_TRACE(path.filename().string() + (word.empty() ? "" : ", refused: " + word));
    const Outcome expected = ByLibrary(path, options);
    EXPECT_EQ(expected.refusal.empty(), word.empty()) << expected.refusal;
    EXPECT_NE(expected.refusal.find(word), std::string::npos) << expected.refusal;
    auto file = itk::ImageFileReader<Reals>::New();
    auto strict = itk::LabelScanReader<Reals>::New();
    auto whole = itk::LabelScanReader<itk::Image<std::int64_t, 3>>::New();
    if (options.volume || options.component || options.niftiForm != "auto" || options.orthonormalize || options.spacing)
    {
      auto io = itk::LabelScanImageIO::New();
      io->SetOptions(options);
      file->SetImageIO(io);
      strict->SetOptions(options);
      whole->SetOptions(options);
    }
    ExpectSame(expected, ByPipeline(*file, path));
    ExpectSame(expected, ByPipeline(*strict, path));
    const Outcome integers = ByPipeline(*whole, path);
    if (expected.refusal.empty() || integers.refusal.find("does not fit") == std::string::npos)
    {
      ExpectSame(expected, integers);
    }
    else // the reader saw the value first
    {
      EXPECT_NE(integers.refusal.find(path.string() + ": value "), std::string::npos) << integers.refusal;
    }
    return expected;
  }

  TempFolder m_Folder;
};

} // namespace voxelcore::testing
