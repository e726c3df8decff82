#pragma once
// A scan that has been opened: what its header says, in one form for all formats, and its voxels as a stream.

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/ByteStream.h"
#include "voxelcore/Formats/ReadOptions.h"
#include "voxelcore/Labels/StoredVoxels.h"
#include "voxelcore/Lattice/CheckedGeometry.h"

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

/** Warns where a scan of slices has but one: the volume is one voxel thick. */
void
NoteOneSlice(std::size_t slices, ScanFile & scan);

/** The scan's warnings, each behind its name. */
std::vector<std::string>
WarningsOf(const ScanFile & scan);

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
