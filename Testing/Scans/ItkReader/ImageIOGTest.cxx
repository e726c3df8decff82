// Scans that ITK's readers open: what their headers say beside what ITK reads of them is looked at, or refused.

#include "ForeignBytes.h"
#include "RunReader.h"
#include "ScanBytes.h"
#include "ScanSource.h"
#include "VoxelCoreTesting/Messages.h"

#include "voxelcore/ItkReader/ItkProcess.h"

#include <itkHDF5ImageIO.h>
#include <itkImage.h>
#include <itkImageFileWriter.h>
#include <itkVector.h>

#include <array>
#include <cmath>
#include <typeinfo>

namespace voxelcore::testing::imageio
{

namespace
{

class ImageIO : public ::testing::Test
{
protected:
  std::unique_ptr<itkreader::ScanSource>
  Open(ItkFormat format, const std::string & bytes) const
  {
    const std::string name = std::string("a.") + (format == ItkFormat::Vtk    ? "vtk"
                                                  : format == ItkFormat::Gipl ? "gipl"
                                                                              : "mrc");
    return itkreader::OpenByImageIO(m_Folder.Write(name, bytes), format);
  }
  void
  Refuse(ItkFormat format, const std::string & bytes, const std::string & text) const
  {
    SCOPED_TRACE(text);
    const std::string message = MessageOf([&] { Open(format, bytes); });
    EXPECT_NE(message.find(text), std::string::npos) << message;
  }
  template <typename TImage>
  std::unique_ptr<itkreader::ScanSource>
  OpenHdf5(const typename TImage::SizeType & size) const
  {
    // A name for each: HDF5 creates no file that it still has open.
    const auto path = m_Folder / (std::string(typeid(TImage).name()) + ".h5");
    {
      auto image = TImage::New();
      image->SetRegions(size);
      image->Allocate(true);
      auto * const bytes = reinterpret_cast<char *>(image->GetBufferPointer());
      std::size_t  count = sizeof(typename TImage::PixelType);
      for (const auto side : size)
      {
        count *= side;
      }
      for (std::size_t at = 0; at < count; ++at)
      {
        bytes[at] = static_cast<char>(at % 3);
      }
      auto writer = itk::ImageFileWriter<TImage>::New();
      writer->SetImageIO(itk::HDF5ImageIO::New());
      writer->SetFileName(path.string());
      writer->SetInput(image);
      writer->Update();
    } // which closes the file
    return itkreader::OpenByImageIO(path, ItkFormat::Hdf5);
  }
  static std::string
  Sent(itkreader::ScanSource & source, std::uint64_t volume = 0)
  {
    std::string bytes;
    source.Send(volume, 0, [&](const char * more, std::size_t count) { bytes.append(more, count); });
    return bytes;
  }
  /** With a word of MRC's header, counted from 1. */
  template <typename T>
  static std::string
  MrcWith(std::size_t number, T value, std::string bytes = MrcBytes())
  {
    return bytes.replace(4 * (number - 1), 4, Raw<T>(value));
  }
  static std::string
  VtkWith(bool text, const std::string & from, const std::string & to)
  {
    std::string bytes = VtkBytes(text);
    return bytes.replace(bytes.find(from), from.size(), to);
  }

  const TempFolder m_Folder;
};

} // namespace

TEST_F(ImageIO, MapsOfMrcThatItkWouldPlaceWronglyAreRefused)
{
  for (const auto & [first, order] : { std::pair(std::size_t{ 17 }, "2 1 3"), std::pair(std::size_t{ 18 }, "1 3 2") })
  {
    const auto turned =
      MrcWith<std::int32_t>(first + 1, first == 17 ? 1 : 2, MrcWith<std::int32_t>(first, first == 17 ? 2 : 3));
    Refuse(ItkFormat::Mrc, turned, std::string("its axes are stored in the order ") + order);
  }
  Refuse(ItkFormat::Mrc, MrcWith<float>(15, 60), "an angle of 60 degrees");
  Refuse(ItkFormat::Mrc, MrcWith<float>(16, NAN), "an angle of nan degrees");
  Refuse(ItkFormat::Mrc, MrcWith<std::int32_t>(23, 401), "a stack of volumes");
  EXPECT_EQ(Open(ItkFormat::Mrc, MrcWith<float>(14, 0))->scan.size[0], 6);
}

TEST_F(ImageIO, BytesOfMrcAreSignedWhereTheProgramThatWroteThemSaysSo)
{
  constexpr std::int32_t imod = 1146047817;
  EXPECT_EQ(Open(ItkFormat::Mrc, MrcBytes())->scan.type, PixelType::Int8);
  EXPECT_EQ(Open(ItkFormat::Mrc, MrcWith<std::int32_t>(28, 0))->scan.type, PixelType::UInt8);
  EXPECT_EQ(Open(ItkFormat::Mrc, MrcWith<std::int32_t>(39, imod))->scan.type, PixelType::UInt8);
  EXPECT_EQ(Open(ItkFormat::Mrc, MrcWith<std::int32_t>(40, 1, MrcWith<std::int32_t>(39, imod)))->scan.type,
            PixelType::Int8);
}

TEST_F(ImageIO, AMapOfMrcLiesWhereItsHeaderSaysOrBeginsAtItsStart)
{
  const auto start = Open(ItkFormat::Mrc, MrcWith<std::int32_t>(5, 3));
  ExpectNear(start->scan.origin, { 3e-6, 0, 0 }, 1e-15);
  const auto begin = Open(ItkFormat::Mrc, MrcWith<float>(50, 20, MrcWith<std::int32_t>(5, 3)));
  ExpectNear(begin->scan.origin, { 2e-6, 0, 0 }, 1e-15);
  EXPECT_EQ(Open(ItkFormat::Mrc, MrcWith<float>(12, 0))->scan.spacing[1], 0); // not said
  EXPECT_EQ(Open(ItkFormat::Mrc, MrcWith<std::int32_t>(9, 0))->scan.spacing[1], 0);
}

TEST_F(ImageIO, WhatGiplSaysAndItkPassesOverIsRefused)
{
  const auto with = [](std::size_t offset, float value) {
    std::string bytes = GiplBytes();
    return bytes.replace(offset, 4, Raw<float>(value, true));
  };
  Refuse(ItkFormat::Gipl, with(106 + 4, 0.5F), "its header has a matrix");
  Refuse(ItkFormat::Gipl, with(106 + 16, -1), "its header has a matrix");
  Refuse(ItkFormat::Gipl, with(236, 5), "scales the values");
  Refuse(ItkFormat::Gipl, with(240, 2), "scales the values");
  for (const std::string & bytes : { with(106, 1), with(106 + 16, 1), with(240, 1) })
  {
    const auto source = Open(ItkFormat::Gipl, bytes);
    EXPECT_EQ(Sent(*source), RawAll<std::uint8_t>(ForeignValues()));
  }
}

TEST_F(ImageIO, WhatVtkSaysAndItkMistakesIsRefused)
{
  for (const bool text : { false, true })
  {
    Refuse(ItkFormat::Vtk, VtkWith(text, "POINT_DATA", "CELL_DATA"), "values of cells, not of points");
    Refuse(ItkFormat::Vtk, VtkWith(text, "DATA 120", "DATA 60"), "not as many values as its DIMENSIONS say");
    Refuse(ItkFormat::Vtk, VtkWith(text, "DATA 120", "DATA many"), "not as many values");
  }
  Refuse(ItkFormat::Vtk, VtkWith(true, "short 1\n", "short 1\nlate "), "it has 0 of 120 numbers");
  const std::string bytes = VtkBytes(true);
  Refuse(ItkFormat::Vtk, bytes.substr(0, bytes.size() - 20), " of 120 numbers");
}

TEST_F(ImageIO, TheFirstOfSeveralArraysOfVtkIsRead)
{
  for (const bool text : { false, true })
  {
    for (const char * more : { "FIELD", "SCALARS", "COLOR_SCALARS", "VECTORS", "NORMALS", "TENSORS" })
    {
      const auto source = Open(ItkFormat::Vtk, VtkBytes(text) + more + " other 1\n");
      EXPECT_TRUE(HasNote(source->scan.warnings, "several arrays; the first is read")) << more;
      EXPECT_EQ(Sent(*source), RawAll<std::int16_t>(ForeignValues()));
    }
    EXPECT_TRUE(Open(ItkFormat::Vtk, VtkBytes(text) + "METADATA none\n")->scan.warnings.empty());
  }
}

TEST_F(ImageIO, SeveralValuesAVoxelOfVtkAreRefused)
{
  const auto values = RawAll<std::int16_t>(ForeignValues(), true);
  Refuse(ItkFormat::Vtk, VtkWith(false, "short 1", "short 2") + values, "2 values a voxel");
}

TEST_F(ImageIO, FilesThatItsReaderDoesNotKnowAreRefused)
{
  Refuse(ItkFormat::Gipl, "no scan", "GiplImageIO does not know it");
  Refuse(ItkFormat::Mrc, "no scan", "");
  m_Folder.Write("a.h5", "no scan");
  EXPECT_NE(MessageOf([&] { itkreader::OpenByImageIO(m_Folder / "a.h5", ItkFormat::Hdf5); }).find("cannot be opened"),
            std::string::npos);
}

TEST_F(ImageIO, NumbersOfEveryTypeAndSeveralVolumesComeAsTheyAre)
{
  const auto expected = [](std::size_t count, std::size_t from = 0) {
    std::string bytes(count, '\0');
    for (std::size_t at = 0; at < count; ++at)
    {
      bytes[at] = static_cast<char>((from + at) % 3);
    }
    return bytes;
  };
  const auto check = [&]<typename T>(T, PixelType type) {
    SCOPED_TRACE(PixelName(type));
    const auto source = OpenHdf5<itk::Image<T, 3>>({ { 4, 3, 2 } });
    EXPECT_EQ(source->scan.type, type);
    EXPECT_EQ(Sent(*source), expected(24 * sizeof(T)));
  };
  check(static_cast<signed char>(0), PixelType::Int8);
  check(static_cast<unsigned char>(0), PixelType::UInt8);
  check(short{}, PixelType::Int16);
  check(static_cast<unsigned short>(0), PixelType::UInt16);
  check(int{}, PixelType::Int32);
  check(unsigned{}, PixelType::UInt32);
  check(long{}, PixelType::Int64);
  check(static_cast<unsigned long>(0), PixelType::UInt64);
  check(float{}, PixelType::Float32);
  check(double{}, PixelType::Float64);
  const auto four = OpenHdf5<itk::Image<short, 4>>({ { 4, 3, 2, 3 } });
  EXPECT_EQ(four->scan.volumes, 3U);
  EXPECT_EQ(Sent(*four, 2), expected(48, 96));
  EXPECT_NE(MessageOf([&] { OpenHdf5<itk::Image<short, 2>>({ { 4, 3 } }); }).find("2-D image"), std::string::npos);
  const auto vectors = OpenHdf5<itk::Image<itk::Vector<float, 3>, 3>>({ { 4, 3, 2 } });
  EXPECT_EQ(vectors->scan.components, 3U);
  ReadOptions second;
  second.component = 1;
  const auto path = vectors->scan.files.front();
  ExpectRefused(path, { "colour image or vectors (3 values" });
  const ScanFile chosen = OpenByItk(path, ItkFormat::Hdf5, second);
  EXPECT_EQ(chosen.interleaved, 3U);
  EXPECT_EQ(chosen.component, 1);
}

TEST_F(ImageIO, TheProgramSaysHowItIsCalled)
{
  std::string           name = "voxelcore-itk-reader";
  std::string           format = "nrrd";
  std::array<char *, 3> words{ name.data(), format.data(), name.data() };
  EXPECT_EQ(itkreader::RunReader(1, words.data()), 2);
  EXPECT_EQ(itkreader::RunReader(3, words.data()), 2);
}

} // namespace voxelcore::testing::imageio
