#include "BallBoxes.h"

#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace voxelcore::verification
{
namespace
{

constexpr unsigned kBits = 10; // of a place along an axis: cells of the curve are a thousandth of the whole
constexpr double   kInfinity = std::numeric_limits<double>::infinity();
constexpr float    kHair = 1e-5F; // more than numbers of 24 bits, squares and roots are rounded by

float
Down(double number)
{
  const auto near = static_cast<float>(number);
  return static_cast<double>(near) > number ? std::nextafter(near, -HUGE_VALF) : near;
}

float
Up(double number)
{
  return -Down(-number);
}

/** Bits of a number, three places apart. */
std::uint64_t
Apart(std::uint64_t number)
{
  std::uint64_t spread = 0;
  for (unsigned bit = 0; bit < kBits; ++bit)
  {
    spread |= (number >> bit & 1U) << (3 * bit);
  }
  return spread;
}

/** The order of places along the curve; those in one cell as they come. */
std::vector<std::uint32_t>
AlongACurve(const std::vector<std::array<double, 3>> & places)
{
  std::array<double, 3> lower{ kInfinity, kInfinity, kInfinity };
  double                side = 0;
  for (const auto & place : places)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      lower[a] = std::min(lower[a], place[a]);
    }
  }
  for (const auto & place : places)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      side = std::max(side, place[a] - lower[a]);
    }
  }
  constexpr double           last = (1U << kBits) - 1;
  const double               cells = side > 0 ? last / side : 0;
  std::vector<std::uint64_t> spread(1U << kBits);
  for (std::size_t i = 0; i < spread.size(); ++i)
  {
    spread[i] = Apart(i);
  }
  std::vector<std::uint64_t> keys(places.size()); // cell, then number
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    std::uint64_t cell = 0;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const double at = (places[i][a] - lower[a]) * cells;
      // What is no number goes to the first cell.
      cell |= spread[at > 0 ? static_cast<std::size_t>(std::min(at, last)) : 0] << a;
    }
    keys[i] = cell << 32U | i;
  }
  // By digits of a cell, the lowest first.
  std::vector<std::uint64_t> sorted(keys.size());
  for (unsigned digit = 0; digit < 3; ++digit)
  {
    const unsigned                             shift = 32 + kBits * digit;
    std::array<std::size_t, (1U << kBits) + 1> begin{};
    const auto digitOf = [shift](std::uint64_t key) { return key >> shift & ((1U << kBits) - 1); };
    for (const std::uint64_t key : keys)
    {
      ++begin[digitOf(key) + 1];
    }
    for (std::size_t i = 1; i < begin.size(); ++i)
    {
      begin[i] += begin[i - 1];
    }
    for (const std::uint64_t key : keys)
    {
      sorted[begin[digitOf(key)]++] = key;
    }
    keys.swap(sorted);
  }
  std::vector<std::uint32_t> order(keys.size());
  ranges::transform(keys, order.begin(), [](std::uint64_t key) { return static_cast<std::uint32_t>(key); });
  return order;
}

} // namespace

/** From one place, the smallest gap so far. */
struct BallBoxes::Search
{
  std::array<double, 3> at; ///< mm
  double                best = kInfinity;
  std::size_t           nearest = 0;
};

BallBoxes::BallBoxes(std::span<const std::array<double, 3>> positions,
                     std::span<const double>                radius,
                     const SpacingWeights &                 weights)
{
  for (std::size_t a = 0; a < 3; ++a)
  {
    m_Scale[a] = weights.unit * static_cast<double>(weights.weight[a]);
  }
  std::vector<std::array<double, 3>> places(positions.size());
  ranges::transform(positions, places.begin(), [&](const auto & position) { return InMm(position); });
  const std::vector<std::uint32_t> order = AlongACurve(places);
  m_Balls.resize((order.size() + kInABox - 1) / kInABox);
  for (std::size_t i = 0; i < kInABox * m_Balls.size(); ++i)
  {
    Balls &           balls = m_Balls[i / kInABox];
    const std::size_t own = i % kInABox;
    const bool        isBall = i < order.size();
    for (std::size_t a = 0; a < 3; ++a)
    {
      balls.centre[a][own] = isBall ? places[order[i]][a] : 0;
    }
    balls.radius[own] = isBall ? radius[order[i]] : -kInfinity;
  }
  MakeBoxes();
}

void
BallBoxes::MakeBoxes()
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Boxes           nothing;
  nothing.radius.fill(-infinity);
  nothing.lower.fill(nothing.radius);
  nothing.upper = nothing.lower;
  for (auto & lower : nothing.lower)
  {
    lower.fill(infinity);
  }
  const auto add = [](Boxes & boxes, std::size_t own, std::size_t a, float lower, float upper) {
    boxes.lower[a][own] = std::min(boxes.lower[a][own], lower);
    boxes.upper[a][own] = std::max(boxes.upper[a][own], upper);
  };
  std::size_t count = m_Balls.size();
  for (; count > 1 || (count == 1 && m_Levels.empty()); count = m_Levels.back().size())
  {
    std::vector<Boxes> level((count + kInABox - 1) / kInABox, nothing);
    for (std::size_t i = 0; i < count; ++i)
    {
      Boxes &           boxes = level[i / kInABox];
      const std::size_t own = i % kInABox;
      float &           largest = boxes.radius[own];
      for (std::size_t k = 0; k < kInABox; ++k)
      {
        const float radius = m_Levels.empty() ? Up(m_Balls[i].radius[k]) : m_Levels.back()[i].radius[k];
        largest = std::max(largest, radius);
        for (std::size_t a = 0; a < 3 && radius > -infinity; ++a)
        {
          if (m_Levels.empty())
          {
            add(boxes, own, a, Down(m_Balls[i].centre[a][k]), Up(m_Balls[i].centre[a][k]));
          }
          else
          {
            add(boxes, own, a, m_Levels.back()[i].lower[a][k], m_Levels.back()[i].upper[a][k]);
          }
        }
      }
    }
    m_Levels.push_back(std::move(level));
  }
}

std::array<double, 3>
BallBoxes::InMm(const std::array<double, 3> & place) const
{
  return { m_Scale[0] * place[0], m_Scale[1] * place[1], m_Scale[2] * place[2] };
}

void
BallBoxes::Look(Search & search, std::size_t box) const
{
  const Balls &               balls = m_Balls[box];
  std::array<double, kInABox> gaps;
  for (std::size_t i = 0; i < kInABox; ++i)
  {
    const double x = search.at[0] - balls.centre[0][i];
    const double y = search.at[1] - balls.centre[1][i];
    const double z = search.at[2] - balls.centre[2][i];
    gaps[i] = std::sqrt(x * x + y * y + z * z) - balls.radius[i];
  }
  for (std::size_t i = 0; i < kInABox; ++i)
  {
    if (gaps[i] < search.best)
    {
      search.best = gaps[i];
      search.nearest = box * kInABox + i;
    }
  }
}

std::array<double, 3>
BallBoxes::Centre(std::size_t number) const
{
  const Balls &     balls = m_Balls[number / kInABox];
  const std::size_t own = number % kInABox;
  return { balls.centre[0][own], balls.centre[1][own], balls.centre[2][own] };
}

bool
BallBoxes::IsNearer(const std::array<double, 3> & place, double most, std::size_t number) const
{
  if (number >= kInABox * m_Balls.size())
  {
    return false;
  }
  const Balls &     balls = m_Balls[number / kInABox];
  const std::size_t own = number % kInABox;
  const auto        at = InMm(place);
  const double      x = at[0] - balls.centre[0][own];
  const double      y = at[1] - balls.centre[1][own];
  const double      z = at[2] - balls.centre[2][own];
  return std::sqrt(x * x + y * y + z * z) - balls.radius[own] < most;
}

double
BallBoxes::SmallestGap(const std::array<double, 3> & place, double enough, std::size_t & likely) const
{
  struct Open
  {
    float       guess; ///< of the smallest gap in it
    float       least; ///< that it can be
    std::size_t level; ///< 0: balls
    std::size_t box;
  };
  Search               search{ .at = InMm(place) };
  std::array<float, 3> down;
  std::array<float, 3> up;
  for (std::size_t a = 0; a < 3; ++a)
  {
    down[a] = Down(search.at[a]);
    up[a] = Up(search.at[a]);
  }
  std::array<Open, kInABox * 12 + 1> open; // seven more at each of the 11 levels that 2^32 balls have
  std::size_t                        count = 0;
  if (!m_Levels.empty())
  {
    Look(search, std::min(likely / kInABox, m_Balls.size() - 1));
    open[count++] = { 0, -std::numeric_limits<float>::infinity(), m_Levels.size(), 0 };
  }
  while (count > 0 && !(search.best < enough))
  {
    const Open next = open[--count];
    if (static_cast<double>(next.least) >= search.best)
    {
      continue;
    }
    if (next.level == 0)
    {
      Look(search, next.box);
      continue;
    }
    const Boxes &              boxes = m_Levels[next.level - 1][next.box];
    std::array<float, kInABox> least;
    std::array<float, kInABox> guess;
    for (std::size_t i = 0; i < kInABox; ++i)
    {
      float squared = 0;
      float toMiddle = 0;
      for (std::size_t a = 0; a < 3; ++a)
      {
        const float below = boxes.lower[a][i] - up[a];
        const float above = down[a] - boxes.upper[a][i];
        const float farther = below < above ? above : below;
        const float beyond = farther < 0 ? 0 : farther;
        squared += beyond * beyond;
        toMiddle += (above - below) * (above - below);
      }
      // Less by more than all that was rounded, also of the radius.
      const float distance = std::sqrt(squared) * (1 - kHair);
      least[i] = (distance - boxes.radius[i]) - kHair * std::abs(boxes.radius[i]);
      guess[i] = 0.5F * std::sqrt(toMiddle) - boxes.radius[i];
    }
    const std::size_t begin = count;
    std::size_t       first = begin; // what is likely the nearest
    for (std::size_t i = 0; i < kInABox; ++i)
    {
      // Without a jump, which would be hard to foretell.
      open[count] = { guess[i], least[i], next.level - 1, next.box * kInABox + i };
      const bool isOpen = static_cast<double>(least[i]) < search.best; // of a box without balls it is infinite
      first = isOpen && guess[i] < open[first].guess ? count : first;
      count += isOpen ? 1 : 0;
    }
    if (count > begin)
    {
      std::swap(open[first], open[count - 1]); // on top: it comes first
    }
  }
  likely = search.nearest;
  return search.best;
}

} // namespace voxelcore::verification
