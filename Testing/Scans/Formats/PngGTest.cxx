#include "PngBytes.h"
#include "ScanBytes.h"
#include "voxelcore/Formats/FormatOpeners.h"

#include <cstdlib>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

/** Slices of 11 x 9 pixels, `values` in all; pixel p of slice z holds (7 p + 3 z) % values, 0 every other row. */
std::vector<PngImage>
Slices(unsigned values, int bits, bool interlaced = false, int filter = 0)
{
  std::vector<PngImage> slices(3);
  for (std::size_t z = 0; z < slices.size(); ++z)
  {
    slices[z].width = 11;
    slices[z].height = 9;
    slices[z].bits = bits;
    slices[z].interlaced = interlaced;
    slices[z].filter = filter;
    for (std::size_t p = 0; p < 99; ++p)
    {
      slices[z].values.push_back(p / 11 % 2 == 0 ? static_cast<unsigned>(7 * p + 3 * z) % values : 0);
    }
  }
  return slices;
}

std::vector<std::int64_t>
Expected(const std::vector<PngImage> & slices)
{
  std::vector<std::int64_t> all;
  for (const PngImage & slice : slices)
  {
    all.insert(all.end(), slice.values.begin(), slice.values.end());
  }
  return all;
}

void
WriteSlices(const TempFolder & folder, const std::string & name, const std::vector<PngImage> & slices)
{
  for (std::size_t z = 0; z < slices.size(); ++z)
  {
    folder.Write(name + "/s" + std::to_string(z + 8) + ".png", Png(slices[z])); // s8, s9, s10
  }
}

} // namespace

TEST(PngSlices, EveryGreyDepthFilterAndInterlacingGivesTheStoredValues)
{
  const TempFolder folder;
  for (const int bits : { 1, 2, 4, 8, 16 })
  {
    for (const bool interlaced : { false, true })
    {
      for (const int filter : { 0, 1, 2 })
      {
        const auto name = std::to_string(bits) + (interlaced ? "i" : "n") + std::to_string(filter);
        SCOPED_TRACE(name);
        const auto slices = Slices(bits == 16 ? 60000U : 1U << bits, bits, interlaced, filter);
        WriteSlices(folder, name, slices);
        const LabelMap volume = ReadLabelVolume(folder / name);
        EXPECT_EQ(volume.format, "PNG slices");
        EXPECT_EQ(volume.pixelType, "uint" + std::to_string(bits));
        ASSERT_EQ(volume.geometry.size, (std::array<std::int64_t, 3>{ 11, 9, 3 }));
        EXPECT_EQ(AllValues(volume), Expected(slices));
      }
    }
  }
}

TEST(PngSlices, AreTakenInNaturalOrderWithOneMillimetreUnlessGiven)
{
  const TempFolder folder;
  WriteSlices(folder, "s", Slices(4, 8));
  const LabelMap volume = ReadLabelVolume(folder / "s/s*.png");
  EXPECT_TRUE(HasNote(volume.notes, "3 slices from s8.png to s10.png"));
  EXPECT_TRUE(HasNote(volume.notes, "--spacing"));
  ReadOptions options;
  options.spacing = Vector3{ 0.5, 0.5, 2 };
  ExpectNear(CentreOf(ReadLabelVolume(folder / "s/s%d.png", options), 2, 1, 2), { 1, 0.5, 4 });
}

TEST(PngSlices, GammaResolutionAndTransparencyChangeNoValue)
{
  const TempFolder folder;
  const auto       slices = Slices(200, 8);
  const auto       more = PngChunk("gAMA", Raw<std::uint32_t>(220000, true)) +
                    PngChunk("pHYs", Raw<std::uint32_t>(20000, true) + Raw<std::uint32_t>(20000, true) + "\1") +
                    PngChunk("tRNS", Raw<std::uint16_t>(7, true));
  for (std::size_t z = 0; z < slices.size(); ++z)
  {
    folder.Write("s/" + std::to_string(z) + ".png", Png(slices[z], {}, more));
  }
  const LabelMap volume = ReadLabelVolume(folder / "s");
  EXPECT_EQ(AllValues(volume), Expected(slices));
  ExpectNear(volume.geometry.spacing, { 1, 1, 1 });
}

TEST(PngSlices, ColoursAndPalettesAreRefused)
{
  const TempFolder folder;
  auto             slices = Slices(4, 8);
  for (auto [colour, samples, text] :
       { std::tuple(2, 3U, "colour image (3"), std::tuple(4, 2U, "opacity (2"), std::tuple(6, 4U, "colour image (4") })
  {
    for (PngImage & slice : slices)
    {
      slice.colour = colour;
      slice.values.assign(std::size_t{ 99 } * samples, 1);
    }
    WriteSlices(folder, "c" + std::to_string(colour), slices);
    try
    {
      ReadLabelVolume(folder / ("c" + std::to_string(colour)));
      ADD_FAILURE() << colour;
    }
    catch (const InputError & error)
    {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("--component 0 to"), std::string::npos) << error.what();
    }
  }
  const auto plain = Slices(2, 8);
  for (std::size_t z = 0; z < plain.size(); ++z)
  {
    PngImage slice = plain[z];
    slice.colour = 3;
    folder.Write("p/" + std::to_string(z) + ".png", Png(slice, {}, PngChunk("PLTE", "abcdef")));
  }
  try
  {
    ReadLabelVolume(folder / "p");
    ADD_FAILURE();
  }
  catch (const InputError & error)
  {
    EXPECT_NE(std::string(error.what()).find("palette"), std::string::npos) << error.what();
  }
}

TEST(PngSlices, MixedAndUnequalSlicesAreRefusedAndASingleOneIsRead)
{
  const TempFolder folder;
  const auto       slices = Slices(4, 8);
  WriteSlices(folder, "s", slices);
  EXPECT_EQ(ReadLabelVolume(folder / "s/s8.png").geometry.size[2], 1);
  folder.Write("s/s11.tif", "II*");
  ExpectRefused(folder / "s", { "both PNG and TIFF" });
  EXPECT_EQ(ReadLabelVolume(folder / "s/*.png").geometry.size[2], 3);
  auto deep = Slices(4, 16);
  folder.Write("s/s11.png", Png(deep[0]));
  EXPECT_THROW(ReadLabelVolume(folder / "s/*.png"), InputError);
}

TEST(PngSlices, DamagedOnesAreRefused)
{
  const TempFolder folder;
  const auto       slices = Slices(4, 8);
  folder.Write("s/1.png", Png(slices[0]));
  const auto refuse = [&](const std::string & bytes, const std::string & text) {
    folder.Write("s/2.png", bytes);
    try
    {
      ReadLabelVolume(folder / "s");
      ADD_FAILURE() << text;
    }
    catch (const InputError & error)
    {
      const std::string message = error.what();
      EXPECT_NE(message.find("2.png: "), std::string::npos) << message;
      EXPECT_NE(message.find(text), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  };
  const std::string good = Png(slices[1]);
  for (std::size_t cut = 0; cut < good.size(); cut += 5)
  {
    refuse(good.substr(0, cut), cut == 0 ? "" : "2.png");
  }
  std::string sum = good;
  sum[sum.size() - 14] ^= 1; // in the checksum of the image data
  refuse(sum, "damaged");
  std::string adler = Zlib(PngRows(slices[1]));
  adler.back() ^= 1;
  refuse(Png(slices[1], adler), "damaged");
  refuse(Png(slices[1], Zlib(PngRows(slices[1]) + "surplus")), "damaged");
  refuse(Png(slices[1], Zlib(PngRows(slices[1]).substr(1))), "damaged");
  refuse("this is no picture at all", "cannot be read");
  // The same where all rows are read at once.
  auto       woven = Slices(4, 8, true);
  const auto rows = PngRows(woven[1]);
  folder.Write("s/1.png", Png(woven[0]));
  refuse(Png(woven[1], Zlib(rows.substr(0, rows.size() - 3))), "damaged");
  refuse(Png(woven[1], Zlib(rows).substr(0, 12)), "damaged");
  folder.Write("s/1.png", Png(slices[0]));
  // Sizes are held against the file before anything is allocated.
  for (const std::uint32_t side : { 1U << 20, 1U << 30, 0x7FFFFFFFU })
  {
    for (const bool interlaced : { false, true })
    {
      PngImage great;
      great.width = side;
      great.height = side;
      great.interlaced = interlaced;
      refuse(Png(great, Zlib("x")), "");
    }
  }
  PngImage none = slices[1];
  none.width = 0;
  refuse(Png(none), "damaged");
}

TEST(PngSlices, PassingOverRowsLeadsToTheSameVoxels)
{
  const TempFolder folder;
  const auto       slices = Slices(200, 8);
  WriteSlices(folder, "s", slices);
  ScanFile  scan = OpenSlices(folder / "s", {});
  std::byte one{};
  scan.voxels->Skip(99 + 30);
  scan.voxels->Read(&one, 1);
  EXPECT_EQ(one, static_cast<std::byte>(slices[1].values[30]));
  scan.voxels->Skip(99); // leaves the second slice in the middle, which is read to its checksum
  scan.voxels->Read(&one, 1);
  EXPECT_EQ(one, static_cast<std::byte>(slices[2].values[31]));
  std::string damaged = Png(slices[1]);
  damaged[damaged.size() - 14] ^= 1;
  folder.Write("s/s9.png", damaged);
  ScanFile again = OpenSlices(folder / "s", {});
  again.voxels->Skip(99 + 30);
  EXPECT_THROW(again.voxels->Skip(99), InputError);
}
