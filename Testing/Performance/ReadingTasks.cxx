#include "ReadingTasks.h"

#include "ProcessFigures.h"

#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Phantom/Phantom.h"
#include "voxelcore/Shape/BoundaryVertices.h"

#include <png.h>
#include <tiffio.h>
#include <zlib.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace voxelcore::performance
{
namespace
{

using Size = std::array<std::int32_t, 3>;

double
Now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double
PeakMegabytes()
{
  return StatusBytes("VmHWM:") * 1e-6;
}

/** A slice of the shape as bytes 0 and 1. */
std::vector<std::uint8_t>
SliceOf(const VoxelShape & shape, const Size & size, std::int32_t z)
{
  std::vector<std::uint8_t> slice(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]));
  const VoxelBox            box = shape.Box();
  if (z < box.lower[2] || z >= box.lower[2] + box.size[2])
  {
    return slice;
  }
  for (std::int32_t y = 0; y < box.size[1]; ++y)
  {
    const auto row = shape.Row(y, z - box.lower[2]);
    auto *     to = slice.data() + static_cast<std::size_t>(y + box.lower[1]) * static_cast<std::size_t>(size[0]) +
                static_cast<std::size_t>(box.lower[0]);
    for (std::int32_t x = 0; x < box.size[0]; ++x)
    {
      to[x] = static_cast<std::uint8_t>(row[static_cast<std::size_t>(x) >> 6] >> (x & 63) & 1U);
    }
  }
  return slice;
}

void
WritePages(const VoxelShape & shape, const Size & size, std::uint16_t compression, const std::string & path, bool apart)
{
  TIFF * tiff = nullptr;
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    if (tiff == nullptr)
    {
      std::array<char, 32> name{};
      std::snprintf(name.data(), name.size(), "/%05d.tif", z);
      tiff = TIFFOpen((apart ? path + name.data() : path).c_str(), "w");
      if (tiff == nullptr)
      {
        throw std::runtime_error("cannot write " + path);
      }
    }
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, size[0]);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, size[1]);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, compression);
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 64);
    auto slice = SliceOf(shape, size, z);
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      if (TIFFWriteScanline(tiff,
                            slice.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(size[0]),
                            static_cast<std::uint32_t>(y),
                            0) < 0)
      {
        throw std::runtime_error("cannot write " + path);
      }
    }
    TIFFWriteDirectory(tiff);
    if (apart)
    {
      TIFFClose(tiff);
      tiff = nullptr;
    }
  }
  if (tiff != nullptr)
  {
    TIFFClose(tiff);
  }
}

void
WritePngs(const VoxelShape & shape, const Size & size, const std::string & folder)
{
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    const auto           slice = SliceOf(shape, size, z);
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "/%05d.png", z);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(size[0]);
    image.height = static_cast<png_uint_32>(size[1]);
    image.format = PNG_FORMAT_GRAY;
    if (png_image_write_to_file(&image, (folder + name.data()).c_str(), 0, slice.data(), 0, nullptr) == 0)
    {
      throw std::runtime_error("cannot write " + folder + name.data());
    }
  }
}

void
WriteScans(const std::string & sizeText, const std::string & folder)
{
  std::istringstream words(sizeText);
  PhantomOptions     options;
  options.kind = "root";
  char comma = 0;
  if (!(words >> options.size[0] >> comma >> options.size[1] >> comma >> options.size[2]))
  {
    throw std::runtime_error("--size X,Y,Z");
  }
  const Size              size = options.size;
  std::vector<LabelShape> labels(1);
  labels[0].value = 1;
  labels[0].shape = MakePhantom(options);
  labels[0].voxels = labels[0].shape.CountVoxels();
  ImageGeometry geometry;
  geometry.size = { size[0], size[1], size[2] };
  std::filesystem::create_directories(folder);
  WriteLabelVolume(folder + "/raw.nrrd", geometry, labels, false);
  WriteLabelVolume(folder + "/gzip.nrrd", geometry, labels, true);
  WriteLabelVolume(folder + "/raw.mha", geometry, labels, false);
  WriteLabelVolume(folder + "/raw.nii", geometry, labels, false);
  WriteLabelVolume(folder + "/gzip.nii.gz", geometry, labels, true);
  WritePages(labels[0].shape, size, COMPRESSION_NONE, folder + "/raw.tif", false);
  WritePages(labels[0].shape, size, COMPRESSION_ADOBE_DEFLATE, folder + "/deflate.tif", false);
  WritePages(labels[0].shape, size, COMPRESSION_LZW, folder + "/lzw.tif", false);
  for (const char * name : { "/tiffs", "/pngs" })
  {
    std::filesystem::create_directories(folder + name);
  }
  WritePages(labels[0].shape, size, COMPRESSION_NONE, folder + "/tiffs", true);
  WritePngs(labels[0].shape, size, folder + "/pngs");
}

void
ReadScan(const std::string & path, const std::string & how)
{
  ReadOptions options;
  options.binary = how == "binary";
  const double   start = Now();
  const double   cpuStart = ProcessorSeconds();
  const LabelMap volume = ReadLabelVolume(path, options);
  const double   read = Now() - start;
  const double   cpuRead = ProcessorSeconds() - cpuStart;
  std::uint64_t  vertices = 0;
  for (const LabelShape & label : volume.labels)
  {
    vertices += BoundaryVertices(label.shape).size();
  }
  const auto & size = volume.geometry.size;
  std::cout << read << ' ' << cpuRead << ' ' << Now() - start - read << ' ' << vertices << ' '
            << static_cast<double>(size[0]) * static_cast<double>(size[1]) * static_cast<double>(size[2]) << ' '
            << volume.labels.size() << ' ' << PeakMegabytes() << '\n';
}

/** Where the packed bytes begin: behind the blank line of an NRRD header, or at once. */
std::streamoff
PackedBegin(const std::string & path)
{
  if (!path.ends_with(".nrrd"))
  {
    return 0;
  }
  std::ifstream file(path, std::ios::binary);
  for (std::string line; std::getline(file, line);)
  {
    if (line.empty())
    {
      return file.tellg();
    }
  }
  throw std::runtime_error("no NRRD header in " + path);
}

void
Inflate(const std::string & path)
{
  const double                                           start = Now();
  const double                                           cpuStart = ProcessorSeconds();
  const std::unique_ptr<std::FILE, int (*)(std::FILE *)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file || std::fseek(file.get(), PackedBegin(path), SEEK_SET) != 0)
  {
    throw std::runtime_error("cannot read " + path);
  }
  std::vector<Bytef> packed(256 * 1024);
  std::vector<Bytef> plain(4U << 20); // as the reader has them
  z_stream           zlib{};
  inflateInit2(&zlib, 15 + 32);
  int status = Z_OK;
  while (status == Z_OK || status == Z_BUF_ERROR)
  {
    if (zlib.avail_in == 0)
    {
      zlib.avail_in = static_cast<uInt>(std::fread(packed.data(), 1, packed.size(), file.get()));
      zlib.next_in = packed.data();
      if (zlib.avail_in == 0)
      {
        break;
      }
    }
    zlib.next_out = plain.data();
    zlib.avail_out = static_cast<uInt>(plain.size());
    status = inflate(&zlib, Z_NO_FLUSH);
  }
  inflateEnd(&zlib);
  if (status != Z_STREAM_END)
  {
    throw std::runtime_error("cannot inflate " + path);
  }
  std::cout << Now() - start << ' ' << ProcessorSeconds() - cpuStart << '\n';
}

} // namespace

std::vector<ReadingScan>
ReadingScans()
{
  return { { "NRRD raw", "raw.nrrd", false },
           { "NRRD gzip", "gzip.nrrd", true },
           { "MetaImage raw", "raw.mha", false },
           { "NIfTI", "raw.nii", false },
           { "NIfTI gzip", "gzip.nii.gz", true },
           { "TIFF pages raw", "raw.tif", false },
           { "TIFF pages deflate", "deflate.tif", false },
           { "TIFF pages LZW", "lzw.tif", false },
           { "TIFF slices raw", "tiffs", false },
           { "PNG slices", "pngs", false } };
}

int
RunReadingTask(int argc, char ** argv)
{
  const std::string task = argc > 2 ? argv[2] : "";
  if (task == "write" && argc == 5)
  {
    WriteScans(argv[3], argv[4]);
  }
  else if (task == "read" && argc == 5)
  {
    ReadScan(argv[3], argv[4]);
  }
  else if (task == "inflate" && argc == 4)
  {
    Inflate(argv[3]);
  }
  else
  {
    throw std::runtime_error("unknown task");
  }
  return 0;
}

} // namespace voxelcore::performance
