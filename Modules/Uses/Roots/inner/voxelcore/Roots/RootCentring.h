#pragma once
// Curves of thin roots put where the grey values say their middle is.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Roots/RootHierarchy.h"

#include <cstdint>
#include <functional>

namespace voxelcore
{

/** How much of a voxel, by its index, is root: 0 as the background, 1 as what is bright. */
using RootBrightness = std::function<double(std::int32_t x, std::int32_t y, std::int32_t z)>;

/** Moves the points of roots up to three slices in radius across the root towards the mean place of what is bright
 *  around them, by half a slice at most. A slice is the greatest spacing. A skeleton of voxels is known to about half a
 *  voxel; where a root is two slices thick, that turns the directions of laterals by several degrees.
 *
 *  Looked at are voxels up to 0.75 slices along the root and 0.6 slices beyond its radius. Where some of them are, in
 *  radii, nearer to another root, nothing is said. Moves are averaged along the root over about a slice, so that noise
 *  of single voxels counts little. Positions of `graph` are LPS mm of the scan; radii and what hangs together stay. */
void
CentreRoots(SkeletonGraph &        graph,
            const RootHierarchy &  roots,
            const ImageGeometry &  geometry,
            const RootBrightness & brightness);

} // namespace voxelcore
