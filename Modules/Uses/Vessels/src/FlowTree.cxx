#include "voxelcore/Vessels/FlowTree.h"

#include "BorderPlaces.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Skeleton/LoopClosers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace voxelcore
{

namespace
{

/** Per node with branches the number of its component. */
std::vector<ElementIndex>
ComponentsOf(const MeasuredSkeleton & part)
{
  std::vector<ElementIndex> components(part.graph.nodePoints.size(), 0);
  for (std::size_t branch = 0; branch < part.graph.BranchCount(); ++branch)
  {
    for (const ElementIndex node : part.graph.branchNodes[branch])
    {
      components[node] = part.table.branches[branch].component;
    }
  }
  return components;
}

/** Mean radius of the thickest branch at a node. */
std::vector<double>
RadiusAtNodes(const MeasuredSkeleton & part)
{
  std::vector<double> radius(part.graph.nodePoints.size(), 0);
  for (std::size_t branch = 0; branch < part.graph.BranchCount(); ++branch)
  {
    for (const ElementIndex node : part.graph.branchNodes[branch])
    {
      radius[node] = std::max(radius[node], part.table.branches[branch].meanRadius);
    }
  }
  return radius;
}

const Vector3 &
PlaceOf(const SkeletonGraph & graph, std::size_t node)
{
  return graph.positions[graph.nodePoints[node]];
}

/** Of the components without an inlet, the tip that is best. */
void
AddThickest(const MeasuredSkeleton & part, const InletChoice & choice, std::vector<ElementIndex> & inlets)
{
  const SkeletonGraph &                               graph = part.graph;
  const std::vector<ElementIndex>                     components = ComponentsOf(part);
  const std::vector<double>                           radius = RadiusAtNodes(part);
  std::map<ElementIndex, std::optional<ElementIndex>> best;
  for (const ElementIndex inlet : inlets)
  {
    best[components[inlet]] = std::nullopt;
  }
  const auto rank = [&](ElementIndex node) {
    const bool isCut =
      choice.border && IsAtBorder(*choice.border, PhysicalToLattice(choice.geometry, PlaceOf(graph, node)));
    return std::pair(isCut ? 1 : 0, radius[node]);
  };
  for (ElementIndex node = 0; node < graph.nodePoints.size(); ++node)
  {
    if (graph.nodeKinds[node] == NodeKind::Tip)
    {
      const auto [found, isNew] = best.try_emplace(components[node], node);
      if (!isNew && found->second && rank(node) > rank(*found->second))
      {
        found->second = node;
      }
    }
  }
  for (const auto & [component, node] : best)
  {
    if (node)
    {
      inlets.push_back(*node);
    }
  }
}

} // namespace

std::vector<std::vector<ElementIndex>>
FindInlets(const std::vector<MeasuredSkeleton> & parts, const InletChoice & choice)
{
  std::vector<std::vector<ElementIndex>> inlets(parts.size());
  for (const Vector3 & place : choice.places)
  {
    double       least = std::numeric_limits<double>::infinity();
    std::size_t  ofPart = 0;
    ElementIndex nearest = 0;
    for (std::size_t part = 0; part < parts.size(); ++part)
    {
      const SkeletonGraph & graph = parts[part].graph;
      for (ElementIndex node = 0; node < graph.nodePoints.size(); ++node)
      {
        const double away = Distance(place, PlaceOf(graph, node));
        if (graph.nodeKinds[node] == NodeKind::Tip && away < least)
        {
          least = away;
          ofPart = part;
          nearest = node;
        }
      }
    }
    if (std::isfinite(least))
    {
      inlets[ofPart].push_back(nearest);
    }
  }
  for (std::size_t part = 0; part < parts.size(); ++part)
  {
    AddThickest(parts[part], choice, inlets[part]);
    ranges::sort(inlets[part]);
    inlets[part].erase(ranges::unique(inlets[part]).begin(), inlets[part].end());
  }
  return inlets;
}

FlowTree
DirectFlow(const MeasuredSkeleton & part, const std::vector<ElementIndex> & inlets)
{
  const SkeletonGraph & graph = part.graph;
  const std::size_t     nodes = graph.nodePoints.size();
  FlowTree              tree;
  tree.into.assign(nodes, kNoBranch);
  tree.way.assign(nodes, std::numeric_limits<double>::infinity());
  tree.isForward.assign(graph.BranchCount(), 1);
  std::vector<double> thickness;
  for (const BranchRecord & branch : part.table.branches)
  {
    thickness.push_back(branch.meanRadius);
  }
  std::vector<ElementIndex> own(nodes);
  std::iota(own.begin(), own.end(), 0U);
  std::vector<std::vector<ElementIndex>> beside(nodes);
  for (const std::uint8_t closes : FindLoopClosers(graph, own, thickness))
  {
    const auto branch = static_cast<ElementIndex>(tree.isOnTree.size());
    tree.isOnTree.push_back(closes == 0 ? 1 : 0);
    for (const ElementIndex node : graph.branchNodes[branch])
    {
      if (closes == 0)
      {
        beside[node].push_back(branch);
      }
    }
  }
  for (const ElementIndex inlet : inlets)
  {
    if (std::isfinite(tree.way[inlet]))
    {
      continue; // its component has one before
    }
    tree.roots.push_back(inlet);
    tree.way[inlet] = 0;
    std::size_t done = tree.order.size();
    tree.order.push_back(inlet);
    while (done < tree.order.size())
    {
      const ElementIndex node = tree.order[done++];
      for (const ElementIndex branch : beside[node])
      {
        const auto [first, last] = graph.branchNodes[branch];
        const ElementIndex other = first == node ? last : first;
        if (!std::isfinite(tree.way[other]))
        {
          tree.into[other] = branch;
          tree.way[other] = tree.way[node] + part.table.branches[branch].length;
          tree.order.push_back(other);
        }
      }
    }
  }
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto [first, last] = graph.branchNodes[branch];
    tree.isForward[branch] = tree.way[first] <= tree.way[last] ? 1 : 0;
  }
  return tree;
}

} // namespace voxelcore
