#pragma once
// Scans written byte by byte, as their formats define them: never with the writers that belong to the readers.

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Imaging/LabelVolume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace voxelcore::testing
{

/** A folder that goes with the test. */
class TempFolder : public TemporaryFolder
{
public:
  TempFolder()
  {} // clang 14 wants it for a const member

  /** Writes a file and returns its path. */
  std::filesystem::path
  Write(const std::string & name, std::string_view bytes) const;
};

/** One value's bytes. */
template <typename T>
std::string
Raw(T value, bool big = false)
{
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big != (std::endian::native == std::endian::big))
  {
    std::reverse(bytes.begin(), bytes.end());
  }
  return bytes;
}

/** Many values' bytes. */
template <typename T, typename U>
std::string
RawAll(const std::vector<U> & values, bool big = false)
{
  std::string bytes;
  for (const U & value : values)
  {
    bytes += Raw<T>(static_cast<T>(value), big);
  }
  return bytes;
}

std::string
Gzip(std::string_view bytes);
std::string
Zlib(std::string_view bytes);

/** NRRD: the lines between the magic and the blank line, then data. */
std::string
Nrrd(const std::vector<std::string> & lines, std::string_view data);
/** Lines for a volume of this type and size, LPS, spacing 1, origin 0, little endian, raw. */
std::vector<std::string>
NrrdLines(const std::string & type, const std::array<int, 3> & size);

/** A NIfTI header of either version and byte order. */
struct NiftiFields
{
  int                       version = 1;
  bool                      big = false;
  bool                      pair = false;
  std::vector<std::int64_t> dim;
  int                       datatype = 2;
  int                       bitpix = 8;
  std::array<double, 4>     pixdim{ 1, 1, 1, 1 };
  double                    slope = 0;
  double                    intercept = 0;
  int                       units = 2;
  int                       qformCode = 0;
  int                       sformCode = 0;
  std::array<double, 3>     quaternion{};
  std::array<double, 3>     qoffset{};
  std::array<double, 12>    srow{};
  double                    voxOffset = -1; ///< -1: just behind the header
};
std::string
NiftiHeaderBytes(const NiftiFields & fields);
std::string
Nifti(const NiftiFields & fields, std::string_view data);

/** MetaImage: the lines before ElementDataFile, which is LOCAL, then data. */
std::string
Meta(const std::vector<std::string> & lines, std::string_view data);

/** A TIFF page: its tags and its strips or tiles as they lie in the file. */
struct TiffPage
{
  std::uint32_t                                        width = 0;
  std::uint32_t                                        height = 0;
  int                                                  bits = 8;
  int                                                  sampleFormat = 1;
  int                                                  compression = 1;
  int                                                  photometric = 1;
  int                                                  samples = 1;
  std::uint32_t                                        rowsPerStrip = 0; ///< 0: all rows
  std::uint32_t                                        tileWidth = 0;    ///< 0: strips
  std::uint32_t                                        tileHeight = 0;
  std::string                                          description;
  std::vector<std::pair<std::uint16_t, std::uint32_t>> more; ///< further LONG tags
  std::vector<std::string>                             parts;
  std::vector<std::pair<std::uint16_t, double>>        rationals{}; ///< in millionths
  std::vector<std::pair<std::uint16_t, std::string>>   blocks{};    ///< further BYTE tags, more than four bytes each
};
struct TiffLayout
{
  bool big = false;     ///< byte order
  bool bigTiff = false; ///< 64-bit offsets
};
std::string
Tiff(const std::vector<TiffPage> & pages, const TiffLayout & layout = {});
/** PackBits of literal runs only. */
std::string
PackBits(std::string_view bytes);
/** LZW with a clear code before the table can grow: codes of nine bits. */
std::string
Lzw(std::string_view bytes);

/** The label that voxel (x,y,z) has, 0 for background. */
std::int64_t
ValueAt(const LabelMap & volume, int x, int y, int z);
/** All voxels' labels, x fastest. */
std::vector<std::int64_t>
AllValues(const LabelMap & volume);
/** Reading fails with InputError in one line that names the file and holds each text. */
void
ExpectRefused(const std::filesystem::path &    path,
              const std::vector<std::string> & texts,
              const ReadOptions &              options = {});
/** LPS mm of the centre of voxel (x,y,z). */
Vector3
CentreOf(const LabelMap & volume, int x, int y, int z);
void
ExpectNear(const Vector3 & a, const Vector3 & b, double tolerance = 1e-6);
bool
HasNote(const std::vector<std::string> & notes, const std::string & text);

} // namespace voxelcore::testing
