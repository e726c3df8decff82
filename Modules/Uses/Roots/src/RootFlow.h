#pragma once
// In which direction each branch of a root system is run through, away from the stems.

#include "voxelcore/Roots/RootHierarchy.h"

#include <array>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** A branch seen from one of its ends. */
struct BranchEnd
{
  ElementIndex branch = 0;
  std::uint8_t last = 0; ///< 1: from its last point

  BranchEnd
  Other() const
  {
    return { branch, static_cast<std::uint8_t>(1 - last) };
  }
};

/** The branches of a graph with what decisions rest on. */
class RootBranches
{
public:
  explicit RootBranches(const SkeletonGraph & graph);

  const SkeletonGraph &
  Graph() const
  {
    return m_Graph;
  }
  std::size_t
  HubCount() const
  {
    return m_HubEnds.size();
  }
  ElementIndex
  HubOf(const BranchEnd & end) const
  {
    return m_Hubs[m_Graph.branchNodes[end.branch][end.last]];
  }
  /** The ends of branches at a hub. */
  const std::vector<BranchEnd> &
  EndsAt(ElementIndex hub) const
  {
    return m_HubEnds[hub];
  }
  bool
  IsJunction(ElementIndex hub) const
  {
    return m_HubEnds[hub].size() > 2;
  }
  /** Mean along it outside the balls at its ends; all of it where nothing is outside. */
  double
  Radius(ElementIndex branch) const
  {
    return m_Radius[branch];
  }
  double
  LengthOf(ElementIndex branch) const
  {
    return m_Length[branch];
  }
  /** The point number i from an end on. */
  ElementIndex
  PointFrom(const BranchEnd & end, std::size_t i) const
  {
    const auto points = m_Graph.Branch(end.branch);
    return end.last ? points[points.size() - 1 - i] : points[i];
  }
  /** The ball at an end. */
  double
  BallAt(const BranchEnd & end) const
  {
    return m_Graph.radius[PointFrom(end, 0)];
  }
  /** Unit vector away from an end, along the branch outside the ball there; `skip` mm more are left out. */
  Vector3
  DirectionFrom(const BranchEnd & end, double skip = 0) const;
  /** cos(turn) of going from a branch that arrives (its end there) on to one that leaves. */
  double
  Straightness(const BranchEnd & arrives, const BranchEnd & leaves) const
  {
    return -Dot(DirectionFrom(arrives), DirectionFrom(leaves));
  }
  /** How well a branch that arrives goes on as one that leaves: cos(turn) + kOfLikeness (thinner / thicker). */
  double
  Onward(const BranchEnd & arrives, const BranchEnd & leaves) const;
  /** What it costs to go on from one to another: 0 straight on and as thick, 1 back. */
  static double
  Crooked(double straightness, double likeness);
  /** Thinner radius over thicker. */
  double
  Likeness(ElementIndex a, ElementIndex b) const;

private:
  const SkeletonGraph &               m_Graph;
  std::vector<ElementIndex>           m_Hubs; ///< per node
  std::vector<std::vector<BranchEnd>> m_HubEnds;
  std::vector<double>                 m_Radius;
  std::vector<double>                 m_Length;
};

/** How branches are run through. */
struct RootFlow
{
  std::vector<BranchEnd>              sources;
  std::vector<std::uint8_t>           loose;    ///< per source
  std::vector<std::uint8_t>           base;     ///< per branch: which end is nearer to the stem
  std::vector<ElementIndex>           before;   ///< per branch: the one the way comes from; kNoRoot at a source
  std::vector<ElementIndex>           stemNext; ///< per branch of a stem the next one of it; kNoRoot for others
  std::vector<std::uint8_t>           isStem;   ///< per branch
  std::vector<std::vector<BranchEnd>> arrivals; ///< per hub the ends of branches that arrive, the cheapest first
  std::vector<ElementIndex>           nearStem; ///< per hub the source of the stem whose roots may run fused there

  BranchEnd
  Base(ElementIndex branch) const
  {
    return { branch, base[branch] };
  }
};

/** The branches of a stem, each seen from the end nearer to its base. */
using StemWay = std::vector<BranchEnd>;

/** Along the stems, and from them on by the cheapest way: turning and thinning cost, so does springing from a side, and
 *  a little does length, so that where roots touch neither is run through backwards. Next to a stem, where roots of a
 *  whorl run fused, only length costs. */
RootFlow
FlowFrom(const RootBranches & branches, const std::vector<StemWay> & stems);

/** What lies beyond the base of a branch. */
struct WhatFollows
{
  double length = 0;    ///< mm, of the longest way
  double junctions = 0; ///< of the way with most
};

std::vector<WhatFollows>
FindWhatFollows(const RootBranches & branches, const RootFlow & flow);

} // namespace voxelcore
