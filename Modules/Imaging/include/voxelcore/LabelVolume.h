#pragma once
// A segmented scan as VoxelCore sees it: geometry, and one voxel shape per label.

#include "voxelcore/ImageGeometry.h"
#include "voxelcore/Progress.h"
#include "voxelcore/VoxelShape.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** One label of a scan. */
struct LabelShape
{
  std::int64_t  value = 0;
  std::string   name;       ///< from the file, from the .txt beside it, or "label-<value>"
  std::uint64_t voxels = 0; ///< how many carry it
  VoxelShape    shape;      ///< in its tight bounding box
};

/** A scan that was read. Labels are sorted by value. */
struct LabelVolume
{
  ImageGeometry            geometry;
  std::string              format;    ///< "NRRD", "NIfTI-1", "NIfTI-2", "MetaImage", "TIFF", "TIFF slices"
  std::string              pixelType; ///< as stored: "uint8", "int16", "float32", ...
  std::vector<std::string> notes;     ///< what was assumed or converted, one sentence each; for the report
  std::vector<std::string> warnings;  ///< those of the notes a user must see
  std::vector<LabelShape>  labels;
};

/** How to read. */
struct ReadOptions
{
  std::string                              labels = "all";         ///< "all", or values or names separated by commas
  bool                                     binary = false;         ///< all non-zero values are one shape, label 1
  std::optional<std::pair<double, double>> threshold;              ///< grey scan: lo <= value <= hi is one shape
  std::optional<Vector3>                   spacing;                ///< mm, instead of the file's
  bool                                     orthonormalize = false; ///< accept the nearest orthonormal direction
  std::string                              niftiForm = "auto";     ///< "auto" (ITK's rule), "sform" or "qform"
  std::optional<std::int64_t>              volume;                 ///< which volume of a 4-D file
};

/** Reads the labels of a scan in one pass over its voxels: .nrrd .nhdr .seg.nrrd .nii .nii.gz .hdr/.img .mha .mhd
 *  .tif .tiff (multi-page) or a folder or pattern of TIFF slices in natural order.
 *  Values are whole numbers or the scan is refused; nothing is ever rounded, clipped or reinterpreted.
 *  \throws InputError with one line when the file is missing, damaged or unfit, when a label asked for does not occur,
 *  or when there is nothing but background; Cancelled when the callback says so. */
LabelVolume
ReadLabelVolume(const std::filesystem::path & path,
                const ReadOptions &           options = {},
                const ProgressCallback &      progress = {});

/** Writes labels as a volume: .nrrd .nii .nii.gz .mha .mhd .tif by the extension of `path`; the smallest unsigned type
 *  that holds the values. Compressed where the format can (`compress`).
 *  \throws OutputError when it cannot be written, UsageError for an unknown extension or an unfit value. */
void
WriteLabelVolume(const std::filesystem::path &   path,
                 const ImageGeometry &           geometry,
                 const std::vector<LabelShape> & labels,
                 bool                            compress = true);

} // namespace voxelcore
