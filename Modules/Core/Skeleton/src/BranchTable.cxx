#include "voxelcore/Skeleton/BranchTable.h"

#include "BranchHierarchy.h"
#include "BranchNumbers.h"

#include <algorithm>

namespace voxelcore
{

namespace
{

void
SumLevels(BranchTable & table)
{
  for (const AxisRecord & axis : table.axes)
  {
    const auto level = static_cast<std::size_t>(axis.level);
    while (table.levels.size() <= level)
    {
      table.levels.emplace_back();
      table.levels.back().level = static_cast<std::int32_t>(table.levels.size() - 1);
    }
    LevelRecord & sum = table.levels[level];
    ++sum.count;
    sum.totalLength += axis.length;
    sum.meanRadius += axis.length * axis.meanRadius;
    sum.meanTortuosity += axis.tortuosity;
    sum.meanTipAngle += axis.tipAngle;
    sum.meanEmergenceAngle += axis.emergenceAngle;
    sum.meanMidpointAngle += axis.midpointAngle;
    sum.meanChildren += axis.children;
  }
  for (LevelRecord & level : table.levels)
  {
    level.meanLength = level.totalLength / level.count;
    level.meanRadius = level.totalLength > 0 ? level.meanRadius / level.totalLength : 0;
    level.meanTortuosity /= level.count;
    level.meanTipAngle /= level.count;
    level.meanEmergenceAngle /= level.count;
    level.meanMidpointAngle /= level.count;
    level.meanChildren /= level.count;
  }
}

void
SumBranches(const SkeletonGraph & graph, BranchTable & table)
{
  SkeletonNumbers & numbers = table.numbers;
  numbers.branches = static_cast<std::int64_t>(graph.BranchCount());
  std::vector<int> degree(graph.nodePoints.size(), 0);
  for (const auto & nodes : graph.branchNodes)
  {
    ++degree[nodes[0]];
    ++degree[nodes[1]];
  }
  for (std::size_t node = 0; node < degree.size(); ++node)
  {
    const NodeKind kind = graph.nodeKinds[node];
    numbers.tips += kind == NodeKind::Tip;
    numbers.junctions += kind == NodeKind::Junction;
    numbers.triplePoints += kind == NodeKind::Junction && degree[node] == 3;
    numbers.quadruplePoints += kind == NodeKind::Junction && degree[node] == 4;
    numbers.isolatedLoops += kind == NodeKind::Loop;
    numbers.isolatedPoints += kind == NodeKind::Isolated;
  }
  for (const std::uint8_t closed : graph.closedFace)
  {
    ++(closed ? numbers.closedFaces : numbers.plateFaces);
  }
  double freeLength = 0;
  double radiusByLength = 0;
  for (const BranchRecord & branch : table.branches)
  {
    numbers.totalLength += branch.length;
    numbers.closingLength += branch.closesLoop ? branch.length : 0;
    numbers.maxLength = std::max(numbers.maxLength, branch.length);
    numbers.volume += branch.volume;
    numbers.surface += branch.surface;
    freeLength += branch.freeLength;
    numbers.meanRadius += branch.freeLength * branch.meanRadius;
    radiusByLength += branch.length * branch.meanRadius;
  }
  numbers.meanLength = numbers.branches > 0 ? numbers.totalLength / static_cast<double>(numbers.branches) : 0;
  numbers.meanRadius = freeLength > 0            ? numbers.meanRadius / freeLength
                       : numbers.totalLength > 0 ? radiusByLength / numbers.totalLength
                                                 : 0;
}

} // namespace

BranchTable
MeasureBranches(const SkeletonGraph & graph, const MeasureOptions & options)
{
  BranchTable table;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    table.branches.push_back(MeasureBranch(graph, branch));
  }
  BuildHierarchy(graph, options, table);
  SumLevels(table);
  SumBranches(graph, table);
  return table;
}

} // namespace voxelcore
