#pragma once
// Walls beside sharp edges.

#include "BandField.h"
#include "SmoothingZones.h"

#include <optional>

namespace voxelcore
{

/** Where passes go beside sharp edges of what is thick. Passes that flatten bends make walls swell beside an edge, by
 *  a sixth of a voxel at most, and wider ones carry that further. So these keep away from it, and a pass that flattens
 *  less draws walls in by as much. Creases between walls are left as they are. */
struct ZonesAtEdges
{
  SmoothingZones flat;   ///< for wider passes: without what is near an edge
  SmoothingZones beside; ///< what is drawn in
  SmoothingZones all;    ///< both
};

/** `thick` are zones of the depths' first radius, `radius`; the field has taken its first passes. None where there are
 *  no edges. */
std::optional<ZonesAtEdges>
FindZonesAtEdges(const BandField & field, const BoundaryDepth & depth, double radius, const SmoothingZones & thick);

/** The weight of the pass that draws in, with a Gaussian of the root of 2 sigma. */
constexpr float kDrawsIn = -0.6F;

} // namespace voxelcore
