#pragma once
// Topology of a mask simplified (TopologySimplification.h) where no grey values say what may change: by distance to the
// boundary.
//
// Only voxels within a depth of the boundary may change. A voxel stands for its centre. Those of the shape farther than
// the depth from all background are the kernel and never cut; background within the depth of the shape, in the shape's
// own box, may be filled. What cutting or filling a voxel costs is its distance to the other side. Distances are the
// exact integers of the lattice (SpacingWeights.h), so voxels need not be cubes.
// The box is no limit: a way from piece to piece that leaves it can be moved into it without getting farther from
// the shape.

// A greater depth need not give fewer loops: it merges candidates into clusters too large to compare all choices.
// Time, on a root of 480 x 480 x 480 with 593,487 boundary vertices: 1 s for a depth of two voxels, 5 s for four.
// Memory there: 90 and 110 MB more than reading takes.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Lattice/TopologyNumbers.h"
#include "voxelcore/Masks/ShapeClosing.h"
#include "voxelcore/Masks/TopologySimplification.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <string>

namespace voxelcore
{

/** Costs are whole numbers: this many are one smallest spacing. */
inline constexpr double kCostOfOneVoxel = 16;

/** The places within `depth` of one. \throws InputError for a length in mm where the image's are in voxels, and for
 *  more than 32 voxels. */
LatticeBall
BallOfDepth(const GapWidth & depth, const ImageGeometry & geometry);

struct DepthSimplified
{
  SimplifiedShape simplified;
  std::string     reason; ///< of a request that was missed: what the bounds themselves have; else empty
};

/** Simplifies a shape by changes no deeper than the ball's radius. \throws InputError, Cancelled as SimplifyTopology */
DepthSimplified
SimplifyWithin(const VoxelShape &       shape,
               const LatticeBall &      ball,
               const TopologyRequest &  request = {},
               const ProgressCallback & progress = {});

/** The voxels within the ball's radius of the shape, in its own box. \throws Cancelled */
VoxelShape
VoxelsAround(const VoxelShape & shape, const LatticeBall & ball, const ProgressCallback & progress = {});

/** What changing a voxel costs here. The shape must outlive it. */
ChangeCost
DepthCost(const VoxelShape & shape, const LatticeBall & ball);

/** "1 piece, 2 loops and 0 cavities" */
std::string
CountsText(const TopologyNumbers & numbers);

} // namespace voxelcore
