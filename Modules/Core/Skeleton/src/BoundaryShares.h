#pragma once
// Which part of a shape's boundary belongs to which point of a set.

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace voxelcore
{

/** A point that takes the places to which it is nearest by |x - place|^2 - weight; ties go to the smaller index. */
struct WeightedSite
{
  Vector3 place{};    ///< mm along the axes of the grid: lattice coordinates times spacing
  double  weight = 0; ///< mm^2
  Vector3 axis{};     ///< unit vector across which the integral is taken; 0: in all directions
};

/** What a site has of a shape. */
struct BoundaryShare
{
  double volume = 0; ///< mm^3
  double moment = 0; ///< mm^4: of that volume along the site's axis, from its place on
};

/** Per site half the integral over its part of the boundary of (x - place) n across `axis`, where n points outwards:
 *  the volume of a slab across the axis. Each face of a voxel belongs as a whole to the site of its middle. The same
 *  bits for every number of threads. */
std::vector<BoundaryShare>
BoundaryShares(const VoxelShape & shape, const Vector3 & spacing, const std::vector<WeightedSite> & sites);

} // namespace voxelcore
