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

struct BallTree::Search
{
  std::array<double, 3> place;
  std::array<double, 3> offsets{ 0, 0, 0 }; ///< from the place to the current range's box, by axis
  double                enough;
  double                best = std::numeric_limits<double>::infinity();
  std::size_t           nearest = 0; ///< the ball that is the best
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
BallTree::Test(Search & search, std::size_t i) const
{
  const Ball & ball = m_Balls[i];
  const double dx = search.place[0] - ball.centre[0];
  const double dy = search.place[1] - ball.centre[1];
  const double dz = search.place[2] - ball.centre[2];
  const double gap = std::sqrt(dx * dx + dy * dy + dz * dz) - ball.radius;
  if (gap < search.best)
  {
    search.best = gap;
    search.nearest = i;
  }
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
  const auto test = [&](std::size_t i) { Test(search, i); };
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
  std::size_t nearest = 0;
  return Gap(place, enough, nearest);
}

double
BallTree::Gap(const std::array<double, 3> & place, double enough, std::size_t & nearest) const
{
  Search search{ .place = { m_Scale[0] * place[0], m_Scale[1] * place[1], m_Scale[2] * place[2] }, .enough = enough };
  if (nearest < m_Balls.size())
  {
    Test(search, nearest);
  }
  Descend(search, 0, m_Balls.size(), 0.0);
  nearest = search.nearest;
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
  Farthest                        farthest;
  // What lies nearer than the farthest so far needs no closer look: a few places from everywhere come first.
  for (const std::size_t step : { std::size_t{ 16 }, std::size_t{ 1 } })
  {
    const std::size_t     count = (points.size() + step - 1) / step;
    constexpr std::size_t chunk = std::size_t{ 1 } << 16;
    for (std::size_t first = 0; first < count; first += chunk)
    {
      ReportProgress(progress, "coverage", static_cast<double>(first) / static_cast<double>(count));
      const std::size_t last = std::min(count, first + chunk);
#pragma omp parallel if (last - first > 4096)
      {
        Farthest    own = farthest;
        std::size_t nearest = 0;
#pragma omp for schedule(dynamic, 512)
        for (std::size_t i = first; i < last; ++i)
        {
          const LatticePoint & p = points[i * step];
          own.Take(tree.Gap({ static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z) },
                            own.gap,
                            nearest),
                   i * step);
        }
#pragma omp critical(voxelcoreFarthest)
        farthest.Take(own.gap, own.point);
      }
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
