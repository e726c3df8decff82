// Formats that are read through ITK and GDCM: labels and places come right, and notes say who read them. More of each
// is compared with the programs that define them (compare_with_oracles.py).

#include "ForeignBytes.h"
#include "ScanBytes.h"
#include "voxelcore/Imaging/ScanRows.h"
#include "voxelcore/ItkReader/ItkProcess.h"

#include <itkHDF5ImageIO.h>
#include <itkImage.h>
#include <itkImageFileWriter.h>

#include <cerrno>
#include <sys/wait.h>
#include <thread>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

void
ExpectForeignValues(const LabelMap & volume)
{
  const auto values = ForeignValues();
  EXPECT_EQ(AllValues(volume), std::vector<std::int64_t>(values.begin(), values.end()));
}

std::filesystem::path
WriteSeries(const TempFolder & folder)
{
  for (const auto & [name, bytes] : DicomSeriesBytes())
  {
    folder.Write("series/" + name, bytes);
  }
  return folder / "series";
}

} // namespace

TEST(ItkProcess, ValuesPlacesAndReadersAreThoseOfTheFile)
{
  struct Case
  {
    std::filesystem::path path;
    std::string           format;
    std::string           reader;
    Vector3               spacing;
    Vector3               origin;
  };
  const TempFolder        folder;
  const std::vector<Case> cases{
    { folder.Write("a.mrc", MrcBytes()), "MRC", "ITK's MRCImageIO", { 1e-6, 2e-6, 3e-6 }, { 0, 0, 0 } },
    { folder.Write("a.gipl", GiplBytes()), "GIPL", "ITK's GiplImageIO", { 0.5, 0.75, 2 }, { 0, 0, 0 } },
    { folder.Write("a.gipl.gz", Gzip(GiplBytes())), "GIPL", "ITK's GiplImageIO", { 0.5, 0.75, 2 }, { 0, 0, 0 } },
    { folder.Write("a.vtk", VtkBytes(false)), "VTK", "ITK's VTKImageIO", { 0.5, 0.75, 2 }, { 1, 2, 3 } },
    { folder.Write("b.vtk", VtkBytes(true)), "VTK", "ITK's VTKImageIO", { 0.5, 0.75, 2 }, { 1, 2, 3 } },
    { WriteSeries(folder), "DICOM", "GDCM", { 0.5, 0.75, 2 }, { -1, 2, 0 } },
    { folder / "series/IM2", "DICOM", "GDCM", { 0.5, 0.75, 2 }, { -1, 2, 0 } },
    { folder.Write("seg", DicomSegmentationBytes()), "DICOM-SEG", "GDCM", { 0.5, 0.75, 2 }, { -1, 2, 0 } },
  };
  for (const Case & one : cases)
  {
    SCOPED_TRACE(one.path);
    const LabelMap volume = ReadLabelVolume(one.path);
    ExpectForeignValues(volume);
    EXPECT_EQ(volume.format, one.format);
    EXPECT_TRUE(HasNote(volume.notes, "read by " + one.reader)) << volume.notes.front();
    ExpectNear(volume.geometry.spacing, one.spacing, 1e-12);
    ExpectNear(volume.geometry.origin, one.origin, 1e-12);
  }
}

namespace
{

/** Every `step`th of the 48 orientations. */
void
ExpectOrientationsToComeBack(int step)
{
  using Image = itk::Image<unsigned short, 3>;
  const TempFolder folder;
  const auto       values = ForeignValues();
  int              turns = 0;
  for (int code = 0; code < 27; ++code)
  {
    const int axes[]{ code % 3, code / 3 % 3, code / 9 };
    if (axes[0] == axes[1] || axes[0] == axes[2] || axes[1] == axes[2])
    {
      continue;
    }
    for (int signs = 0; signs < 8; ++signs)
    {
      if (turns++ % step != 0)
      {
        continue;
      }
      auto                 image = Image::New();
      Image::DirectionType direction;
      direction.Fill(0);
      for (unsigned a = 0; a < 3; ++a)
      {
        direction(static_cast<unsigned>(axes[a]), a) = (signs >> a & 1) != 0 ? -1 : 1;
      }
      const double spacing[]{ 0.5, 0.75, 2 };
      const double origin[]{ 10, -20, 30.5 };
      image->SetRegions(Image::SizeType{ { 6, 5, 4 } });
      image->SetDirection(direction);
      image->SetSpacing(spacing);
      image->SetOrigin(origin);
      image->Allocate();
      std::copy(values.begin(), values.end(), image->GetBufferPointer());
      {
        auto writer = itk::ImageFileWriter<Image>::New();
        writer->SetImageIO(itk::HDF5ImageIO::New());
        writer->SetFileName((folder / "a.h5").string());
        writer->SetInput(image);
        writer->Update();
      } // which closes the file
      const LabelMap volume = ReadLabelVolume(folder / "a.h5");
      ExpectForeignValues(volume);
      const Image::IndexType corner{ { 5, 4, 3 } };
      Image::PointType       place;
      image->TransformIndexToPhysicalPoint(corner, place);
      ExpectNear(CentreOf(volume, 5, 4, 3), { place[0], place[1], place[2] }, 1e-9);
    }
  }
  EXPECT_EQ(turns, 48);
}

} // namespace

TEST(ItkProcess, OrientationsThatItkWritesComeBack)
{
  ExpectOrientationsToComeBack(5);
}

TEST(HeavyItkProcess, AllOrientationsThatItkWritesComeBack)
{
  ExpectOrientationsToComeBack(1);
}

TEST(ItkProcess, ANameOfASegmentIsThatOfTheFile)
{
  const TempFolder folder;
  const LabelMap   volume = ReadLabelVolume(folder.Write("a.dcm", DicomSegmentationBytes()));
  ASSERT_EQ(volume.labels.size(), 6U);
  EXPECT_EQ(volume.labels[3].name, "segment 4");
}

TEST(ItkProcess, AllFilesOfASeriesAreTheScans)
{
  const TempFolder folder;
  const auto       series = WriteSeries(folder);
  const auto       files = ScanFiles(series);
  ASSERT_EQ(files.size(), 4U);
  EXPECT_EQ(files[0].filename(), "IM0");
  const auto byFile = ScanFiles(series / "IM2");
  ASSERT_EQ(byFile.size(), 4U);
  EXPECT_EQ(byFile[0], series / "IM2");
  EXPECT_EQ(byFile[3].filename(), "IM3");
}

TEST(ItkProcess, RowsComeInAnyOrder)
{
  const TempFolder folder;
  ScanRows         rows(folder.Write("a.mrc", MrcBytes()), {});
  const auto       values = ForeignValues();
  for (const std::uint64_t first : { 7U, 3U, 18U, 0U })
  {
    rows.Read(first, 2, [&](const std::byte * row, std::uint64_t number) {
      for (std::size_t x = 0; x < 6; ++x)
      {
        EXPECT_EQ(static_cast<int>(row[x]), values[number * 6 + x]);
      }
    });
  }
}

TEST(ItkProcess, SeveralThreadsReadAtATime)
{
  const TempFolder         folder;
  const auto               path = folder.Write("a.vtk", VtkBytes(false));
  std::vector<std::thread> threads;
  for (int n = 0; n < 4; ++n)
  {
    threads.emplace_back([&path] { ExpectForeignValues(ReadLabelVolume(path)); });
  }
  for (std::thread & thread : threads)
  {
    thread.join();
  }
}

TEST(ItkProcess, WhatIsCutOffIsRefused)
{
  const TempFolder folder;
  for (const auto & [name, bytes] : std::vector<std::pair<std::string, std::string>>{ { "a.mrc", MrcBytes() },
                                                                                      { "a.gipl", GiplBytes() },
                                                                                      { "a.vtk", VtkBytes(false) },
                                                                                      { "b.vtk", VtkBytes(true) } })
  {
    ExpectRefused(folder.Write(name, bytes.substr(0, bytes.size() - 20)), { "truncated" });
  }
  const std::string segmentation = DicomSegmentationBytes();
  ExpectRefused(folder.Write("c.dcm", segmentation.substr(0, segmentation.size() - 4)), {});
  WriteSeries(folder);
  const std::string slice = DicomSeriesBytes().at("IM2");
  folder.Write("series/IM2", slice.substr(0, slice.size() - 4));
  ExpectRefused(folder / "series", {});
}

// ITK 5.2.1 frees memory twice where the extended header of MRC is shorter than the header says.
TEST(ItkProcess, AnExtendedHeaderThatIsNotThereIsRefusedBeforeItkLooks)
{
  const TempFolder folder;
  for (const std::int32_t length : { -1, 1 << 30, 1000 })
  {
    std::string bytes = MrcBytes();
    bytes.replace(92, 4, Raw<std::int32_t>(length));
    ExpectRefused(folder.Write("a.mrc", bytes), { "of another header", "damaged" });
  }
}

TEST(ItkProcess, FilesAndFoldersGoToItByTheirFirstBytes)
{
  ASSERT_TRUE(HasItkReader());
  const TempFolder folder;
  EXPECT_EQ(FormatByItk(folder.Write("a.mrc", MrcBytes())), ItkFormat::Mrc);
  EXPECT_EQ(FormatByItk(WriteSeries(folder)), ItkFormat::Dicom);
  EXPECT_EQ(FormatByItk(folder.Write("seg", DicomSegmentationBytes())), ItkFormat::Dicom);
  EXPECT_EQ(FormatByItk(folder.Write("a.nrrd", "NRRD0004\n")), ItkFormat::None);
  EXPECT_EQ(FormatByItk(folder / "nowhere"), ItkFormat::None);
  folder.Write("series/slice.tif", "");
  EXPECT_EQ(FormatByItk(folder / "series"), ItkFormat::None);
}

TEST(ItkProcess, GivesHeaderAndVoxelsOfOneScan)
{
  const TempFolder folder;
  ScanFile         scan = OpenByItk(folder.Write("a.gipl", GiplBytes()), ItkFormat::Gipl, {});
  EXPECT_EQ(scan.geometry.size, (std::array<std::int64_t, 3>{ 6, 5, 4 }));
  std::vector<std::uint8_t> voxels(120);
  ASSERT_EQ(scan.type, PixelType::UInt8);
  scan.voxels->Read(reinterpret_cast<std::byte *>(voxels.data()), voxels.size());
  const auto values = ForeignValues();
  EXPECT_EQ(voxels, std::vector<std::uint8_t>(values.begin(), values.end()));
  EXPECT_FALSE(scan.voxels->Finish());
  EXPECT_EQ(ItkScanFiles(folder / "a.gipl", ItkFormat::Gipl), std::vector<std::filesystem::path>{ folder / "a.gipl" });
}

TEST(ItkProcess, WhatIsLeftUnreadLeavesNoProcessBehind)
{
  const TempFolder folder;
  const auto       path = folder.Write("a.gipl", GiplBytes());
  for (int n = 0; n < 3; ++n)
  {
    OpenByItk(path, ItkFormat::Gipl, {});
  }
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

TEST(ItkProcess, WhatIsAskedForMustMakeSense)
{
  const TempFolder folder;
  ReadOptions      options;
  options.component = 0;
  const auto segmentation = folder.Write("a.dcm", DicomSegmentationBytes());
  EXPECT_THROW(OpenByItk(segmentation, ItkFormat::Dicom, options), UsageError);
  options = {};
  options.volume = 1;
  ExpectRefused(folder.Write("a.gipl", GiplBytes()), { "no volume 1" }, options);
}

TEST(ItkProcess, ASizeThatTheFileCannotHoldIsRefused)
{
  const TempFolder folder;
  for (const auto & [name, bytes] : DicomSeriesBytes())
  {
    const std::string great = DicomElement(0x0028, 0x0010, "US", "\xFF\x7F");
    folder.Write("s/" + name,
                 WithDicomElement(WithDicomElement(bytes, 0x0028, 0x0010, great),
                                  0x0028,
                                  0x0011,
                                  DicomElement(0x0028, 0x0011, "US", "\xFF\x7F")));
  }
  ExpectRefused(folder / "s", { "more voxels than its data can hold" });
}

TEST(ItkProcess, AMapThatSaysItsDistancesOfOnlyTwoAxesIsCubic)
{
  const TempFolder folder;
  std::string      bytes = MrcBytes();
  bytes.replace(4 * 12, 4, Raw<float>(0)); // of the cell along z
  const LabelMap volume = ReadLabelVolume(folder.Write("a.mrc", bytes));
  ExpectForeignValues(volume);
  ExpectNear(volume.geometry.spacing, { 1e-6, 2e-6, 1e-6 }, 1e-15);
  EXPECT_TRUE(HasNote(volume.warnings, "not the distance between slices"));
  bytes.replace(4 * 11, 4, Raw<float>(0));
  EXPECT_EQ(ReadLabelVolume(folder.Write("a.mrc", bytes)).geometry.unit, SpatialUnit::Voxels);
}
