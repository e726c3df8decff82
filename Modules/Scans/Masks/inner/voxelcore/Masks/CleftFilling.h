#pragma once
// Filling of clefts within a voxel shape: narrow hollows whose walls have holes.

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <array>
#include <cstdint>
#include <optional>

namespace voxelcore
{

/** Fills clefts within walls, narrow ones that no ball fits into and whose walls have holes: background of the shape
 *  from where fewer than 5 of the 26 directions to neighbours lead on for `reach` mm without meeting a wall. 5 lead out
 *  of a groove between two bodies that touch, 8 out of a gap between two plates, so that these stay; 2 lead out of a
 *  tube, so that its wall may have holes. `walls` holds the shape, and what else is a wall. In a direction of which a
 *  single step is longer than `reach` nothing is met. With the scan's size, walls go on beyond its border as they end
 *  there. All lies in the shape's own box. Counts voxelsAdded and componentsJoined. Time: proportional to the box, a
 *  word of 64 voxels at a time. The same on any number of threads. */
EditedShape
FillClefts(VoxelShape                                         shape,
           const VoxelShape &                                 walls,
           const Vector3 &                                    spacing,
           double                                             reach,
           const std::optional<std::array<std::int64_t, 3>> & scan = {});

} // namespace voxelcore
