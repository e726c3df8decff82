#include "FootPoints.h"

#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

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

// About the places where normals are asked for in Descend().
void
FootPointFinder::FindBends(const std::vector<double> & radii)
{
  constexpr double ofRadius = 0.25;
  m_Bends.assign(m_Anchors.size(), SurfaceBend{});
  const auto count = static_cast<std::ptrdiff_t>(Ripples() > 0 ? m_Anchors.size() : 0);
#pragma omp parallel for schedule(dynamic, 256) if (count > 512)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto point = static_cast<std::size_t>(i);
    if (radii[point] > 0 && m_Anchors[point].found)
    {
      m_Bends[point] = BendOf(*m_Input.surface, m_Anchors[point], std::max(m_Voxel, ofRadius * radii[point]), m_Voxel);
    }
  }
}

// Within so many strides of where the surface passes a boundary vertex and its bends are known: those of the distance
// from `place` to it.
bool
FootPointFinder::BendsAt(const Vector3 & place, const FootPoint & foot, double strides, DistanceBends & bends) const
{
  const SurfaceBend &  bend = m_Bends[foot.point];
  const SurfacePoint & anchor = m_Anchors[foot.point];
  if (!(bend.stride > 0) || Distance(foot.position, anchor.position) > strides * bend.stride)
  {
    return false;
  }
  bends = DistanceBendsOf(bend, anchor.normal, Dot(Minus(place, foot.position), foot.normal));
  return true;
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
  if (Ripples() == 0)
  {
    footPoints.clear(); // facets hold feet where they were
  }
  constexpr double unwanted = -1;
  for (FootPoint & foot : footPoints)
  {
    foot.distance = unwanted;
  }
  const std::size_t before = footPoints.size();
  for (const PointPair & pair : pairs)
  {
    const double width = 0.45 * Distance(Place(pair[0]), Place(pair[1]));
    for (const std::uint32_t point : pair)
    {
      const auto found =
        std::find_if(footPoints.begin(), footPoints.end(), [&](const FootPoint & foot) { return foot.point == point; });
      if (found != footPoints.end())
      {
        found->distance = std::max(found->distance, width);
        continue;
      }
      const SurfacePoint & anchor = m_Anchors[point];
      footPoints.push_back(
        { point, anchor.found ? anchor.position : Place(point), width, anchor.normal, anchor.found });
    }
  }
  const bool added = footPoints.size() > before;
  std::erase_if(footPoints, [&](const FootPoint & foot) { return foot.distance == unwanted; });
  if (added)
  {
    std::sort(footPoints.begin(), footPoints.end(), [](const FootPoint & a, const FootPoint & b) {
      return a.point < b.point;
    });
  }
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

} // namespace voxelcore
