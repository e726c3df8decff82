#include "voxelcore/Complex/SoundComplex.h"

#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <functional>

namespace voxelcore
{

bool
IsComplex(const CellComplex & cells)
{
  const auto & offsets = cells.faceOffsets;
  const bool   countsAgree = cells.HasCorners() && !offsets.empty() && offsets.front() == 0 &&
                           offsets.back() == cells.faceVertices.size() && ranges::is_sorted(offsets);
  const bool edgesAreInOrder =
    ranges::all_of(cells.edges, [&](const auto & edge) { return edge[0] < edge[1] && edge[1] < cells.vertexCount; }) &&
    ranges::adjacent_find(cells.edges, ranges::greater_equal()) == cells.edges.end();
  if (!countsAgree || !edgesAreInOrder)
  {
    return false;
  }
  std::vector<ElementIndex> sorted;
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    const auto corners = cells.FaceVertices(face);
    const auto sides = cells.FaceEdges(face);
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      const auto [low, high] = std::minmax(corners[i], corners[i + 1 == corners.size() ? 0 : i + 1]);
      if (sides[i] >= cells.edges.size() || cells.edges[sides[i]] != std::array{ low, high })
      {
        return false;
      }
    }
    sorted.assign(corners.begin(), corners.end());
    ranges::sort(sorted);
    if (corners.size() < 3 || ranges::adjacent_find(sorted) != sorted.end())
    {
      return false;
    }
  }
  return true;
}

} // namespace voxelcore
