#pragma once
// The order in which points are inserted: near ones soon after each other, yet spread over the whole set first.

#include "voxelcore/LatticePoint.h"

#include <cstdint>
#include <vector>

namespace voxelcore
{

/** A biased randomized insertion order (Amenta, Choi, Rote 2003): rounds that double in size, each along a Hilbert
 *  curve. The same for the same points in the same order. */
std::vector<std::uint32_t>
InsertionOrder(const std::vector<LatticePoint> & points);

} // namespace voxelcore
