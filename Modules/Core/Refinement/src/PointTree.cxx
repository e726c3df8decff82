#include "PointTree.h"

#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <numeric>

namespace voxelcore
{

namespace
{

constexpr std::size_t kFew = 8;      ///< points that are looked at one by one
constexpr std::size_t kTask = 32768; ///< points that are worth a thread of their own

} // namespace

PointTree::PointTree(std::span<const LatticePoint> points, const Vector3 & spacing)
  : m_Points(points)
  , m_Spacing(spacing)
  , m_Order(points.size())
{
  std::iota(m_Order.begin(), m_Order.end(), std::uint32_t{ 0 });
#pragma omp parallel if (m_Order.size() > 2 * kTask)
#pragma omp single
  Build(0, m_Order.size(), 0);
}

Vector3
PointTree::Place(std::uint32_t point) const
{
  const LatticePoint & p = m_Points[point];
  return Times({ static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z) }, m_Spacing);
}

void
PointTree::Build(std::size_t first, std::size_t last, std::size_t axis)
{
  if (last - first <= kFew)
  {
    return;
  }
  const auto at = [&](std::uint32_t point) {
    const LatticePoint & p = m_Points[point];
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
  };
  const std::size_t middle = first + (last - first) / 2;
  const auto        begin = m_Order.begin();
  std::nth_element(begin + static_cast<std::ptrdiff_t>(first),
                   begin + static_cast<std::ptrdiff_t>(middle),
                   begin + static_cast<std::ptrdiff_t>(last),
                   [&](std::uint32_t a, std::uint32_t b) { return at(a) < at(b); });
  const std::size_t next = (axis + 1) % 3;
  if (last - first <= kTask)
  {
    Build(first, middle, next);
    Build(middle + 1, last, next);
    return;
  }
#pragma omp task
  Build(first, middle, next);
  Build(middle + 1, last, next);
#pragma omp taskwait
}

double
PointTree::SquaredDistance(const Vector3 & place, double within) const
{
  double least = within * within;
  Descend(0, m_Order.size(), 0, place, least);
  return least;
}

void
PointTree::Descend(std::size_t first, std::size_t last, std::size_t axis, const Vector3 & place, double & least) const
{
  const auto look = [&](std::size_t i) {
    const Vector3 gap = Minus(place, Place(m_Order[i]));
    least = std::min(least, Dot(gap, gap));
    return gap[axis];
  };
  if (last - first <= kFew)
  {
    for (std::size_t i = first; i < last; ++i)
    {
      look(i);
    }
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  const std::size_t next = (axis + 1) % 3;
  const double      gap = look(middle);
  for (const bool lower : { gap <= 0, gap > 0 })
  {
    if ((lower == (gap <= 0)) || gap * gap < least)
    {
      lower ? Descend(first, middle, next, place, least) : Descend(middle + 1, last, next, place, least);
    }
  }
}

} // namespace voxelcore
