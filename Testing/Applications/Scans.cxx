#include "Scans.h"

#include "VoxelCoreTesting/TemporaryFolder.h"

#include <cstring>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <zlib.h>

namespace voxelcore::testing
{

void
TestScan::Fill(const std::array<std::size_t, 3> & first, const std::array<std::size_t, 3> & last, std::uint8_t value)
{
  for (std::size_t z = first[2]; z <= last[2]; ++z)
  {
    for (std::size_t y = first[1]; y <= last[1]; ++y)
    {
      for (std::size_t x = first[0]; x <= last[0]; ++x)
      {
        At(x, y, z) = value;
      }
    }
  }
}

void
WriteNrrd(const std::filesystem::path & path, const std::string & header, const std::string & bytes)
{
  WriteAll(path, "NRRD0004\n" + header + "encoding: raw\n\n" + bytes);
}

void
WriteNrrd(const std::filesystem::path & path, const TestScan & scan)
{
  std::ostringstream header;
  header << "type: uint8\ndimension: 3\nsizes: " << scan.size[0] << ' ' << scan.size[1] << ' ' << scan.size[2]
         << "\nspace: left-posterior-superior\nspace directions: (" << scan.spacing[0] << ",0,0) (0," << scan.spacing[1]
         << ",0) (0,0," << scan.spacing[2] << ")\nspace origin: (-5,6.5,7)\n";
  WriteNrrd(path, header.str(), std::string(scan.voxels.begin(), scan.voxels.end()));
}

TestScan
ThreeBlocks()
{
  TestScan scan({ 14, 12, 10 });
  scan.spacing = { 1, 1, 2 };
  scan.Fill({ 1, 1, 1 }, { 6, 10, 8 }, 1);
  scan.Fill({ 7, 1, 1 }, { 12, 10, 4 }, 2);
  scan.Fill({ 7, 1, 5 }, { 12, 10, 8 }, 9);
  scan.At(3, 4, 4) = 0; // a cavity in label 1
  return scan;
}

TestScan
CropNifti(const std::filesystem::path &      path,
          const std::array<std::size_t, 3> & first,
          const std::array<std::size_t, 3> & size)
{
  struct Closer
  {
    void
    operator()(gzFile_s * file) const
    {
      gzclose(file);
    }
  };
  const std::unique_ptr<gzFile_s, Closer> file(gzopen(path.c_str(), "rb"));
  TestScan                                crop({ 0, 0, 0 });
  if (!file)
  {
    return crop;
  }
  std::array<char, 348> header;
  if (gzread(file.get(), header.data(), header.size()) != static_cast<int>(header.size()))
  {
    throw std::runtime_error(path.string() + ": no NIfTI header");
  }
  std::array<std::int16_t, 4> dimensions;
  std::int16_t                type = 0;
  float                       offset = 0;
  std::memcpy(dimensions.data(), header.data() + 40, sizeof(dimensions));
  std::memcpy(&type, header.data() + 70, sizeof(type));
  std::memcpy(&offset, header.data() + 108, sizeof(offset));
  if (type != 2)
  {
    throw std::runtime_error(path.string() + ": not of bytes");
  }
  TestScan whole({ static_cast<std::size_t>(dimensions[1]),
                   static_cast<std::size_t>(dimensions[2]),
                   static_cast<std::size_t>(dimensions[3]) });
  gzseek(file.get(), static_cast<z_off_t>(offset), SEEK_SET);
  if (gzread(file.get(), whole.voxels.data(), static_cast<unsigned>(whole.voxels.size())) !=
      static_cast<int>(whole.voxels.size()))
  {
    throw std::runtime_error(path.string() + ": too short");
  }
  crop = TestScan(size);
  for (std::size_t z = 0; z < size[2]; ++z)
  {
    for (std::size_t y = 0; y < size[1]; ++y)
    {
      for (std::size_t x = 0; x < size[0]; ++x)
      {
        crop.At(x, y, z) = whole.At(first[0] + x, first[1] + y, first[2] + z);
      }
    }
  }
  return crop;
}

} // namespace voxelcore::testing
