#pragma once
// A scan that has been opened: what its header says, in one form for all formats, and its voxels as a stream.

#include "ByteStream.h"
#include "voxelcore/CheckedGeometry.h"
#include "voxelcore/Error.h"
#include "voxelcore/LabelVolume.h"
#include "voxelcore/StoredVoxels.h"
#include "voxelcore/TextFields.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace voxelcore
{

struct ScanFile : StoredVoxels
{
  std::string              format;            ///< as LabelMap::format
  std::string              storedType;        ///< as LabelMap::pixelType; empty: PixelName(type)
  bool                     swapBytes = false; ///< the stream's byte order is not this machine's
  std::vector<std::string> notes;
  std::vector<std::string> warnings;

  bool                        moreVolumes = false; ///< the stream goes on behind the volume that is read
  bool                        hasMore = false;     ///< what follows the voxels in the file is no surprise
  std::unique_ptr<ByteStream> voxels;              ///< i fastest, then j, then k, from the first voxel on
};

/** The scan's warnings, each behind its name. */
std::vector<std::string>
WarningsOf(const ScanFile & scan);

/** What VoxelCore writes as the description of a NIfTI file whose lengths are in voxels: the format has no such unit.
 *  */
inline constexpr std::string_view kNiftiInVoxels = "VoxelCore: lengths in voxels";

/** One opener a format. \throws InputError */
ScanFile
OpenNrrd(const std::filesystem::path & path, const ReadOptions & options);
ScanFile
OpenNifti(const std::filesystem::path & path, const ReadOptions & options);
ScanFile
OpenMetaImage(const std::filesystem::path & path, const ReadOptions & options);
ScanFile
OpenMgh(const std::filesystem::path & path, const ReadOptions & options);
ScanFile
OpenTiff(const std::filesystem::path & path, const ReadOptions & options);
/** Bare voxels, by options.raw or by a text beside them. */
ScanFile
OpenRaw(const std::filesystem::path & path, const ReadOptions & options);
/** Whether a text beside bare voxels says what they are, or the file is such a text (.dat). */
bool
IsRawFile(const std::filesystem::path & path);
/** That text, or for it the voxels. */
std::vector<std::filesystem::path>
RawFileTexts(const std::filesystem::path & path);
/** Voxels in `data` that a text in the manner of MetaImage describes. */
ScanFile
OpenMetaText(const std::filesystem::path & data, const std::filesystem::path & text, const ReadOptions & options);
/** Whether a file begins as such a text. */
bool
IsMetaText(const std::filesystem::path & path);
/** A folder, or a pattern in the last part of the path: `*` stands for anything, `%d`, `%04d` or a run of `#` for a
 *  number. */
ScanFile
OpenSlices(const std::filesystem::path & path, const ReadOptions & options);
/** A Zarr store, an image or an array in it. Only chunks that options.crop touches are read; beyond it voxels are 0. */
ScanFile
OpenZarr(const std::filesystem::path & path, const ReadOptions & options);
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
/** Metadata and chunks of the part that options choose. */
std::vector<std::filesystem::path>
ZarrFiles(const std::filesystem::path & path, const ReadOptions & options);
/** The slices that a folder or pattern stands for, in natural order. */
std::vector<std::filesystem::path>
SlicePaths(const std::filesystem::path & path);

/** Kinds of scans, told by the extension. */
enum class ScanKind : std::uint8_t
{
  Nrrd,
  Nifti,
  MetaImage,
  Mgh,
  Tiff,
  Png,
  Slices,
  Zarr,
  Unknown
};
ScanKind
ScanKindOf(const std::filesystem::path & path);

/** By its kind. */
ScanFile
OpenScan(const std::filesystem::path & path, const ReadOptions & options);

/** CheckedGeometry() of scan.geometry.size and unit, with the notes in the scan's. */
void
SetGeometry(ScanFile &                     scan,
            const std::array<Vector3, 3> & axes,
            const Vector3 &                spacing,
            const Vector3 &                origin,
            const ReadOptions &            options);

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
