#include "PlaceTree.h"

#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace voxelcore
{

namespace
{

constexpr std::size_t kFew = 8; ///< places that are looked at one by one

} // namespace

PlaceTree::PlaceTree(std::span<const Vector3> places)
  : m_Places(places)
  , m_Order(places.size())
{
  std::iota(m_Order.begin(), m_Order.end(), std::uint32_t{ 0 });
  Build(0, m_Order.size(), 0);
}

void
PlaceTree::Build(std::size_t first, std::size_t last, std::size_t axis)
{
  if (last - first <= kFew)
  {
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  const auto        at = [this](std::size_t i) { return m_Order.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(middle), at(last), [&](std::uint32_t a, std::uint32_t b) {
    return m_Places[a][axis] < m_Places[b][axis];
  });
  Build(first, middle, (axis + 1) % 3);
  Build(middle + 1, last, (axis + 1) % 3);
}

NearPlace
PlaceTree::Nearest(const Vector3 & to) const
{
  NearPlace least{ std::numeric_limits<std::uint32_t>::max(), std::numeric_limits<double>::infinity() };
  Descend(0, m_Order.size(), 0, to, least);
  return least;
}

void
PlaceTree::Descend(std::size_t first, std::size_t last, std::size_t axis, const Vector3 & to, NearPlace & least) const
{
  const auto look = [&](std::size_t i) {
    const std::uint32_t index = m_Order[i];
    const Vector3       gap = Minus(to, m_Places[index]);
    const double        squared = Dot(gap, gap);
    if (squared < least.squared || (squared == least.squared && index < least.index))
    {
      least = { index, squared };
    }
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
  for (const bool isLower : { gap <= 0, gap > 0 })
  {
    if (isLower == (gap <= 0) || gap * gap <= least.squared)
    {
      isLower ? Descend(first, middle, next, to, least) : Descend(middle + 1, last, next, to, least);
    }
  }
}

void
PlaceTree::Within(const Vector3 & of, double reach, std::vector<std::uint32_t> & found) const
{
  found.clear();
  Gather(0, m_Order.size(), 0, of, reach * reach, found);
  std::sort(found.begin(), found.end());
}

void
PlaceTree::Gather(std::size_t                  first,
                  std::size_t                  last,
                  std::size_t                  axis,
                  const Vector3 &              of,
                  double                       squared,
                  std::vector<std::uint32_t> & found) const
{
  const auto look = [&](std::size_t i) {
    const Vector3 gap = Minus(of, m_Places[m_Order[i]]);
    if (Dot(gap, gap) < squared)
    {
      found.push_back(m_Order[i]);
    }
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
  const double      gap = look(middle);
  if (gap <= 0 || gap * gap < squared)
  {
    Gather(first, middle, (axis + 1) % 3, of, squared, found);
  }
  if (gap >= 0 || gap * gap < squared)
  {
    Gather(middle + 1, last, (axis + 1) % 3, of, squared, found);
  }
}

} // namespace voxelcore
