#include "voxelcore/VoxelCore/BallTree.h"

#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace voxelcore
{
namespace
{

constexpr std::size_t kLeafBalls = 16;
constexpr std::size_t kWorthThreads = 10000; ///< balls
constexpr int         kHalvings = 4;

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
    m_Balls[i] = { { m_Scale[0] * p[0], m_Scale[1] * p[1], m_Scale[2] * p[2] },
                   radius[i],
                   static_cast<std::uint32_t>(i) };
  }
  // Ranges of several threads: halves of halves.
  std::vector<std::pair<std::size_t, std::size_t>> ranges{ { 0, m_Balls.size() } };
  for (int halving = 0; halving < kHalvings && m_Balls.size() > kWorthThreads; ++halving)
  {
    std::vector<std::pair<std::size_t, std::size_t>> halves(2 * ranges.size());
    RunEach(ranges.size(), [&](std::size_t i) {
      const auto [first, last] = ranges[i];
      const std::size_t middle = Split(first, last);
      halves[2 * i] = { first, middle };
      halves[2 * i + 1] = { middle + 1, last };
    });
    ranges = std::move(halves);
  }
  if (ranges.size() == 1)
  {
    Build(0, m_Balls.size());
  }
  else
  {
    RunEach(ranges.size(), [&](std::size_t i) { Build(ranges[i].first, ranges[i].second); });
  }
}

std::size_t
BallTree::Split(std::size_t first, std::size_t last)
{
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
    return middle;
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
  return middle;
}

void
BallTree::Build(std::size_t first, std::size_t last)
{
  if (first == last)
  {
    return;
  }
  const std::size_t middle = Split(first, last);
  if (last - first > kLeafBalls)
  {
    Build(first, middle);
    Build(middle + 1, last);
  }
}

double
BallTree::GapTo(const std::array<double, 3> & place, std::size_t i) const
{
  const Ball & ball = m_Balls[i];
  const double dx = place[0] - ball.centre[0];
  const double dy = place[1] - ball.centre[1];
  const double dz = place[2] - ball.centre[2];
  return std::sqrt(dx * dx + dy * dy + dz * dz) - ball.radius;
}

void
BallTree::Test(Search & search, std::size_t i) const
{
  const double gap = GapTo(search.place, i);
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

void
BallTree::FindWithin(const std::array<double, 3> & place, double most, std::vector<std::uint32_t> & found) const
{
  found.clear();
  const std::array<double, 3> at{ m_Scale[0] * place[0], m_Scale[1] * place[1], m_Scale[2] * place[2] };
  const auto                  test = [&](std::size_t i) {
    if (GapTo(at, i) <= most)
    {
      found.push_back(m_Balls[i].index);
    }
  };
  // Ranges that are still to be looked at; a plane between place and range is at least as near as its balls' centres.
  std::vector<std::pair<std::size_t, std::size_t>> ranges{ { 0, m_Balls.size() } };
  while (!ranges.empty())
  {
    const auto [first, last] = ranges.back();
    ranges.pop_back();
    if (last - first <= kLeafBalls)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        test(i);
      }
      continue;
    }
    const std::size_t middle = first + (last - first) / 2;
    const std::size_t axis = m_Axes[middle];
    const double      toSplit = at[axis] - m_Balls[middle].centre[axis];
    const bool        beyond = std::abs(toSplit) * (1 - 1e-12) - m_Largest[middle] > most;
    test(middle);
    if (!beyond || toSplit <= 0)
    {
      ranges.emplace_back(first, middle);
    }
    if (!beyond || toSplit >= 0)
    {
      ranges.emplace_back(middle + 1, last);
    }
  }
  std::sort(found.begin(), found.end());
}

bool
BallTree::IsWithin(const std::array<double, 3> & place, double most, std::size_t number) const
{
  return number < m_Balls.size() &&
         GapTo({ m_Scale[0] * place[0], m_Scale[1] * place[1], m_Scale[2] * place[2] }, number) < most;
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

} // namespace voxelcore
