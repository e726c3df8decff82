#include "voxelcore/BallCoverage.h"

#include "voxelcore/BoundaryVertices.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{
namespace
{

constexpr std::size_t kLeafBalls = 8;

} // namespace

struct BallTree::Search
{
  std::array<double, 3> place;
  std::array<double, 3> offsets{ 0, 0, 0 }; ///< from the place to the current range's box, by axis
  double                enough;
  double                best = std::numeric_limits<double>::infinity();
};

BallTree::BallTree(std::span<const std::array<double, 3>> positions,
                   std::span<const double>                radius,
                   const SpacingWeights &                 weights)
  : m_Scale{ weights.unit * static_cast<double>(weights.weight[0]),
             weights.unit * static_cast<double>(weights.weight[1]),
             weights.unit * static_cast<double>(weights.weight[2]) }
  , m_Balls(positions.size())
  , m_Largest(positions.size(), 0.0)
  , m_Axes(positions.size(), 0)
{
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const auto & p = positions[i];
    m_Balls[i] = { { m_Scale[0] * p[0], m_Scale[1] * p[1], m_Scale[2] * p[2] }, radius[i] };
  }
  Build(0, m_Balls.size());
}

void
BallTree::Build(std::size_t first, std::size_t last)
{
  if (first == last)
  {
    return;
  }
  std::array<double, 3> lower = m_Balls[first].centre;
  std::array<double, 3> upper = lower;
  double                largest = 0;
  for (std::size_t i = first; i < last; ++i)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      lower[a] = std::min(lower[a], m_Balls[i].centre[a]);
      upper[a] = std::max(upper[a], m_Balls[i].centre[a]);
    }
    largest = std::max(largest, m_Balls[i].radius);
  }
  const std::size_t middle = first + (last - first) / 2;
  m_Largest[middle] = largest;
  if (last - first <= kLeafBalls)
  {
    return;
  }
  std::size_t axis = 0;
  for (std::size_t a = 1; a < 3; ++a)
  {
    axis = upper[a] - lower[a] > upper[axis] - lower[axis] ? a : axis;
  }
  const auto begin = m_Balls.begin();
  std::nth_element(begin + static_cast<std::ptrdiff_t>(first),
                   begin + static_cast<std::ptrdiff_t>(middle),
                   begin + static_cast<std::ptrdiff_t>(last),
                   [axis](const Ball & a, const Ball & b) { return a.centre[axis] < b.centre[axis]; });
  m_Axes[middle] = static_cast<std::uint8_t>(axis);
  Build(first, middle);
  Build(middle + 1, last);
}

void
BallTree::Descend(Search & search, std::size_t first, std::size_t last, double squared) const
{
  if (first == last || search.best < search.enough)
  {
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  // A hair below, so that rounding never hides the best ball.
  if (std::sqrt(squared) * (1 - 1e-12) - m_Largest[middle] >= search.best)
  {
    return;
  }
  const auto test = [&](std::size_t i) {
    const Ball & ball = m_Balls[i];
    const double dx = search.place[0] - ball.centre[0];
    const double dy = search.place[1] - ball.centre[1];
    const double dz = search.place[2] - ball.centre[2];
    search.best = std::min(search.best, std::sqrt(dx * dx + dy * dy + dz * dz) - ball.radius);
  };
  if (last - first <= kLeafBalls)
  {
    for (std::size_t i = first; i < last; ++i)
    {
      test(i);
    }
    return;
  }
  test(middle);
  const std::size_t axis = m_Axes[middle];
  const double      toSplit = search.place[axis] - m_Balls[middle].centre[axis];
  const bool        lowerFirst = toSplit < 0;
  Descend(search, lowerFirst ? first : middle + 1, lowerFirst ? middle : last, squared);
  const double offset = search.offsets[axis];
  search.offsets[axis] = toSplit;
  Descend(search,
          lowerFirst ? middle + 1 : first,
          lowerFirst ? last : middle,
          std::max(0.0, squared - offset * offset) + toSplit * toSplit);
  search.offsets[axis] = offset;
}

double
BallTree::Gap(const std::array<double, 3> & place, double enough) const
{
  Search search{ .place = { m_Scale[0] * place[0], m_Scale[1] * place[1], m_Scale[2] * place[2] }, .enough = enough };
  Descend(search, 0, m_Balls.size(), 0.0);
  return search.best;
}

double
RefinedGapBound(std::span<const std::array<double, 3>> displacement, const std::array<double, 3> & spacing)
{
  if (displacement.empty())
  {
    return 0;
  }
  double farthest = 0;
  for (const auto & d : displacement)
  {
    farthest = std::max(farthest, std::hypot(d[0], d[1], d[2]));
  }
  return 2 * farthest + 0.5 * std::hypot(spacing[0], spacing[1], spacing[2]);
}

BoundaryGap
LargestBoundaryGap(const VoxelShape &                     shape,
                   const SpacingWeights &                 weights,
                   std::span<const std::array<double, 3>> positions,
                   std::span<const double>                radius,
                   const ProgressCallback &               progress)
{
  const std::vector<LatticePoint> points = BoundaryVertices(shape);
  const BallTree                  tree(positions, radius, weights);
  std::vector<double>             gaps(points.size());
  BoundaryGap                     result;
  // What lies nearer than the farthest so far needs no closer look.
  constexpr std::size_t chunk = std::size_t{ 1 } << 13;
  for (std::size_t first = 0; first < points.size(); first += chunk)
  {
    ReportProgress(progress, "coverage", static_cast<double>(first) / static_cast<double>(points.size()));
    const std::size_t last = std::min(points.size(), first + chunk);
#pragma omp parallel for schedule(dynamic, 512) if (last - first > 4096)
    for (std::size_t i = first; i < last; ++i)
    {
      gaps[i] = tree.Gap(
        { static_cast<double>(points[i].x), static_cast<double>(points[i].y), static_cast<double>(points[i].z) },
        first == 0 ? -HUGE_VAL : result.largest);
    }
    for (std::size_t i = first; i < last; ++i)
    {
      if (i == 0 || gaps[i] > result.largest)
      {
        result = { gaps[i], { points[i].x, points[i].y, points[i].z } };
      }
    }
  }
  result.largest = std::max(result.largest, 0.0);
  return result;
}

} // namespace voxelcore
