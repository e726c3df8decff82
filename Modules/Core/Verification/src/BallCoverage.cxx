#include "voxelcore/Verification/BallCoverage.h"

#include "BallBoxes.h"
#include "BoundaryNormals.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Verification/OctantScan.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{
namespace
{

// The first of the points that lie farthest, in whatever order they come.
struct Farthest
{
  double      gap = -std::numeric_limits<double>::infinity();
  std::size_t point = 0;

  void
  Take(double other, std::size_t at)
  {
    if (other > gap || (other == gap && at < point))
    {
      gap = other;
      point = at;
    }
  }
};

/** By more than divisions and sums round. */
double
ALittleLess(double number)
{
  return number * (number > 0 ? 1 - 1e-12 : 1 + 1e-12);
}

/** `weigh` is asked for weights at places, from 1 to `largest`. */
template <typename TWeigh>
BoundaryGap
SearchLargestGap(const VoxelShape &                     shape,
                 const SpacingWeights &                 weights,
                 std::span<const std::array<double, 3>> positions,
                 std::span<const double>                radius,
                 double                                 beyond,
                 double                                 largest,
                 const TWeigh &                         weigh,
                 const ProgressCallback &               progress)
{
  const std::vector<LatticePoint> points = ScanOctants(shape).boundary;
  const verification::BallBoxes   balls(positions, radius, weights);
  const auto                      width = static_cast<std::size_t>(shape.Box().size[0]) + 3;
  Farthest                        farthest;
  // What lies nearer than the farthest so far needs no closer look: a few places from everywhere come first.
  for (const std::size_t step : { std::size_t{ 64 }, std::size_t{ 1 } })
  {
    const std::size_t     count = (points.size() + step - 1) / step;
    constexpr std::size_t chunk = std::size_t{ 1 } << 16;
    for (std::size_t first = 0; first < count; first += chunk)
    {
      ReportProgress(progress, "coverage", static_cast<double>(first) / static_cast<double>(count));
      const std::size_t last = std::min(count, first + chunk);
      FirstFailure      failure;
#pragma omp parallel if (last - first > 4096)
      {
        Farthest                 own = farthest;
        std::size_t              nearest = 0;
        std::vector<std::size_t> below; // what was nearest at each x, and one x before and behind
        failure.Guard(first, [&] { below.assign(width, 0); });
#pragma omp for schedule(dynamic, 512)
        for (std::size_t i = first; i < last; ++i)
        {
          if (below.empty())
          {
            continue; // there was no memory for it
          }
          const LatticePoint &        p = points[i * step];
          const std::array<double, 3> place{ static_cast<double>(p.x),
                                             static_cast<double>(p.y),
                                             static_cast<double>(p.z) };
          // Around it in the row before, then along its own row.
          std::size_t * const at = &below[static_cast<std::size_t>(p.x - shape.Box().lower[0])];
          const double        near = beyond + ALittleLess(std::min(own.gap, own.gap / largest));
          bool                isNear = false;
          for (const std::size_t ball : { at[1], nearest, at[0], at[2] })
          {
            if (balls.IsNearer(place, near, ball))
            {
              nearest = ball;
              isNear = true;
              break;
            }
          }
          if (!isNear)
          {
            const double weight = weigh(p);
            const double enough = beyond + ALittleLess(own.gap / weight);
            const double gap = balls.SmallestGap(place, enough, nearest);
            if (gap >= enough)
            {
              own.Take(weight * (gap - beyond), i * step);
            }
          }
          at[1] = nearest;
        }
#pragma omp critical(voxelcoreFarthest)
        farthest.Take(own.gap, own.point);
      }
      failure.Rethrow();
    }
  }
  BoundaryGap result;
  if (!points.empty())
  {
    const LatticePoint & p = points[farthest.point];
    result = { farthest.gap, { p.x, p.y, p.z } };
  }
  result.largest = std::max(result.largest, 0.0);
  return result;
}

} // namespace

PromisedGap
RefinedGapBound(double                                 height,
                const std::array<double, 3> &          spacing,
                std::span<const std::array<double, 3>> movesBeforePruning)
{
  const double half = 0.5 * std::hypot(spacing[0], spacing[1], spacing[2]);
  if (movesBeforePruning.empty())
  {
    return { std::max(height, half), 0 };
  }
  double farthest = 0;
  for (const auto & d : movesBeforePruning)
  {
    farthest = std::max(farthest, std::hypot(d[0], d[1], d[2]));
  }
  return { height, 2 * farthest + half };
}

BoundaryGap
LargestBoundaryGap(const VoxelShape &                     shape,
                   const SpacingWeights &                 weights,
                   std::span<const std::array<double, 3>> positions,
                   std::span<const double>                radius,
                   const ProgressCallback &               progress)
{
  return SearchLargestGap(
    shape,
    weights,
    positions,
    radius,
    0,
    1,
    [](const LatticePoint &) { return 1.0; },
    progress);
}

BoundaryGap
LargestWeighedGap(const VoxelShape &                     shape,
                  const SpacingWeights &                 weights,
                  std::span<const std::array<double, 3>> positions,
                  std::span<const double>                radius,
                  double                                 beyond,
                  const ProgressCallback &               progress)
{
  const verification::BoundaryNormals normals(shape, weights);
  const auto                          weigh = [&](const LatticePoint & corner) { return normals.WeightAt(corner); };
  return SearchLargestGap(shape, weights, positions, radius, beyond, normals.Largest(), weigh, progress);
}

BoundaryGaps
LargestBoundaryGaps(const VoxelShape &                     shape,
                    const SpacingWeights &                 weights,
                    std::span<const std::array<double, 3>> positions,
                    std::span<const double>                radius,
                    double                                 beyond)
{
  BoundaryGaps gaps;
  gaps.plain = LargestBoundaryGap(shape, weights, positions, radius);
  const auto [least, largest] = ranges::minmax(weights.weight);
  gaps.weighed = least == largest ? BoundaryGap{ std::max(gaps.plain.largest - beyond, 0.0), gaps.plain.place }
                                  : LargestWeighedGap(shape, weights, positions, radius, beyond);
  return gaps;
}

} // namespace voxelcore
