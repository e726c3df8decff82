// The voxel size of TIFF files, and hyperstacks: what programs for microscopes write into tags and descriptions.

#include "ScanBytes.h"

#include <cstdlib>
#include <sys/resource.h>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

constexpr std::uint16_t kXResolution = 282;
constexpr std::uint16_t kYResolution = 283;
constexpr std::uint16_t kResolutionUnit = 296;

/** Pages of 2 x 1 pixels; page p holds value p + 1. */
std::vector<TiffPage>
Pages(std::size_t count, const std::string & description = "")
{
  std::vector<TiffPage> pages(count);
  for (std::size_t p = 0; p < count; ++p)
  {
    pages[p].width = 2;
    pages[p].height = 1;
    pages[p].parts = { std::string(2, static_cast<char>(p + 1)) };
  }
  pages[0].description = description;
  return pages;
}

/** Dots a unit (1: none, 2: inch, 3: cm) on every page. */
std::vector<TiffPage>
WithResolution(std::vector<TiffPage> pages, std::uint32_t unit, double x, double y)
{
  for (TiffPage & page : pages)
  {
    page.more = { { kResolutionUnit, unit } };
    page.rationals = { { kXResolution, x }, { kYResolution, y } };
  }
  return pages;
}

std::string
Ome(const std::string & attributes, const std::string & inside = "")
{
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?><OME xmlns=\"http://www.openmicroscopy.org/Schemas/OME/2016-06\">"
         "<Image ID=\"Image:0\"><Pixels ID=\"Pixels:0\" Type=\"uint8\" SizeX=\"2\" SizeY=\"1\" " +
         attributes + ">" + inside + "</Pixels></Image></OME>";
}

class TiffSpacing : public ::testing::Test
{
protected:
  LabelMap
  Read(const std::vector<TiffPage> & pages, const ReadOptions & options = {}) const
  {
    return ReadLabelVolume(m_Folder.Write("a.tif", Tiff(pages)), options);
  }

  void
  ExpectSpacing(const std::vector<TiffPage> & pages, const Vector3 & spacing) const
  {
    const LabelMap volume = Read(pages);
    for (std::size_t a = 0; a < 3; ++a)
    {
      EXPECT_DOUBLE_EQ(volume.geometry.spacing[a], spacing[a]) << pages[0].description;
    }
    EXPECT_TRUE(volume.warnings.empty()) << volume.warnings[0];
    EXPECT_TRUE(HasNote(volume.notes, "the voxel size is from "));
  }

  void
  ExpectUnknown(const std::vector<TiffPage> & pages) const
  {
    const LabelMap volume = Read(pages);
    ExpectNear(volume.geometry.spacing, { 1, 1, 1 });
    ASSERT_EQ(volume.warnings.size(), 1U);
    EXPECT_EQ(volume.warnings[0],
              "a.tif: no voxel size in the file: all lengths are in voxels. Give the true size with --spacing X,Y,Z.");
    ReadOptions given;
    given.spacing = Vector3{ 0.5, 0.5, 2 };
    const LabelMap scaled = Read(pages, given);
    ExpectNear(CentreOf(scaled, 1, 0, 1), { 0.5, 0, 2 });
    EXPECT_TRUE(scaled.warnings.empty());
  }

  const TempFolder m_Folder;
};

} // namespace

TEST_F(TiffSpacing, OfImageJIsReadInEveryUnit)
{
  const std::vector<std::pair<std::string, double>> units{
    { "micron", 1e-3 }, { "um", 1e-3 },      { "\\u00B5m", 1e-3 },  { "\xC2\xB5m", 1e-3 },
    { "\xB5m", 1e-3 },  { "microns", 1e-3 }, { "nm", 1e-6 },        { "mm", 1 },
    { "cm", 10 },       { "inch", 25.4 },    { "millimeter", 1.0 },
  };
  for (const auto & [unit, mm] : units)
  {
    const std::string text = "ImageJ=1.53t\nimages=3\nslices=3\nunit=" + unit + "\nspacing=5.0\nloop=false\n";
    ExpectSpacing(WithResolution(Pages(3, text), 1, 0.5, 0.25), { 2 * mm, 4 * mm, 5 * mm });
  }
  // Seven digits of a fraction stand for 0.3, and depth may have a unit of its own or run downwards.
  ExpectSpacing(WithResolution(Pages(2, "ImageJ=1.53t\nunit=um\nzunit=nm\nspacing=-300\n"), 1, 3.333333, 3.333333),
                { 3e-4, 3e-4, 3e-4 });
}

TEST_F(TiffSpacing, OfImageJWithoutAUnitIsUnknown)
{
  for (const std::string unit : { "", "unit=pixel\n", "unit=\n", "unit=parsec\n" })
  {
    ExpectUnknown(WithResolution(Pages(2, "ImageJ=1.53t\nslices=2\n" + unit + "spacing=5.0\n"), 1, 0.5, 0.5));
  }
}

TEST_F(TiffSpacing, OfOmeIsReadWithItsUnits)
{
  const std::string axes = "DimensionOrder=\"XYZCT\" SizeC=\"1\" SizeZ=\"2\" SizeT=\"1\" ";
  ExpectSpacing(Pages(2, Ome(axes + "PhysicalSizeX=\"2.0\" PhysicalSizeY=\"3\" PhysicalSizeZ=\"5\"")),
                { 2e-3, 3e-3, 5e-3 });
  ExpectSpacing(Pages(2,
                      Ome(axes + "PhysicalSizeX=\"200\" PhysicalSizeXUnit=\"nm\" PhysicalSizeY='0.3' "
                                 "PhysicalSizeYUnit='&#181;m' PhysicalSizeZ=\"5\" PhysicalSizeZUnit=\"mm\"")),
                { 2e-4, 3e-4, 5 });
  ExpectUnknown(Pages(2, Ome(axes + "PhysicalSizeX=\"2\" PhysicalSizeXUnit=\"pixel\" PhysicalSizeY=\"3\"")));
  // Elements within others, prefixes, and words that are none of them.
  ExpectSpacing(Pages(2,
                      "<ome:OME><ome:Image Name='Pixels '><Pixelset/><a b='c:Pixels '/><ome:Pixels "
                      "PhysicalSizeX='2' PhysicalSizeY='3' PhysicalSizeZ='5'/></ome:Image></ome:OME>"),
                { 2e-3, 3e-3, 5e-3 });
  ExpectUnknown(Pages(2, Ome(axes + "PhysicalSizeX=\"0\" PhysicalSizeY=\"3\"")));
  ExpectUnknown(Pages(2, Ome(axes + "PhysicalSizeX=\"inf\" PhysicalSizeY=\"3\"")));
  ExpectUnknown(Pages(2, Ome(axes + "PhysicalSizeX=\"2\"")));
  ExpectUnknown(Pages(2, "<OME><Pixels PhysicalSizeX=\"2"));
  ExpectUnknown(Pages(2, "<OME><Pixels"));
  ExpectUnknown(Pages(2, "<OME"));
  ExpectUnknown(Pages(2, "<OME><Pixels PhysicalSizeX="));
}

TEST_F(TiffSpacing, OfOmeWithoutEndsOfElementsTakesMemoryLikeTheFile)
{
  std::string text = "<OME><Pixels PhysicalSizeX='2' PhysicalSizeY='3' PhysicalSizeZ='5'/>";
  for (int i = 0; i < 20000; ++i)
  {
    text += "<TiffData a" + std::to_string(i) + "=''";
  }
  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  ExpectSpacing(Pages(2, text), { 0.002, 0.003, 0.005 });
  rusage after{};
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 100 << 10);
}

TEST_F(TiffSpacing, OfResolutionTagsSaysNothingAboutSlices)
{
  const LabelMap cm = Read(WithResolution(Pages(2), 3, 1000, 500));
  ExpectNear(cm.geometry.spacing, { 0.01, 0.02, 0.01 }, 1e-12);
  ASSERT_EQ(cm.warnings.size(), 1U);
  EXPECT_EQ(
    cm.warnings[0],
    "a.tif: the file gives the size of a pixel (0.01 x 0.02 mm) but not the distance between slices; 0.01 mm is "
    "assumed. Give --spacing X,Y,Z.");
  EXPECT_TRUE(HasNote(cm.notes, "resolution tags (1000 dots a cm)"));
  ExpectNear(Read(WithResolution(Pages(2), 2, 2540, 2540)).geometry.spacing, { 0.01, 0.01, 0.01 }, 1e-12);
}

TEST_F(TiffSpacing, OfImageJWithoutAUnitIsThatOfTheTagsWithItsDepth)
{
  const std::string text = "ImageJ=1.53t\nslices=2\nspacing=5.0\n";
  ExpectSpacing(WithResolution(Pages(2, text), 3, 1000, 500), { 0.01, 0.02, 50 });
  ExpectSpacing(WithResolution(Pages(2, text), 2, 254, 508), { 0.1, 0.05, 127 });
  // Without a resolution a pixel is one unit wide.
  ExpectSpacing(Pages(2, text + "unit=mm\n"), { 1, 1, 5 });
}

TEST_F(TiffSpacing, ResolutionsOfScreensAndPrintersAreNone)
{
  for (const double dots : { 72.0, 96.0, 150.0, 300.0, 600.0 })
  {
    ExpectUnknown(WithResolution(Pages(2), 2, dots, dots));
    EXPECT_TRUE(HasNote(Read(WithResolution(Pages(2), 2, dots, dots)).notes, "for screens or printers"));
  }
  ExpectUnknown(WithResolution(Pages(2), 3, 28.346, 28.346)); // 72 dots an inch
  ExpectUnknown(WithResolution(Pages(2), 3, 118.11, 118.11)); // 300
  ExpectUnknown(WithResolution(Pages(2), 2, 1, 1));
  ExpectUnknown(WithResolution(Pages(2), 1, 250, 250));
  ExpectUnknown(WithResolution(Pages(2), 2, 0, 0));
  ExpectUnknown(WithResolution(Pages(2), 2, 500, 0));
  // One that no printer has along y is a voxel's.
  EXPECT_EQ(Read(WithResolution(Pages(2), 2, 300, 317.5)).geometry.spacing[1], 0.08);
}

TEST_F(TiffSpacing, SurvivesOurOwnWriter)
{
  for (const Vector3 & spacing : { Vector3{ 0.012, 0.012, 0.05 }, Vector3{ 0.7, 0.3, 2.5 }, Vector3{ 1, 1, 1 } })
  {
    ImageGeometry geometry;
    geometry.size = { 3, 2, 4 };
    geometry.spacing = spacing;
    LabelMap first = Read(Pages(4));
    for (const bool compress : { true, false })
    {
      WriteLabelVolume(m_Folder / "b.tif", geometry, first.labels, compress);
      const LabelMap volume = ReadLabelVolume(m_Folder / "b.tif");
      for (std::size_t a = 0; a < 3; ++a)
      {
        EXPECT_DOUBLE_EQ(volume.geometry.spacing[a], spacing[a]);
      }
      EXPECT_TRUE(volume.warnings.empty());
      EXPECT_EQ(AllValues(volume)[7], 2);
    }
  }
}

TEST_F(TiffSpacing, SlicesStateItTogetherOrAreRefused)
{
  const auto slice = [](double dots, int value) {
    auto page = WithResolution(Pages(1), 3, dots, dots);
    page[0].parts = { std::string(2, static_cast<char>(value)) };
    return Tiff(page);
  };
  m_Folder.Write("s/1.tif", slice(1000, 1));
  m_Folder.Write("s/2.tif", slice(1000, 1));
  EXPECT_DOUBLE_EQ(ReadLabelVolume(m_Folder / "s").geometry.spacing[0], 0.01);
  EXPECT_TRUE(HasNote(ReadLabelVolume(m_Folder / "s").warnings, "s: the file gives the size of a pixel"));
  m_Folder.Write("s/3.tif", slice(500, 1));
  ExpectRefused(m_Folder / "s", { "3.tif", "another voxel size", "--spacing" });
  ReadOptions given;
  given.spacing = Vector3{ 1, 1, 1 };
  EXPECT_EQ(ReadLabelVolume(m_Folder / "s", given).geometry.size[2], 3);
}

TEST_F(TiffSpacing, HyperstacksGiveTheChannelAndFrameChosen)
{
  // Twelve pages: in ImageJ the channel is the fastest, then the slice; in OME as it says.
  const std::string imagej = "ImageJ=1.53t\nimages=12\nchannels=2\nslices=3\nframes=2\nhyperstack=true\nunit=um\n";
  const std::string sizes = "SizeC=\"2\" SizeZ=\"3\" SizeT=\"2\" PhysicalSizeX=\"1\" PhysicalSizeY=\"1\" ";
  ReadOptions       options;
  options.component = 1;
  options.volume = 1;
  const auto values = [&](const std::string & description) {
    std::vector<std::int64_t> found;
    const LabelMap            volume = Read(Pages(12, description), options);
    for (int z = 0; z < volume.geometry.size[2]; ++z)
    {
      found.push_back(ValueAt(volume, 0, 0, z));
    }
    return found;
  };
  EXPECT_EQ(values(imagej), (std::vector<std::int64_t>{ 8, 10, 12 }));
  EXPECT_EQ(values(Ome(sizes + "DimensionOrder=\"XYCZT\"")), (std::vector<std::int64_t>{ 8, 10, 12 }));
  EXPECT_EQ(values(Ome(sizes + "DimensionOrder=\"XYZCT\"")), (std::vector<std::int64_t>{ 10, 11, 12 }));
  EXPECT_EQ(values(Ome(sizes + "DimensionOrder=\"XYTCZ\"")), (std::vector<std::int64_t>{ 4, 8, 12 }));

  const auto refused = [&](const std::string & description, const std::vector<std::string> & texts) {
    ExpectRefused(m_Folder.Write("a.tif", Tiff(Pages(12, description))), texts, options);
  };
  options.component = 2;
  refused(imagej, { "there is no channel 2, it has 2", "--component 1" });
  options.component = 0;
  options.volume = 2;
  refused(imagej, { "there is no time point 2" });
  options = {};
  refused(imagej, { "hyperstack of ImageJ with 2 channels", "--component 0 to --component 1" });
  options.component = 0;
  refused(imagej, { "2 time points", "--volume 0 to --volume 1" });
  options.volume = 0;
  refused("ImageJ=1.53t\nimages=12\nchannels=5\nslices=2\n", { "5 channels", "12 pages" });
  refused(Ome(sizes + "DimensionOrder=\"XYQQQ\""), { "do not fit" });
  refused(Ome(sizes + "DimensionOrder=\"XYCZT\"", "<TiffData IFD=\"1\" FirstC=\"0\" FirstZ=\"1\"/>"), { "do not fit" });
  refused(Ome(sizes + "DimensionOrder=\"X\""), { "do not fit" });
  refused(Ome("SizeC=\"2\" SizeZ=\"7\" DimensionOrder=\"XYCZT\""), { "do not fit" });
  refused("ImageJ=1.53t\nchannels=24\n", { "24 channels" });
  EXPECT_EQ(
    Read(Pages(12, Ome(sizes + "DimensionOrder=\"XYCZT\"", "<TiffData/><TiffData IFD=\"4\" FirstZ=\"2\"/>")), options)
      .geometry.size[2],
    3);
  refused(Ome("SizeC=\"4294967296\" SizeT=\"4294967296\""), { "do not fit" });
  refused(Ome(sizes) + Ome(sizes), { "2 images" });
}

TEST_F(TiffSpacing, ReadsWhatTifffileWrote)
{
  const char * folder = std::getenv("VOXELCORE_TEST_DATA");
  const auto   faults = std::filesystem::path(folder == nullptr ? "" : folder) / "faults";
  if (folder == nullptr || !std::filesystem::exists(faults / "ij2.tif"))
  {
    GTEST_SKIP() << "no faults/ij2.tif in VOXELCORE_TEST_DATA";
  }
  EXPECT_EQ(ReadLabelVolume(faults / "ij2.tif").geometry.spacing, (Vector3{ 0.002, 0.002, 0.005 }));
  EXPECT_EQ(ReadLabelVolume(faults / "ij3.ome.tif").geometry.spacing, (Vector3{ 0.002, 0.002, 0.005 }));
  EXPECT_EQ(ReadLabelVolume(faults / "cm.tif").geometry.spacing, (Vector3{ 0.01, 0.01, 0.01 }));
}
