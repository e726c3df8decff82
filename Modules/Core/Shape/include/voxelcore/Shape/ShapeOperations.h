#pragma once
// Cutting and cleaning a voxel shape before its core is computed. Shapes are taken by value: move one in, and no
// second copy is made where nothing changes. Components are the shape's own, 6-connected; results lie in tight boxes.

#include "voxelcore/Shape/VoxelShape.h"

#include <cstdint>
#include <vector>

namespace voxelcore
{

/** A shape after an operation, and what that changed. */
struct EditedShape
{
  VoxelShape    shape;
  std::uint64_t voxelsRemoved = 0;
  std::uint64_t voxelsAdded = 0;
  std::uint64_t componentsRemoved = 0; ///< components that are gone with all their voxels
  std::uint64_t componentsJoined = 0;  ///< by how many there are fewer because they became parts of others
  std::uint64_t cavitiesFilled = 0;    ///< 26-connected components of the background
};

/** The smallest box that holds both; one without voxels counts for nothing. */
VoxelBox
BoxOfBoth(const VoxelBox & a, const VoxelBox & b);

/** The voxels inside `box` (voxel indices of the scan; it may reach beyond the shape's box, and a side of no voxels
 *  means an empty box). Components and cavities that are cut may fall apart or open: they are not counted. */
EditedShape
CropToBox(VoxelShape shape, const VoxelBox & box);

/** The same voxels, of a shape that stays as it is. */
VoxelShape
VoxelsWithin(const VoxelShape & shape, const VoxelBox & box);

/** Without the components of fewer than `minVoxels` voxels. */
EditedShape
RemoveSmallComponents(VoxelShape shape, std::uint64_t minVoxels);

/** Only the `count` components of most voxels; of equally large ones, those whose first voxel comes first in scan order
 *  (z, then y, then x fastest). All of them where there are no more than `count`. */
EditedShape
KeepLargestComponents(VoxelShape shape, std::uint64_t count);

/** With every cavity, a 26-connected component of the background other than the outside, made shape: b2 becomes 0.
 *  A component that floats in a cavity becomes part of the one around it, so b0 may fall (by componentsJoined); the
 *  handles of a cavity's wall go, too. Components that do not lie in a cavity stay apart. */
EditedShape
FillCavities(VoxelShape shape);

/** The voxels of each component, the largest first. */
std::vector<std::uint64_t>
ComponentSizes(const VoxelShape & shape);

/** Each component as a shape of its own, by number of voxels, the largest first; equally large ones by their first
 *  voxel in scan order. */
std::vector<VoxelShape>
SplitComponents(const VoxelShape & shape);

/** How many of the bits begin, begin + 1, .., end - 1 of a row are set: none where end <= begin. begin >= 0,
 *  end <= 64 row.size(). */
std::int32_t
CountBits(const ConstShapeRow & row, std::int32_t begin, std::int32_t end);

} // namespace voxelcore
