#pragma once
// What may take the place of a cut or fill: a least vertex cut, a cheapest way, a part filled or taken out as a whole.

#include "ChangeWindow.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace voxelcore
{

/** Voxels ascend. */
struct ChangeProposal
{
  bool          isFill = false;
  std::uint64_t cost = 0;
  VoxelNumbers  voxels;
  VoxelNumbers  between; ///< of a wall: what lies between it and the change it stands for
};

/** A change within a window. */
struct ChangeInWindow
{
  const ChangeWindow & window;
  bool                 isFill = false;
  bool                 mayTurn = false; ///< into a cut from a fill, or the other way round
  std::int32_t         reach = 0;       ///< what is as many steps away or more stays
  std::uint64_t        total = 0;       ///< its cost
  VoxelNumbers         voxels;          ///< ascending
  /** The cost of making a voxel part of a cut or of a fill; 0 of what must stay. */
  std::function<std::uint64_t(std::size_t number, bool isFill)> cost;
};

/** All that cost less than the change, the cheapest first. `now` is the window with the change. */
std::vector<ChangeProposal>
ProposeChanges(const ChangeInWindow & change, std::vector<char> now);

} // namespace voxelcore
