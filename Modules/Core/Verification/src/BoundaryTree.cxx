#include "voxelcore/Verification/BoundaryTree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{
namespace
{

constexpr std::size_t kLeafSize = 12;

std::int32_t
Coordinate(const LatticePoint & point, std::size_t axis)
{
  return axis == 0 ? point.x : axis == 1 ? point.y : point.z;
}

} // namespace

struct BoundaryTree::Search
{
  std::array<double, 3>    position;
  std::array<double, 3>    gaps{ 0, 0, 0 }; ///< weighted distance from the position to the current range's box, by axis
  double                   slack;
  double                   best = std::numeric_limits<double>::infinity();  ///< squared
  double                   bound = std::numeric_limits<double>::infinity(); ///< squared: best plus slack
  std::vector<Candidate> * found;
};

BoundaryTree::BoundaryTree(std::vector<LatticePoint> points, const SpacingWeights & weights)
  : BoundaryTree(std::move(points),
                 std::array<double, 3>{ static_cast<double>(weights.weight[0]),
                                        static_cast<double>(weights.weight[1]),
                                        static_cast<double>(weights.weight[2]) })
{}

BoundaryTree::BoundaryTree(std::vector<LatticePoint> points, const std::array<double, 3> & spacing)
  : m_Points(std::move(points))
  , m_Axes(m_Points.size(), 0)
  , m_Weights(spacing)
{
  Build(0, m_Points.size());
}

void
BoundaryTree::Build(std::size_t first, std::size_t last)
{
  while (last - first > kLeafSize)
  {
    LatticePoint lower = m_Points[first];
    LatticePoint upper = lower;
    for (std::size_t i = first + 1; i < last; ++i)
    {
      const LatticePoint & p = m_Points[i];
      lower = { std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z) };
      upper = { std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z) };
    }
    std::size_t axis = 0;
    double      widest = -1;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const double width = m_Weights[a] * (static_cast<double>(Coordinate(upper, a)) - Coordinate(lower, a));
      if (width > widest)
      {
        widest = width;
        axis = a;
      }
    }
    const std::size_t middle = first + (last - first) / 2;
    const auto        begin = m_Points.begin();
    std::nth_element(
      begin + static_cast<std::ptrdiff_t>(first),
      begin + static_cast<std::ptrdiff_t>(middle),
      begin + static_cast<std::ptrdiff_t>(last),
      [axis](const LatticePoint & a, const LatticePoint & b) { return Coordinate(a, axis) < Coordinate(b, axis); });
    m_Axes[middle] = static_cast<std::uint8_t>(axis);
    Build(first, middle);
    first = middle + 1;
  }
}

void
BoundaryTree::Descend(Search & search, std::size_t first, std::size_t last, double squaredGap) const
{
  const auto test = [&](std::size_t i) {
    const LatticePoint & p = m_Points[i];
    const double         dx = m_Weights[0] * (search.position[0] - p.x);
    const double         dy = m_Weights[1] * (search.position[1] - p.y);
    const double         dz = m_Weights[2] * (search.position[2] - p.z);
    const double         squared = dx * dx + dy * dy + dz * dz;
    if (squared > search.bound)
    {
      return;
    }
    if (squared < search.best)
    {
      // The factor covers the rounding of the distances themselves.
      const double reach = std::sqrt(squared) * (1 + 16 * std::numeric_limits<double>::epsilon()) + search.slack;
      search.best = squared;
      search.bound = reach * reach;
    }
    search.found->push_back({ squared, static_cast<std::uint32_t>(i) });
  };
  if (last - first <= kLeafSize)
  {
    for (std::size_t i = first; i < last; ++i)
    {
      test(i);
    }
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  const std::size_t axis = m_Axes[middle];
  const double      toSplit = m_Weights[axis] * (search.position[axis] - Coordinate(m_Points[middle], axis));
  const bool        lowerFirst = toSplit < 0;
  Descend(search, lowerFirst ? first : middle + 1, lowerFirst ? middle : last, squaredGap);
  test(middle);
  const double gap = search.gaps[axis];
  const double farGap = squaredGap - gap * gap + toSplit * toSplit;
  // A hair below, so that rounding never hides a point on the bound.
  if (farGap * (1 - 1e-12) <= search.bound)
  {
    search.gaps[axis] = toSplit;
    Descend(search, lowerFirst ? middle + 1 : first, lowerFirst ? last : middle, farGap);
    search.gaps[axis] = gap;
  }
}

double
BoundaryTree::FindNearest(const std::array<double, 3> & position, double slack, std::vector<Candidate> & found) const
{
  found.clear();
  Search search{ .position = position, .slack = slack, .found = &found };
  Descend(search, 0, m_Points.size(), 0.0);
  std::erase_if(found, [&](const Candidate & candidate) { return candidate.squaredDistance > search.bound; });
  std::sort(found.begin(), found.end(), [](const Candidate & a, const Candidate & b) { return a.point < b.point; });
  return std::sqrt(search.best);
}

} // namespace voxelcore
