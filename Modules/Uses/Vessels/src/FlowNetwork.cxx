#include "voxelcore/Vessels/FlowNetwork.h"

#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace voxelcore
{

double
FlowSegment::PoiseuilleRadius() const
{
  return std::sqrt(std::sqrt(length / perRadius4));
}

FlowNetwork
MakeFlowNetwork(const std::vector<MeasuredSkeleton> & parts, const std::vector<std::vector<ElementIndex>> & inlets)
{
  FlowNetwork network;
  for (std::size_t part = 0; part < parts.size(); ++part)
  {
    const SkeletonGraph &               graph = parts[part].graph;
    const std::vector<double> &         radius = SectionRadii(graph);
    const FlowTree                      tree = DirectFlow(parts[part], inlets[part]);
    const std::vector<ElementIndex>     hubs = NodeHubs(graph);
    std::map<ElementIndex, std::size_t> known;
    const auto                          numberOf = [&](ElementIndex node) {
      const auto [found, isNew] = known.try_emplace(hubs[node], network.nodes.size());
      if (isNew)
      {
        const ElementIndex point = graph.nodePoints[node];
        const bool         isInlet = ranges::binary_search(inlets[part], node);
        const bool         isTip = graph.nodeKinds[node] == NodeKind::Tip;
        network.nodes.push_back({ isInlet ? FlowNodeKind::Inlet
                                                           : isTip ? FlowNodeKind::Outlet
                                                                   : FlowNodeKind::Inner,
                                  graph.positions[point],
                                  radius[point],
                                  part });
      }
      return found->second;
    };
    for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
    {
      const auto points = graph.Branch(branch);
      auto [from, to] = graph.branchNodes[branch];
      if (graph.nodeKinds[from] == NodeKind::Loop ||
          ranges::any_of(points, [&](ElementIndex point) { return !(radius[point] > 0); }))
      {
        continue;
      }
      if (tree.isForward[branch] == 0)
      {
        std::swap(from, to);
      }
      FlowSegment segment;
      segment.part = part;
      segment.branch = static_cast<ElementIndex>(branch);
      segment.from = numberOf(from);
      segment.to = numberOf(to);
      segment.leastRadius = HUGE_VAL;
      for (const ElementIndex point : points)
      {
        segment.leastRadius = std::min(segment.leastRadius, radius[point]);
        segment.greatestRadius = std::max(segment.greatestRadius, radius[point]);
      }
      for (std::size_t i = 1; i < points.size(); ++i)
      {
        const double way = Distance(graph.positions[points[i - 1]], graph.positions[points[i]]);
        const double a = radius[points[i - 1]];
        const double b = radius[points[i]];
        segment.length += way;
        segment.meanRadius += 0.5 * way * (a + b);
        segment.perRadius4 += way * (a * a + a * b + b * b) / (3 * a * a * a * b * b * b);
        segment.perRadius2 += way / (a * b);
      }
      segment.meanRadius /= segment.length;
      network.segments.push_back(segment);
    }
  }
  std::vector<int> pipes(network.nodes.size(), 0);
  for (const FlowSegment & segment : network.segments)
  {
    ++pipes[segment.from];
    ++pipes[segment.to];
  }
  for (std::size_t node = 0; node < pipes.size(); ++node)
  {
    FlowNodeKind & kind = network.nodes[node].kind;
    kind = kind == FlowNodeKind::Inner && pipes[node] == 1 ? FlowNodeKind::Outlet : kind;
  }
  return network;
}

} // namespace voxelcore
