#pragma once
// How much of a shape's topology is as fine as noise makes it.

#include "voxelcore/Progress.h"
#include "voxelcore/ShapeTopology.h"
#include "voxelcore/VoxelShape.h"

#include <cstdint>
#include <optional>

namespace voxelcore
{

/** Loops, cavities and pieces that are less than three voxels wide. */
struct FineTopology
{
  std::uint64_t loops = 0;    ///< that MendShape closes
  std::uint64_t cavities = 0; ///< that it fills
  std::uint64_t joined = 0;   ///< pieces that it joins to others
  std::uint64_t specks = 0;   ///< pieces of less than 27 voxels that stay apart

  std::uint64_t
  Sum() const
  {
    return loops + cavities + joined + specks;
  }
};

constexpr std::uint64_t kSpeckVoxels = 27; ///< pieces of fewer are specks

/** Counts them where a shape may have fifty. None where it has fewer, or where they are less than a tenth of all its
 *  loops, cavities and pieces: so none of a foam or a gyroid whose holes are wide. Takes as long as MendShape(), and no
 *  time where `topology`, the shape's own, has fewer than fifty of them all. \throws Cancelled */
std::optional<FineTopology>
FindFineTopology(const VoxelShape & shape, const TopologyNumbers & topology, const ProgressCallback & progress = {});

} // namespace voxelcore
