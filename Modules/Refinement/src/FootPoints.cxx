#include "FootPoints.h"

#include "voxelcore/Vectors.h"


#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{

namespace
{

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
  , m_Close(std::max(2 * input.surface->Ripples(), 1e-3))
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

// Of each boundary vertex in pairs one foot, that may go farthest: where it was found before, or where the surface
// passes the vertex.
void
FootPointFinder::Begin(std::span<const PointPair> pairs, std::vector<FootPoint> & footPoints) const
{
  constexpr double former = -1;
  if (Ripples() == 0)
  {
    footPoints.clear(); // facets hold feet where they were
  }
  for (FootPoint & foot : footPoints)
  {
    foot.distance = former;
  }
  for (const PointPair & pair : pairs)
  {
    const double width = 0.45 * Distance(Place(pair[0]), Place(pair[1]));
    footPoints.push_back({ pair[0], {}, width });
    footPoints.push_back({ pair[1], {}, width });
  }
  std::sort(footPoints.begin(), footPoints.end(), [](const FootPoint & a, const FootPoint & b) {
    return a.point != b.point ? a.point < b.point : a.distance > b.distance;
  });
  std::size_t kept = 0;
  for (std::size_t first = 0, end = 0; first < footPoints.size(); first = end)
  {
    const std::uint32_t point = footPoints[first].point;
    const double        width = footPoints[first].distance;
    while (end < footPoints.size() && footPoints[end].point == point)
    {
      ++end;
    }
    if (width == former)
    {
      continue;
    }
    FootPoint foot = footPoints[end - 1];
    if (foot.distance != former)
    {
      const SurfacePoint & anchor = m_Anchors[point];
      foot = { point, anchor.found ? anchor.position : Place(point), 0, anchor.normal, anchor.found };
    }
    foot.distance = width;
    footPoints[kept++] = foot;
  }
  footPoints.resize(kept);
}

void
FootPointFinder::Find(const Vector3 &            place,
                      std::span<const PointPair> pairs,
                      std::vector<FootPoint> &   footPoints) const
{
  Begin(pairs, footPoints);
  for (FootPoint & foot : footPoints)
  {
    Slide(place, foot.distance, foot);
  }
}

void
FootPointFinder::Settle(const Vector3 &            place,
                        std::span<const PointPair> pairs,
                        std::vector<FootPoint> &   footPoints) const
{
  Begin(pairs, footPoints);
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
    Descend(place, foot);
    const auto meet = [&](FootPoint & one, double widest) {
      const bool met = one.distance == open && Falls(place, one.point, foot, widest);
      if (met)
      {
        one.position = foot.position;
        one.distance = foot.distance;
      }
      return met;
    };
    // Small angles tell little, as a rim is flat about its end, but where the surface is round about `place`. Without
    // ripples descents tell more.
    constexpr double rightAngle = 0;
    bool             round = false;
    for (std::size_t i = 0; Ripples() > 0 && i < footPoints.size(); ++i)
    {
      round = meet(footPoints[i], rightAngle) || round;
    }
    for (std::size_t i = 0; round && i < footPoints.size(); ++i)
    {
      meet(footPoints[i], 1);
    }
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

// Whether the way along the ball from where the surface passes a boundary vertex to a foot falls all along, but for
// ripples. The cosine of the angle between both is at most `most`.
bool
FootPointFinder::Falls(const Vector3 & place, std::uint32_t point, const FootPoint & to, double most) const
{
  constexpr double     opposite = -0.9; // cosine: there are many ways
  const double         ripples = Ripples() * m_Voxel;
  const SurfacePoint & anchor = m_Anchors[point];
  const Vector3        first = Minus(anchor.position, place);
  const Vector3        last = Minus(to.position, place);
  const double         distance = Length(first);
  double               farthest = distance + ripples;
  const double         cosine = Dot(first, last) / (distance * to.distance);
  if (!anchor.found || to.distance > farthest || !(cosine >= opposite) || cosine > most)
  {
    return false;
  }
  const auto   steps = static_cast<int>(std::ceil(Distance(first, last) / m_Voxel));
  SurfacePoint before = anchor;
  SurfacePoint next;
  for (int step = 1; step <= steps; ++step)
  {
    const double  part = step / (steps + 1.0);
    const Vector3 ray = AddScaled(first, part, Minus(last, first));
    const double  away = distance + part * (to.distance - distance);
    const double  rise = TryFoot(place, AddScaled(place, away / Length(ray), ray), before, farthest, next);
    if (!(rise <= 0))
    {
      return false;
    }
    farthest = std::min(farthest, farthest + rise + ripples);
    before = next;
  }
  return true;
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
void
FootPointFinder::Descend(const Vector3 & place, FootPoint & begin) const
{
  constexpr int    steps = 120;
  const double     shortest = Ripples() > 0 ? 0.3 : 0.1; // voxels
  constexpr double ofRadius = 0.25;
  constexpr double ofFlatRise = 0.2;
  constexpr double ofFlatRiseOfTwo = 0.6; // on two ways at right angles: then at least 0.2 on all
  SurfacePoint     foot{ begin.position, begin.normal, begin.found };
  double           distance = Distance(place, foot.position);
  begin.distance = distance;
  if (!foot.found)
  {
    return;
  }
  const double longest = std::max(kLongestStride * m_Voxel, ofRadius * distance);
  double       stride = std::max(0.5 * m_Voxel, ofRadius * distance);
  bool         flat = false;
  SurfacePoint next;
  // Facets have no slopes to go by, so that on a mesh ways are tried all around.
  const bool bySlopes = Ripples() > 0;
  // What is nearly as near lies along the ball, not along the surface's tangents, which leave a tube soon. From one
  // shallow ripple to the next it would be a long way.
  constexpr double ofRipples = 0.1;
  const double     shallowest = ofRipples * Ripples() * m_Voxel;
  double           rise = 0;
  const auto       descends = [&](double length, const Vector3 & way) {
    const Vector3 ray = Minus(AddScaled(foot.position, length, way), place);
    const double  away = Length(ray);
    const Vector3 to = away > 0 ? AddScaled(place, distance / away, ray) : place;
    rise = TryFoot(place, to, foot, distance, next);
    if (rise >= -shallowest)
    {
      return false;
    }
    foot = next;
    distance += rise;
    return true;
  };
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
  begin = { begin.point, foot.position, distance, foot.normal, true };
}

// From where the surface passes the boundary vertex downhill towards where a ball about `place` touches it. Where it is
// nearly as near in many directions, as about the axis of a tube, going all the way would lead to the deepest ripple,
// and both foot points of a pair to the same: a few steps reach the foot on all that is flatter.
void
FootPointFinder::Slide(const Vector3 & place, double most, FootPoint & begin) const
{
  const int        steps = Ripples() > 0 ? 4 : 24;
  constexpr double shortest = 1.0 / 16;
  const Vector3    home = Place(begin.point);
  SurfacePoint     foot{ begin.position, begin.normal, begin.found };
  begin.distance = Distance(place, foot.position);
  if (!foot.found)
  {
    return;
  }
  const double radius = Distance(place, home);
  const double reach = std::min(most, 1.5 * std::sqrt(2 * radius * m_Voxel) + 2 * m_Voxel);
  double       distance = begin.distance;
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
  begin = { begin.point, foot.position, distance, foot.normal, true };
}

} // namespace voxelcore
