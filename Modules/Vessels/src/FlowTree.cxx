#include "voxelcore/FlowTree.h"

#include "BorderPlaces.h"

#include "voxelcore/UnionFind.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace voxelcore
{

namespace
{

/** Per node the number of the first node of its component. */
std::vector<ElementIndex>
ComponentsOf(const SkeletonGraph & graph)
{
  const std::vector<ElementIndex> hubs = NodeHubs(graph);
  UnionFind                       joined(static_cast<ElementIndex>(hubs.size()));
  for (const auto & [first, last] : graph.branchNodes)
  {
    joined.Unite(hubs[first], hubs[last]);
  }
  std::vector<ElementIndex> components;
  for (const ElementIndex hub : hubs)
  {
    components.push_back(joined.Find(hub));
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
  const std::vector<ElementIndex>                     components = ComponentsOf(graph);
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
    std::ranges::sort(inlets[part]);
    inlets[part].erase(std::ranges::unique(inlets[part]).begin(), inlets[part].end());
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
  tree.isOnTree.assign(graph.BranchCount(), 0);

  std::vector<std::size_t> thickest(graph.BranchCount());
  std::iota(thickest.begin(), thickest.end(), std::size_t{ 0 });
  std::ranges::stable_sort(thickest, std::ranges::greater(), [&](std::size_t branch) {
    return part.table.branches[branch].meanRadius;
  });
  UnionFind                              joined(static_cast<ElementIndex>(nodes));
  std::vector<std::vector<ElementIndex>> beside(nodes);
  for (const std::size_t branch : thickest)
  {
    const auto [first, last] = graph.branchNodes[branch];
    if (joined.Find(first) != joined.Find(last))
    {
      joined.Unite(first, last);
      tree.isOnTree[branch] = 1;
      beside[first].push_back(static_cast<ElementIndex>(branch));
      beside[last].push_back(static_cast<ElementIndex>(branch));
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
      std::ranges::sort(beside[node]);
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
