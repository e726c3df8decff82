// What of a tree of triangles is nearest to a place.

#include "voxelcore/Refinement/TriangleTree.h"

#include "voxelcore/Base/EightLanes.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace voxelcore
{

namespace
{

// What distances in single precision are off by at most, as part of how far all that is compared is from the middle.
constexpr double kRounding = 1.0 / (1 << 18);

using Eight = EightFloats;

Vector3
NearestOnSegment(const Vector3 & place, const Vector3 & a, const Vector3 & b)
{
  const Vector3 ab = Minus(b, a);
  const double  length = Dot(ab, ab);
  const double  t = length > 0 ? std::clamp(Dot(Minus(place, a), ab) / length, 0.0, 1.0) : 0.0;
  return AddScaled(a, t, ab);
}

} // namespace

Vector3
NearestOnTriangle(const Vector3 & place, const std::array<Vector3, 3> & corners)
{
  const auto & [a, b, c] = corners;
  const Vector3 ab = Minus(b, a);
  const Vector3 ac = Minus(c, a);
  const Vector3 ap = Minus(place, a);
  const double  d1 = Dot(ab, ap);
  const double  d2 = Dot(ac, ap);
  const Vector3 bp = Minus(place, b);
  const double  d3 = Dot(ab, bp);
  const double  d4 = Dot(ac, bp);
  const Vector3 cp = Minus(place, c);
  const double  d5 = Dot(ab, cp);
  const double  d6 = Dot(ac, cp);
  const double  va = d3 * d6 - d5 * d4;
  const double  vb = d5 * d2 - d1 * d6;
  const double  vc = d1 * d4 - d3 * d2;
  if (va > 0 && vb > 0 && vc > 0)
  {
    const double sum = va + vb + vc;
    return AddScaled(AddScaled(a, vb / sum, ab), vc / sum, ac);
  }
  // Outside, or no triangle: the nearest of the sides, of those that it lies beyond.
  Vector3    best{};
  double     least = std::numeric_limits<double>::infinity();
  const auto lookAt = [&](const Vector3 & from, const Vector3 & to) {
    const Vector3 other = NearestOnSegment(place, from, to);
    const Vector3 gap = Minus(place, other);
    const double  squared = Dot(gap, gap);
    if (squared < least)
    {
      least = squared;
      best = other;
    }
  };
  if (!(vc > 0))
  {
    lookAt(a, b);
  }
  if (!(va > 0))
  {
    lookAt(b, c);
  }
  if (!(vb > 0))
  {
    lookAt(c, a);
  }
  return best;
}

// From near to far, as long as something may still be nearer.
struct TriangleTree::Search
{
  struct Part
  {
    float         squared = 0;
    std::uint32_t level = 0; ///< one more than that of the box
    std::uint32_t index = 0;
  };
  // Eight boxes each of which leaves seven others open: no tree of 2^32 triangles is higher than ten levels.
  static constexpr std::size_t kMostOpen = 80;

  const TriangleTree & tree;
  const Vector3 &      place;
  Nearest &            best;
  std::array<float, 3> at{};
  double               rounding = 0;
  float                farthest = 0; ///< what is not nearer need not be looked at; squared

  [[gnu::always_inline]] void
  Limit()
  {
    const double distance = std::sqrt(best.squaredDistance) + rounding;
    farthest = static_cast<float>(std::min(distance * distance, 1e38)); // there are boxes infinitely far away
  }

  [[gnu::always_inline]] void
  LookInto(const Leaf & leaf)
  {
    const auto find = [&](std::size_t i, Eight & beyond) __attribute__((always_inline))
    {
      const auto & [x, y, z, behind] = leaf.planes[i];
      beyond = EightAt(x.data())->lanes * at[0] + EightAt(y.data())->lanes * at[1] +
               (EightAt(z.data())->lanes * at[2] + EightAt(behind.data())->lanes);
    };
    Eight off;
    Eight beside{};
    find(0, off);
    for (std::size_t side = 1; side <= 3; ++side)
    {
      Eight beyond;
      find(side, beyond);
      beside = beside > beyond ? beside : beyond;
    }
    const Eight squared = off * off + beside * beside;
    for (std::uint32_t near = LanesOf(squared <= farthest); near != 0; near &= near - 1)
    {
      const std::uint32_t triangle = leaf.triangles[static_cast<std::size_t>(std::countr_zero(near))];
      if (triangle != kNoTriangle && triangle != best.triangle)
      {
        const double before = best.squaredDistance;
        tree.LookAt(triangle, place, best);
        if (best.squaredDistance < before)
        {
          Limit();
        }
      }
    }
  }

  // Puts those of eight that may hold something nearer onto the open ones, the nearest last.
  [[gnu::always_inline]] void
  Open(const Boxes & boxes, const Part & part, std::array<Part, kMostOpen> & open, std::size_t & count)
  {
    Eight squared{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const Eight zero{};
      const Eight before = EightAt(boxes.lower[axis].data())->lanes - at[axis];
      const Eight behind = at[axis] - EightAt(boxes.upper[axis].data())->lanes;
      Eight       gap = before > behind ? before : behind;
      gap = gap > zero ? gap : zero;
      squared += gap * gap;
    }
    const std::size_t first = count;
    for (std::uint32_t near = LanesOf(squared <= farthest); near != 0; near &= near - 1)
    {
      const auto  lane = static_cast<std::uint32_t>(std::countr_zero(near));
      const float gap = squared[lane];
      std::size_t i = count++;
      for (; i > first && open[i - 1].squared < gap; --i)
      {
        open[i] = open[i - 1];
      }
      open[i] = { gap, part.level - 1, static_cast<std::uint32_t>(kLanes) * part.index + lane };
    }
  }

  [[gnu::always_inline]] void
  Run()
  {
    double far = tree.m_Extent;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double along = place[axis] - tree.m_Middle[axis];
      at[axis] = static_cast<float>(along);
      far = std::max(far, std::abs(along));
    }
    rounding = kRounding * far;
    Limit();
    std::array<Part, kMostOpen> open;
    std::size_t                 count = 1;
    open[0] = { 0, static_cast<std::uint32_t>(tree.m_Levels.size()), 0 };
    while (count > 0)
    {
      const Part part = open[--count];
      if (part.squared > farthest)
      {
        continue;
      }
      if (part.level == 0)
      {
        LookInto(tree.m_Leaves[part.index]);
      }
      else
      {
        Open(tree.m_Levels[part.level - 1][part.index], part, open, count);
      }
    }
  }

  static VOXELCORE_EIGHT_LANES void
  RunOn(Search & search)
  {
    search.Run();
  }
};

TriangleTree::Nearest
TriangleTree::FindNearest(const Vector3 & place, double within, std::uint32_t likely) const
{
  Nearest best;
  best.squaredDistance = within * within;
  best.triangle = kNoTriangle;
  if (likely < m_Corners.size())
  {
    LookAt(likely, place, best);
  }
  if (!m_Leaves.empty())
  {
    Search search{ *this, place, best };
    Search::RunOn(search);
  }
  return best;
}

void
TriangleTree::LookAt(std::uint32_t triangle, const Vector3 & place, Nearest & best) const
{
  const Vector3 point = NearestOnTriangle(place, m_Corners[triangle]);
  const Vector3 gap = Minus(place, point);
  const double  squared = Dot(gap, gap);
  if (squared < best.squaredDistance || (squared == best.squaredDistance && triangle < best.triangle))
  {
    best = { point, squared, triangle };
  }
}

} // namespace voxelcore
