#pragma once
// `voxelcore reconstruct`: the balls of a finished core as a volume.

#include "voxelcore/Jobs/JobContext.h"
#include "voxelcore/Lattice/ImageGeometry.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

struct ReconstructOptions
{
  std::filesystem::path                core; ///< .vtp
  std::optional<std::filesystem::path> like; ///< a scan on whose grid the volume is made; else that of the core's scan
  std::optional<std::filesystem::path> scan; ///< the scan the core was made from, to compare with
  std::filesystem::path                output; ///< .nrrd .nii .nii.gz .mha .mhd .tif .ome.zarr
  std::optional<std::filesystem::path> report;
  bool                                 force = false;
  std::string                          command; ///< only recorded
};

/** How the volume compares with the scan. */
struct ReconstructComparison
{
  std::uint64_t voxels = 0;            ///< of the scan's label
  double        dice = 0;              ///< 2 |A and B| / (|A| + |B|)
  double        surfaceDistanceMm = 0; ///< largest, from a boundary vertex of either to the nearest of the other
  double        boundaryGapMm = 0;     ///< largest, from a boundary vertex of the scan to the balls themselves
};

struct ReconstructedLabel
{
  std::int64_t                         label = 0;
  std::string                          name;
  std::uint64_t                        voxels = 0;
  std::uint64_t                        contested = 0; ///< voxels in its balls that a label of smaller value has
  std::optional<ReconstructComparison> comparison;
};

struct ReconstructResult
{
  std::string                     command;
  std::string                     core;
  ImageGeometry                   geometry;
  std::vector<ReconstructedLabel> labels;
  std::vector<std::string>        warnings; ///< about the scans; a user must see them
  std::vector<std::string>        notes;
};

/** A voxel is in where its centre lies in a ball of the core (UnionOfBalls); in balls of several labels, in the one of
 *  smallest value. A whole core with cubic voxels gives the scan's labels themselves.
 *  \throws UsageError, InputError (also when the scan does not fit the core), OutputError, Cancelled */
ReconstructResult
RunReconstructJob(const ReconstructOptions & options, const JobContext & context = {});

/** A table for people. */
std::string
ReconstructText(const ReconstructResult & result);

} // namespace voxelcore
