// Folders and patterns of slices: which files are meant, in which order, and what is no volume.

#include "PngBytes.h"
#include "ScanBytes.h"
#include "voxelcore/Formats/FormatOpeners.h"

namespace voxelcore::testing::slices
{

namespace
{

class SliceFiles : public ::testing::Test
{
protected:
  void
  Write(const std::string & name, int value = 1, const TiffPage & like = {}) const
  {
    TiffPage page = like;
    page.width = 3;
    page.height = 2;
    page.parts = { std::string(std::size_t{ 6 } * static_cast<unsigned>(page.samples), static_cast<char>(value)) };
    m_Folder.Write(name, Tiff({ page }));
  }
  /** Names of the slices that a pattern stands for, each followed by a blank. */
  std::string
  Found(const std::string & pattern) const
  {
    std::string names;
    for (const auto & path : SlicePaths(m_Folder / pattern))
    {
      names += path.filename().string() + " ";
    }
    return names;
  }
  const TempFolder m_Folder;
};

} // namespace

TEST_F(SliceFiles, PatternsStandForNumbersOfTheirWidthAndMore)
{
  for (const char * name : { "a8.tif", "a08.tif", "a99.tif", "a100.tif", "a1x.tif", "a.tif", "ab.tif", "a%d.tif" })
  {
    Write(name);
  }
  EXPECT_EQ(Found("a#.tif"), "a8.tif a99.tif a100.tif ");
  EXPECT_EQ(Found("a##.tif"), "a08.tif a99.tif a100.tif ");
  EXPECT_EQ(Found("a%d.tif"), "a08.tif a8.tif a99.tif a100.tif ");
  EXPECT_EQ(Found("a%02d.tif"), "a08.tif a99.tif a100.tif ");
  EXPECT_EQ(Found("a%3d*"), "a100.tif ");
  EXPECT_EQ(Found("a*x.tif"), "a1x.tif ");
  EXPECT_EQ(Found("a*1*"), "a1x.tif a100.tif ");
  for (const char * none : { "a%", "a%5", "a%x.tif", "a%000000000d.tif", "b*", "a#", "a######.tif" })
  {
    ExpectRefused(m_Folder / none, { "no TIFF, PNG, BMP or JPEG slices of this pattern" });
  }
  ExpectRefused(m_Folder / "a*b*c*d*e*", { "too many *" });
  EXPECT_THROW(OpenSlices(m_Folder / "nowhere/a*.tif", {}), InputError);
  EXPECT_THROW(OpenSlices("no-such-slice-*.tif", {}), InputError); // in the working folder
}

TEST_F(SliceFiles, WhatIsInTheFolderBesideThemIsPassedOver)
{
  for (int n = 1; n < 4; ++n)
  {
    Write("s/a" + std::to_string(n) + ".tiff", n);
  }
  Write("s/.a9.tiff");
  m_Folder.Write("s/a4.txt", "");
  std::filesystem::create_directories(m_Folder / "s/a5.tif");
  EXPECT_EQ(ReadLabelVolume(m_Folder / "s").labels.size(), 3U);
  EXPECT_TRUE(HasSlices(m_Folder / "s"));
  EXPECT_FALSE(AreSlices(m_Folder / "s/a1.tiff"));
  EXPECT_FALSE(AreSlices(m_Folder / "s/a9.tiff"));
  EXPECT_TRUE(AreSlices(m_Folder / "s/a%d.tiff"));
  EXPECT_FALSE(HasSlices(m_Folder / "s/a5.tif"));
}

TEST_F(SliceFiles, NumberedInTwoPlacesOrTwiceAreRefused)
{
  const auto refuse = [&](const std::string & folder, std::initializer_list<const char *> names, const char * text) {
    for (const char * name : names)
    {
      Write(folder + "/" + name);
    }
    ExpectRefused(m_Folder / folder, { text });
  };
  refuse("two", { "a1_1.tif", "a1_2.tif", "a2_3.tif" }, "not numbered alike");
  refuse("parts", { "a1.tif", "a1_2.tif" }, "not numbered alike");
  refuse("words", { "a1.tif", "ax.tif" }, "not numbered alike");
  refuse("long", { "a99999999999999999999.tif", "a99999999999999999998.tif" }, "not numbered alike");
  refuse("twice", { "a1.tif", "a2.tif", "a02.tif" }, "two slices have the number 2");
  refuse("gaps",
         { "1.tif", "3.tif", "5.tif", "7.tif", "9.tif", "11.tif", "13.tif" },
         "slices 2, 4, 6, 8, 10 and others are missing");
}

TEST_F(SliceFiles, UnequalOnesAreDescribed)
{
  Write("s/1.tif");
  TiffPage pair;
  pair.samples = 2;
  Write("s/2.tif", 1, pair);
  ReadOptions options;
  options.component = 0;
  try
  {
    ReadLabelVolume(m_Folder / "s", options);
    ADD_FAILURE();
  }
  catch (const InputError & error)
  {
    EXPECT_NE(std::string(error.what()).find("3 x 2, 8 bits, 2 values a pixel"), std::string::npos) << error.what();
  }
}

TEST_F(SliceFiles, OfSeveralValuesGiveTheOneThatIsChosen)
{
  for (unsigned z = 0; z < 2; ++z)
  {
    const unsigned first = 10 * z;
    PngImage       png{ .width = 2, .height = 1, .bits = 16, .colour = 2, .values = {} };
    png.values = { first, first + 1, first + 2, first + 3, first + 4, first + 5 };
    m_Folder.Write("png/" + std::to_string(z) + ".png", Png(png));
    TiffPage tiff;
    tiff.width = 2;
    tiff.height = 1;
    tiff.samples = 3;
    tiff.photometric = 2;
    tiff.parts = { RawAll<std::uint8_t>(png.values) };
    m_Folder.Write("tif/" + std::to_string(z) + ".tif", Tiff({ tiff }));
  }
  for (const char * kind : { "png", "tif" })
  {
    ReadOptions options;
    options.component = 2;
    EXPECT_EQ(AllValues(ReadLabelVolume(m_Folder / kind, options)), (std::vector<std::int64_t>{ 2, 5, 12, 15 }))
      << kind;
    options.component = 3;
    EXPECT_THROW(ReadLabelVolume(m_Folder / kind, options), InputError);
  }
}

} // namespace voxelcore::testing::slices
