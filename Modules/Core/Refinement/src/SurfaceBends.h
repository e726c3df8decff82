#pragma once
// How a surface bends about places on it, to tell how far it is to where it is nearest.

#include "voxelcore/Refinement/SurfaceEstimate.h"

#include <array>

namespace voxelcore
{

/** The shape operator of a surface at a place, from normals beside it. */
struct SurfaceBend
{
  std::array<float, 3> along{};    ///< the first of two directions at right angles to the normal and to each other
  std::array<float, 3> bends{};    ///< along the first, between both, along the second, 1/mm
  float                stride = 0; ///< mm to where normals were taken; 0: not known
};

/** From normals `stride` mm to either side. */
SurfaceBend
BendOf(const SurfaceEstimate & surface, const SurfacePoint & at, double stride, double reach);

/** Two directions at right angles to a normal and to each other, the first nearest to `near`. */
std::array<Vector3, 2>
TangentsOf(const Vector3 & normal, const Vector3 & near);

/** How the distance from a place grows along the surface, as half its square is bent: 1 where the surface is flat, 0
 *  where it is round about the place. Along the two directions where that is least and most. */
struct DistanceBends
{
  std::array<double, 2>  bends{};      ///< the lesser first
  std::array<Vector3, 2> directions{}; ///< unit vectors
};
/** Of a place `away` mm off the surface along its normal. */
DistanceBends
DistanceBendsOf(const SurfaceBend & bend, const Vector3 & normal, double away);

} // namespace voxelcore
