#pragma once
// Skeletons as networks of pipes, for solvers of flow.

#include "voxelcore/Vessels/FlowTree.h"

#include <cstdint>
#include <vector>

namespace voxelcore
{

enum class FlowNodeKind : std::uint8_t
{
  Inlet,
  Outlet, ///< any other end of one pipe
  Inner   ///< where pipes meet
};

/** Numbers are over all skeletons. */
struct FlowNode
{
  FlowNodeKind kind = FlowNodeKind::Inner;
  Vector3      place{};    ///< LPS mm
  double       radius = 0; ///< of the section, mm
  std::size_t  part = 0;   ///< the skeleton
};

/** A branch. It runs from the node nearer to the inlet to the other one, along the tree of thickest branches
 *  (FlowTree); in loops flow may go either way. Radii are SectionRadii(), linear between points. */
struct FlowSegment
{
  std::size_t  part = 0;
  ElementIndex branch = 0; ///< of this skeleton
  std::size_t  from = 0;   ///< nodes
  std::size_t  to = 0;
  double       length = 0; ///< mm
  double       meanRadius = 0;
  double       leastRadius = 0;
  double       greatestRadius = 0;
  double perRadius4 = 0; ///< integral of 1 / radius^4 along it, mm^-3: 8 viscosity / pi times it is its resistance
  double perRadius2 = 0; ///< the same of 1 / radius^2, mm^-1: density / pi times it is its inertance

  /** Radius of the even pipe of the same length and resistance. */
  double
  PoiseuilleRadius() const;
};

struct FlowNetwork
{
  std::vector<FlowNode>    nodes;
  std::vector<FlowSegment> segments; ///< by skeleton and branch
};

/** All branches, loops too. Nodes on one surface that stays are one node. Closed curves without junctions, isolated
 *  points, and what has radius 0 somewhere, have no flow and are left out. */
FlowNetwork
MakeFlowNetwork(const std::vector<MeasuredSkeleton> & parts, const std::vector<std::vector<ElementIndex>> & inlets);

} // namespace voxelcore
