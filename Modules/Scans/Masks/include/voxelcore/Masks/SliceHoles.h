#pragma once
// Holes of a shape's slices: what a slice encloses though the shape as a whole does not, such as the lumen of a tube.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace voxelcore
{

/** The axis across which slices lie, by the names of voxel indices. */
enum class SliceAxis : std::uint8_t
{
  I,
  J,
  K
};

/** "i", "j" or "k"; nothing for another text. */
std::optional<SliceAxis>
SliceAxisNamed(std::string_view name);

/** The inverse. */
std::string_view
SliceAxisName(SliceAxis axis);

/** The background of each slice that does not reach the slice's border, by steps over edges and corners of pixels: the
 *  counterpart of the shape's 6-connection, which in a slice is one over edges alone. Outside the image is background.
 *  A shape of the same box; `count` becomes the number of holes over all slices. \throws Cancelled */
VoxelShape
FindSliceHoles(const VoxelShape & shape, SliceAxis axis, std::uint64_t & count, const ProgressCallback & progress = {});

/** With these holes made shape. Counts voxelsAdded, componentsJoined and, as cavitiesFilled, the holes. */
EditedShape
FillSlices(VoxelShape shape, SliceAxis axis, const ProgressCallback & progress = {});

} // namespace voxelcore
