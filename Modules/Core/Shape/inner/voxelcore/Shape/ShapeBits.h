#pragma once
// Packed rows cut and moved, a word at a time.

#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace voxelcore
{

/** Which of the 64 lattice corners from 64 * `word` on lie between voxels that are in and such as are out. `rows` are
 *  the four around the row of corners; corner x lies between voxels x - 1 and x, and `word` may be one beyond. */
inline std::uint64_t
MixedCorners(const std::array<ConstShapeRow, 4> & rows, std::size_t word)
{
  const auto          any = [&](std::size_t at) { return rows[0][at] | rows[1][at] | rows[2][at] | rows[3][at]; };
  const auto          all = [&](std::size_t at) { return rows[0][at] & rows[1][at] & rows[2][at] & rows[3][at]; };
  const bool          isWithin = word < rows[0].size();
  const std::uint64_t ownAny = isWithin ? any(word) : 0;
  const std::uint64_t ownAll = isWithin ? all(word) : 0;
  const std::uint64_t anyBefore = word > 0 ? any(word - 1) >> 63U : 0;
  const std::uint64_t allBefore = word > 0 ? all(word - 1) >> 63U : 0;
  return (ownAny | ownAny << 1U | anyBefore) & ~(ownAll & (ownAll << 1U | allBefore));
}

/** The smallest box that holds all voxels (size 0 and the same lower corner for an empty shape). */
VoxelBox
TightBox(const VoxelShape & shape);

/** The voxels inside `box`, which must lie within the shape's box, as a shape of just that box. */
VoxelShape
CopyBox(const VoxelShape & shape, const VoxelBox & box);

/** Sets the voxels of `shape` in `result`, whose box holds its box. */
void
PutInto(const VoxelShape & shape, VoxelShape & result);

/** CropToVoxels without a copy where the box is tight already. */
VoxelShape
Tightened(VoxelShape shape);

} // namespace voxelcore
