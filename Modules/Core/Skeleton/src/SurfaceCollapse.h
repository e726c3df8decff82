#pragma once
// Collapsing a surface to curves in the order in which it burns.

#include "voxelcore/Complex/SimplePairCollapse.h"
#include "voxelcore/Skeleton/ErosionThickness.h"

#include <cstdint>
#include <vector>

namespace voxelcore
{

/** Removes pairs of a free edge and its face, the edge that burns first among those free at that moment. A face stays
 *  when its erosion thickness is at least `plateThreshold`, and then an edge that would be removed with another face
 *  without the plates stays with that face, so that no dangling edges appear but those of the curve.
 *  Closed faces stay in any case. All vertices stay. `closed` receives one flag a face. */
LiveElements
CollapseSurface(const MedialComplex &       surface,
                const BurnTimes &           times,
                double                      plateThreshold,
                std::vector<std::uint8_t> & closed);

} // namespace voxelcore
