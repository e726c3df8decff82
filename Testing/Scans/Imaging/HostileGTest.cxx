// Files made to do harm: whatever a byte is changed to, reading ends in time, with a volume or with InputError, and
// takes memory in proportion to the file.

#include "PngBytes.h"
#include "ScanBytes.h"
#include "VoxelCoreTesting/ProcessUse.h"

#include <chrono>
#include <ctime>
#include <iostream>
#include <map>
#include <optional>
#include <random>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

struct Seed
{
  const char *                       name; ///< of the file that is changed
  std::string                        bytes;
  const char *                       scan = nullptr; ///< what is read, when it is not that file
  std::optional<std::int64_t>        component;
  std::map<std::string, std::string> others; ///< files beside it that stay as they are
};

PngImage
PngSeed(int bits, int colour, bool interlaced)
{
  PngImage image;
  image.width = 9;
  image.height = 5;
  image.bits = bits;
  image.colour = colour;
  image.interlaced = interlaced;
  for (unsigned i = 0; i < 45U * (colour == 2 ? 3U : 1U); ++i)
  {
    image.values.push_back(i % 3 == 0 ? i % (1U << std::min(bits, 8)) : 0);
  }
  return image;
}

std::vector<Seed>
Seeds()
{
  std::vector<int> values(6 * 5 * 4, 0);
  for (std::size_t i = 0; i < values.size(); i += 3)
  {
    values[i] = static_cast<int>(i % 7);
  }
  const std::string bytes = RawAll<std::uint8_t>(values);
  const std::string words = RawAll<std::int16_t>(values);
  auto              lines = NrrdLines("short", { 6, 5, 4 });
  auto              packed = lines;
  packed[7] = "encoding: gzip";
  auto text = lines;
  text[7] = "encoding: ascii";
  std::string written;
  for (const int value : values)
  {
    written += std::to_string(value) + " ";
  }
  std::vector<std::string> layers{ "type: uchar",
                                   "dimension: 4",
                                   "space: RAS",
                                   "sizes: 2 6 5 2",
                                   "space directions: none (1,0,0) (0,1,0) (0,0,1)",
                                   "kinds: list domain domain domain",
                                   "encoding: raw",
                                   "space units: \"um\" \"um\" \"um\"",
                                   "Segment0_Name:=a",
                                   "Segment0_LabelValue:=1",
                                   "Segment0_Layer:=0",
                                   "Segment1_Name:=b",
                                   "Segment1_LabelValue:=3",
                                   "Segment1_Layer:=1" };
  NiftiFields              nifti;
  nifti.dim = { 6, 5, 4 };
  nifti.datatype = 4;
  nifti.bitpix = 16;
  nifti.qformCode = 1;
  nifti.sformCode = 1;
  nifti.srow = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 };
  NiftiFields nifti2 = nifti;
  nifti2.version = 2;
  nifti2.big = true;
  const std::vector<std::string> meta{ "ObjectType = Image",      "NDims = 3",
                                       "DimSize = 6 5 4",         "ElementSpacing = 1 1 1",
                                       "ElementType = MET_SHORT", "BinaryDataByteOrderMSB = False" };
  auto                           metaPacked = meta;
  metaPacked.emplace_back("CompressedData = True");

  std::vector<TiffPage> strips(4);
  for (std::size_t p = 0; p < 4; ++p)
  {
    strips[p].width = 6;
    strips[p].height = 5;
    strips[p].rowsPerStrip = 3;
    strips[p].compression = 5;
    strips[p].parts = { Lzw(bytes.substr(30 * p, 18)), Lzw(bytes.substr(30 * p + 18, 12)) };
  }
  auto bits = strips;
  for (TiffPage & page : bits)
  {
    page.compression = 32773;
    page.parts = { PackBits(page.parts[0] + std::string(18, 'x')).substr(0, 19), PackBits(std::string(12, '\1')) };
  }
  std::vector<TiffPage> tiles(2);
  for (TiffPage & page : tiles)
  {
    page.width = 20;
    page.height = 18;
    page.tileWidth = 16;
    page.tileHeight = 16;
    page.compression = 8;
    page.parts.assign(4, Zlib(std::string(256, '\2')));
  }
  auto hex = NrrdLines("uchar", { 6, 5, 4 });
  hex[7] = "encoding: hex";
  std::string digits;
  for (const char c : bytes)
  {
    digits += "0123456789abcdef"[static_cast<unsigned char>(c) >> 4];
    digits += "0123456789abcdef"[static_cast<unsigned char>(c) & 15];
  }
  auto list = lines;
  list.emplace_back("data file: LIST\na.part\n./b.part");
  auto pattern = lines;
  pattern.emplace_back("data file: p%02d.part 1 2 1");
  const std::string                        half = words.substr(0, words.size() / 2);
  const std::map<std::string, std::string> parts{ { "a.part", half },
                                                  { "b.part", half },
                                                  { "p01.part", half },
                                                  { "p02.part", half },
                                                  { "pair.img", words } };
  auto                                     metaParts = meta;
  metaParts.emplace_back("ElementDataFile = p%02d.part 1 2 1\n");
  std::string metaHeader;
  for (const auto & line : metaParts)
  {
    metaHeader += line + "\n";
  }
  NiftiFields pair = nifti;
  pair.pair = true;
  NiftiFields colours = nifti;
  colours.datatype = 128;
  colours.bitpix = 24;
  auto samples = tiles;
  for (TiffPage & page : samples)
  {
    page = strips[0];
    page.samples = 3;
    page.photometric = 2;
    page.compression = 1;
    page.rowsPerStrip = 0;
    page.parts = { std::string(90, '\3') };
  }
  const auto header = [](const std::string & whole) { return whole.substr(0, whole.size() - 1); };
  return { { "hex.nrrd", Nrrd(hex, digits), nullptr, {}, {} },
           { "list.nhdr", header(Nrrd(list, "")), nullptr, {}, parts },
           { "pattern.nhdr", header(Nrrd(pattern, "")), nullptr, {}, parts },
           { "parts.mhd", metaHeader, nullptr, {}, parts },
           { "pair.hdr", NiftiHeaderBytes(pair), nullptr, {}, parts },
           { "colours.nii", Nifti(colours, bytes + bytes + bytes), nullptr, 0, {} },
           { "samples.tif", Tiff(samples), nullptr, 2, {} },
           { "p/1.png", Png(PngSeed(8, 0, false)), "p", {}, { { "p/2.png", Png(PngSeed(8, 0, true)) } } },
           { "q/1.png", Png(PngSeed(16, 0, true)), "q/#.png", {}, { { "q/2.png", Png(PngSeed(16, 0, false)) } } },
           { "b/1.png", Png(PngSeed(1, 0, true)), "b", {}, { { "b/2.png", Png(PngSeed(1, 0, false)) } } },
           { "c/1.png", Png(PngSeed(8, 2, false)), "c", 0, { { "c/2.png", Png(PngSeed(8, 2, true)) } } },
           { "raw.nrrd", Nrrd(lines, words), nullptr, {}, {} },
           { "gzip.nrrd", Nrrd(packed, Gzip(words)), nullptr, {}, {} },
           { "ascii.nrrd", Nrrd(text, written), nullptr, {}, {} },
           { "layers.seg.nrrd", Nrrd(layers, bytes), nullptr, {}, {} },
           { "one.nii", Nifti(nifti, words), nullptr, {}, {} },
           { "two.nii", Nifti(nifti2, RawAll<std::int16_t>(values, true)), nullptr, {}, {} },
           { "packed.nii.gz", Gzip(Nifti(nifti, words)), nullptr, {}, {} },
           { "raw.mha", Meta(meta, words), nullptr, {}, {} },
           { "packed.mha", Meta(metaPacked, Zlib(words)), nullptr, {}, {} },
           { "strips.tif", Tiff(strips), nullptr, {}, {} },
           { "bits.tif", Tiff(bits, { true, false }), nullptr, {}, {} },
           { "tiles.tif", Tiff(tiles, { false, true }), nullptr, {}, {} } };
}

void
ReadMutations(std::size_t countOfEach)
{
  const TempFolder folder;
  const unsigned   seed = std::random_device()();
  std::cout << "seed " << seed << "\n";
  ::testing::Test::RecordProperty("seed", std::to_string(seed));
  std::mt19937                random(seed);
  [[maybe_unused]] const long before = PeakMegabytes(); // a sanitizer holds back what was freed
  std::size_t                 read = 0;
  std::size_t                 refused = 0;
  for (const Seed & original : Seeds())
  {
    const std::filesystem::path scan = folder / (original.scan != nullptr ? original.scan : original.name);
    ReadOptions                 options;
    options.component = original.component;
    for (const auto & [name, bytes] : original.others)
    {
      folder.Write(name, bytes);
    }
    folder.Write(original.name, original.bytes);
    ASSERT_NO_THROW(ReadLabelVolume(scan, options)) << original.name;
    for (std::size_t i = 0; i < countOfEach; ++i)
    {
      std::string bytes = original.bytes;
      for (std::size_t changes = 1 + (i % 4 == 0 ? random() % 4 : 0); changes > 0; --changes)
      {
        bytes[random() % bytes.size()] = static_cast<char>(random());
      }
      if (i % 16 == 0)
      {
        bytes.resize(random() % bytes.size() + 1);
      }
      const auto   path = folder.Write(original.name, bytes);
      const double begin = ProcessorSeconds();
      try
      {
        ReadLabelVolume(scan, options);
        ++read;
      }
      catch (const InputError & error)
      {
        ++refused;
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      }
      catch (const std::exception & error)
      {
        std::filesystem::copy_file(path, std::filesystem::temp_directory_path() / path.filename());
        FAIL() << original.name << " change " << i << ": " << error.what();
      }
      // Of the processor: other work on the machine is no hang. One that waits for ever meets the test's own limit.
      ASSERT_LT(ProcessorSeconds() - begin, 10.0) << original.name << " change " << i;
    }
#ifndef __SANITIZE_ADDRESS__
    EXPECT_LT(PeakMegabytes() - before, 400) << original.name;
#endif
  }
  std::cout << read << " read, " << refused << " refused\n";
  EXPECT_GT(read, 0U);
  EXPECT_GT(refused, 0U);
}

} // namespace

TEST(Hostile, SmallFilesWithAByteChanged)
{
  ReadMutations(400);
}

TEST(HeavyHostile, TenThousandSmallFilesOfEachFormatWithAByteChanged)
{
  ReadMutations(10000);
}

TEST(Hostile, ABombEndsWithItsVolumeNotWithItsBytes)
{
  // 100 MB of zeros in 100 kB, of which the header speaks of 27 bytes: more are left over than are worth unpacking.
  const TempFolder folder;
  auto             lines = NrrdLines("uchar", { 3, 3, 3 });
  lines[7] = "encoding: gzip";
  std::string zeros(100U << 20, '\0');
  zeros[3] = 1;
  const auto begin = std::chrono::steady_clock::now();
  const auto volume = ReadLabelVolume(folder.Write("a.nrrd", Nrrd(lines, Gzip(zeros))));
  EXPECT_TRUE(HasNote(volume.warnings, "longer than its header says"));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST(Hostile, AHeaderWithoutEndIsRefused)
{
  const TempFolder folder;
  ExpectRefused(folder.Write("a.nrrd", "NRRD0004\n" + std::string(70U << 20, 'x')), { "no end" });
  ExpectRefused(folder.Write("a.mha", "NDims = 3\n" + std::string(3U << 20, 'x')), { "not a MetaImage" });
}

TEST(Hostile, DetachedDataMayLieAboveTheHeaderButMustBeAFile)
{
  // A study may keep its headers in a folder of their own. What is named is only ever read, and only a regular file.
  const TempFolder folder;
  folder.Write("data/a.raw", std::string(27, '\1'));
  auto lines = NrrdLines("uchar", { 3, 3, 3 });
  lines.emplace_back("data file: ../data/a.raw");
  const std::string header = Nrrd(lines, "");
  EXPECT_EQ(ReadLabelVolume(folder.Write("headers/a.nhdr", header)).labels[0].voxels, 27U);
  for (const char * file :
       { "../data/b.raw", "../../../../../../../../no/such/file", "..", "../data", "/dev/zero", "." })
  {
    lines.back() = std::string("data file: ") + file;
    const std::string meta = "NDims = 3\nDimSize = 3 3 3\nElementType = MET_UCHAR\nElementDataFile = ";
    for (const auto & path :
         { folder.Write("headers/a.nhdr", Nrrd(lines, "")), folder.Write("headers/a.mhd", meta + file + "\n") })
    {
      try
      {
        ReadLabelVolume(path);
        ADD_FAILURE() << file;
      }
      catch (const InputError & error)
      {
        const std::string refusal = error.what();
        EXPECT_NE(refusal.find(file), std::string::npos) << refusal;
        EXPECT_TRUE(refusal.find("no such file") != std::string::npos ||
                    refusal.find("not a regular file") != std::string::npos)
          << refusal;
      }
    }
  }
}
