// Bare voxels: what a user or a text beside them says, and a file whose size must fit.

#include "ForeignBytes.h"
#include "ScanBytes.h"

#include "voxelcore/Formats/FormatOpeners.h"

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

class RawFile : public ::testing::Test
{
protected:
  void
  ExpectForeignValues(const LabelMap & volume) const
  {
    const auto values = ForeignValues();
    EXPECT_EQ(AllValues(volume), std::vector<std::int64_t>(values.begin(), values.end()));
    EXPECT_EQ(volume.format, "raw");
  }

  const std::string m_Bytes = RawAll<std::uint8_t>(ForeignValues());
  const TempFolder  m_Folder;
};

} // namespace

TEST_F(RawFile, IsReadAsTheOptionSays)
{
  for (const auto & [layout, bytes] : std::vector<std::pair<std::string, std::string>>{
         { "6,5,4,uint8", m_Bytes },
         { "6,5,4,int16", RawAll<std::int16_t>(ForeignValues()) },
         { "6,5,4,uint32,big", RawAll<std::uint32_t>(ForeignValues(), true) },
         { " 6, 5, 4, FLOAT32, little", RawAll<float>(ForeignValues()) },
         { "6,5,4,float64,big", RawAll<double>(ForeignValues(), true) } })
  {
    SCOPED_TRACE(layout);
    ReadOptions options;
    options.raw = ParseRawLayout(layout);
    options.spacing = Vector3{ 0.5, 0.75, 2 };
    EXPECT_EQ(ParseRawLayout(RawLayoutText(*options.raw)), *options.raw);
    for (const char * name : { "a.raw", "a.vol", "a", "a.nrrd" })
    {
      const LabelMap volume = ReadLabelVolume(m_Folder.Write(name, bytes), options);
      ExpectForeignValues(volume);
      ExpectNear(volume.geometry.spacing, { 0.5, 0.75, 2 });
      EXPECT_TRUE(volume.warnings.empty());
    }
  }
  ReadOptions options;
  options.raw = ParseRawLayout("6,5,4,uint8");
  EXPECT_FALSE(ReadLabelVolume(m_Folder.Write("a.raw", m_Bytes), options).warnings.empty()); // no spacing
}

TEST_F(RawFile, HasTheSizeThatIsSaid)
{
  ReadOptions options;
  options.raw = ParseRawLayout("6,5,4,uint8");
  ExpectRefused(m_Folder.Write("a.raw", m_Bytes + "x"), { "121 bytes", "6 x 5 x 4", "are 120 bytes" }, options);
  ExpectRefused(m_Folder.Write("a.raw", m_Bytes.substr(1)), { "119 bytes", "--raw" }, options);
  options.raw = ParseRawLayout("1073741824,1073741824,1073741824,uint8");
  ExpectRefused(m_Folder.Write("a.raw", m_Bytes), {}, options);
  m_Folder.Write("b.dat", "Resolution: 6 5 3\nFormat: UCHAR\n");
  ExpectRefused(m_Folder.Write("b.raw", m_Bytes), { "6 x 5 x 3", "'b.dat'" });
  m_Folder.Write("c.txt", "DimSize = 6 5 3\nElementType = MET_UCHAR\n");
  ExpectRefused(m_Folder.Write("c.raw", m_Bytes), { "120 bytes", "describes 90", "'c.txt'" });
}

TEST_F(RawFile, OfNorthStarIsDescribedByItsDat)
{
  const std::string text =
    "ObjectFileName: scan.raw\r\nTaggedFileName: ---\r\nResolution:\t6 5 4\r\n"
    "SliceThickness:\t0.5 0.75 2\r\nFormat:\t";
  const auto raw = m_Folder.Write("scan.raw", RawAll<std::uint16_t>(ForeignValues()));
  const auto dat = m_Folder.Write("scan.dat", text + "USHORT\r\nObjectModel: I\r\n");
  for (const auto & path : { raw, dat })
  {
    const LabelMap volume = ReadLabelVolume(path);
    ExpectForeignValues(volume);
    ExpectNear(volume.geometry.spacing, { 0.5, 0.75, 2 });
    EXPECT_TRUE(HasNote(volume.notes, "SliceThickness"));
    const auto files = ScanFiles(path);
    ASSERT_EQ(files.size(), 2U);
    EXPECT_EQ(files[0], path);
  }
  m_Folder.Write("scan.dat", "Resolution: 6 5 4\nSliceThickness: 1 1 1\nFormat: USHORT\n");
  EXPECT_FALSE(ReadLabelVolume(raw).warnings.empty()); // 1 1 1 is what is written where nothing is known
  m_Folder.Write("scan.dat", "Resolution: 6 5 4\nFormat: RGBA\n");
  ExpectRefused(dat, { "Format: RGBA" });
  m_Folder.Write("scan.dat", "Resolution: 6 five 4\nFormat: USHORT\n");
  ExpectRefused(dat, { "Resolution: 6 five 4" });
  ExpectRefused(m_Folder.Write("alone.dat", "Resolution: 6 5 4\nFormat: UCHAR\n"), { "is not there" });
}

TEST_F(RawFile, IsDescribedByATextInTheMannerOfMetaImage)
{
  const std::string lines =
    "made by a program that shall not be named\nDimSize = 6 5 4\nElementSpacing = 0.5 0.75 2\n"
    "ElementType = MET_SHORT\nElementByteOrderMSB = True\n";
  for (const char * name : { "a.txt", "a.info", "a.raw.txt" })
  {
    SCOPED_TRACE(name);
    const TempFolder folder;
    folder.Write(name, lines);
    const auto     path = folder.Write("a.raw", RawAll<std::int16_t>(ForeignValues(), true));
    const LabelMap volume = ReadLabelVolume(path);
    ExpectForeignValues(volume);
    ExpectNear(volume.geometry.spacing, { 0.5, 0.75, 2 });
    EXPECT_EQ(ScanFiles(path).size(), 2U);
  }
  m_Folder.Write("b.txt", "7 voxels wide, says my notebook\n");
  ExpectRefused(m_Folder.Write("b.raw", m_Bytes), { "bare voxels without a header", "--raw 512,512,300,uint16" });
}

TEST_F(RawFile, NamesItsTextOrTheTextItsVoxels)
{
  using Paths = std::vector<std::filesystem::path>;
  const std::string dat = "Resolution: 6 5 4\nFormat: UCHAR\n";
  for (const char * extension : { ".raw", ".vol", ".bin" })
  {
    SCOPED_TRACE(extension);
    const TempFolder folder;
    const auto       voxels = folder.Write(std::string("a") + extension, m_Bytes);
    EXPECT_FALSE(IsRawFile(voxels));
    EXPECT_TRUE(RawFileTexts(voxels).empty());
    const auto text = folder.Write("a.dat", dat);
    EXPECT_TRUE(IsRawFile(text));
    EXPECT_TRUE(IsRawFile(voxels));
    EXPECT_EQ(RawFileTexts(text), Paths{ voxels });
    EXPECT_EQ(RawFileTexts(voxels), Paths{ text });
    ExpectForeignValues(ReadLabelVolume(text));
  }
  // A name that leads nowhere is passed over; a .dat may be the voxels, too.
  m_Folder.Write("b.vol", m_Bytes);
  EXPECT_EQ(RawFileTexts(m_Folder.Write("b.dat", "ObjectFileName: gone.raw\n" + dat)), Paths{ m_Folder / "b.vol" });
  const auto bare = m_Folder.Write("c.dat", m_Bytes);
  EXPECT_FALSE(IsRawFile(bare));
  m_Folder.Write("c.dat.txt", "DimSize = 6 5 4\nElementType = MET_UCHAR\n");
  EXPECT_TRUE(IsRawFile(bare));
  ExpectForeignValues(ReadLabelVolume(bare));
  EXPECT_FALSE(IsRawFile(m_Folder.Write("d.dat", "Resolution: 6 5 4\n" + std::string(70000, ' '))));
  EXPECT_FALSE(IsRawFile(m_Folder.Write("e.dat", "Format: UCHAR\nno colon here\n")));
  EXPECT_FALSE(IsRawFile(m_Folder / "nowhere.dat"));
  EXPECT_FALSE(IsRawFile(m_Folder.Write("f.xyz", m_Bytes)));
}

TEST_F(RawFile, OfADatWithoutSenseIsRefused)
{
  m_Folder.Write("a.raw", m_Bytes);
  const auto read = [&](const std::string & more) {
    return m_Folder.Write("a.dat", "Resolution: 6 5 4\nFormat: UCHAR\n" + more);
  };
  ExpectRefused(m_Folder.Write("a.dat", "Resolution: 6 5\nFormat: UCHAR\n"), { "Resolution: 6 5" });
  for (const char * none : { "SliceThickness: 1 2\n", "SliceThickness: a b c\n", "" })
  {
    EXPECT_EQ(ReadLabelVolume(read(none)).geometry.unit, SpatialUnit::Voxels) << none;
  }
  ReadOptions options;
  options.volume = 1;
  ExpectRefused(read(""), { "no volume 1" }, options);
}

TEST_F(RawFile, OfATextThatSaysWhereTheVoxelsBeginIsHeldAgainstIt)
{
  const std::string text = "DimSize = 6 5 4\nElementType = MET_UCHAR\nHeaderSize = ";
  const auto        path = m_Folder.Write("a.raw", "head" + m_Bytes);
  m_Folder.Write("a.txt", text + "4\n");
  ExpectForeignValues(ReadLabelVolume(path));
  m_Folder.Write("a.txt", text + "-1\n");
  ExpectForeignValues(ReadLabelVolume(path));
  m_Folder.Write("a.txt", text + "3\n");
  ExpectRefused(path, { "it has 124 bytes, but its text describes 123" });
  m_Folder.Write("a.txt", "NDims = 4\n" + text + "4\n");
  ExpectRefused(path, { "DimSize should have 4 numbers" });
}
