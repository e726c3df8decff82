#pragma once
// Each cut and fill by itself at its least cost: growth by simple voxels finds the weakest level, not the least sum.
//
// In a window around a change, all else staying as it is, what parts two sides is parted anew by a least vertex cut
// (maximal flow, Dinic 1970), and what joins two parts by a cheapest way (Dijkstra); or the part goes as a whole, or
// stays. The new change is taken if it costs less and the window's Euler number, and how its pieces and its
// background hang together at its border, stay: then all topology numbers stay. A wall that would leave a loop or a
// scrap behind is moved there by simple voxels, or made anew without one of its voxels. Sides that meet within the
// window elsewhere are left as they are.

#include "SimpleFlips.h"

#include "voxelcore/Masks/TopologySimplification.h"

namespace voxelcore
{

/** What was there before anything was changed. */
struct ChangeBounds
{
  const VoxelShape & kernel;
  const VoxelShape & shape;
  const VoxelShape & neighbourhood;
};

/** Changes `shape` and the lists of its changes, up to some hundreds of them, the costliest first. \throws Cancelled */
void
RefineChanges(PaddedShape &            shape,
              const VoxelBox &         box,
              const ChangeBounds &     bounds,
              const PaddedCost &       cost,
              SimplifiedShape &        result,
              const ProgressCallback & progress);

} // namespace voxelcore
