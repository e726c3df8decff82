#pragma once
// A surface put into an order that does not depend on how the scan was turned.

#include "voxelcore/Complex/SimplePairCollapse.h"
#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/VoxelCore/ExtractPart.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <cstddef>
#include <cstdint>
#include <vector>

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
  std::vector<std::uint32_t> starts; ///< per face: twice the place that its first corner had among its corners, and one
                                     ///< more where it runs the other way round
};

/** Positions of `surface` in LPS mm of `geometry`, of which spacing, origin and direction are used.
 *  \throws InputError when a position is beyond 2^31 voxels. */
TurnedSurface
TurnSurface(const MedialComplex & surface, const ImageGeometry & geometry);

/** Where a corner of a turned face, and the side behind it, are among those of the face as it was. */
struct PlaceBefore
{
  std::size_t corner;
  std::size_t side;

  PlaceBefore(std::size_t i, std::size_t count, std::size_t start, bool back)
    : corner((back ? start + count - i : start + i) % count)
    , side(!back         ? corner
           : corner == 0 ? count - 1
                         : corner - 1)
  {}
};

/** All cells of a surface as they were before it was turned. */
CellComplex
CellsBefore(const TurnedSurface & turned);

/** The cells that are left of a surface, as ExtractLive() would take them out of it as it was before it was turned.
 *  `left` is by turned index; `elements` receives what each was in the surface. */
CellComplex
CellsBefore(const TurnedSurface & turned, const LiveElements & left, PartElements & elements);

} // namespace voxelcore
