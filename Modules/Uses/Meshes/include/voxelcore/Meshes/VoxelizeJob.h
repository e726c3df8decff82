#pragma once
// `voxelcore voxelize`: a mesh in, volumes out; and studies of a mesh's core at several resolutions.

#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Jobs/JobContext.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

struct VoxelizeJobOptions
{
  std::filesystem::path                mesh;
  std::vector<std::int64_t>            resolutions; ///< either these; several give OUT_resolution-256.nrrd and so on
  std::optional<Vector3>               spacing;     ///< or this, mm
  MeshReading                          reading;
  std::filesystem::path                output; ///< .nrrd .nii .nii.gz .mha .mhd .tif .ome.zarr
  std::optional<std::filesystem::path> report; ///< .json
  bool                                 force = false;
};

struct VoxelizeResult
{
  std::vector<std::string> lines; ///< one per volume, saying what was made
  std::vector<std::string> warnings;
};

/** Writes a volume with one label, 1, per resolution. All or nothing.
 *  \throws UsageError, InputError, OutputError, Cancelled */
VoxelizeResult
RunVoxelizeJob(const VoxelizeJobOptions & options, const JobContext & context = {});

/** What `voxelcore core MESH` did at several resolutions. */
struct StudyResult
{
  std::vector<CoreResult> runs; ///< in the order of the resolutions
  std::filesystem::path   table;
};

/** RunCoreJob at each resolution: OUT_resolution-256.vtp and so on, before what several lambdas add, or in a folder
 *  DIR/ DIR/resolution-256/; reports likewise; and one table, `options.table` or OUT.csv, a row for each resolution and
 *  result. All or nothing.
 *  \throws what RunCoreJob throws */
StudyResult
RunStudyJob(const CoreOptions &               options,
            const std::vector<std::int64_t> & resolutions,
            const JobContext &                context = {});

} // namespace voxelcore
