#include "ScanBytes.h"

#include <algorithm>
#include <random>

namespace voxelcore::testing::tiff
{

namespace
{

const std::vector<int> kValues{ 0, 1, 2, 3, 0, 7, 0, 0, 0, 2, 2, 120 }; // 3 x 2 x 2

void
ExpectValues(const LabelMap & volume)
{
  EXPECT_EQ(AllValues(volume), std::vector<std::int64_t>(kValues.begin(), kValues.end()));
}

/** Two pages of 3 x 2 pixels of kValues. */
template <typename T>
std::vector<TiffPage>
Pages(int sampleFormat, bool big = false)
{
  std::vector<TiffPage> pages(2);
  for (std::size_t p = 0; p < 2; ++p)
  {
    pages[p].width = 3;
    pages[p].height = 2;
    pages[p].bits = 8 * sizeof(T);
    pages[p].sampleFormat = sampleFormat;
    const auto begin = kValues.begin() + static_cast<std::ptrdiff_t>(6 * p);
    pages[p].parts = { RawAll<T>(std::vector<int>(begin, begin + 6), big) };
  }
  return pages;
}

std::string
Slice(int value, std::uint32_t width = 3, int bits = 8)
{
  TiffPage page;
  page.width = width;
  page.height = 2;
  page.bits = bits;
  page.parts = { std::string(width * 2U * static_cast<unsigned>(bits) / 8U, static_cast<char>(value)) };
  return Tiff({ page });
}

} // namespace

TEST(Tiff, TypesByteOrdersAndOffsetSizes)
{
  const TempFolder folder;
  for (const bool big : { false, true })
  {
    for (const bool wide : { false, true })
    {
      const auto check = [&](const std::vector<TiffPage> & pages, const std::string & type) {
        const LabelMap volume = ReadLabelVolume(folder.Write("a.tif", Tiff(pages, { big, wide })));
        ExpectValues(volume);
        EXPECT_EQ(volume.pixelType, type);
        EXPECT_EQ(volume.format, "TIFF");
      };
      check(Pages<std::uint8_t>(1, big), "uint8");
      check(Pages<std::int8_t>(2, big), "int8");
      check(Pages<std::uint16_t>(1, big), "uint16");
      check(Pages<std::int16_t>(2, big), "int16");
      check(Pages<std::uint32_t>(1, big), "uint32");
      check(Pages<std::int32_t>(2, big), "int32");
      check(Pages<float>(3, big), "float32");
      check(Pages<double>(3, big), "float64");
    }
  }
}

TEST(Tiff, CompressionsAndStrips)
{
  const TempFolder folder;
  const auto       packed = [&](int compression, std::string (*pack)(std::string_view)) {
    auto pages = Pages<std::uint16_t>(1);
    for (TiffPage & page : pages)
    {
      page.compression = compression;
      page.rowsPerStrip = 1;
      const std::string raw = page.parts[0];
      page.parts = { pack(raw.substr(0, 6)), pack(raw.substr(6)) };
    }
    ExpectValues(ReadLabelVolume(folder.Write("a.tif", Tiff(pages))));
  };
  packed(1, [](std::string_view bytes) { return std::string(bytes); });
  packed(5, Lzw);
  packed(8, Zlib);
  packed(32946, Zlib);
  packed(32773, PackBits);
}

TEST(Tiff, PackedBitsAreUnpacked)
{
  const TempFolder      folder;
  std::vector<TiffPage> pages(2);
  for (TiffPage & page : pages)
  {
    page.width = 11;
    page.height = 2;
    page.bits = 1;
    page.parts = { std::string("\x80\x20\x01\x40", 4) }; // pixels 0 and 10 of row 0; 7 and 9 of row 1
  }
  const LabelMap volume = ReadLabelVolume(folder.Write("a.tif", Tiff(pages)));
  ASSERT_EQ(volume.labels.size(), 1U);
  EXPECT_EQ(volume.pixelType, "uint1");
  EXPECT_EQ(volume.labels[0].voxels, 8U);
  for (const int z : { 0, 1 })
  {
    EXPECT_TRUE(volume.labels[0].shape.Contains(0, 0, z));
    EXPECT_TRUE(volume.labels[0].shape.Contains(10, 0, z));
    EXPECT_TRUE(volume.labels[0].shape.Contains(7, 1, z));
    EXPECT_TRUE(volume.labels[0].shape.Contains(9, 1, z));
  }
  for (TiffPage & page : pages)
  {
    page.width = 3;
    page.bits = 4;
    page.parts = { std::string("\x12\x30\x4F\x00", 4) };
  }
  EXPECT_EQ(AllValues(ReadLabelVolume(folder.Write("b.tif", Tiff(pages)))),
            (std::vector<std::int64_t>{ 1, 2, 3, 4, 15, 0, 1, 2, 3, 4, 15, 0 }));
}

TEST(Tiff, TilesGiveTheSameValuesAsStrips)
{
  const TempFolder          folder;
  constexpr std::uint32_t   width = 37;
  constexpr std::uint32_t   height = 21;
  std::mt19937              random(7);
  std::vector<TiffPage>     pages(2);
  std::vector<std::int64_t> expected;
  for (TiffPage & page : pages)
  {
    std::vector<int> values(std::size_t{ width } * height);
    for (int & value : values)
    {
      value = static_cast<int>(random() % 5);
    }
    expected.insert(expected.end(), values.begin(), values.end());
    page.width = width;
    page.height = height;
    page.bits = 16;
    page.compression = 8;
    page.tileWidth = 16;
    page.tileHeight = 32; // beyond the page
    for (std::uint32_t left = 0; left < width; left += 16)
    {
      std::string tile;
      for (std::uint32_t y = 0; y < 32; ++y)
      {
        for (std::uint32_t x = left; x < left + 16; ++x)
        {
          // What lies beyond the page must not be read.
          const bool inside = x < width && y < height;
          tile += Raw<std::uint16_t>(static_cast<std::uint16_t>(inside ? values[std::size_t{ y } * width + x] : 99));
        }
      }
      page.parts.push_back(Zlib(tile));
    }
  }
  EXPECT_EQ(AllValues(ReadLabelVolume(folder.Write("a.tif", Tiff(pages)))), expected);
}

TEST(Tiff, MoreThan65535PagesAreAllRead)
{
  const TempFolder      folder;
  std::vector<TiffPage> pages(66000);
  for (TiffPage & page : pages)
  {
    page.width = 1;
    page.height = 1;
    page.parts = { std::string(1, '\0') };
  }
  pages[65999].parts = { "\3" };
  pages[65536].parts = { "\2" };
  const LabelMap volume = ReadLabelVolume(folder.Write("a.tif", Tiff(pages)));
  EXPECT_EQ(volume.geometry.size[2], 66000);
  ASSERT_EQ(volume.labels.size(), 2U);
  EXPECT_TRUE(volume.labels[0].shape.Contains(0, 0, 65536));
  EXPECT_TRUE(volume.labels[1].shape.Contains(0, 0, 65999));
}

TEST(TiffBad, WhatIsNoVolumeOfWholeNumbersIsRefused)
{
  const TempFolder folder;
  const auto       refuse = [&](std::vector<TiffPage> pages, const std::vector<std::string> & texts, auto change) {
    for (TiffPage & page : pages)
    {
      change(page);
    }
    ExpectRefused(folder.Write("a.tif", Tiff(pages)), texts);
  };
  const auto pages = Pages<std::uint8_t>(1);
  refuse(pages, { "colour" }, [](TiffPage & page) {
    page.samples = 3;
    page.photometric = 2;
    page.parts[0] += page.parts[0] + page.parts[0];
  });
  refuse(pages, { "palette" }, [](TiffPage & page) { page.photometric = 3; });
  refuse(pages, { "12 bits" }, [](TiffPage & page) { page.bits = 12; });
  refuse(pages, { "orientation 4" }, [](TiffPage & page) { page.more = { { 274, 4 } }; });
  refuse(pages, { "truncated" }, [](TiffPage & page) { page.parts[0].pop_back(); });
  refuse(Pages<std::int16_t>(2), { "-257", "(0,0,0)", "--threshold" }, [](TiffPage & page) {
    page.parts[0].replace(0, 2, "\xFF\xFE");
  });
  refuse(Pages<float>(3), { "0.25", "(1,0,0)" }, [](TiffPage & page) {
    page.parts[0].replace(4, 4, Raw<float>(0.25F));
  });
  auto unequal = pages;
  unequal[1].width = 2;
  ExpectRefused(folder.Write("b.tif", Tiff(unequal)), { "page 2", "2 x 2", "3 x 2" });
  auto hyper = pages;
  hyper[0].description = "ImageJ=1.53t\nimages=5000\nslices=5000\n";
  ExpectRefused(folder.Write("d.tif", Tiff(hyper)), { "5000" });
  hyper[0].description = "ImageJ=1.53t\nimages=2\nslices=2\n";
  ExpectValues(ReadLabelVolume(folder.Write("e.tif", Tiff(hyper))));
  ExpectRefused(folder.Write("f.tif", "II*"), {});
  ExpectRefused(folder.Write("g.tif", "this is no picture"), {});
}

TEST(TiffBad, DirectoriesInCirclesAndGreatClaimsAreRefused)
{
  const TempFolder folder;
  std::string      bytes = Tiff(Pages<std::uint8_t>(1));
  // The last link, which ends the chain, is made to point at the first directory.
  std::string first = bytes.substr(4, 4);
  bytes.replace(bytes.size() - 4, 4, first);
  ExpectRefused(folder.Write("a.tif", bytes), {});
  for (const std::uint32_t side : { 1U << 20, 1U << 30, 0xFFFFFFFFU, 0U })
  {
    for (const int compression : { 1, 5, 8, 32773, 4, 34925, 50000 })
    {
      auto pages = Pages<std::uint8_t>(1);
      for (TiffPage & page : pages)
      {
        page.width = side;
        page.height = side;
        page.compression = compression;
      }
      ExpectRefused(folder.Write("b.tif", Tiff(pages)), {});
      for (TiffPage & page : pages)
      {
        page.tileWidth = side;
        page.tileHeight = side;
      }
      ExpectRefused(folder.Write("c.tif", Tiff(pages)), {});
    }
  }
}

TEST(TiffSlices, AFolderIsReadInNaturalOrder)
{
  const TempFolder folder;
  for (int i = 1; i <= 12; ++i)
  {
    folder.Write("s/slice_" + std::to_string(i) + ".tif", Slice(i));
  }
  folder.Write("s/readme.md", "not a slice");
  const LabelMap volume = ReadLabelVolume(folder / "s");
  EXPECT_EQ(volume.format, "TIFF slices");
  ASSERT_EQ(volume.geometry.size, (std::array<std::int64_t, 3>{ 3, 2, 12 }));
  for (int z = 0; z < 12; ++z)
  {
    EXPECT_EQ(ValueAt(volume, 0, 0, z), z + 1);
  }
  EXPECT_TRUE(HasNote(volume.notes, "12 slices from slice_1.tif to slice_12.tif"));
}

TEST(TiffSlices, PatternsChooseAmongFiles)
{
  const TempFolder folder;
  for (int i = 8; i <= 11; ++i)
  {
    const std::string digits = (i < 10 ? "00" : "0") + std::to_string(i);
    folder.Write("a_" + digits + ".tif", Slice(i));
    folder.Write("b_" + digits + ".tif", Slice(100 + i));
  }
  for (const char * pattern : { "a_*.tif", "a_###.tif", "a_%03d.tif", "a_%d.tif" })
  {
    const LabelMap volume = ReadLabelVolume(folder / pattern);
    ASSERT_EQ(volume.geometry.size[2], 4) << pattern;
    EXPECT_EQ(volume.labels.front().value, 8);
    EXPECT_EQ(volume.labels.back().value, 11);
  }
  ExpectRefused(folder.Path(), { "not numbered alike", "a_008.tif" });
  ExpectRefused(folder / "c_*.tif", { "no TIFF, PNG, BMP or JPEG slices" });
  ExpectRefused(folder / "a_%02d.tif", { "no TIFF, PNG, BMP or JPEG slices" });
}

TEST(TiffSlices, GapsTwinsAndUnequalSlicesAreRefused)
{
  const TempFolder folder;
  folder.Write("gap/1.tif", Slice(1));
  folder.Write("gap/2.tif", Slice(1));
  folder.Write("gap/5.tif", Slice(1));
  ExpectRefused(folder / "gap", { ": slices 3 to 4 are missing;" });
  folder.Write("gap/4.tif", Slice(1));
  ExpectRefused(folder / "gap", { ": slice 3 is missing;" });
  folder.Write("gap/8.tif", Slice(1));
  folder.Write("gap/10.tif", Slice(1));
  ExpectRefused(folder / "gap", { ": slices 3, 6 to 7 and 9 are missing;" });
  folder.Write("twin/1.tif", Slice(1));
  folder.Write("twin/01.tif", Slice(1));
  ExpectRefused(folder / "twin", {});
  folder.Write("wide/1.tif", Slice(1));
  folder.Write("wide/2.tif", Slice(1, 4));
  try
  {
    ReadLabelVolume(folder / "wide");
    FAIL();
  }
  catch (const InputError & error)
  {
    EXPECT_NE(std::string(error.what()).find("2.tif: this slice (4 x 2"), std::string::npos) << error.what();
  }
  folder.Write("deep/1.tif", Slice(1));
  folder.Write("deep/2.tif", Slice(1, 3, 16));
  EXPECT_THROW(ReadLabelVolume(folder / "deep"), InputError);
  folder.Write("one/1.tif", Slice(1));
  const LabelMap one = ReadLabelVolume(folder / "one");
  EXPECT_EQ(one.geometry.size, (std::array<std::int64_t, 3>{ 3, 2, 1 }));
  EXPECT_TRUE(HasNote(one.warnings, "one slice"));
  EXPECT_EQ(AllValues(ReadLabelVolume(folder / "one/1.tif")), AllValues(one));
  std::filesystem::create_directory(folder / "none");
  ExpectRefused(folder / "none", { "no TIFF, PNG, BMP or JPEG slices" });
  folder.Write("stacks/1.tif", Tiff(Pages<std::uint8_t>(1)));
  folder.Write("stacks/2.tif", Tiff(Pages<std::uint8_t>(1)));
  EXPECT_THROW(ReadLabelVolume(folder / "stacks"), InputError);
}

} // namespace voxelcore::testing::tiff
