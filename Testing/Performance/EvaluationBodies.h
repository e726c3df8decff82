#pragma once
// Bodies whose medial axes are known, sampled at any rotation, resolution and spacing, clean or rough.

#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace voxelcore::evaluation
{

using Vector = std::array<double, 3>;

/** A solid about the origin; lengths in mm. */
struct Body
{
  std::string                           name;
  double                                reach = 0; ///< all of it lies within this distance of the origin
  std::function<double(const Vector &)> distance;  ///< signed, negative inside; exact to 4 mm from the surface
  std::function<double(const Vector &)> depth;     ///< of a place near the axis below the surface, mm
  std::vector<Vector>                   axis;      ///< samples of what a medial surface must have, about 0.25 mm apart
  std::vector<Vector>                   allowed;   ///< and of what else belongs to it: where branches join
  std::vector<Vector>                   tips;      ///< ends of curves
};

/** Ellipsoid; capsules of radius 1.5 to 8; slabs of thickness 3 to 20; a cone; rods and a plate on a thick body; a root
 *  system with known lines. */
std::vector<Body>
EvaluationBodies();

/** Where the voxels of a sample lie in the body. */
struct Placement
{
  std::array<Vector, 3>       axes;    ///< of the grid in the body, orthonormal
  Vector                      spacing; ///< mm
  Vector                      shift;   ///< mm, of the grid, less than a voxel
  std::array<std::int32_t, 3> size;
};

Placement
Place(const Body & body, const Vector & spacing, std::uint64_t seed);

Vector
ToBody(const Placement & placement, const Vector & lattice);

/** noise: standard deviation, in voxels, of what is added to the distance at each voxel; then only the largest
 *  component is kept and its cavities are filled. */
VoxelShape
Sample(const Body & body, const Placement & placement, double noise, std::uint64_t seed);

} // namespace voxelcore::evaluation
