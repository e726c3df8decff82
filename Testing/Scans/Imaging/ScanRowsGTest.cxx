#include "voxelcore/Imaging/ScanRows.h"
#include "NrrdFixtures.h"

#include <random>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

std::vector<int>
RandomLabels(std::size_t count, unsigned seed)
{
  std::mt19937     random(seed);
  std::vector<int> values(count);
  for (int & value : values)
  {
    value = static_cast<int>(random() % 5);
  }
  return values;
}

/** Rows as numbers. */
std::vector<double>
RowsOf(ScanRows & rows, std::uint64_t first, std::uint64_t count)
{
  std::vector<double> values;
  std::uint64_t       expected = first;
  rows.Read(first, count, [&](const std::byte * row, std::uint64_t number) {
    EXPECT_EQ(number, expected++);
    for (std::int64_t x = 0; x < rows.Geometry().size[0]; ++x)
    {
      values.push_back(StoredValue(row + static_cast<std::size_t>(x) * PixelBytes(rows.Type()), rows.Type()));
    }
  });
  EXPECT_EQ(expected, first + count);
  return values;
}

} // namespace

TEST(ScanRows, ComeInAnyOrderFromPlainAndPackedFiles)
{
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937      random(seed);
  const auto        labels = RandomLabels(7 * 6 * 5, seed);
  const TempFolder  folder;
  const auto        big = RawAll<std::int16_t>(labels, true);
  auto              lines = nrrd::With(NrrdLines("int16", { 7, 6, 5 }), "endian", "big");
  const std::string plain = Nrrd(lines, big);
  const std::string packed = Nrrd(nrrd::With(lines, "encoding", "gzip"), Gzip(big));
  for (const std::string & bytes : { plain, packed })
  {
    ScanRows rows(folder.Write("a.nrrd", bytes), {});
    EXPECT_EQ(rows.Type(), PixelType::Int16);
    for (int n = 0; n < 20; ++n)
    {
      const std::uint64_t first = random() % 30;
      const std::uint64_t count = 1 + random() % (30 - first);
      const auto          begin = labels.begin() + static_cast<std::ptrdiff_t>(first * 7);
      EXPECT_EQ(RowsOf(rows, first, count), std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(count * 7)));
    }
  }
}

TEST(ScanRows, OfAScaledScanAreItsValues)
{
  const TempFolder  folder;
  const NiftiFields fields{ .dim = { 3, 2, 2 }, .slope = 0.25, .intercept = 3 };
  ScanRows          rows(folder.Write("a.nii", Nifti(fields, RawAll<std::uint8_t>(nrrd::kValues))), {});
  EXPECT_EQ(rows.Type(), PixelType::Float64);
  const auto values = RowsOf(rows, 0, 4);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    EXPECT_EQ(values[i], 0.25 * nrrd::kValues[i] + 3);
  }
}

TEST(ScanRows, OfLayersAreNumbersOfLabelsUnlessTwoOverlap)
{
  const TempFolder folder;
  std::vector<int> stored(24, 0);
  stored[0] = 1;
  stored[3] = 4;
  ScanRows rows(folder.Write("a.seg.nrrd", Nrrd(nrrd::LayerLines(), RawAll<std::uint8_t>(stored))), {});
  EXPECT_EQ(rows.Type(), PixelType::Int64);
  EXPECT_EQ(rows.Segments().size(), 2U);
  EXPECT_EQ(RowsOf(rows, 0, 1), (std::vector<double>{ 1, 4, 0 }));
  stored[1] = 4; // beside the 1
  ScanRows overlapping(folder.Write("b.seg.nrrd", Nrrd(nrrd::LayerLines(), RawAll<std::uint8_t>(stored))), {});
  EXPECT_THROW(RowsOf(overlapping, 0, 1), InputError);
}

TEST(ScanRows, TheEndOfTheDataIsCheckedWithTheLastRow)
{
  const TempFolder folder;
  std::string      packed = Gzip(RawAll<std::uint8_t>(nrrd::kValues));
  packed[packed.size() - 6] = static_cast<char>(packed[packed.size() - 6] ^ 1); // its checksum
  ScanRows rows(folder.Write("a.nrrd", Nrrd(nrrd::With(nrrd::Lines(), "encoding", "gzip"), packed)), {});
  EXPECT_NO_THROW(RowsOf(rows, 0, 2));
  EXPECT_THROW(RowsOf(rows, 2, 2), InputError);
}

TEST(ScanRows, FormatsAreToldByTheName)
{
  const TempFolder folder;
  for (const char * name : { "a.nrrd", "a.nii.gz", "a.mha", "a.mgz", "a.npy", "a.tif", "slice_*.png" })
  {
    EXPECT_TRUE(IsScanFormat(folder / name)) << name;
  }
  EXPECT_TRUE(IsScanFormat(folder.Path()));
  for (const char * name : { "a.png", "a.vtp", "a.txt", "a" })
  {
    EXPECT_FALSE(IsScanFormat(folder / name)) << name;
  }
}
