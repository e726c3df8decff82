#pragma once
// How finely places of results are told apart.

namespace voxelcore
{

/** Of a voxel's side; places are multiples of it (BodyFrame.h). Far below what refining, or a measurement, can tell,
 *  and twenty bits of a double are left to say which voxel. */
inline constexpr double kPlaceStep = 0x1p-32;

} // namespace voxelcore
