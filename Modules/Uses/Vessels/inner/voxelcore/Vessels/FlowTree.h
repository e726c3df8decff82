#pragma once
// Skeletons directed from their inlets.

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/VoxelShape.h"
#include "voxelcore/Skeleton/MeasuredSkeleton.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace voxelcore
{

/** What is known of where flow enters. */
struct InletChoice
{
  std::vector<Vector3>    places; ///< LPS mm: each is the tip nearest to it, of all skeletons
  ImageGeometry           geometry;
  std::optional<VoxelBox> border{}; ///< of the scan, where it cuts vessels
};

/** Per skeleton the nodes where flow enters, ascending. A component with none of the places enters at its tip with the
 *  thickest branch (mean radius; of equals the first), of those at the border where there are any. One without tips has
 *  no inlet. */
std::vector<std::vector<ElementIndex>>
FindInlets(const std::vector<MeasuredSkeleton> & parts, const InletChoice & choice);

/** A skeleton's branches from the inlet of each component outwards: its tree of thickest branches. Those off the tree
 *  close loops. */
struct FlowTree
{
  std::vector<ElementIndex> roots;     ///< nodes: the first inlet of each component
  std::vector<ElementIndex> order;     ///< nodes that are reached, each after the one it is reached from
  std::vector<ElementIndex> into;      ///< per node the branch by which it is reached; kNoBranch: none
  std::vector<double>       way;       ///< per node the length to its inlet, mm; infinite where it has none
  std::vector<std::uint8_t> isForward; ///< per branch: whether its first node is nearer to the inlet, along the tree
  std::vector<std::uint8_t> isOnTree;  ///< per branch
};

FlowTree
DirectFlow(const MeasuredSkeleton & part, const std::vector<ElementIndex> & inlets);

} // namespace voxelcore
