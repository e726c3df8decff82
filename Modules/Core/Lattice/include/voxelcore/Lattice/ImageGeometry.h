#pragma once
// Where the voxels of a scan lie in the patient: LPS millimetres, as ITK has them. Where a file gives no voxel size,
// the unit is the voxel, and every length and place called mm in this library is one in voxels.

#include "voxelcore/Base/SpatialUnit.h"

#include <array>
#include <cstdint>

namespace voxelcore
{

using Vector3 = std::array<double, 3>;

/** physical = origin + direction * (spacing .* index); index (0,0,0) is the centre of the first voxel. */
struct ImageGeometry
{
  std::array<std::int64_t, 3> size{ 0, 0, 0 };                        ///< voxels along i, j, k
  Vector3                     spacing{ 1, 1, 1 };                     ///< mm
  Vector3                     origin{ 0, 0, 0 };                      ///< LPS mm of the centre of voxel (0,0,0)
  std::array<double, 9>       direction{ 1, 0, 0, 0, 1, 0, 0, 0, 1 }; ///< row-major; its columns are the axes
  SpatialUnit                 unit = SpatialUnit::Millimetres;        ///< of spacing, origin and all that follows
};

/** LPS mm of a point given in lattice coordinates (lattice = voxel index + 1/2). */
Vector3
LatticeToPhysical(const ImageGeometry & geometry, const Vector3 & lattice);

/** The inverse of LatticeToPhysical. The direction must be invertible. */
Vector3
PhysicalToLattice(const ImageGeometry & geometry, const Vector3 & physical);

/** True when the map from index to LPS mirrors: polygons must then be reversed to keep their orientation. */
bool
IsLeftHanded(const ImageGeometry & geometry);

/** How far the direction is from orthonormal: the largest deviation of an angle between two axes from 90 degrees, in
 *  degrees, or of an axis' length from 1 expressed as asin of the excess, whichever is greater. */
double
OrthonormalityDeviationDegrees(const ImageGeometry & geometry);

/** The largest coordinate in LPS mm that is met on the way from index to LPS: origin plus extent. */
double
LargestCoordinate(const ImageGeometry & geometry);

/** Doubles must tell places within a voxel apart: no coordinate may exceed 2^36 times the finest spacing, so that
 *  positions keep 2^-17 of a voxel or better. Scans lie well within: 10^6 mm away, voxels may be as fine as 15 nm.
 *  \throws InputError where the image lies farther off, or its origin or direction is not finite. */
void
RequireDistinctPositions(const ImageGeometry & geometry);

} // namespace voxelcore
