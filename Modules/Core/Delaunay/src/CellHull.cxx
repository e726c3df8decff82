#include "CellHull.h"

#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <array>

namespace voxelcore
{

namespace
{

// TNumber holds the volume of three differences, 6 N^3 for points that differ by up to N.
template <typename TNumber>
struct Vector
{
  TNumber x, y, z;
};

template <typename TNumber>
Vector<TNumber>
Between(const LatticePoint & from, const LatticePoint & to)
{
  return { TNumber{ to.x } - from.x, TNumber{ to.y } - from.y, TNumber{ to.z } - from.z };
}

template <typename TNumber>
Vector<TNumber>
Cross(const Vector<TNumber> & a, const Vector<TNumber> & b)
{
  return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

template <typename TNumber>
TNumber
Dot(const Vector<TNumber> & a, const Vector<TNumber> & b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// The facet whose outline runs from point `from` to point `to`: pivot a plane about that side until all points lie
// behind it, then take every point on it, in order around `from`.
template <typename TNumber>
void
AppendFacet(std::span<const LatticePoint> points, std::uint32_t from, std::uint32_t to, HullFacets & hull)
{
  const auto      side = Between<TNumber>(points[from], points[to]);
  std::uint32_t   third = from;
  Vector<TNumber> normal{ 0, 0, 0 };
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (i == from || i == to)
    {
      continue;
    }
    const auto arm = Between<TNumber>(points[from], points[i]);
    if (third == from || Dot(normal, arm) > 0)
    {
      third = static_cast<std::uint32_t>(i);
      normal = Cross(side, arm);
    }
  }
  const std::size_t start = hull.corners.size();
  hull.corners.push_back(from);
  hull.corners.push_back(to);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (i != from && i != to && Dot(normal, Between<TNumber>(points[from], points[i])) == 0)
    {
      hull.corners.push_back(static_cast<std::uint32_t>(i));
    }
  }
  // All lie on the left of from -> to in the facet's plane, so angles about `from` are less than half a turn.
  if (hull.corners.size() > start + 3)
  {
    // The product of a normal and another vector of its size may be twice as long as a volume.
    const Vector<std::int64_t> axis{ normal.x, normal.y, normal.z };
    std::sort(hull.corners.begin() + static_cast<std::ptrdiff_t>(start) + 2,
              hull.corners.end(),
              [&](std::uint32_t a, std::uint32_t b) {
                return Dot(Cross(Between<std::int64_t>(points[from], points[a]),
                                 Between<std::int64_t>(points[from], points[b])),
                           axis) > 0;
              });
  }
  hull.offsets.push_back(static_cast<std::uint32_t>(hull.corners.size()));
}

// A directed side of the hull at point 0 to start from: every cospherical point is a corner, so some plane through
// point 0 and two others has all points behind it.
template <typename TNumber>
std::array<std::uint32_t, 2>
FirstSide(std::span<const LatticePoint> points)
{
  for (std::uint32_t i = 1; i < points.size(); ++i)
  {
    for (std::uint32_t j = 1; j < points.size(); ++j)
    {
      const auto normal = Cross(Between<TNumber>(points[0], points[i]), Between<TNumber>(points[0], points[j]));
      if (i != j && (normal.x != 0 || normal.y != 0 || normal.z != 0) &&
          std::all_of(points.begin(), points.end(), [&](const LatticePoint & p) {
            return Dot(normal, Between<TNumber>(points[0], p)) <= 0;
          }))
      {
        // The facet's outline through point 0: pivoting about a chord of it would miss part of the facet, so take the
        // point in its plane that is first in counter-clockwise order.
        std::uint32_t first = i;
        for (std::uint32_t k = 1; k < points.size(); ++k)
        {
          const auto                 arm = Between<std::int64_t>(points[0], points[k]);
          const Vector<std::int64_t> axis{ normal.x, normal.y, normal.z };
          if (Dot(axis, arm) == 0 && Dot(Cross(Between<std::int64_t>(points[0], points[first]), arm), axis) < 0)
          {
            first = k;
          }
        }
        return { 0, first };
      }
    }
  }
  throw Error("a Delaunay cell is flat; please report this input");
}

// Gift wrapping: sides of known facets whose other facet is still missing.
template <typename TNumber>
void
WrapHull(std::span<const LatticePoint> points, HullFacets & hull)
{
  std::vector<std::array<std::uint32_t, 2>> open;
  open.reserve(3 * points.size());
  open.push_back(FirstSide<TNumber>(points));
  std::swap(open[0][0], open[0][1]); // as if the facet beyond had run the other way
  while (!open.empty())
  {
    const std::array<std::uint32_t, 2> side{ open.back()[1], open.back()[0] };
    open.pop_back();
    AppendFacet<TNumber>(points, side[0], side[1], hull);
    const auto polygon = hull.Polygon(hull.Count() - 1);
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const std::array<std::uint32_t, 2> own{ polygon[i], polygon[i + 1 == polygon.size() ? 0 : i + 1] };
      const std::array<std::uint32_t, 2> twin{ own[1], own[0] };
      if (own == side && hull.Count() > 1) // the facet on its other side is where it came from
      {
        continue;
      }
      const auto met = std::find(open.begin(), open.end(), twin);
      if (met != open.end())
      {
        *met = open.back();
        open.pop_back();
      }
      else
      {
        open.push_back(own);
      }
    }
    if (hull.Count() > 2 * points.size())
    {
      throw Error("the hull of a Delaunay cell does not close; please report this input");
    }
  }
}

// A loop: for a dozen numbers a call to the library's comparison costs more.
bool
IsSame(const std::uint32_t * key, const std::uint32_t * old, std::size_t size)
{
  for (std::size_t i = 0; i < size; ++i)
  {
    if (key[i] != old[i])
    {
      return false;
    }
  }
  return true;
}

// Of points in a box of 64: a sphere meets its 2^12 columns twice at most.
void
AppendPolygons(const HullFacets & hull, std::vector<std::uint16_t> & polygons)
{
  for (std::size_t facet = 0; facet < hull.Count(); ++facet)
  {
    const auto polygon = hull.Polygon(facet);
    polygons.push_back(static_cast<std::uint16_t>(polygon.size()));
    for (const std::uint32_t corner : polygon)
    {
      polygons.push_back(static_cast<std::uint16_t>(corner));
    }
  }
}

} // namespace

HullFacets
ComputeHull(std::span<const LatticePoint> points)
{
  HullFacets hull;
  WrapHull<std::int64_t>(points, hull);
  return hull;
}

HullMemo::Polygons
HullMemo::Get(std::span<const std::uint32_t> points)
{
  // Large sets do not come back, and the table must not outgrow the caches.
  constexpr std::size_t                  largestKept = 12;
  constexpr std::size_t                  mostKept = 100000;
  std::array<std::uint32_t, largestKept> key;
  Slot *                                 slot = nullptr;
  if (points.size() <= largestKept)
  {
    // 64 keeps what y and x may be less from the bits of others.
    const std::uint32_t from = points[0] - (64U << 7 | 64U);
    std::uint64_t       hash = points.size();
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      key[i] = points[i] - from;
      hash = (hash ^ key[i]) * 0xD6E8FEB86659FD93U;
      hash ^= hash >> 32;
    }
    const std::size_t mask = m_Slots.size() - 1;
    std::size_t       at = hash & mask;
    for (; m_Slots[at].hullSize != 0; at = (at + 1) & mask)
    {
      const Slot & old = m_Slots[at];
      if (old.hash == hash && old.keySize == points.size() &&
          IsSame(key.data(), m_Keys.data() + old.key, points.size()))
      {
        return { m_Polygons.data() + old.hull, old.hullSize };
      }
    }
    if (m_Used < mostKept)
    {
      slot = &m_Slots[at];
      slot->hash = hash;
    }
  }
  m_Points.clear();
  for (const std::uint32_t p : points)
  {
    m_Points.push_back({ static_cast<std::int32_t>(p & 127U),
                         static_cast<std::int32_t>(p >> 7 & 127U),
                         static_cast<std::int32_t>(p >> 14) });
  }
  m_Hull.Clear();
  WrapHull<std::int32_t>(m_Points, m_Hull); // 6 * 64^3 < 2^31
  if (slot == nullptr)
  {
    m_Last.clear();
    AppendPolygons(m_Hull, m_Last);
    return m_Last;
  }
  slot->key = static_cast<std::uint32_t>(m_Keys.size());
  slot->keySize = static_cast<std::uint16_t>(points.size());
  slot->hull = static_cast<std::uint32_t>(m_Polygons.size());
  m_Keys.insert(m_Keys.end(), key.begin(), key.begin() + slot->keySize);
  AppendPolygons(m_Hull, m_Polygons);
  slot->hullSize = static_cast<std::uint16_t>(m_Polygons.size() - slot->hull);
  const Polygons polygons{ m_Polygons.data() + slot->hull, slot->hullSize };
  if (2 * ++m_Used > m_Slots.size())
  {
    std::vector<Slot> old(2 * m_Slots.size());
    old.swap(m_Slots);
    for (const Slot & kept : old)
    {
      if (kept.hullSize != 0)
      {
        std::size_t at = kept.hash & (m_Slots.size() - 1);
        while (m_Slots[at].hullSize != 0)
        {
          at = (at + 1) & (m_Slots.size() - 1);
        }
        m_Slots[at] = kept;
      }
    }
  }
  return polygons;
}

} // namespace voxelcore
