#pragma once
// How much of the shape lies around a voxel.

#include "voxelcore/Shape/PaddedShape.h"

namespace voxelcore
{

// Weights (1 2 1) along each axis, applied once, blur; 2 x once - twice keeps what is curved where it is, to second
// order (one step of the sharpening behind Taubin's smoothing of meshes), so that thin parts do not seem to lie
// outside.
constexpr std::array<std::int32_t, 5> kBlurOnce{ 0, 4, 8, 4, 0 };  ///< / 16
constexpr std::array<std::int32_t, 5> kBlurTwice{ 1, 4, 6, 4, 1 }; ///< / 16
constexpr std::int32_t                kFieldWhole = 4096;
constexpr std::int32_t                kFieldOwn = 2 * 8 * 8 * 8 - 6 * 6 * 6; ///< of the voxel itself
constexpr std::int32_t                kFieldHalf = (kFieldWhole - kFieldOwn) / 2;

/** The weights of what is in of the 5 x 5 x 5 voxels about one, itself left out: kFieldHalf on a flat boundary between
 *  voxels. The weights are symmetric under all turns and reflections of the grid. */
std::int32_t
FieldAround(const PaddedShape & shape, const Voxel & at);

} // namespace voxelcore
