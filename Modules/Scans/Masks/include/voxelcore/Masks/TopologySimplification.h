#pragma once
// A shape made topologically as simple as asked by the least change between two bounds (after Zeng, Chambers, Letscher
// and Ju, To cut or to fill: a global optimization approach to topological simplification, SIGGRAPH Asia 2020).
//
// Three nested shapes: the kernel is never cut, the neighbourhood may be filled, and the shape lies between. The kernel
// grows inside the shape by simple voxels, the costliest to cut first; what stays out, by 6-connected components, are
// the cuts to choose from. The neighbourhood shrinks towards the shape in the same way; what stays in are the fills.
// Topology numbers of every choice are sums over a small graph, so choices are compared exactly: candidates that cannot
// affect each other apart, all choices of up to twelve, up to eight neighbouring candidates at a time in greater
// clusters (three, and one, in still greater ones), so that these need not get the least change. Then every changed
// voxel that may go back without a change of topology goes back, the costliest first. What touches is one change: a
// wall that is cut hangs together over edges and corners. Each change is made anew where it costs least, by a least
// vertex cut or a cheapest way within some voxels of it, all else staying. The numbers of the result are counted anew
// from its voxels.
//
// The same result on every run. Equal costs are told apart by the order in which voxels are reached, so a turned or
// mirrored scan gives the turned result where costs differ.
// Memory: about eight bits a voxel of the neighbourhood's box, and what the voxels between the bounds need in turn.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Lattice/TopologyNumbers.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace voxelcore
{

/** What it costs to change a voxel between kernel and neighbourhood, in indices of the scan: at least 1; of grey values
 *  how far the value is beyond the level of the shape, of masks how deep the voxel lies. */
using ChangeCost = std::function<std::uint32_t(std::int32_t x, std::int32_t y, std::int32_t z)>;

/** The topology numbers asked for; with none, as few pieces, loops and cavities together as the bounds allow. With
 *  some, those not given stay what they are. */
struct TopologyRequest
{
  std::optional<std::int64_t> pieces;
  std::optional<std::int64_t> loops;
  std::optional<std::int64_t> cavities;

  bool
  IsGiven() const
  {
    return pieces || loops || cavities;
  }
};

/** One cut or fill that was made. */
struct TopologyChange
{
  bool                        isFill = false;
  std::uint64_t               voxels = 0;
  std::uint64_t               cost = 0;
  std::array<double, 3>       centre{ 0, 0, 0 };     ///< mean of its voxels, in indices of the scan
  std::array<std::int64_t, 3> difference{ 0, 0, 0 }; ///< it makes to pieces, loops and cavities, all else being done
  std::vector<std::array<std::int32_t, 3>> where;    ///< its voxels, in indices of the scan
};

struct SimplifiedShape
{
  VoxelShape                  shape;
  TopologyNumbers             before;
  TopologyNumbers             after;          ///< counted from the voxels of the result
  bool                        asAsked = true; ///< whether all numbers asked for were reached
  std::uint64_t               voxelsAdded = 0;
  std::uint64_t               voxelsRemoved = 0;
  std::uint64_t               cost = 0; ///< of all changed voxels
  std::vector<TopologyChange> changes;  ///< the costliest first
};

/** Simplifies `shape`. An empty kernel is taken for the costliest voxel of the shape.
 *  \throws InputError where the shapes are not nested or a number asked for is negative; CertificateError where the
 *  numbers counted from the result are not those the graph foresaw; Cancelled */
SimplifiedShape
SimplifyTopology(const VoxelShape &       kernel,
                 const VoxelShape &       shape,
                 const VoxelShape &       neighbourhood,
                 const ChangeCost &       cost,
                 const TopologyRequest &  request = {},
                 const ProgressCallback & progress = {});

} // namespace voxelcore
