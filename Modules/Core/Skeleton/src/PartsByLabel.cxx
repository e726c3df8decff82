#include "GraphLines.h"
#include "voxelcore/Skeleton/MeasuredSkeleton.h"

#include <utility>

namespace voxelcore
{

std::vector<MeasuredSkeleton>
PartsByLabel(const MeasuredSkeleton & network)
{
  std::vector<MeasuredSkeleton> parts;
  for (const NetworkLabel & label : network.network->labels)
  {
    MeasuredSkeleton part;
    part.label = label.value;
    part.name = label.name;
    part.graph = network.graph;
    std::vector<std::uint8_t>              keep(part.graph.positions.size(), 1);
    std::vector<std::vector<ElementIndex>> lines;
    for (const ElementIndex point : part.graph.branchPoints)
    {
      keep[point] = 0;
    }
    for (std::size_t point = 0; point < keep.size(); ++point) // isolated ones, and those of faces
    {
      keep[point] = keep[point] != 0 && part.graph.labels[point] == label.value;
    }
    for (std::size_t branch = 0; branch < network.graph.BranchCount(); ++branch)
    {
      if (network.graph.BranchLabel(branch) == label.value)
      {
        const auto points = network.graph.Branch(branch);
        lines.emplace_back(points.begin(), points.end());
        for (const ElementIndex point : points)
        {
          keep[point] = 1;
        }
      }
    }
    // Faces are of no label.
    part.graph.faceOffsets.assign(1, 0);
    part.graph.faceVertices.clear();
    part.graph.closedFace.clear();
    KeepPoints(part.graph, lines, keep);
    part.graph.labels.assign(part.graph.positions.size(), label.value);
    SortBranches(part.graph, lines, false);
    part.table = MeasureBranches(part.graph);
    parts.push_back(std::move(part));
  }
  return parts;
}

} // namespace voxelcore
