// What itk::ImageFileReader and LabelScanReader give of a scan: pixels that hold their values, regions, streams.

#include "ForeignBytes.h"
#include "ItkFixtures.h"
#include "ItkScanOutcomes.h"
#include "NrrdFixtures.h"
#include "VoxelCoreTesting/Shapes.h"

#include "itkImageIOFactory.h"
#include "itkMetaDataObject.h"

#include <fstream>
#include <iostream>
#include <limits>
#include <stdexcept>

using namespace voxelcore;
using namespace voxelcore::testing;
using namespace voxelcore::testing::nrrd;

namespace
{

class ItkLabelScan : public ScanByAllReaders
{};

/** The most memory this process has held since the last call with `restart`, in bytes. */
std::uint64_t
PeakMemory(bool restart)
{
  if (restart)
  {
    std::ofstream("/proc/self/clear_refs") << 5;
  }
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
  {
    if (line.starts_with("VmHWM:"))
    {
      return std::stoull(line.substr(6)) * 1024;
    }
  }
  throw std::runtime_error("no VmHWM in /proc/self/status");
}

/** A file that takes no place on the disk, all background but the corners, in 16 divisions. */
void
ExpectAtMostTwoSlabs(const TempFolder & folder, int side, int slices)
{
  auto                lines = NrrdLines("uint16", { side, side, slices });
  const auto          path = folder.Write("large.nrrd", Nrrd(lines, Raw<std::uint16_t>(1)));
  const std::uint64_t header = std::filesystem::file_size(path) - 2;
  const auto          bytes = std::uint64_t{ 2 } * static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side) *
                     static_cast<std::uint64_t>(slices);
  std::filesystem::resize_file(path, header + bytes);
  {
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(header + bytes - 2));
    file << Raw<std::uint16_t>(7);
  }
  using Image = itk::Image<std::uint16_t, 3>;
  const auto check = [&](auto reader) {
    reader->SetFileName(path.string());
    auto shapes = itk::LabelImageToVoxelShapeFilter<Image>::New();
    shapes->SetInput(reader->GetOutput());
    shapes->SetNumberOfStreamDivisions(16);
    Watcher             watcher(reader);
    const std::uint64_t before = PeakMemory(true);
    shapes->Update();
    const std::uint64_t more = PeakMemory(false) - before;
    std::cout << static_cast<double>(more) / (static_cast<double>(bytes) / 16) << " slabs in memory\n";
#ifndef __SANITIZE_ADDRESS__
    EXPECT_LT(more, 2 * bytes / 16);
#endif
    EXPECT_EQ(watcher.starts, 16);
    ASSERT_EQ(shapes->GetOutput()->GetLabels().size(), 2U);
    EXPECT_EQ(shapes->GetOutput()->GetLabel(7).shape.Box().lower,
              (std::array<std::int32_t, 3>{ side - 1, side - 1, slices - 1 }));
  };
  check(itk::LabelScanReader<Image>::New());
  check(itk::ImageFileReader<Image>::New());
}

} // namespace

TEST_F(ItkLabelScan, NoValueIsCast)
{
  const auto path = [&](const char * type, const std::string & bytes) {
    return m_Folder.Write("a.nrrd", Nrrd(Lines(type), bytes));
  };
  std::vector<double> values(12, 1);
  for (const auto & [value, word] : std::vector<std::pair<double, const char *>>{ { 0.9999999, "is a fraction" },
                                                                                  { -1, "is negative" },
                                                                                  { 70000, "" } })
  {
    values[7] = value;
    ExpectSameByAll(path("double", RawAll<double>(values)), word);
    auto narrow = itk::LabelScanReader<itk::Image<unsigned short, 3>>::New();
    narrow->SetFileName((m_Folder / "a.nrrd").string());
    const std::string refusal = ThrownBy([&] { narrow->Update(); });
    EXPECT_EQ(refusal.find("a.nrrd: value ") == std::string::npos, false) << refusal;
    EXPECT_NE(refusal.find("at voxel (1,0,1) does not fit"), std::string::npos) << refusal;
    EXPECT_EQ(refusal.find('\n'), std::string::npos);
  }
  values[7] = -1024;
  ExpectSameByAll(path("int16", RawAll<std::int16_t>(values)), "is negative");
  // Beyond 2^53 doubles skip whole numbers, which no cast may hide.
  std::vector<std::int64_t> large(12, 1);
  large[3] = (std::int64_t{ 1 } << 53) + 1;
  path("int64", RawAll<std::int64_t>(large));
  auto exact = itk::LabelScanReader<itk::Image<std::int64_t, 3>>::New();
  exact->SetFileName((m_Folder / "a.nrrd").string());
  exact->Update();
  EXPECT_EQ(exact->GetOutput()->GetPixel({ { 0, 1, 0 } }), large[3]);
  auto reals = itk::LabelScanReader<Reals>::New();
  reals->SetFileName((m_Folder / "a.nrrd").string());
  EXPECT_NE(ThrownBy([&] { reals->Update(); }).find("does not fit"), std::string::npos);
}

TEST_F(ItkLabelScan, APixelHoldsAValueExactlyOrNotAtAll)
{
  using itk::Detail::CanHold;
  EXPECT_TRUE((CanHold<unsigned char>(255)));
  EXPECT_FALSE((CanHold<unsigned char>(256)));
  EXPECT_FALSE((CanHold<unsigned char>(-1)));
  EXPECT_TRUE((CanHold<signed char>(-128)));
  EXPECT_FALSE((CanHold<signed char>(-129LL)));
  EXPECT_FALSE((CanHold<long long>(std::numeric_limits<unsigned long long>::max())));
  EXPECT_TRUE((CanHold<unsigned long long>(std::numeric_limits<unsigned long long>::max())));
  EXPECT_TRUE((CanHold<float>(16777216)));
  EXPECT_FALSE((CanHold<float>(16777217)));
  EXPECT_FALSE((CanHold<double>(std::numeric_limits<unsigned long long>::max())));
  EXPECT_TRUE((CanHold<float>(0.1)));
  EXPECT_FALSE((CanHold<float>(1e300)));
  EXPECT_TRUE((CanHold<float>(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_FALSE((CanHold<int>(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE((CanHold<int>(-2147483648.0)));
  EXPECT_FALSE((CanHold<int>(2147483648.0)));
  EXPECT_FALSE((CanHold<unsigned int>(-1.0)));
  EXPECT_FALSE((CanHold<int>(0.5F)));
}

TEST_F(ItkLabelScan, SegmentsInLayersAreTheNumbersOfTheirLabels)
{
  const auto path = [&](const std::vector<int> & values, int secondValue) {
    return m_Folder.Write("a.seg.nrrd", Nrrd(LayerLines(1, secondValue), RawAll<std::uint8_t>(values)));
  };
  std::vector<int> apart(24, 0);
  for (std::size_t voxel = 0; voxel < 12; ++voxel)
  {
    apart[2 * voxel + (voxel < 6 ? 0 : 1)] = voxel % 5 == 0 ? 0 : 1;
  }
  ExpectSameByAll(path(apart, 1)); // both layers use 1: numbered anew
  for (std::size_t voxel = 6; voxel < 12; ++voxel)
  {
    apart[2 * voxel + 1] *= 4;
  }
  ExpectSameByAll(path(apart, 4));
  // Two at one place are more than an image can hold.
  apart[2 * 4 + 1] = 4;
  auto          reader = itk::LabelScanReader<Reals>::New();
  const Outcome overlap = ByPipeline(*reader, path(apart, 4));
  EXPECT_NE(overlap.refusal.find("a.seg.nrrd: two segments overlap at voxel (1,1,0)"), std::string::npos)
    << overlap.refusal;
  EXPECT_EQ(ByLibrary(m_Folder / "a.seg.nrrd", {}).voxels.size(), 2U);
}

TEST_F(ItkLabelScan, SegmentsAreInTheDictionaryUnderTheNumbersOfTheirPixels)
{
  auto lines = Lines();
  for (const char * line : { "Segment0_Name:=Liver",
                             "Segment0_LabelValue:=250",
                             "Segment0_Layer:=0",
                             "Segment0_Color:=1 0.5 0",
                             "Segment1_Name:=Vessel",
                             "Segment1_LabelValue:=2",
                             "Segment1_Layer:=0" })
  {
    lines.emplace_back(line);
  }
  auto file = itk::ImageFileReader<Reals>::New();
  file->SetFileName(m_Folder.Write("a.seg.nrrd", Nrrd(lines, RawAll<std::uint8_t>(kValues))).string());
  file->Update();
  auto strict = itk::LabelScanReader<Reals>::New();
  strict->SetFileName(file->GetFileName());
  strict->Update();
  for (const auto & dictionary :
       { file->GetImageIO()->GetMetaDataDictionary(), strict->GetOutput()->GetMetaDataDictionary() })
  {
    const auto text = [&dictionary](const char * key) {
      std::string value = "(none)";
      itk::ExposeMetaData(dictionary, key, value);
      return value;
    };
    EXPECT_EQ(text("Segment0_Name"), "Liver");
    EXPECT_EQ(text("Segment0_LabelValue"), "250");
    EXPECT_EQ(text("Segment0_Color"), "1 0.5 0");
    EXPECT_EQ(text("Segment1_Name"), "Vessel");
    EXPECT_EQ(text("Segment1_LabelValue"), "2");
    EXPECT_EQ(text("Segment1_Color"), "(none)");
  }
}

TEST_F(ItkLabelScan, ShapesOfAScanWithoutAVoxelSizeAreInVoxels)
{
  using Image = itk::Image<std::uint8_t, 3>;
  for (const bool sized : { true, false })
  {
    const std::string header = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 3 3 3\nencoding: raw\n";
    const auto        path = m_Folder.Write("a.nrrd",
                                     header + (sized ? "spacings: 1 1 1\n\n" : "\n") + std::string(13, '\0') + '\1' +
                                       std::string(13, '\0'));
    const auto        expect = [&](auto reader) {
      reader->SetFileName(path.string());
      auto shapes = itk::LabelImageToVoxelShapeFilter<Image>::New();
      shapes->SetInput(reader->GetOutput());
      shapes->Update();
      EXPECT_EQ(shapes->GetOutput()->GetGeometry().unit, sized ? SpatialUnit::Millimetres : SpatialUnit::Voxels);
    };
    expect(itk::LabelScanReader<Image>::New());
    auto file = itk::ImageFileReader<Image>::New();
    file->SetImageIO(itk::LabelScanImageIO::New());
    expect(file);
  }
}

TEST_F(ItkLabelScan, TheFactoryGivesItForItsFormatsAndNoOthers)
{
  const auto nameOf = [](const char * file) {
    const auto io = itk::ImageIOFactory::CreateImageIO(file, itk::ImageIOFactory::IOFileModeEnum::ReadMode);
    return io ? std::string(io->GetNameOfClass()) : std::string();
  };
  for (const char * file : { "a.nrrd", "a.NII.gz", "a.mha", "a.tif", "none/s_*.png" })
  {
    EXPECT_EQ(nameOf(file), "LabelScanImageIO") << file; // also of files that are not there
  }
  EXPECT_EQ(nameOf("a.png"), "");
  EXPECT_EQ(nameOf("a.dcm"), "");
  EXPECT_EQ(nameOf("a.mrc"), ""); // ITK's own readers keep their formats
  auto io = itk::LabelScanImageIO::New();
  EXPECT_FALSE(io->CanWriteFile("a.nrrd"));
  EXPECT_NE(ThrownBy([&] { io->Write(nullptr); }).find("only reads"), std::string::npos);
  auto reader = itk::LabelScanReader<Reals>::New();
  reader->SetFileName("none.nrrd");
  EXPECT_NE(ThrownBy([&] { reader->Update(); }).find("none.nrrd"), std::string::npos);
}

TEST_F(ItkLabelScan, AnyRegionsInAnyOrderAreThoseOfTheWhole)
{
  Random                     random(20261122);
  std::vector<std::uint16_t> values(13 * 11 * 9);
  for (auto & value : values)
  {
    value = static_cast<std::uint16_t>(random.Next() % 60000);
  }
  for (const bool packed : { false, true })
  {
    auto lines = NrrdLines("uint16", { 13, 11, 9 });
    lines = packed ? With(lines, "encoding", "gzip") : lines;
    lines = With(lines, "endian", "big");
    const std::string raw = RawAll<std::uint16_t>(values, true);
    auto              reader = itk::LabelScanReader<itk::Image<std::uint16_t, 3>>::New();
    reader->SetFileName(m_Folder.Write("a.nrrd", Nrrd(lines, packed ? Gzip(raw) : raw)).string());
    reader->UpdateOutputInformation();
    for (int round = 0; round < 30; ++round)
    {
      ImageRegion region;
      const int   sides[3] = { 13, 11, 9 };
      for (unsigned axis = 0; axis < 3; ++axis)
      {
        const auto from = static_cast<int>(random.Next() % static_cast<std::uint64_t>(sides[axis]));
        region.SetIndex(axis, from);
        region.SetSize(axis, 1 + random.Next() % static_cast<std::uint64_t>(sides[axis] - from));
      }
      reader->GetOutput()->SetRequestedRegion(region);
      reader->Update();
      ASSERT_EQ(reader->GetOutput()->GetBufferedRegion(), region);
      const auto * pixel = reader->GetOutput()->GetBufferPointer();
      for (itk::SizeValueType n = 0; n < region.GetNumberOfPixels(); ++n, ++pixel)
      {
        const ImageIndex at = reader->GetOutput()->ComputeIndex(static_cast<itk::OffsetValueType>(n));
        ASSERT_EQ(*pixel, values[static_cast<std::size_t>(at[0] + 13 * (at[1] + 11 * at[2]))]) << at;
      }
      reader->Modified(); // else what is buffered may do
    }
  }
}

TEST_F(ItkLabelScan, ARawNrrdStreamsWithinTwoSlabs)
{
  ExpectAtMostTwoSlabs(m_Folder, 512, 512); // 256 MB
}

TEST_F(ItkLabelScan, FormatsOfItkAreReadByTheStrictRules)
{
  const auto values = ForeignValues();
  for (const auto & [name, bytes] :
       std::vector<std::pair<std::string, std::string>>{ { "a.mrc", MrcBytes() },
                                                         { "a.gipl", GiplBytes() },
                                                         { "a.dcm", DicomSegmentationBytes() } })
  {
    auto reader = itk::LabelScanReader<itk::Image<unsigned char, 3>>::New();
    reader->SetFileName(m_Folder.Write(name, bytes).string());
    reader->Update();
    const auto * image = reader->GetOutput();
    EXPECT_TRUE(std::equal(values.begin(), values.end(), image->GetBufferPointer())) << name;
    const LabelMap expected = ReadLabelVolume(m_Folder / name);
    for (unsigned axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(image->GetSpacing()[axis], expected.geometry.spacing[axis]) << name;
      EXPECT_EQ(image->GetOrigin()[axis], expected.geometry.origin[axis]) << name;
    }
  }
}

using HeavyItkLabelScan = ItkLabelScan;

TEST_F(HeavyItkLabelScan, ARawNrrdOfTwoGigabytesStreamsWithinTwoSlabs)
{
  ExpectAtMostTwoSlabs(m_Folder, 1024, 1024);
}
