#pragma once
// `voxelcore phantom`: synthetic volumes.

#include "voxelcore/Jobs/JobContext.h"
#include "voxelcore/Phantom/Phantom.h"
#include "voxelcore/Phantom/RootScan.h"

#include <filesystem>
#include <optional>
#include <string>

namespace voxelcore
{

struct PhantomJobOptions
{
  PhantomOptions        phantom;
  std::filesystem::path output; ///< .nrrd .nii .nii.gz .mha .mhd .tif .ome.zarr
  bool                  force = false;

  std::optional<std::filesystem::path> centreLines; ///< .swc or .rsml; of kind root only
  std::optional<RootScanOptions>       scan;        ///< of kind root: grey values of this scan; its `root` is not read
};

/** The kinds, a paragraph each, for people. */
std::string
PhantomList();

/** Makes and writes a volume with one label, 1, or with labels from 1 on, a body each, or grey values, and the true
 *  centre lines of a root: SWC in micrometres, LPS axes, type the order of the branch. Returns one line that says what
 *  was made. \throws UsageError, OutputError, Cancelled */
std::string
RunPhantomJob(const PhantomJobOptions & options, const JobContext & context = {});

} // namespace voxelcore
