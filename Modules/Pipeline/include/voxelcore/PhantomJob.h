#pragma once
// `voxelcore phantom`: synthetic volumes.

#include "voxelcore/JobContext.h"
#include "voxelcore/Phantom.h"

#include <filesystem>
#include <string>

namespace voxelcore
{

struct PhantomJobOptions
{
  PhantomOptions        phantom;
  std::filesystem::path output; ///< .nrrd .nii .nii.gz .mha .mhd .tif
  bool                  force = false;
};

/** The kinds, a paragraph each, for people. */
std::string
PhantomList();

/** Makes and writes a volume with one label, 1. Returns one line that says what was made.
 *  \throws UsageError, OutputError, Cancelled */
std::string
RunPhantomJob(const PhantomJobOptions & options, const JobContext & context = {});

} // namespace voxelcore
