#pragma once
// The skeleton of a body that was made to go on beyond its scan's border, cut where the scan ends.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Shape/BorderExtension.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <cstddef>
#include <vector>

namespace voxelcore
{

/** Cuts a skeleton at the border of the box `scan`, in voxels of `geometry`. What lies beyond the border goes from the
 *  tips inwards, and a branch that crosses the border ends in it; so the topology stays. What remains outside, as the
 *  fork of two branches that leave the scan together, is pushed back straight into the border, and so into the section
 *  it stands on. With BorderEnds::Overlap the border runs through the middle of the outermost layers, and the nearest
 *  end in each of `sections` is put into the section's centre; where there is none, a straight branch leads there from
 *  the nearest point of its component of `voxels`. Gives the number of tips in the border. */
std::size_t
CutAtBorder(SkeletonGraph &                    graph,
            const VoxelShape &                 voxels,
            const VoxelBox &                   scan,
            const ImageGeometry &              geometry,
            BorderEnds                         ends,
            const std::vector<BorderSection> & sections);

} // namespace voxelcore
