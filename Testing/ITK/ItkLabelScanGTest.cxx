// What itk::ImageFileReader and LabelScanReader give of a scan is what ReadLabelVolume gives, or the same refusal.

#include "ItkFixtures.h"
#include "NrrdFixtures.h"
#include "VoxelCoreTesting/Shapes.h"

#include "itkImageFileReader.h"
#include "itkImageIOFactory.h"
#include "itkLabelImageToVoxelShapeFilter.h"
#include "itkLabelScanReader.h"
#include "itkMetaImageIOFactory.h"
#include "itkNrrdImageIOFactory.h"

#include <fstream>
#include <limits>
#include <map>
#include <sys/resource.h>

using namespace voxelcore;
using namespace voxelcore::testing;
using namespace voxelcore::testing::nrrd;

namespace
{

using Reals = itk::Image<double, 3>;

/** Geometry and values, or why not. */
struct Outcome
{
  ImageGeometry                                     geometry;
  std::map<std::int64_t, std::vector<LatticePoint>> voxels; ///< by label
  std::string                                       refusal;
};

std::vector<LatticePoint>
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

Outcome
Of(const ImageGeometry & geometry, const std::vector<LabelShape> & labels)
{
  Outcome outcome{ geometry, {}, {} };
  for (const LabelShape & label : labels)
  {
    outcome.voxels[label.value] = VoxelsOf(label.shape);
  }
  return outcome;
}

Outcome
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
std::string
Fault(const std::string & refusal)
{
  std::string fault = refusal.substr(0, refusal.find(';'));
  const auto  scaling = fault.find("(after scaling) ");
  return scaling == std::string::npos ? fault : fault.erase(scaling, 16);
}

void
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

class ItkLabelScan : public ::testing::Test
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

  /** The same three times; `word`, where given, is in the refusal. */
  void
  ExpectSameByAll(const std::filesystem::path & path, const std::string & word = "", const ReadOptions & options = {})
  {
    SCOPED_TRACE(path.filename().string() + (word.empty() ? "" : ", refused: " + word));
    const Outcome expected = ByLibrary(path, options);
    EXPECT_EQ(expected.refusal.empty(), word.empty()) << expected.refusal;
    EXPECT_NE(expected.refusal.find(word), std::string::npos) << expected.refusal;
    auto file = itk::ImageFileReader<Reals>::New();
    auto strict = itk::LabelScanReader<Reals>::New();
    auto whole = itk::LabelScanReader<itk::Image<std::int64_t, 3>>::New();
    if (options.volume || options.niftiForm != "auto" || options.orthonormalize || options.spacing)
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
  }

  TempFolder m_Folder;
};

NiftiFields
Plain(int datatype = 2, int bitpix = 8)
{
  NiftiFields fields;
  fields.dim = { 3, 2, 2 };
  fields.datatype = datatype;
  fields.bitpix = bitpix;
  fields.pixdim = { 1, 0.5, 0.75, 2 };
  return fields;
}

} // namespace

TEST_F(ItkLabelScan, NrrdIsReadAsByTheLibrary)
{
  const auto path = [&](const std::vector<std::string> & lines) {
    return m_Folder.Write("a.nrrd", Nrrd(lines, RawAll<std::uint8_t>(kValues)));
  };
  ExpectSameByAll(path(Lines()));
  ExpectSameByAll(path(With(Lines(), "space units", "\"um\" \"um\" \"um\"")));
  ExpectSameByAll(path(With(Lines(), "space", "right-anterior-superior")));
  ExpectSameByAll(path(With(Lines(), "space directions", "(0,2,0) (-3,0,0) (0,0,0.5)")));
  ExpectSameByAll(path(With(Lines(), "space directions", "(1,0.5,0) (0,1,0) (0,0,1)")), "skewed");
  ReadOptions mended;
  mended.orthonormalize = true;
  ExpectSameByAll(path(With(Lines(), "space directions", "(1,0.001,0) (0,1,0) (0,0,1)")), "", mended);
  ExpectSameByAll(path(With(Lines(), "space directions", "(1,0,0) (1,0,0) (0,0,1)")), "in one plane");
  ExpectSameByAll(path({ "type: uint8", "dimension: 3", "sizes: 3 2 2", "spacings: 0.5 0.25 2", "encoding: raw" }));
  const std::string all = Nrrd(Lines(), RawAll<std::uint8_t>(kValues));
  ExpectSameByAll(m_Folder.Write("cut.nrrd", all.substr(0, all.size() - 1)), "truncated");
  const std::string packed = Gzip(RawAll<std::uint8_t>(kValues));
  const auto        gzip = With(Lines(), "encoding", "gzip");
  ExpectSameByAll(m_Folder.Write("gzip.nrrd", Nrrd(gzip, packed)));
  ExpectSameByAll(m_Folder.Write("cutgzip.nrrd", Nrrd(gzip, packed.substr(0, packed.size() - 6))), "end too early");
}

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

TEST_F(ItkLabelScan, NiftiIsReadAsByTheLibrary)
{
  const std::string bytes = RawAll<std::uint8_t>(kValues);
  const auto        path = [&](const NiftiFields & fields, const std::string & data) {
    return m_Folder.Write("a.nii", Nifti(fields, data));
  };
  ExpectSameByAll(path(Plain(), bytes)); // neither form
  ExpectSameByAll(m_Folder.Write("a.nii.gz", Gzip(Nifti(Plain(), bytes))));
  NiftiFields fields = Plain();
  fields.dim = { 3, 2, 2, 2 };
  ExpectSameByAll(path(fields, bytes + bytes), "4-D file with 2 volumes");
  ReadOptions second;
  second.volume = 1;
  ExpectSameByAll(path(fields, std::string(12, '\0') + bytes), "", second);
  fields = Plain();
  fields.units = 3; // micrometres
  fields.qformCode = 1;
  fields.qoffset = { 1000, 2000, -3000 };
  ExpectSameByAll(path(fields, bytes));
  fields = Plain();
  fields.sformCode = 1;
  fields.srow = { 1, 0.3, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 };
  ExpectSameByAll(path(fields, bytes), "skewed");
  fields.qformCode = 1;
  ExpectSameByAll(path(fields, bytes)); // the qform, which is right-angled
  fields.srow = { -1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0 };
  for (const char * form : { "auto", "qform", "sform" }) // which disagree
  {
    ReadOptions options;
    options.niftiForm = form;
    ExpectSameByAll(path(fields, bytes), "", options);
  }
  fields = Plain(4, 16);
  fields.slope = 0.5;
  ExpectSameByAll(path(fields, RawAll<std::int16_t>(kValues)), "is a fraction");
  fields.slope = 1.0F / 255;
  std::vector<int> multiples = kValues;
  for (int & value : multiples)
  {
    value *= 255 / 3;
  }
  fields.slope = 3.0F / 255;
  ExpectSameByAll(path(fields, RawAll<std::int16_t>(multiples)));
  fields = Plain();
  fields.pixdim[2] = 0;
  ExpectSameByAll(path(fields, bytes), "spacing along axis j is 0");
  fields = Plain(128, 24);
  ExpectSameByAll(path(fields, bytes + bytes + bytes), "3 values a voxel");
}

TEST_F(ItkLabelScan, SegmentsInLayersAreTheNumbersOfTheirLabels)
{
  const auto path = [&](const std::vector<int> & values, int secondValue) {
    const std::vector<std::string> lines{ "type: uint8",
                                          "dimension: 4",
                                          "space: left-posterior-superior",
                                          "sizes: 2 3 2 2",
                                          "space directions: none (1,0,0) (0,1,0) (0,0,1)",
                                          "kinds: list domain domain domain",
                                          "encoding: raw",
                                          "space origin: (0,0,0)",
                                          "Segment0_Name:=Liver",
                                          "Segment0_LabelValue:=1",
                                          "Segment0_Layer:=0",
                                          "Segment1_Name:=Vessel",
                                          "Segment1_LabelValue:=" + std::to_string(secondValue),
                                          "Segment1_Layer:=1" };
    return m_Folder.Write("a.seg.nrrd", Nrrd(lines, RawAll<std::uint8_t>(values)));
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

TEST_F(ItkLabelScan, TiffStacksAndSlicesAreReadAsByTheLibrary)
{
  const auto page = [](int z, const std::string & description) {
    TiffPage one;
    one.width = 3;
    one.height = 2;
    one.description = description;
    one.parts = { RawAll<std::uint8_t>(std::vector<int>(kValues.begin() + 6 * z, kValues.begin() + 6 * z + 6)) };
    return one;
  };
  ExpectSameByAll(
    m_Folder.Write("a.tif",
                   Tiff({ page(0, "ImageJ=1.53t\nimages=2\nslices=2\nunit=micron\nspacing=2.5\n"), page(1, "") })));
  ExpectSameByAll(m_Folder.Write("b.tif", Tiff({ page(0, ""), page(1, "") })));
  std::filesystem::create_directory(m_Folder / "slices");
  m_Folder.Write("slices/s_9.tif", Tiff({ page(0, "") }));
  m_Folder.Write("slices/s_10.tif", Tiff({ page(1, "") }));
  ExpectSameByAll(m_Folder / "slices");
  ExpectSameByAll(m_Folder / "slices/s_*.tif");
  m_Folder.Write("slices/s_12.tif", Tiff({ page(1, "") }));
  ExpectSameByAll(m_Folder / "slices", "11");
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
  // 256 MB that take no place on the disk: all background but the corners.
  constexpr std::int64_t side = 512;
  constexpr std::int64_t slices = 512;
  auto                   lines = NrrdLines("uint16", { side, side, slices });
  const auto             path = m_Folder.Write("large.nrrd", Nrrd(lines, Raw<std::uint16_t>(1)));
  const std::uint64_t    header = std::filesystem::file_size(path) - 2;
  const std::uint64_t    bytes = 2 * side * side * slices;
  std::filesystem::resize_file(path, header + bytes);
  {
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(header + bytes - 2));
    file << Raw<std::uint16_t>(7);
  }
  const auto peak = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  };
  using Image = itk::Image<std::uint16_t, 3>;
  const auto check = [&](auto reader) {
    reader->SetFileName(path.string());
    auto shapes = itk::LabelImageToVoxelShapeFilter<Image>::New();
    shapes->SetInput(reader->GetOutput());
    shapes->SetNumberOfStreamDivisions(16);
    Watcher             watcher(reader);
    const std::uint64_t before = peak();
    shapes->Update();
#ifndef __SANITIZE_ADDRESS__
    EXPECT_LT(peak() - before, 2 * bytes / 16);
#endif
    EXPECT_EQ(watcher.starts, 16);
    ASSERT_EQ(shapes->GetOutput()->GetLabels().size(), 2U);
    EXPECT_EQ(shapes->GetOutput()->GetLabel(7).shape.Box().lower,
              (std::array<std::int32_t, 3>{ side - 1, side - 1, slices - 1 }));
  };
  check(itk::LabelScanReader<Image>::New());
  check(itk::ImageFileReader<Image>::New());
}
