#pragma once
// A core in the scan's space.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <cstdint>
#include <vector>

namespace voxelcore
{

/** The core of one label, or of one component of it, as it stands in a file: positions in LPS mm, polygons oriented for
 *  LPS. */
struct PlacedCore
{
  std::int64_t  label = 0;
  MedialComplex core;          ///< positions here are LPS mm; radii and measures mm as ever
  std::int64_t  component = 0; ///< from 1 for a label split into its components; 0: the whole label

  std::vector<Vector3> displacement{}; ///< LPS mm, of a refined core: what moved each vertex; else empty
  std::vector<double>  thickness{};    ///< mm, the shape's local thickness at each vertex, where it was measured
  std::vector<double>  radiusMargin{}; ///< mm per vertex, of one refined from labels: RadiusMargin.h; else empty
};

/** A core that PlaceInLps moved to LPS mm. */
PlacedCore
ToPhysical(MedialComplex core, const ImageGeometry & geometry, std::int64_t label);

} // namespace voxelcore
