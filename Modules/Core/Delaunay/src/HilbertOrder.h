#pragma once
// An order in which points that are near each other follow each other.

#include "voxelcore/Lattice/LatticePoint.h"

#include <cstdint>
#include <vector>

namespace voxelcore
{

/** Sorts numbers of points, whose coordinates differ by up to 2^20, by their places along a Hilbert curve. */
void
SortAlongCurve(const std::vector<LatticePoint> & points, std::vector<std::uint32_t> & chosen);

} // namespace voxelcore
