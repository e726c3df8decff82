#pragma once
// The formats a volume is written in. Written here and not through ITK's writers: those print to stderr when a disk is
// full, round geometry to a few digits (MetaIO) or do not know 64-bit values, and each is a page of text and numbers.

#include "voxelcore/Formats/ScanFile.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>

namespace voxelcore
{

/** The voxels of slice k, good until it is called again; so a volume need never be in memory as a whole. */
using SliceSource = std::function<std::span<const std::byte>(std::int64_t k)>;

/** A volume about to be written: unsigned whole numbers or float32 in this machine's byte order, i fastest. */
struct VolumeToWrite
{
  ImageGeometry geometry;
  PixelType     type = PixelType::UInt8;
  SliceSource   slice;
  bool          compress = true;
  std::int64_t  layers = 1; ///< NRRD only: so many values a voxel, on a leading list axis
  std::string   fields{};   ///< NRRD only: further lines of the header, each with its line end
  std::optional<std::map<std::int64_t, ListedLabel>> labels{}; ///< OME-Zarr only: values are labels, with these names
};

/** \throws OutputError when the file cannot be written in full. */
void
WriteNrrd(const std::filesystem::path & path, const VolumeToWrite & volume);
/** Packed when the name ends with .gz. */
void
WriteNifti(const std::filesystem::path & path, const VolumeToWrite & volume);
/** .mha, or .mhd with the voxels in a .raw or .zraw file beside it. */
void
WriteMetaImage(const std::filesystem::path & path, const VolumeToWrite & volume);
/** A folder, .ome.zarr, of versions 0.4 and 0.5 in one. \throws UsageError where axes are oblique */
void
WriteOmeZarr(const std::filesystem::path & path, const VolumeToWrite & volume);
/** One page a slice; BigTIFF when 4 GB may not do. */
void
WriteTiff(const std::filesystem::path & path, const VolumeToWrite & volume);

} // namespace voxelcore
