#include "voxelcore/Compare/CoreComparison.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Compare/MaskComparison.h"
#include "voxelcore/Refinement/TriangleTree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{

namespace
{

TriangleTree
TreeOfCore(const MedialComplex & core)
{
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const CellComplex &                       cells = core.cells;
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    const auto corners = cells.FaceVertices(face);
    for (std::size_t i = 2; i < corners.size(); ++i)
    {
      triangles.push_back({ corners[0], corners[i - 1], corners[i] });
    }
  }
  for (const auto & [first, last] : cells.edges)
  {
    triangles.push_back({ first, last, last });
  }
  for (std::uint32_t vertex = 0; vertex < core.positions.size(); ++vertex)
  {
    triangles.push_back({ vertex, vertex, vertex });
  }
  return { core.positions, triangles };
}

std::vector<double>
DistancesFrom(const MedialComplex & core, const TriangleTree & other)
{
  std::vector<double> distances(core.positions.size());
  RunInParts(distances.size() > 1000, distances.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
    {
      const double squared =
        other.FindNearest(core.positions[i], std::numeric_limits<double>::infinity()).squaredDistance;
      distances[i] = std::sqrt(squared);
    }
  });
  ranges::sort(distances);
  return distances;
}

} // namespace

CoreComparison
CompareCores(const MedialComplex & a, const MedialComplex & b, double within)
{
  if (a.positions.empty() || b.positions.empty())
  {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return { none, none, none, none, none };
  }
  const auto fromA = DistancesFrom(a, TreeOfCore(b));
  const auto fromB = DistancesFrom(b, TreeOfCore(a));
  const auto sum = [](const std::vector<double> & sorted) {
    double all = 0;
    for (const double distance : sorted)
    {
      all += distance;
    }
    return all;
  };
  const auto coverage = [&](const std::vector<double> & sorted) {
    return static_cast<double>(ranges::upper_bound(sorted, within) - sorted.begin()) /
           static_cast<double>(sorted.size());
  };
  CoreComparison compared;
  compared.hausdorff = std::max(fromA.back(), fromB.back());
  compared.percentile95 = std::max(QuantileOf(fromA, 0.95), QuantileOf(fromB, 0.95));
  compared.mean = (sum(fromA) + sum(fromB)) / static_cast<double>(fromA.size() + fromB.size());
  compared.coverageA = coverage(fromA);
  compared.coverageB = coverage(fromB);
  return compared;
}

} // namespace voxelcore
