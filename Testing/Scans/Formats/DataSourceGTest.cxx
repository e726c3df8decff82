// Voxels beside a header or behind it, packed or as text: what NRRD and MetaImage share.

#include "NrrdFixtures.h"

#include <algorithm>

namespace voxelcore::testing::nrrd
{

namespace
{

const std::string kData = RawAll<std::uint8_t>(kValues);
// The same, as bzip2 itself packs them.
const std::string kBzip2(
  "\x42\x5A\x68\x39\x31\x41\x59\x26\x53\x59\xF5\xFB\x7B\x4A\x00\x00\x01\x40\x00\xF8\x80\x00\x10"
  "\x20\x00\x21\xA7\xA8\xDA\x83\x00\xA2\x24\xAC\xD3\xC5\xDC\x91\x4E\x14\x24\x3D\x7E\xDE\xD2\x80",
  46);

class DataSources : public ::testing::Test
{
protected:
  std::filesystem::path
  Write(const std::vector<std::string> & lines, std::string_view data = {}) const
  {
    return m_Folder.Write("a.nrrd", Nrrd(lines, data));
  }

  const TempFolder m_Folder;
};

} // namespace

TEST_F(DataSources, NumbersAsTextAreReadAsTheTypeThatIsStated)
{
  const std::string text = "0, 1 2\r\n3\t0 +7\n0 0 0 2 2 ";
  for (const char * type :
       { "int8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float", "double", "uint8" })
  {
    SCOPED_TRACE(type);
    for (const char * encoding : { "ascii", "text", "txt" })
    {
      auto values = kValues;
      values.back() = 120;
      ExpectValues(ReadLabelVolume(Write(With(Lines(type), "encoding", encoding), text + "120\n")), values);
    }
  }
  EXPECT_TRUE(HasNote(ReadLabelVolume(Write(With(Lines(), "encoding", "text"), text + "120 5")).warnings, "longer"));
}

TEST_F(DataSources, ANumberThatTheTypeCannotHoldIsRefused)
{
  const auto refuse = [&](const std::string & type, const std::string & word) {
    SCOPED_TRACE(type + " " + word.substr(0, 20));
    ExpectRefused(Write(With(Lines(type), "encoding", "text"), "0 1 2 3 0 7 0 0 " + word + " 2 2 1"),
                  { "among its voxel values is no number of type " });
  };
  refuse("uint8", "256");
  refuse("uint8", "-1");
  refuse("int8", "128");
  refuse("int16", "-32769");
  refuse("uint16", "65536");
  refuse("int32", "2147483648");
  refuse("uint32", "4294967296");
  refuse("int64", "9223372036854775808");
  refuse("uint64", "-1");
  refuse("uint8", "1.5");
  refuse("uint8", "two");
  refuse("uint8", std::string("1\0", 2));
  refuse("uint8", std::string(100, '1'));
  refuse("float", "1,e5x");
  refuse("double", "one");
}

TEST_F(DataSources, LinesAndBytesInFrontOfTheDataArePassedOver)
{
  const auto lines = With(With(Lines(), "line skip", "2"), "byte skip", "3");
  ExpectValues(ReadLabelVolume(Write(lines, "first line\nsecond\nxyz" + kData)));
  ExpectRefused(Write(lines, "first line\nsecond\nx" + kData), { "truncated" });
  ExpectRefused(Write(lines, "no line ends here"), { "ends before the lines" });
  ExpectValues(ReadLabelVolume(Write(With(lines, "encoding", "gzip"), "1\n2\n" + Gzip("xyz" + kData))));
  // Data that end with the file, however much is in front; what is packed is unpacked to see how much.
  const auto atEnd = With(Lines(), "byte skip", "-1");
  ExpectValues(ReadLabelVolume(Write(With(atEnd, "encoding", "gzip"), Gzip("anything" + kData))));
  ExpectValues(ReadLabelVolume(Write(atEnd, "anything" + kData)));
  const auto path = m_Folder.Write("short.raw", kData.substr(1));
  EXPECT_THROW(ReadLabelVolume(Write(With(atEnd, "data file", "short.raw"))), InputError);
  EXPECT_THROW(ReadLabelVolume(Write(With(With(Lines(), "byte skip", "100"), "data file", "short.raw"))), InputError);
  m_Folder.Write("short.gz", Gzip(kData.substr(1)));
  try
  {
    ReadLabelVolume(Write(With(With(atEnd, "encoding", "gzip"), "data file", "short.gz")));
    ADD_FAILURE();
  }
  catch (const InputError & error)
  {
    EXPECT_NE(std::string(error.what()).find("short.gz: it holds 11 bytes of data, 12 are needed"), std::string::npos)
      << error.what();
  }
}

TEST_F(DataSources, PatternsCountUpAndDownWithZerosOrWithout)
{
  m_Folder.Write("s008.raw", kData.substr(6));
  m_Folder.Write("s010.raw", kData.substr(0, 6));
  m_Folder.Write("t 8.raw", kData.substr(0, 6));
  m_Folder.Write("t10.raw", kData.substr(6));
  const auto down = Write(With(Lines(), "data file", "s%03d.raw 10 8 -2"));
  ExpectValues(ReadLabelVolume(down));
  const auto absolute = Write(With(Lines(), "data file", (m_Folder / "s%03u.raw").string() + " 10 8 -2"));
  ExpectValues(ReadLabelVolume(absolute));
  ExpectValues(ReadLabelVolume(Write(With(Lines(), "data file", "t%2i.raw 8 10 2"))));
}

TEST_F(DataSources, PatternsAndListsWithoutSenseAreRefused)
{
  for (const char * pattern : { "s%x.raw 1 2 1",
                                "s%d.raw 1 2 0",
                                "s%d.raw 1 2 -1",
                                "s%d.raw one 2 1",
                                "s%d.raw 1 two 1",
                                "s%d.raw 1 2 three",
                                "s%d.raw -2000000 0 1",
                                "s%d.raw -9223372036854775808 0 -1", // ended the program
                                "s%d.raw 0 -9223372036854775808 -1",
                                "s%d.raw 1 2 -9223372036854775808",
                                "s%d.raw 1 2 2000000",
                                "s%33d.raw 1 2 1",
                                "s%999999999999d.raw 1 2 1",
                                "s% 1 2 1",
                                "s%0 1 2 1" })
  {
    SCOPED_TRACE(pattern);
    ExpectRefused(Write(With(Lines(), "data file", pattern)), { "pattern" });
  }
  ExpectRefused(Write(With(Lines(), "data file", "LIST")), { "names no data file" });
  m_Folder.Write("a", kData);
  ExpectRefused(Write(With(Lines(), "data file", "LIST\na\na\na\na\na")), { "its 5 data files", "equal share" });
}

TEST_F(DataSources, OutsideTheHeadersFolderAreWarnedOf)
{
  m_Folder.Write("all.raw", kData);
  const auto below = m_Folder.Write("d/a.nhdr", Nrrd(With(Lines(), "data file", "../all.raw"), {}));
  EXPECT_TRUE(HasNote(ReadLabelVolume(below).warnings, "outside the header's folder"));
  EXPECT_TRUE(ReadLabelVolume(Write(With(Lines(), "data file", "d/../all.raw"))).warnings.empty());
}

TEST_F(DataSources, OutsideTheHeadersFolderThroughALinkAreWarnedOf)
{
  namespace fs = std::filesystem;
  m_Folder.Write("away/all.raw", kData);
  m_Folder.Write("d/own.raw", kData);
  const auto warned = [&](const std::string & header, const std::string & data) {
    const auto path = m_Folder.Write(header, Nrrd(With(Lines(), "data file", data), {}));
    return HasNote(ReadLabelVolume(path).warnings, "outside the header's folder");
  };
  fs::create_symlink("../away/all.raw", m_Folder / "d/link.raw");
  fs::create_directory_symlink("../away", m_Folder / "d/folder");
  fs::create_symlink("own.raw", m_Folder / "d/within.raw");
  EXPECT_TRUE(warned("d/a.nhdr", "link.raw"));
  EXPECT_TRUE(warned("d/a.nhdr", "folder/all.raw"));
  EXPECT_TRUE(warned("d/a.nhdr", "folder/../away/all.raw"));
  EXPECT_FALSE(warned("d/a.nhdr", "within.raw"));
  EXPECT_FALSE(warned("d/a.nhdr", "own.raw"));
  // The folder itself may be reached through a link.
  fs::create_directory_symlink("d", m_Folder / "also");
  EXPECT_FALSE(warned("also/a.nhdr", "own.raw"));
  EXPECT_FALSE(warned("also/a.nhdr", (m_Folder / "d/own.raw").string()));
  m_Folder.Write("d/a.mhd",
                 "NDims = 3\nDimSize = 3 2 2\nElementSpacing = 1 1 1\nElementType = MET_UCHAR\n"
                 "ElementDataFile = link.raw\n");
  EXPECT_TRUE(HasNote(ReadLabelVolume(m_Folder / "d/a.mhd").warnings, "outside the header's folder"));
}

TEST_F(DataSources, AScanInOneFileIsReadThroughALinkWithoutAWord)
{
  m_Folder.Write("d/whole.nrrd", Nrrd(Lines(), kData));
  std::filesystem::create_symlink("d/whole.nrrd", m_Folder / "link.nrrd");
  EXPECT_TRUE(ReadLabelVolume(m_Folder / "link.nrrd").warnings.empty());
}

TEST_F(DataSources, OfSeveralFilesGiveTheVolumeThatIsChosen)
{
  auto lines = With(With(Lines(), "dimension", "4"), "sizes", "3 2 2 2");
  lines = With(With(lines, "kinds", "domain domain domain time"), "space directions", "(1,0,0) (0,1,0) (0,0,1) none");
  m_Folder.Write("1", std::string(6, '\5'));
  m_Folder.Write("2", std::string(6, '\5'));
  m_Folder.Write("3", kData.substr(0, 6));
  m_Folder.Write("4", kData.substr(6));
  ReadOptions options;
  options.volume = 1;
  const auto path = Write(With(lines, "data file", "%d 1 4 1"));
  ExpectValues(ReadLabelVolume(path, options));
  // Files of eight bytes begin in the middle of a slice.
  m_Folder.Write("1", std::string(8, '\5'));
  m_Folder.Write("2", std::string(4, '\5') + kData.substr(0, 4));
  m_Folder.Write("3", kData.substr(4));
  ExpectValues(ReadLabelVolume(Write(With(lines, "data file", "%d 1 3 1")), options));
  // A file that cannot be passed over as a whole is looked at to its end.
  options.volume = 0;
  EXPECT_EQ(ReadLabelVolume(path, options).labels.size(), 1U);
}

TEST_F(DataSources, OfSeveralFilesThatAreTooLongAreReported)
{
  for (const std::size_t longer : { 0U, 1U })
  {
    m_Folder.Write("1", kData.substr(0, 6) + (longer == 0 ? "surplus" : ""));
    m_Folder.Write("2", kData.substr(6) + (longer == 1 ? "surplus" : ""));
    const LabelMap volume = ReadLabelVolume(Write(With(Lines(), "data file", "%d 1 2 1")));
    ExpectValues(volume);
    EXPECT_TRUE(HasNote(volume.warnings, "longer than its header says")) << longer;
  }
}

TEST_F(DataSources, PackedMembersFollowEachOtherAndPaddingIsNone)
{
  const auto bzip2 = With(Lines(), "encoding", "bz2");
  auto       two = With(With(With(bzip2, "sizes", "3 2 4"), "kinds", ""), "space origin", "(0,0,0)");
  auto       twice = kValues;
  twice.insert(twice.end(), kValues.begin(), kValues.end());
  ExpectValues(ReadLabelVolume(Write(two, kBzip2 + kBzip2)), twice);
  ExpectValues(ReadLabelVolume(Write(bzip2, kBzip2 + std::string(512, '\0'))));
  ExpectValues(ReadLabelVolume(Write(With(Lines(), "encoding", "gzip"), Gzip(kData) + std::string(512, '\0'))));
  ExpectRefused(Write(two, kBzip2), { "too early" });
  std::string damaged = kBzip2;
  damaged[30] ^= 0x11;
  ExpectRefused(Write(bzip2, damaged), { "damaged" });
  ExpectRefused(Write(bzip2, "this is not of bzip2"), { "damaged" });
  const auto hex = With(Lines(), "encoding", "hex");
  ExpectValues(ReadLabelVolume(Write(hex, "00 01 02\n03\r\n00\t070000000202fa")));
  ExpectRefused(Write(hex, "00010203000700000002020"), { "middle of a byte" });
  ExpectRefused(Write(hex, "00010203000700000002020G"), { "other than hexadecimal digits" });
}

} // namespace voxelcore::testing::nrrd
