#pragma once
// `voxelcore straighten`: a scan along a vessel.

#include "voxelcore/Formats/ReadOptions.h"
#include "voxelcore/Jobs/JobContext.h"
#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace voxelcore
{

enum class SampleKind : std::uint8_t
{
  Auto,   ///< of labels the nearest, of grey values linear
  Linear, ///< between the middles of voxels
  Nearest ///< that of the voxel a place lies in
};

struct StraightenOptions
{
  std::filesystem::path                      scan;          ///< grey values or labels
  std::filesystem::path                      skeleton;      ///< .vtp that 'voxelcore skeleton' wrote
  ReadOptions                                reading;       ///< of the scan
  std::optional<std::int64_t>                label;         ///< of the skeleton; needed where it has several
  std::int64_t                               component = 0; ///< of this label, where it was split
  std::vector<std::int64_t>                  branches;      ///< in a row; else
  std::optional<std::pair<Vector3, Vector3>> ends;          ///< points near the skeleton, LPS mm
  std::optional<Vector3>                     spacing;       ///< across, up, along, mm; else the least of the scan
  std::optional<Lambda>                      width; ///< to each side of the axis; else twice the greatest radius
  SampleKind                                 samples = SampleKind::Auto;
  double                                     outside = 0; ///< value where there is no scan
  std::filesystem::path                      output;      ///< .nrrd .nii .nii.gz .mha .mhd .tif .ome.zarr
  std::optional<std::filesystem::path>       table;       ///< .csv, a row per plane; its columns go beside
  std::optional<std::filesystem::path>       points;      ///< .csv with the columns x, y, z or across, up, arc_length
  std::optional<std::filesystem::path>       mapped;      ///< .csv: the same with all of these
  bool                                       force = false;
};

struct StraightenResult
{
  ImageGeometry            geometry; ///< of the volume: its third axis is arc length, the others begin at the axis
  double                   length = 0;
  bool                     isLinear = false;
  double                   tightestBend = 0; ///< radius, mm
  std::size_t              mapped = 0;       ///< points
  std::vector<std::string> warnings;
  std::vector<std::string> notes;
};

/** Writes the volume of planes across a way through the skeleton (Straightening.h): whole numbers from 0 on as they
 *  are, if they are not mixed, and else float32. Places of the volume are across, up and arc length, in mm. The same
 *  for every number of threads.
 *  \throws UsageError, InputError, OutputError, Cancelled */
StraightenResult
RunStraightenJob(const StraightenOptions & options, const JobContext & context = {});

/** For people. */
std::string
StraightenText(const StraightenResult & result);

} // namespace voxelcore
