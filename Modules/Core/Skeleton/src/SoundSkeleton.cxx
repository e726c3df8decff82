#include "voxelcore/Skeleton/SoundSkeleton.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

bool
IsSkeleton(const SkeletonGraph & graph)
{
  const std::size_t points = graph.positions.size();
  const std::size_t nodes = graph.nodePoints.size();
  const auto        areBelow = [](const std::vector<ElementIndex> & indices, std::size_t count) {
    return ranges::all_of(indices, [&](ElementIndex index) { return index < count; });
  };
  const auto areOffsets = [](const std::vector<std::uint64_t> & offsets, std::size_t count, std::size_t all) {
    return offsets.size() == count + 1 && offsets.front() == 0 && offsets.back() == all && ranges::is_sorted(offsets);
  };
  const auto arePlaces = [](const std::vector<Vector3> & places) {
    return ranges::all_of(places, [](const Vector3 & p) {
      return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
    });
  };
  const auto areLengths = [](const std::vector<double> & values) {
    return ranges::all_of(values, [](double value) { return value >= 0 && std::isfinite(value); });
  };
  const bool pointsFit = graph.radius.size() == points && graph.erosionThickness.size() == points &&
                         (graph.medial.empty() || graph.medial.size() == points) &&
                         (graph.sectionRadius.empty() || graph.sectionRadius.size() == points) &&
                         (graph.labels.empty() || graph.labels.size() == points) &&
                         graph.contact.size() == graph.labels.size() && arePlaces(graph.positions) &&
                         arePlaces(graph.medial) && areLengths(graph.radius) && areLengths(graph.sectionRadius) &&
                         ranges::all_of(graph.erosionThickness, [](double value) { return value >= 0; });
  const bool nodesFit = graph.nodeKinds.size() == nodes && areBelow(graph.nodePoints, points) &&
                        ranges::all_of(graph.nodeKinds, [](NodeKind kind) { return kind <= NodeKind::Contact; });
  const bool facesFit = areOffsets(graph.faceOffsets, graph.closedFace.size(), graph.faceVertices.size()) &&
                        areBelow(graph.faceVertices, points) &&
                        ranges::all_of(graph.closedFace, [](std::uint8_t closed) { return closed <= 1; });
  if (!pointsFit || !nodesFit || !facesFit ||
      !areOffsets(graph.branchOffsets, graph.BranchCount(), graph.branchPoints.size()) ||
      !areBelow(graph.branchPoints, points))
  {
    return false;
  }
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto   line = graph.Branch(branch);
    const auto & ends = graph.branchNodes[branch];
    if (line.size() < 2 || ends[0] >= nodes || ends[1] >= nodes || graph.nodePoints[ends[0]] != line.front() ||
        graph.nodePoints[ends[1]] != line.back())
    {
      return false;
    }
  }
  return true;
}

} // namespace voxelcore
