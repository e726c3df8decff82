#include "FootPoints.h"

#include "voxelcore/Vectors.h"


#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{

namespace
{

// Of each boundary vertex the foot that may go farthest.
void
KeepOneOfEach(std::vector<FootPoint> & footPoints)
{
  std::sort(footPoints.begin(), footPoints.end(), [](const FootPoint & a, const FootPoint & b) {
    return a.point != b.point ? a.point < b.point : a.distance > b.distance;
  });
  footPoints.erase(std::unique(footPoints.begin(),
                               footPoints.end(),
                               [](const FootPoint & a, const FootPoint & b) { return a.point == b.point; }),
                   footPoints.end());
}

// Two directions at right angles to a normal and to each other, the first nearest to `slide`.
std::array<Vector3, 2>
TangentsOf(const Vector3 & n, const Vector3 & slide)
{
  const Vector3 axis = std::abs(n[0]) < 0.6 ? Vector3{ 1, 0, 0 } : Vector3{ 0, 1, 0 };
  const Vector3 along = Length(slide) > 0 ? slide : AddScaled(axis, -Dot(axis, n), n);
  const Vector3 u = AddScaled({ 0, 0, 0 }, 1 / Length(along), along);
  return { u, Cross(n, u) };
}

// What is left to the foot of the plane through the surface at a place.
Vector3
SlideOf(const Vector3 & place, const SurfacePoint & foot)
{
  const Vector3 gap = Minus(place, foot.position);
  return AddScaled(gap, -Dot(gap, foot.normal), foot.normal);
}

// Of a quadratic form the least value among all directions, by what it makes of two at right angles.
double
LeastOf(const std::array<Vector3, 2> & ways, const std::array<Vector3, 2> & made)
{
  const double a = Dot(ways[0], made[0]);
  const double b = Dot(ways[1], made[1]);
  const double c = 0.5 * (Dot(ways[0], made[1]) + Dot(ways[1], made[0]));
  return 0.5 * (a + b) - std::hypot(0.5 * (a - b), c);
}

constexpr double kLongestStride = 2.0; // voxels
constexpr double kTurn = 0.3;          // cosine: beyond it is another side of the surface

} // namespace

FootPointFinder::FootPointFinder(const RefinementInput & input, const ProgressCallback & progress)
  : m_Input(input)
  , m_Anchors(input.points->size())
  , m_Close(input.surface->Ripples() > 0 ? 1e-2 : 1e-3)
{
  m_Voxel = std::cbrt(input.spacing[0] * input.spacing[1] * input.spacing[2]);
  // The surface parts the eight centres around a boundary vertex, so it passes within half a diagonal; smoothed, a
  // little beyond.
  const double reach = 0.75 * Length(input.spacing);
  const auto   count = static_cast<std::ptrdiff_t>(m_Anchors.size());
  ReportProgress(progress, "refining", 0);
#pragma omp parallel for schedule(dynamic, 256) if (count > 512)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto point = static_cast<std::uint32_t>(i);
    m_Anchors[point] = input.surface->Project(Place(point), reach);
  }
}

Vector3
FootPointFinder::Place(std::uint32_t point) const
{
  const LatticePoint & p = (*m_Input.points)[point];
  return Times({ static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z) }, m_Input.spacing);
}

// From either end the way downhill along the surface, as far as it leads to the other end: all of the way between them
// where the surface is flat, none where it is bent about `place`.
bool
FootPointFinder::Meet(const Vector3 & place, const PointPair & pair) const
{
  constexpr double     ofWay = 0.25;
  constexpr double     sameSide = 0.7; // cosine
  const SurfacePoint & a = m_Anchors[pair[0]];
  const SurfacePoint & b = m_Anchors[pair[1]];
  const Vector3        way = Minus(b.position, a.position);
  const Vector3        toA = Minus(place, a.position);
  const Vector3        toB = Minus(place, b.position);
  const double         awayA = Dot(toA, a.normal);
  const double         awayB = Dot(toB, b.normal);
  if (!a.found || !b.found || std::abs(Dot(a.normal, b.normal)) < sameSide ||
      (awayA > 0) != ((Dot(a.normal, b.normal) > 0) == (awayB > 0)))
  {
    return false;
  }
  return Dot(AddScaled(toA, -awayA, a.normal), way) - Dot(AddScaled(toB, -awayB, b.normal), way) >
         ofWay * Dot(way, way);
}

void
FootPointFinder::Find(const Vector3 &            place,
                      std::span<const PointPair> pairs,
                      std::vector<FootPoint> &   footPoints) const
{
  footPoints.clear();
  for (const PointPair & pair : pairs)
  {
    const double width = 0.45 * Distance(Place(pair[0]), Place(pair[1]));
    footPoints.push_back({ pair[0], {}, width });
    footPoints.push_back({ pair[1], {}, width });
  }
  KeepOneOfEach(footPoints);
  for (FootPoint & foot : footPoints)
  {
    foot.position = Slide(place, foot.point, foot.distance);
    foot.distance = Distance(place, foot.position);
  }
}

void
FootPointFinder::Settle(const Vector3 &            place,
                        std::span<const PointPair> pairs,
                        std::vector<FootPoint> &   footPoints) const
{
  footPoints.clear();
  for (const PointPair & pair : pairs)
  {
    footPoints.push_back({ pair[0], {}, 0 });
    footPoints.push_back({ pair[1], {}, 0 });
  }
  KeepOneOfEach(footPoints);
  // Of those that meet one alone goes all the way.
  constexpr double open = -1;
  for (FootPoint & foot : footPoints)
  {
    foot.distance = open;
  }
  for (FootPoint & foot : footPoints)
  {
    if (foot.distance != open)
    {
      continue;
    }
    foot.position = Descend(place, foot.point);
    foot.distance = Distance(place, foot.position);
    for (bool more = true; more;)
    {
      more = false;
      for (const PointPair & pair : pairs)
      {
        FootPoint & a = FootPointOf(footPoints, pair[0]);
        FootPoint & b = FootPointOf(footPoints, pair[1]);
        if ((a.distance == open) != (b.distance == open) && Meet(place, pair))
        {
          FootPoint &       one = a.distance == open ? a : b;
          const FootPoint & other = a.distance == open ? b : a;
          one.position = other.position;
          one.distance = other.distance;
          more = true;
        }
      }
    }
  }
}

// A try to come nearer to `place` by way of `to`, a place beside the surface. Returns how much farther than `distance`
// the surface is there, at `next`; infinity where it is another side of it.
double
FootPointFinder::TryFoot(const Vector3 &      place,
                         const Vector3 &      to,
                         const SurfacePoint & foot,
                         double               distance,
                         SurfacePoint &       next) const
{
  next = m_Input.surface->Project(to, m_Voxel);
  return !next.found || std::abs(Dot(next.normal, foot.normal)) < kTurn ? std::numeric_limits<double>::infinity()
                                                                        : Distance(place, next.position) - distance;
}

// Near the axis of a tube the surface falls less than its ripples and facets do, and the way down cannot be told from
// its normal. So where no slope is left, ways at right angles are tried with long strides, until slopes beside the foot
// show that it lies lower than all around nearly as that of a flat surface does.
Vector3
FootPointFinder::Descend(const Vector3 & place, std::uint32_t point) const
{
  constexpr int    steps = 120;
  constexpr double shortest = 0.1; // voxels
  constexpr double ofRadius = 0.25;
  constexpr double ofFlatRise = 0.2;
  constexpr double ofFlatRiseOfTwo = 0.6; // on two ways at right angles: then at least 0.2 on all
  SurfacePoint     foot = m_Anchors[point];
  if (!foot.found)
  {
    return Place(point);
  }
  double       distance = Distance(place, foot.position);
  const double longest = std::max(kLongestStride * m_Voxel, ofRadius * distance);
  double       stride = std::max(0.5 * m_Voxel, ofRadius * distance);
  bool         flat = false;
  SurfacePoint next;
  // What is nearly as near lies along the ball, not along the surface's tangents, which leave a tube soon.
  double     rise = 0;
  const auto descends = [&](double length, const Vector3 & way) {
    const Vector3 ray = Minus(AddScaled(foot.position, length, way), place);
    const double  away = Length(ray);
    const Vector3 to = away > 0 ? AddScaled(place, distance / away, ray) : place;
    rise = TryFoot(place, to, foot, distance, next);
    if (rise < 0)
    {
      foot = next;
      distance += rise;
    }
    return rise < 0;
  };
  // Facets have no slopes to go by, so that on a mesh ways are tried all around.
  const bool bySlopes = Ripples() > 0;
  for (int step = 0; step < steps && stride >= shortest * m_Voxel; ++step)
  {
    const Vector3 slide = SlideOf(place, foot);
    const double  length = Length(slide);
    const bool    slopes = length >= m_Close * m_Voxel;
    if (flat && !slopes)
    {
      break;
    }
    const double part = (flat || bySlopes ? std::min(stride, length) : stride) / length;
    if ((bySlopes ? slopes : length > 0) && descends(part, slide))
    {
      stride = std::min(longest, 2 * stride);
      continue;
    }
    if (!flat)
    {
      const std::array<Vector3, 2> ways = TangentsOf(foot.normal, slide);
      std::array<Vector3, 2>       back{};
      bool                         found = true;
      bool                         lower = false;
      double                       least = std::numeric_limits<double>::infinity();
      for (std::size_t way = 0; way < 4 && !lower && !flat; ++way)
      {
        lower = descends(way < 2 ? stride : -stride, ways[way % 2]);
        least = std::min(least, rise);
        if (bySlopes && !lower && way < 2)
        {
          found = found && next.found;
          back[way] = AddScaled({ 0, 0, 0 }, 1 / stride, Minus(slide, SlideOf(place, next)));
          flat = way == 1 && found && LeastOf(ways, back) > ofFlatRise;
        }
      }
      if (lower)
      {
        continue;
      }
      flat = flat || (!bySlopes && least > ofFlatRiseOfTwo * stride * stride / (2 * distance));
    }
    stride *= 0.5;
  }
  return foot.position;
}

// From where the surface passes the boundary vertex downhill towards where a ball about `place` touches it. Where it is
// nearly as near in many directions, as about the axis of a tube, going all the way would lead to the deepest ripple,
// and both foot points of a pair to the same: a few steps reach the foot on all that is flatter.
Vector3
FootPointFinder::Slide(const Vector3 & place, std::uint32_t point, double most) const
{
  const int        steps = Ripples() > 0 ? 4 : 24;
  constexpr double shortest = 1.0 / 16;
  const Vector3    home = Place(point);
  SurfacePoint     foot = m_Anchors[point];
  if (!foot.found)
  {
    return home;
  }
  const double radius = Distance(place, home);
  const double reach = std::min(most, 1.5 * std::sqrt(2 * radius * m_Voxel) + 2 * m_Voxel);
  double       distance = Distance(place, foot.position);
  double       shorter = 1;
  SurfacePoint next;
  for (int step = 0; step < steps && shorter >= shortest; ++step)
  {
    const Vector3 slide = SlideOf(place, foot);
    const double  length = Length(slide);
    if (shorter * length < m_Close * m_Voxel)
    {
      break;
    }
    const double part = shorter * std::min(1.0, kLongestStride * m_Voxel / length);
    const double rise = TryFoot(place, AddScaled(foot.position, part, slide), foot, distance, next);
    // A crease that draws back from `place` is nearest itself: steps end on it from either side only if they get
    // shorter.
    if (rise >= 0 || Distance(next.position, home) > reach)
    {
      shorter *= 0.5;
      continue;
    }
    foot = next;
    distance += rise;
  }
  return foot.position;
}

} // namespace voxelcore
