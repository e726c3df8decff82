#include "GraphLines.h"

#include <cstddef>

namespace voxelcore
{

GraphLines
LinesOf(const SkeletonGraph & graph)
{
  GraphLines lines;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto points = graph.Branch(branch);
    lines.emplace_back(points.begin(), points.end());
  }
  return lines;
}

ElementIndex
CopyPoint(SkeletonGraph & graph, ElementIndex point)
{
  const auto copy = static_cast<ElementIndex>(graph.positions.size());
  graph.positions.push_back(graph.positions[point]);
  graph.radius.push_back(graph.radius[point]);
  graph.erosionThickness.push_back(graph.erosionThickness[point]);
  if (!graph.medial.empty())
  {
    graph.medial.push_back(graph.medial[point]);
  }
  if (!graph.sectionRadius.empty())
  {
    graph.sectionRadius.push_back(graph.sectionRadius[point]);
  }
  if (!graph.labels.empty())
  {
    graph.labels.push_back(graph.labels[point]);
    graph.contact.push_back(graph.contact[point]);
  }
  return copy;
}

void
KeepBranches(SkeletonGraph & graph, const std::vector<std::uint8_t> & stays)
{
  std::vector<std::uint8_t> keep(graph.positions.size(), 1);
  for (const ElementIndex point : graph.branchPoints)
  {
    keep[point] = 0;
  }
  GraphLines lines;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    if (stays[branch] == 0)
    {
      continue;
    }
    const auto points = graph.Branch(branch);
    lines.emplace_back(points.begin(), points.end());
    for (const ElementIndex point : points)
    {
      keep[point] = 1;
    }
  }
  for (const ElementIndex point : graph.faceVertices)
  {
    keep[point] = 1;
  }
  KeepPoints(graph, lines, keep);
  SortBranches(graph, lines, true);
}

void
KeepPoints(SkeletonGraph & graph, GraphLines & lines, const std::vector<std::uint8_t> & keep)
{
  std::vector<ElementIndex> number(keep.size(), 0);
  std::size_t               kept = 0;
  for (std::size_t point = 0; point < keep.size(); ++point)
  {
    if (keep[point])
    {
      number[point] = static_cast<ElementIndex>(kept);
      graph.positions[kept] = graph.positions[point];
      graph.radius[kept] = graph.radius[point];
      graph.erosionThickness[kept] = graph.erosionThickness[point];
      if (!graph.sectionRadius.empty())
      {
        graph.sectionRadius[kept] = graph.sectionRadius[point];
      }
      if (!graph.medial.empty())
      {
        graph.medial[kept] = graph.medial[point];
      }
      if (!graph.labels.empty())
      {
        graph.labels[kept] = graph.labels[point];
        graph.contact[kept] = graph.contact[point];
      }
      ++kept;
    }
  }
  graph.positions.resize(kept);
  graph.radius.resize(kept);
  graph.erosionThickness.resize(kept);
  graph.medial.resize(graph.medial.empty() ? 0 : kept);
  graph.sectionRadius.resize(graph.sectionRadius.empty() ? 0 : kept);
  graph.labels.resize(graph.labels.empty() ? 0 : kept);
  graph.contact.resize(graph.contact.empty() ? 0 : kept);
  for (auto & line : lines)
  {
    for (ElementIndex & point : line)
    {
      point = number[point];
    }
  }
  for (ElementIndex & point : graph.faceVertices)
  {
    point = number[point];
  }
}

} // namespace voxelcore
