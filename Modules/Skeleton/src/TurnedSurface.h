#pragma once
// A surface put into an order that does not depend on how the scan was turned.

#include "voxelcore/ImageGeometry.h"
#include "voxelcore/MedialComplex.h"

namespace voxelcore
{

/** A surface in the one of its 48 turned and mirrored places on the grid that its own shape picks, in canonical order
 *  there. What is computed on it, ties by index and sums in order included, is the same for a scan and for the same
 *  scan turned, up to a symmetry of the shape. */
struct TurnedSurface
{
  MedialComplex             surface; ///< cells, positions (mm from its corner, along turned axes), radius; nothing else
  std::vector<ElementIndex> vertices; ///< per vertex its index in the surface as it was
  std::vector<ElementIndex> edges;
  std::vector<ElementIndex> faces;
};

/** Positions of `surface` in LPS mm of `geometry`, of which spacing, origin and direction are used.
 *  \throws InputError when a position is beyond 2^31 voxels. */
TurnedSurface
TurnSurface(const MedialComplex & surface, const ImageGeometry & geometry);

} // namespace voxelcore
