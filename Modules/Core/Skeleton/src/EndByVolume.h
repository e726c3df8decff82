#pragma once
// The end of a tube, by its volume.

#include "WayLine.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <optional>

namespace voxelcore
{

// Balls between the corners of voxels are smaller than the body, by so many diagonals on average.
inline constexpr double kMeanExcess = 0.25;

/** Where the half ball around the end of a branch has its centre, if it is one of a tube. `line` leads from the end of
 *  the branch inwards, of which `free` is nothing but the branch; `radius` is about that of the tube, and stands for it
 *  where too little is free to measure it. `isBar`: the line ends at another tip. Places and lengths in mm along the
 *  grid (lattice coordinates times spacing). */
std::optional<Vector3>
FindEndByVolume(const VoxelShape & shape,
                const Vector3 &    spacing,
                const WayLine &    line,
                double             free,
                double             radius,
                bool               isBar);

} // namespace voxelcore
