#include "voxelcore/Verification/BallCoverage.h"

#include "BallBoxes.h"
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

} // namespace

double
RefinedGapBound(double                                 height,
                const std::array<double, 3> &          spacing,
                std::span<const std::array<double, 3>> movesBeforePruning)
{
  const double half = 0.5 * std::hypot(spacing[0], spacing[1], spacing[2]);
  if (movesBeforePruning.empty())
  {
    return std::max(height, half);
  }
  double farthest = 0;
  for (const auto & d : movesBeforePruning)
  {
    farthest = std::max(farthest, std::hypot(d[0], d[1], d[2]));
  }
  return height + 2 * farthest + half;
}

BoundaryGap
LargestBoundaryGap(const VoxelShape &                     shape,
                   const SpacingWeights &                 weights,
                   std::span<const std::array<double, 3>> positions,
                   std::span<const double>                radius,
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
          bool                isNear = false;
          for (const std::size_t ball : { at[1], nearest, at[0], at[2] })
          {
            if (balls.IsNearer(place, own.gap, ball))
            {
              nearest = ball;
              isNear = true;
              break;
            }
          }
          if (!isNear)
          {
            own.Take(balls.SmallestGap(place, own.gap, nearest), i * step);
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

} // namespace voxelcore
