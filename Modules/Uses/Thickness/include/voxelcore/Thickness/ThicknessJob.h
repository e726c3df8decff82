#pragma once
// `voxelcore thickness`: local thickness at every voxel of a scan's labels.

#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Thickness/ThicknessFiles.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace voxelcore
{

/** What becomes of voxels whose ball touches the border of the scan. */
enum class BorderRule
{
  Flag, ///< all count; the numbers without them stand beside
  Keep, ///< all count
  Drop  ///< they do not count
};

/** The background that is measured, too. */
enum class SeparationRegion
{
  None,
  Box,   ///< within the box around all labels
  Hull,  ///< within their convex hull
  Within ///< within another label of the scan, or a mask
};

struct ThicknessOptions
{
  CoreOptions           core;           ///< what is read and computed, and its report; nothing of it is written
  std::filesystem::path output;         ///< .nrrd .nii .nii.gz .mha .mhd .tif .ome.zarr, or a folder (IsFolderOutput)
  bool                  bounds = false; ///< proven bounds as volumes beside: OUT_lower, OUT_upper
  BorderRule            border = BorderRule::Flag;
  SeparationRegion      separation = SeparationRegion::None; ///< as a volume beside: OUT_separation
  std::string           within;                 ///< of SeparationRegion::Within: labels as --labels has them, or a mask
  std::optional<std::filesystem::path> surface; ///< .vtp: the labels' surfaces with the point array Thickness
  std::optional<std::filesystem::path> medial;  ///< .vtp: the medial surface with it
  std::optional<std::filesystem::path> table;   ///< .csv; a histogram and a data dictionary go beside
};
// A label that needs more than core.memory, or else than the machine has, is measured block by block
// (ThicknessInBlocks.h). Bounds, and outputs that show the core, need the whole label.

struct ThicknessResult
{
  CoreReport                   report;
  std::vector<ThicknessRecord> thickness; ///< per label of the report; then the separation, where it was asked for
  std::vector<std::string>     warnings;
  std::vector<std::string>     notes;
  std::size_t                  blocks = 0; ///< windows that were computed where labels were measured block by block
};

/** The volumes have the scan's grid, float32, mm (voxels where the scan has no voxel size), and 0 outside. Each label
 *  is measured by itself. Everything is written or nothing. The same bits for every number of threads.
 *  \throws UsageError, InputError, OutputError, CertificateError, Cancelled */
ThicknessResult
RunThicknessJob(const ThicknessOptions & options, const JobContext & context = {});

/** Per ball, whether it comes within half a voxel of a side of `box`, in voxel indices. */
std::vector<char>
BallsAtSides(const PaintingBalls & balls, const ImageGeometry & geometry, const VoxelBox & box);

/** The numbers of a map. `atBorder`: per voxel, whether its ball meets the border, where it may have been larger. */
void
SummarizeMap(const VoxelValues &   map,
             const ImageGeometry & geometry,
             std::span<const char> atBorder,
             BorderRule            border,
             ThicknessRecord &     record);

/** The same, and the bounds. `touches`: per ball, whether it meets the border. */
void
Summarize(const CertifiedThickness & found,
          const ImageGeometry &      geometry,
          std::span<const char>      touches,
          BorderRule                 border,
          ThicknessRecord &          record);

/** A table for people. */
std::string
ThicknessText(const ThicknessResult & result);

} // namespace voxelcore
