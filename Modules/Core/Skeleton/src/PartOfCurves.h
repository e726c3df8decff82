#pragma once
// The curves of a surface followed into a part of it that pruning has left.

#include "CurveFire.h"
#include "TurnedSurface.h"

#include "voxelcore/Complex/SimplePairCollapse.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Skeleton/ErosionThickness.h"
#include "voxelcore/VoxelCore/ExtractPart.h"

#include <cstdint>
#include <vector>

namespace voxelcore
{

/** Where a curve ends. */
struct TipPlace
{
  Vector3       place{};   ///< mm
  std::uint32_t component; ///< of the surface: the smallest vertex of the piece it is on
};

/** Per vertex the smallest vertex of its piece. */
std::vector<std::uint32_t>
ComponentOfVertices(const CellComplex & cells);

/** Leaves a part of a burned surface, given by the surface's elements before it was turned, and of `components` those
 *  of its vertices. */
void
KeepPart(const LiveElements & part, TurnedSurface & turned, BurnTimes & times, std::vector<std::uint32_t> & components);

/** Of the live curves only those stay that lead from one vertex to another of those nearest to the tips on the same
 *  piece, or around cycles; one vertex of pieces that have neither. */
void
KeepWaysBetween(const std::vector<TipPlace> &      tips,
                const MedialComplex &              surface,
                const std::vector<std::uint32_t> & components,
                const CurveFire &                  fire,
                LiveElements &                     live);

} // namespace voxelcore
