#pragma once
// `--refine`: cores moved, within a voxel, to the medial axis of the smooth surface their voxels stand for.

#include "voxelcore/Certified/Certified.h"
#include "voxelcore/Jobs/ReadInput.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace voxelcore
{

/** What is asked for. */
struct RefineOptions
{
  std::string           surface; ///< "labels", "grey" or "mesh"; empty: nothing is refined
  std::filesystem::path grey;    ///< the scan with grey values; empty: the one that is read, by its threshold
  std::optional<std::pair<double, double>> greyRange; ///< the shape is where lo <= value <= hi; with `grey`
};

/** The source for a job's scan, or mesh, that was read like this: none when nothing is to be refined.
 *  Grey values are read around a label; of several labels all at once, where they fit into 512 MB.
 *  \throws UsageError when a surface is asked for that the input does not have; InputError when the grey scan does not
 *  lie where the labels do */
SurfaceSource
MakeSurfaceSource(const RefineOptions &         options,
                  const std::filesystem::path & scan,
                  const ReadOptions &           reading,
                  const InputScan &             input);

} // namespace voxelcore
