// A crop while reading: what it leaves is what cropping afterwards would leave, and the rest costs nothing.

#include "PngBytes.h"
#include "ScanBytes.h"
#include "VoxelCoreTesting/ProcessUse.h"

#include "voxelcore/Shape/ShapeOperations.h"

#include <fstream>
#include <functional>
#include <iostream>
#include <random>
#include <sys/resource.h>

namespace voxelcore::testing::crop
{

namespace
{

constexpr std::array<int, 3> kSize{ 37, 11, 9 };

std::vector<int>
RandomValues(unsigned seed)
{
  std::mt19937     random(seed);
  std::vector<int> values(37 * 11 * 9);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = random() % 5 == 0 && i > 0 ? values[i - 1] : static_cast<int>(random() % 4);
  }
  return values;
}

/** The same voxels in every format and packing. */
std::vector<std::filesystem::path>
WriteAllFormats(const TempFolder & folder, const std::vector<int> & values)
{
  const std::string bytes = RawAll<std::uint8_t>(values);
  const std::string words = RawAll<std::int16_t>(values, true);
  std::string       text;
  for (const int value : values)
  {
    text += std::to_string(value) + " ";
  }
  auto lines = NrrdLines("uchar", kSize);
  auto big = NrrdLines("short", kSize);
  big[6] = "endian: big";
  auto packed = lines;
  packed[7] = "encoding: gzip";
  auto ascii = lines;
  ascii[7] = "encoding: ascii";
  auto detached = lines;
  detached.emplace_back("data file: LIST");
  std::vector<TiffPage> pages(9);
  for (std::size_t z = 0; z < 9; ++z)
  {
    const std::string page = bytes.substr(37 * 11 * z, 37 * 11);
    folder.Write("part" + std::to_string(z), page);
    detached.push_back("part" + std::to_string(z));
    pages[z].width = 37;
    pages[z].height = 11;
    pages[z].compression = 8;
    pages[z].rowsPerStrip = 4;
    pages[z].parts = { Zlib(page.substr(0, 148)), Zlib(page.substr(148, 148)), Zlib(page.substr(296)) };
    folder.Write("tiffs/" + std::to_string(z) + ".tif", Tiff({ pages[z] }));
    PngImage png;
    png.width = 37;
    png.height = 11;
    png.values.assign(page.begin(), page.end());
    png.interlaced = z % 2 == 1;
    folder.Write("pngs/" + std::to_string(z) + ".png", Png(png));
  }
  NiftiFields nifti;
  nifti.dim = { 37, 11, 9 };
  const std::string header = Nrrd(detached, "");
  return { folder.Write("raw.nrrd", Nrrd(lines, bytes)),
           folder.Write("big.nrrd", Nrrd(big, words)),
           folder.Write("gzip.nrrd", Nrrd(packed, Gzip(bytes))),
           folder.Write("ascii.nrrd", Nrrd(ascii, text)),
           folder.Write("list.nhdr", header.substr(0, header.size() - 1)),
           folder.Write("a.nii", Nifti(nifti, bytes)),
           folder.Write("a.nii.gz", Gzip(Nifti(nifti, bytes))),
           folder.Write("a.mha", Meta({ "NDims = 3", "DimSize = 37 11 9", "ElementType = MET_UCHAR" }, bytes)),
           folder.Write("a.tif", Tiff(pages)),
           folder / "tiffs",
           folder / "pngs" };
}

VoxelBox
BoxOf(const CropRange & crop)
{
  VoxelBox box{ crop.first, {} };
  for (std::size_t a = 0; a < 3; ++a)
  {
    box.size[a] = crop.end[a] - crop.first[a];
  }
  return box;
}

void
ExpectEqual(const VoxelShape & a, const VoxelShape & b)
{
  ASSERT_EQ(a.Box().lower, b.Box().lower);
  ASSERT_EQ(a.Box().size, b.Box().size);
  for (std::int32_t z = 0; z < a.Box().size[2]; ++z)
  {
    for (std::int32_t y = 0; y < a.Box().size[1]; ++y)
    {
      const auto rowA = a.Row(y, z);
      const auto rowB = b.Row(y, z);
      ASSERT_TRUE(std::equal(rowA.begin(), rowA.end(), rowB.begin(), rowB.end())) << y << ", " << z;
    }
  }
}

/** Cropped while reading is the same as cropped afterwards. */
void
ExpectSame(const std::filesystem::path & path, const CropRange & crop, ReadOptions options = {})
{
  SCOPED_TRACE(path.filename().string());
  const LabelMap whole = ReadLabelVolume(path, options);
  options.crop = crop;
  const LabelMap part = ReadLabelVolume(path, options);
  EXPECT_EQ(part.crop, crop);
  EXPECT_EQ(part.geometry.size, whole.geometry.size);
  EXPECT_EQ(part.geometry.origin, whole.geometry.origin);
  std::size_t next = 0;
  for (const LabelShape & label : whole.labels)
  {
    VoxelShape shape = label.shape;
    shape = CropToBox(std::move(shape), BoxOf(crop)).shape;
    if (shape.CountVoxels() == 0)
    {
      continue;
    }
    ASSERT_LT(next, part.labels.size());
    EXPECT_EQ(part.labels[next].value, label.value);
    EXPECT_EQ(part.labels[next].name, label.name);
    EXPECT_EQ(part.labels[next].voxels, shape.CountVoxels());
    ExpectEqual(part.labels[next].shape, shape);
    ++next;
  }
  EXPECT_EQ(next, part.labels.size());
}

CropRange
RandomCrop(std::mt19937 & random)
{
  CropRange crop;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto size = static_cast<unsigned>(kSize[a]);
    crop.first[a] = random() % 3 == 0 ? 0 : static_cast<std::int32_t>(random() % (size - 1));
    const auto left = size - static_cast<unsigned>(crop.first[a]);
    crop.end[a] = random() % 3 == 0 ? kSize[a] : crop.first[a] + 1 + static_cast<std::int32_t>(random() % left);
    crop.end[a] = std::min(crop.end[a], kSize[a]);
  }
  // Enough to hold something.
  crop.end[0] = std::min(kSize[0], crop.end[0] + 8);
  return crop;
}

} // namespace

TEST(Crop, WhileReadingGivesWhatCroppingAfterwardsGivesInEveryFormat)
{
  const TempFolder folder;
  const unsigned   seed = std::random_device()();
  std::cout << "seed " << seed << "\n";
  std::mt19937 random(seed);
  const auto   paths = WriteAllFormats(folder, RandomValues(seed));
  for (int round = 0; round < 12; ++round)
  {
    const CropRange crop = RandomCrop(random);
    SCOPED_TRACE(::testing::PrintToString(crop.first) + " to " + ::testing::PrintToString(crop.end));
    ReadOptions options;
    options.binary = round % 4 == 1;
    if (round % 4 == 2)
    {
      options.threshold = { 2, 3 };
    }
    for (const auto & path : paths)
    {
      ExpectSame(path, crop, options);
    }
  }
}

TEST(Crop, NumbersOfOverlappingLayersDoNotDependOnIt)
{
  // Value 3 in both layers, named in neither; value 1 is a segment of layer 0. Numbers are given in the order in which
  // values turn up: outside the part too.
  const TempFolder         folder;
  std::vector<std::string> lines{ "type: uchar",
                                  "dimension: 4",
                                  "space: LPS",
                                  "sizes: 2 4 2 2",
                                  "space directions: none (1,0,0) (0,1,0) (0,0,1)",
                                  "kinds: list domain domain domain",
                                  "encoding: raw",
                                  "Segment0_Name:=a",
                                  "Segment0_LabelValue:=1",
                                  "Segment0_Layer:=0" };
  std::string              data(32, '\0');
  data[1] = 3; // layer 1 first
  data[4] = 5;
  data[8] = 3;
  data[18] = 1;
  data[21] = 5;
  data[24] = 3;
  data[27] = 3;
  const auto path = folder.Write("a.seg.nrrd", Nrrd(lines, data));
  for (const int z : { 0, 1 })
  {
    ExpectSame(path, { { 0, 0, z }, { 4, 2, z + 1 } });
    ExpectSame(path, { { 0, 0, z }, { 3, 2, z + 1 } });
  }
  ReadOptions options;
  options.crop = CropRange{ { 0, 0, 0 }, { 4, 2, 1 } };
  options.labels = "a";
  ExpectRefused(path, { "no label 'a' within the crop" }, options);
}

TEST(Crop, WhatLiesOutsideIsNotLookedAt)
{
  const TempFolder folder;
  auto             lines = NrrdLines("short", { 4, 4, 4 });
  std::vector<int> values(64, 1);
  values[5] = -7;
  const auto  path = folder.Write("a.nrrd", Nrrd(lines, RawAll<std::int16_t>(values)));
  ReadOptions options;
  ExpectRefused(path, { "-7" });
  options.crop = CropRange{ { 0, 0, 1 }, { 0, 0, 0 } };
  EXPECT_EQ(ReadLabelVolume(path, options).labels[0].voxels, 48U);
  options.crop = CropRange{ { 2, 0, 0 }, { 0, 0, 0 } };
  EXPECT_EQ(ReadLabelVolume(path, options).labels[0].voxels, 32U);
}

TEST(Crop, PackedDataAreStillCheckedToTheirEnd)
{
  const TempFolder folder;
  auto             lines = NrrdLines("uchar", { 8, 8, 8 });
  lines[7] = "encoding: gzip";
  std::string packed = Gzip(std::string(512, '\1'));
  ReadOptions options;
  options.crop = CropRange{ { 0, 0, 0 }, { 8, 8, 1 } };
  EXPECT_EQ(ReadLabelVolume(folder.Write("a.nrrd", Nrrd(lines, packed)), options).labels[0].voxels, 64U);
  packed[packed.size() - 6] ^= 1; // the checksum
  ExpectRefused(folder.Write("a.nrrd", Nrrd(lines, packed)), { "damaged" }, options);
  ExpectRefused(folder.Write("a.nrrd", Nrrd(lines, packed.substr(0, packed.size() - 8))), { "truncated" }, options);
}

TEST(Crop, OfAGreatRawScanTakesTimeAndMemoryOfThePart)
{
  // 8 GB of holes on disk, a voxel in the middle.
  const TempFolder folder;
  const auto       path = folder / "a.nrrd";
  const auto       header = Nrrd(NrrdLines("uchar", { 2048, 2048, 2048 }), "");
  std::ofstream    file(path, std::ios::binary);
  file << header;
  file.seekp(static_cast<std::streamoff>(header.size() + (1024ULL * 2048 + 1024) * 2048 + 1024));
  file.put(1);
  file.close();
  std::filesystem::resize_file(path, header.size() + (1ULL << 33));
  ReadOptions options;
  options.crop = CropRange{ { 1000, 1000, 1000 }, { 1050, 1050, 1050 } };
  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  const LabelMap volume = ReadLabelVolume(path, options);
  rusage         after{};
  getrusage(RUSAGE_SELF, &after);
  ASSERT_EQ(volume.labels.size(), 1U);
  EXPECT_EQ(volume.labels[0].shape.Box().lower, (std::array<std::int32_t, 3>{ 1024, 1024, 1024 }));
  EXPECT_EQ(volume.labels[0].voxels, 1U);
  const auto seconds = [](const rusage & usage) {
    return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  };
  // All of it would take seconds.
  EXPECT_LT(seconds(after) - seconds(before), 0.5);
#ifndef __SANITIZE_ADDRESS__
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 40 * 1024);
#endif
}

TEST(Crop, OfLongRowsOnlyThePartIsReadWithTheSameResult)
{
  constexpr std::array<int, 3> size{ 9001, 5, 4 };
  const TempFolder             folder;
  std::mt19937                 random(5);
  std::vector<int>             values(9001 * 5 * 4);
  for (int & value : values)
  {
    value = static_cast<int>(random() % 3);
  }
  auto big = NrrdLines("short", size);
  big[6] = "endian: big";
  auto packed = NrrdLines("uchar", size);
  packed[7] = "encoding: gzip";
  const std::string bytes = RawAll<std::uint8_t>(values);
  for (const auto & path : { folder.Write("raw.nrrd", Nrrd(NrrdLines("uchar", size), bytes)),
                             folder.Write("big.nrrd", Nrrd(big, RawAll<std::int16_t>(values, true))),
                             folder.Write("gzip.nrrd", Nrrd(packed, Gzip(bytes))) })
  {
    for (const CropRange & crop : { CropRange{ { 0, 1, 1 }, { 60, 4, 3 } },
                                    CropRange{ { 4000, 0, 0 }, { 4130, 5, 4 } },
                                    CropRange{ { 8960, 2, 0 }, { 9001, 3, 4 } } })
    {
      ExpectSame(path, crop);
      ReadOptions threshold;
      threshold.threshold = { 1.5, 2.5 };
      ExpectSame(path, crop, threshold);
    }
  }
}

TEST(Crop, OfLongRowsTheRestIsNotRead)
{
  const TempFolder  folder;
  const auto        lines = NrrdLines("uchar", { 200000, 50, 20 });
  const std::string header = Nrrd(lines, "");
  const auto        path = folder.Write("wide.nrrd", header);
  std::filesystem::resize_file(path, header.size() + std::uintmax_t{ 200000 } * 50 * 20);
  std::fstream(path, std::ios::in | std::ios::out | std::ios::binary)
    .seekp(static_cast<std::streamoff>(header.size() + std::size_t{ 200000 } * 50 * 10 + 1000))
    .put(1);
  ReadOptions options;
  options.crop = CropRange{ { 900, 0, 0 }, { 1100, 50, 20 } };
  const std::uint64_t before = BytesRead();
  const LabelMap      map = ReadLabelVolume(path, options);
  EXPECT_LT(BytesRead() - before, 3000000U) << "of 200 MB; the part has 200000 bytes";
  ASSERT_EQ(map.labels.size(), 1U);
  EXPECT_TRUE(map.labels[0].shape.Contains(1000, 0, 10));
  EXPECT_EQ(map.labels[0].voxels, 1U);
}

TEST(Crop, ARangeThatIsNoneIsRefused)
{
  const TempFolder folder;
  const auto       path = folder.Write("a.nrrd", Nrrd(NrrdLines("uchar", { 2, 2, 2 }), std::string(8, '\1')));
  ReadOptions      options;
  options.crop = CropRange{ { 0, 0, 0 }, { 3, 0, 0 } };
  ExpectRefused(path, { "--crop 0:3,:,: reaches beyond the scan of 2 x 2 x 2" }, options);
  options.crop = CropRange{ { 0, 2, 0 }, { 0, 0, 0 } };
  ExpectRefused(path, { "--crop :,2:,: reaches beyond" }, options);
  for (const CropRange & crop : { CropRange{ { 1, 0, 0 }, { 1, 0, 0 } }, CropRange{ { -1, 0, 0 }, { 1, 0, 0 } } })
  {
    options.crop = crop;
    EXPECT_THROW(ReadLabelVolume(path, options), UsageError);
  }
}

} // namespace voxelcore::testing::crop
