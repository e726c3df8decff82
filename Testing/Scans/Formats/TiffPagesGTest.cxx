// Pages of TIFF: kinds of pixels, places of values in a page, and files that are damaged where their pages lie.

#include "ScanBytes.h"
#include "voxelcore/Formats/FormatOpeners.h"
#include "voxelcore/Formats/VolumeWriters.h"

namespace voxelcore::testing::tiffpages
{

namespace
{

/** Two pages of 2 x 2 pixels, all their values one after the other. */
std::vector<TiffPage>
Pages(const std::string & first = "\1\2\3\4", const std::string & second = "\5\6\7\10")
{
  std::vector<TiffPage> pages(2);
  for (TiffPage & page : pages)
  {
    page.width = 2;
    page.height = 2;
  }
  pages[0].parts = { first };
  pages[1].parts = { second };
  return pages;
}

const std::vector<std::int64_t> kValues{ 1, 2, 3, 4, 5, 6, 7, 8 };

class TiffPagesOf : public ::testing::Test
{
protected:
  template <typename Change>
  std::filesystem::path
  Write(std::vector<TiffPage> pages, const Change & change) const
  {
    for (TiffPage & page : pages)
    {
      change(page);
    }
    return m_Folder.Write("a.tif", Tiff(pages));
  }
  const TempFolder m_Folder;
};

} // namespace

TEST_F(TiffPagesOf, AnyKindOfGreyAreTakenAsStored)
{
  const auto white = Write(Pages(), [](TiffPage & page) { page.photometric = 0; });
  const auto volume = ReadLabelVolume(white);
  EXPECT_EQ(AllValues(volume), kValues);
  EXPECT_TRUE(HasNote(volume.notes, "pages show 0 as white"));
  auto mixed = Pages();
  mixed[1].photometric = 0;
  EXPECT_THROW(ReadLabelVolume(m_Folder.Write("b.tif", Tiff(mixed))), InputError);
  const std::vector<int> first{ 1, 2, 3, 4 };
  const std::vector<int> second{ 5, 6, 7, 8 };
  for (const int format : { 1, 2 })
  {
    const auto wide = Write(Pages(RawAll<std::int64_t>(first), RawAll<std::int64_t>(second)), [&](TiffPage & page) {
      page.bits = 64;
      page.sampleFormat = format;
    });
    EXPECT_EQ(AllValues(ReadLabelVolume(wide)), kValues);
    EXPECT_EQ(ReadLabelVolume(wide).pixelType, format == 1 ? "uint64" : "int64");
  }
  const auto undefined = Write(Pages(), [](TiffPage & page) { page.sampleFormat = 4; });
  EXPECT_EQ(AllValues(ReadLabelVolume(undefined)), kValues);
}

TEST_F(TiffPagesOf, PixelsOfKindsThatNobodyStoresLabelsInAreRefused)
{
  const auto refuse = [&](const char * text, auto change) { ExpectRefused(Write(Pages(), change), { text }); };
  refuse("photometric kind 4", [](TiffPage & page) { page.photometric = 4; });
  refuse("16 bits (sample format 3)", [](TiffPage & page) {
    page.bits = 16;
    page.sampleFormat = 3;
  });
  refuse("4 bits (sample format 2)", [](TiffPage & page) {
    page.bits = 4;
    page.sampleFormat = 2;
  });
  refuse("sample format 5", [](TiffPage & page) {
    page.bits = 32;
    page.sampleFormat = 5;
  });
}

TEST_F(TiffPagesOf, OfSeveralValuesTheOneChosenIsRead)
{
  ReadOptions options;
  options.component = 1;
  // Side by side, of a byte, two bytes or four bits each; or in planes.
  const std::vector<int> first{ 9, 1, 9, 2, 9, 3, 9, 4 };
  const std::vector<int> second{ 9, 5, 9, 6, 9, 7, 9, 8 };
  const auto             pairs = [](TiffPage & page) { page.samples = 2; };
  EXPECT_EQ(
    AllValues(ReadLabelVolume(Write(Pages(RawAll<std::uint8_t>(first), RawAll<std::uint8_t>(second)), pairs), options)),
    kValues);
  EXPECT_EQ(AllValues(ReadLabelVolume(Write(Pages(RawAll<std::uint16_t>(first), RawAll<std::uint16_t>(second)),
                                            [](TiffPage & page) {
                                              page.samples = 2;
                                              page.bits = 16;
                                            }),
                                      options)),
            kValues);
  EXPECT_EQ(AllValues(ReadLabelVolume(Write(Pages("\x91\x92\x93\x94", "\x95\x96\x97\x98"),
                                            [](TiffPage & page) {
                                              page.samples = 2;
                                              page.bits = 4;
                                            }),
                                      options)),
            kValues);
  auto planes = Pages();
  for (TiffPage & page : planes)
  {
    page.samples = 2;
    page.more = { { 284, 2 } };
    page.parts = { std::string(4, '\11'), page.parts[0] };
  }
  EXPECT_EQ(AllValues(ReadLabelVolume(m_Folder.Write("a.tif", Tiff(planes)), options)), kValues);
  options.component = 0;
  EXPECT_EQ(ReadLabelVolume(m_Folder / "a.tif", options).labels.front().value, 9);
}

TEST_F(TiffPagesOf, AHyperstackOfColoursGivesTheValueOfAPixelThatIsChosen)
{
  const std::string ome =
    "<OME><Image><Pixels SizeX=\"2\" SizeY=\"2\" SizeZ=\"2\" SizeT=\"1\" SizeC=\"2\" "
    "DimensionOrder=\"XYCZT\"/></Image></OME>";
  for (const std::string & text : { ome, std::string("ImageJ=1.53t\nimages=2\nchannels=2\nslices=2\n") })
  {
    auto pages = Pages(std::string("\1\11\2\11\3\11\4\11"), std::string("\5\11\6\11\7\11\10\11"));
    for (TiffPage & page : pages)
    {
      page.samples = 2;
    }
    pages[0].description = text;
    ReadOptions options;
    options.component = 0;
    EXPECT_EQ(AllValues(ReadLabelVolume(m_Folder.Write("a.tif", Tiff(pages)), options)), kValues) << text;
  }
}

TEST_F(TiffPagesOf, FilesWhoseFirstDirectoryIsNoneAreRefused)
{
  const std::string bytes = Tiff(Pages());
  for (const std::uint32_t where : { 0U, 3U, 1000000U, 0xFFFFFFF0U })
  {
    std::string moved = bytes;
    moved.replace(4, 4, Raw<std::uint32_t>(where));
    ExpectRefused(m_Folder.Write("a.tif", moved), {});
  }
  std::string none = bytes; // a directory of no fields
  none.replace(4, 4, Raw<std::uint32_t>(static_cast<std::uint32_t>(none.size())));
  none += std::string(6, '\0');
  ExpectRefused(m_Folder.Write("b.tif", none), {});
  EXPECT_THROW(OpenTiff(m_Folder.Path(), {}), InputError);
}

TEST_F(TiffPagesOf, AnEndlessChainOfPagesIsRefused)
{
  // The second page's link leads to the first.
  std::string       bytes = Tiff(Pages());
  const std::string first = bytes.substr(4, 4);
  bytes.replace(bytes.size() - 4, 4, first);
  ExpectRefused(m_Folder.Write("a.tif", bytes), {});
}

TEST_F(TiffPagesOf, AFileThatChangesAfterItWasOpenedIsRefusedNotMisread)
{
  const auto path = Write(Pages(), [](TiffPage &) {});
  ScanFile   scan = OpenTiff(path, {});
  const auto size = std::filesystem::file_size(path);
  std::filesystem::resize_file(path, 12);
  std::array<std::byte, 8> got{};
  EXPECT_THROW(scan.voxels->Read(got.data(), got.size()), InputError);
  std::filesystem::resize_file(path, size); // now of zeros
  EXPECT_THROW(OpenTiff(path, {}), InputError);
}

TEST_F(TiffPagesOf, PassingOverPagesLeadsToTheSameVoxels)
{
  ScanFile  scan = OpenTiff(Write(Pages(), [](TiffPage &) {}), {});
  std::byte one{};
  scan.voxels->Read(&one, 1);
  scan.voxels->Skip(4); // into the second page
  scan.voxels->Read(&one, 1);
  EXPECT_EQ(one, std::byte{ 6 });
  EXPECT_FALSE(scan.voxels->Finish());
  scan.voxels->Skip(2);
  EXPECT_EQ(scan.voxels->ReadSome(&one, 1), 0U);
  EXPECT_THROW(scan.voxels->Skip(4), InputError);
}

} // namespace voxelcore::testing::tiffpages
