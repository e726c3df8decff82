#include "DeepCells.h"

#include "DeepTracer.h"
#include "HilbertOrder.h"
#include "SharedProgress.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/ParallelTasks.h"

#include <omp.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr std::size_t worthAThread = 2000; // points

// The points of the walls, near ones side by side.
std::vector<std::uint32_t>
PointsOfWalls(const Tracing & tracing, const std::vector<LatticePoint> & points)
{
  std::vector<bool> isUsed(points.size(), false);
  for (const std::uint32_t facet : tracing.deep)
  {
    for (const std::uint32_t point : tracing.cells.FacetPoints(facet))
    {
      isUsed[point] = true;
    }
  }
  std::vector<std::uint32_t> used;
  for (std::size_t point = 0; point < points.size(); ++point)
  {
    if (isUsed[point])
    {
      used.push_back(static_cast<std::uint32_t>(point));
    }
  }
  SortAlongCurve(points, used);
  return used;
}

// Cuts the points into slabs along their longest side, with about the same number each.
PointSlabs
CutIntoSlabs(const std::vector<LatticePoint> & points, const std::vector<std::uint32_t> & chosen, std::size_t count)
{
  const auto coordinate = [](const LatticePoint & p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; };
  PointSlabs slabs;
  std::vector<std::int32_t> sorted(chosen.size());
  std::int64_t              length = -1;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto [low, high] = std::minmax_element(chosen.begin(), chosen.end(), [&](std::uint32_t a, std::uint32_t b) {
      return coordinate(points[a], axis) < coordinate(points[b], axis);
    });
    const std::int64_t own = std::int64_t{ coordinate(points[*high], axis) } - coordinate(points[*low], axis);
    if (own > length)
    {
      length = own;
      slabs.axis = axis;
    }
  }
  std::transform(chosen.begin(), chosen.end(), sorted.begin(), [&](std::uint32_t p) {
    return coordinate(points[p], slabs.axis);
  });
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t slab = 1; slab < count; ++slab)
  {
    slabs.cuts.push_back(sorted[sorted.size() * slab / count]);
  }
  return slabs;
}

} // namespace

Tracing
AddDeepCells(Tracing                           tracing,
             const std::vector<LatticePoint> & points,
             const SpacingWeights &            weights,
             const ProgressCallback &          progress)
{
  std::sort(tracing.deep.begin(), tracing.deep.end());
  std::vector<Tracing> parts(1);
  {
    const std::vector<std::uint32_t> ordered = PointsOfWalls(tracing, points);
    const std::size_t                count =
      std::clamp<std::size_t>(ordered.size() / worthAThread, 1, static_cast<std::size_t>(omp_get_max_threads()));
    const PointSlabs       slabs = CutIntoSlabs(points, ordered, count);
    const DeepInput        input{ tracing, points, weights, ordered, slabs, CellTracer::LargestRadius(weights) };
    std::deque<DeepTracer> tracers;
    parts.resize(1 + count);
    for (std::size_t slab = 0; slab < count; ++slab)
    {
      tracers.emplace_back(input, slab);
    }
    SharedProgress shared(progress);
    RunInParts(true, count, [&](std::size_t first, std::size_t last) {
      for (std::size_t slab = first; slab < last; ++slab)
      {
        parts[1 + slab] = tracers[slab].Trace(std::ref(shared));
      }
    });
    // The walls of the region are the open facets themselves: only the cells behind them are new.
    auto shift = static_cast<std::uint32_t>(tracing.cells.CellCount());
    for (std::size_t slab = 0; slab < count; ++slab)
    {
      for (std::size_t wall = 0; wall < tracing.deep.size(); ++wall)
      {
        if (const std::uint32_t cell = tracers[slab].BeyondWalls()[wall]; cell != kOpen)
        {
          auto & open = tracing.cells.facetCells[tracing.deep[wall]];
          open[open[0] == kOpen ? 0 : 1] = cell + shift;
        }
      }
      shift += static_cast<std::uint32_t>(parts[1 + slab].cells.CellCount());
    }
  }
  std::erase_if(tracing.deep, [&](std::uint32_t facet) {
    const auto & sides = tracing.cells.facetCells[facet];
    return sides[0] != kOpen && sides[1] != kOpen;
  });
  parts[0] = std::move(tracing);
  Tracing joined = JoinTracings(std::move(parts), points.size());
  if (!joined.deep.empty())
  {
    throw CertificateError("the deep Delaunay cells do not close; please report this input");
  }
  return joined;
}

} // namespace voxelcore
