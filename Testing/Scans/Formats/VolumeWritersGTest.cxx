#include "voxelcore/Formats/VolumeWriters.h"
#include "ScanBytes.h"
#include "voxelcore/Formats/FormatOpeners.h"

#include <fstream>
#include <map>
#include <random>
#include <string>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

struct Writer
{
  void (*write)(const std::filesystem::path &, const VolumeToWrite &);
  ScanFile (*open)(const std::filesystem::path &, const ReadOptions &);
};

const std::map<std::string, Writer> kWriters{
  { "a.nrrd", { WriteNrrd, OpenNrrd } },          { "a.nii", { WriteNifti, OpenNifti } },
  { "a.nii.gz", { WriteNifti, OpenNifti } },      { "a.mha", { WriteMetaImage, OpenMetaImage } },
  { "a.mhd", { WriteMetaImage, OpenMetaImage } }, { "a.tif", { WriteTiff, OpenTiff } }
};

} // namespace

TEST(VolumeWriters, EveryFormatAndTypeGivesItsBytesBackInOrder)
{
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (const PixelType type : { PixelType::UInt8, PixelType::UInt16, PixelType::UInt32, PixelType::UInt64 })
  {
    VolumeToWrite volume;
    volume.geometry.size = { 5, 4, 3 };
    volume.geometry.spacing = { 0.5, 0.75, 2 };
    volume.type = type;
    const std::size_t      sliceBytes = 20 * PixelBytes(type);
    std::vector<std::byte> bytes(3 * sliceBytes);
    std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<std::byte>(random() % 3); });
    volume.slice = [&](std::int64_t k) {
      return std::span<const std::byte>(bytes).subspan(static_cast<std::size_t>(k) * sliceBytes, sliceBytes);
    };
    for (const auto & [name, format] : kWriters)
    {
      for (const bool compress : { true, false })
      {
        SCOPED_TRACE(name + " " + PixelName(type));
        const TempFolder folder;
        volume.compress = compress;
        format.write(folder / name, volume);
        ScanFile scan = format.open(folder / name, {});
        EXPECT_EQ(scan.type, type);
        EXPECT_FALSE(scan.swapBytes);
        EXPECT_EQ(scan.geometry.size, volume.geometry.size);
        ExpectNear(scan.geometry.spacing, volume.geometry.spacing);
        std::vector<std::byte> got(bytes.size());
        scan.voxels->Read(got.data(), got.size());
        EXPECT_TRUE(got == bytes);
        EXPECT_FALSE(scan.voxels->Finish());
      }
    }
  }
}

TEST(VolumeWriters, NrrdNamesItsTypesAsOtherReadersOfTheFormatDo)
{
  // Of the names that Teem, and so 3D Slicer and ITK, takes. There is no "float32".
  const std::map<PixelType, std::string> names{ { PixelType::UInt8, "uint8" },
                                                { PixelType::UInt16, "uint16" },
                                                { PixelType::UInt32, "uint32" },
                                                { PixelType::UInt64, "uint64" },
                                                { PixelType::Float32, "float" } };
  for (const auto & [type, name] : names)
  {
    const TempFolder folder;
    VolumeToWrite    volume;
    volume.geometry.size = { 1, 1, 1 };
    volume.type = type;
    const std::vector<std::byte> bytes(PixelBytes(type));
    volume.slice = [&](std::int64_t) { return std::span<const std::byte>(bytes); };
    WriteNrrd(folder / "a.nrrd", volume);
    std::ifstream file(folder / "a.nrrd", std::ios::binary);
    std::string   line;
    while (std::getline(file, line) && !line.starts_with("type: "))
    {}
    EXPECT_EQ(line, "type: " + name);
  }
}

TEST(VolumeWriters, LayersAndFurtherFieldsGoIntoNrrd)
{
  const TempFolder folder;
  VolumeToWrite    volume;
  volume.geometry.size = { 2, 1, 1 };
  volume.layers = 2;
  volume.fields = "Segment0_ID:=S\nSegment0_Layer:=1\nSegment0_LabelValue:=4\nSegment0_Name:=liver\n";
  const std::array<std::byte, 4> bytes{ std::byte{ 0 }, std::byte{ 4 }, std::byte{ 1 }, std::byte{ 0 } };
  volume.slice = [&](std::int64_t) { return std::span<const std::byte>(bytes); };
  WriteNrrd(folder / "a.seg.nrrd", volume);
  const ScanFile scan = OpenNrrd(folder / "a.seg.nrrd", {});
  EXPECT_EQ(scan.interleaved, 2U);
  ASSERT_EQ(scan.segments.size(), 1U);
  EXPECT_EQ(scan.segments[0].name, "liver");
  EXPECT_EQ(scan.segments[0].layer, 1U);
  EXPECT_EQ(scan.segments[0].value, 4);
}

TEST(VolumeWriters, AFullDiskIsAnOutputErrorInEveryFormat)
{
  VolumeToWrite volume;
  volume.geometry.size = { 300, 300, 20 };
  volume.compress = false;
  std::vector<std::byte> slice(90000);
  volume.slice = [&](std::int64_t) { return std::span<const std::byte>(slice); };
  for (const auto & [name, format] : kWriters)
  {
    if (name.find(".mhd") == std::string::npos && name.find(".gz") == std::string::npos)
    {
      EXPECT_THROW(format.write("/dev/full", volume), OutputError) << name;
    }
    EXPECT_THROW(format.write("/nowhere/" + name, volume), OutputError) << name;
  }
}

TEST(VolumeWriters, LengthsInVoxelsAndFractionsComeBackAsSuch)
{
  const std::vector<float> values{ 0.5F, -1.25F, 3e10F, 0, 1, 2 };
  VolumeToWrite            volume;
  volume.geometry.size = { 3, 2, 1 };
  volume.geometry.unit = SpatialUnit::Voxels;
  volume.type = PixelType::Float32;
  volume.slice = [&](std::int64_t) { return std::as_bytes(std::span(values)); };
  for (const auto & [name, format] : kWriters)
  {
    SCOPED_TRACE(name);
    const TempFolder folder;
    if (name == "a.tif")
    {
      volume.geometry.size[2] = 2; // one page is no volume
    }
    format.write(folder / name, volume);
    ScanFile scan = format.open(folder / name, {});
    volume.geometry.size[2] = 1;
    EXPECT_EQ(scan.type, PixelType::Float32);
    EXPECT_EQ(scan.geometry.unit, SpatialUnit::Voxels);
    std::vector<float> got(values.size());
    scan.voxels->Read(reinterpret_cast<std::byte *>(got.data()), got.size() * sizeof(float));
    EXPECT_EQ(got, values);
  }
}

TEST(VolumeWriters, ASliceOfMoreThanAMegabyteComesBackFromEveryFormat)
{
  std::vector<std::uint64_t> values(600 * 600);
  std::generate(values.begin(), values.end(), [random = std::mt19937_64(7)]() mutable { return random(); });
  VolumeToWrite volume;
  volume.geometry.size = { 600, 600, 2 };
  volume.type = PixelType::UInt64;
  volume.slice = [&](std::int64_t) { return std::as_bytes(std::span(values)); };
  for (const auto & [name, format] : kWriters)
  {
    const TempFolder folder;
    volume.compress = name == "a.mha"; // which is copied behind its header
    format.write(folder / name, volume);
    ScanFile                   scan = format.open(folder / name, {});
    std::vector<std::uint64_t> got(values.size());
    scan.voxels->Skip(values.size() * sizeof(std::uint64_t));
    scan.voxels->Read(reinterpret_cast<std::byte *>(got.data()), got.size() * sizeof(std::uint64_t));
    EXPECT_TRUE(got == values) << name;
  }
}
