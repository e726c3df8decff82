#pragma once
// A scan that has been opened: what its header says, in one form for all formats, and its voxels as a stream.

#include "ByteStream.h"
#include "voxelcore/Error.h"
#include "voxelcore/LabelVolume.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace voxelcore
{

enum class PixelType : std::uint8_t
{
  UInt8,
  Int8,
  UInt16,
  Int16,
  UInt32,
  Int32,
  UInt64,
  Int64,
  Float32,
  Float64
};

std::size_t
PixelBytes(PixelType type);

/** "uint8", "float32", ... */
const char *
PixelName(PixelType type);

inline bool
IsFloat(PixelType type)
{
  return type == PixelType::Float32 || type == PixelType::Float64;
}

/** A named segment of a .seg.nrrd. */
struct Segment
{
  std::string  name;
  std::size_t  layer = 0;
  std::int64_t value = 0;

  std::optional<std::array<double, 3>> color; ///< as LabelShape::color
};

struct ScanFile
{
  std::filesystem::path    path;
  std::string              format;     ///< as LabelMap::format
  std::string              storedType; ///< as LabelMap::pixelType; empty: PixelName(type)
  PixelType                type = PixelType::UInt8;
  bool                     swapBytes = false; ///< the stream's byte order is not this machine's
  ImageGeometry            geometry;
  std::size_t              interleaved = 1; ///< values a voxel in the stream, the fastest axis
  std::ptrdiff_t           component = -1;  ///< which of them to take; -1: all are layers of a segmentation
  double                   slope = 1;       ///< value = slope * stored + intercept
  double                   intercept = 0;
  std::vector<Segment>     segments;
  std::vector<std::string> notes;
  std::vector<std::string> warnings;

  bool                        moreVolumes = false; ///< the stream goes on behind the volume that is read
  std::unique_ptr<ByteStream> voxels;              ///< i fastest, then j, then k, from the first voxel on

  bool
  IsScaled() const
  {
    return slope != 1 || intercept != 0;
  }
};

/** The scan's warnings, each behind its name. */
std::vector<std::string>
WarningsOf(const ScanFile & scan);

/** One opener a format. \throws InputError */
ScanFile
OpenNrrd(const std::filesystem::path & path, const ReadOptions & options);
ScanFile
OpenNifti(const std::filesystem::path & path, const ReadOptions & options);
ScanFile
OpenMetaImage(const std::filesystem::path & path, const ReadOptions & options);
ScanFile
OpenTiff(const std::filesystem::path & path, const ReadOptions & options);
/** A folder, or a pattern in the last part of the path: `*` stands for anything, `%d`, `%04d` or a run of `#` for a
 *  number. */
ScanFile
OpenSlices(const std::filesystem::path & path, const ReadOptions & options);
/** Whether the path names slices: a folder, or a pattern that is no file. */
bool
AreSlices(const std::filesystem::path & path);
/** The files besides `path` itself that hold its voxels, as its header names them. \throws InputError */
std::vector<std::filesystem::path>
NrrdDataFiles(const std::filesystem::path & path);
std::vector<std::filesystem::path>
MetaImageDataFiles(const std::filesystem::path & path);
std::vector<std::filesystem::path>
NiftiPartner(const std::filesystem::path & path);
/** The slices that a folder or pattern stands for, in natural order. */
std::vector<std::filesystem::path>
SlicePaths(const std::filesystem::path & path);

/** Kinds of scans, told by the extension. */
enum class ScanKind : std::uint8_t
{
  Nrrd,
  Nifti,
  MetaImage,
  Tiff,
  Png,
  Slices,
  Unknown
};
ScanKind
ScanKindOf(const std::filesystem::path & path);

/** By its kind. */
ScanFile
OpenScan(const std::filesystem::path & path, const ReadOptions & options);

/** Sides as a header claims them, checked: each 1 to 2^30, and their product (times bytesPerVoxel) at most
 *  bytesPossible. Returns the product. */
std::uint64_t
CheckSize(const std::filesystem::path &       path,
          const std::array<std::int64_t, 3> & size,
          std::uint64_t                       bytesPerVoxel,
          std::uint64_t                       bytesPossible);

/** Sets spacing (mm), origin (LPS mm) and direction of scan.geometry, the latter from the directions (LPS, any length) of
 *  the axes i, j, k; applies options.spacing and options.orthonormalize. \throws InputError when they are no geometry */
void
SetGeometry(ScanFile &                     scan,
            const std::array<Vector3, 3> & directions,
            const Vector3 &                spacing,
            const Vector3 &                origin,
            const ReadOptions &            options);

/** The largest cosine between two of the three directions: 0 when they are orthogonal. */
double
LargestCosine(const std::array<Vector3, 3> & directions);

/** Checks options.component against the values a voxel has, which are `kind` ("colour image", ...), and returns the one
 *  to take. \throws InputError when there are several and none was chosen, or there is none of that number. */
std::uint64_t
ChooseComponent(const std::filesystem::path & path,
                std::uint64_t                 components,
                std::string_view              kind,
                const ReadOptions &           options);

/** Checks options.volume against the volumes there are and returns the one to read.
 *  \throws InputError when there are several and none was chosen, or there is none of that number. */
std::uint64_t
ChooseVolume(const std::filesystem::path & path, std::uint64_t volumes, const ReadOptions & options);

} // namespace voxelcore
