#include "Feet.h"

#include "Vectors.h"

#include <algorithm>

namespace voxelcore
{

namespace
{

// Of each boundary vertex the foot that may go farthest.
void
KeepOneOfEach(std::vector<Foot> & feet)
{
  std::sort(feet.begin(), feet.end(), [](const Foot & a, const Foot & b) {
    return a.point != b.point ? a.point < b.point : a.distance > b.distance;
  });
  feet.erase(std::unique(feet.begin(), feet.end(), [](const Foot & a, const Foot & b) { return a.point == b.point; }),
             feet.end());
}

constexpr double kLongestStride = 2.0; // voxels
constexpr double kClose = 1e-3;        // voxels
constexpr double kTurn = 0.5;          // cosine: beyond it is another side of the surface

} // namespace

FootFinder::FootFinder(const RefinementInput &           input,
                       const std::vector<std::uint8_t> & used,
                       const ProgressCallback &          progress)
  : m_Input(input)
  , m_Anchors(used.size())
{
  m_Voxel = std::cbrt(input.spacing[0] * input.spacing[1] * input.spacing[2]);
  // The surface parts the eight centres around a boundary vertex, so it passes within half a diagonal; smoothed, it may
  // pass a little beyond.
  const double reach = 0.75 * Length(input.spacing);
  const auto   count = static_cast<std::ptrdiff_t>(used.size());
  ReportProgress(progress, "refining", 0);
#pragma omp parallel for schedule(dynamic, 256) if (count > 512)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto point = static_cast<std::uint32_t>(i);
    if (used[point] != 0)
    {
      m_Anchors[point] = input.surface->Project(Place(point), reach);
    }
  }
}

Vector3
FootFinder::Place(std::uint32_t point) const
{
  const LatticePoint & p = (*m_Input.points)[point];
  return Times({ static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z) }, m_Input.spacing);
}

void
FootFinder::Find(const Vector3 & place, std::span<const PointPair> pairs, std::vector<Foot> & feet) const
{
  feet.clear();
  for (const PointPair & pair : pairs)
  {
    const double width = 0.45 * Distance(Place(pair[0]), Place(pair[1]));
    feet.push_back({ pair[0], {}, width });
    feet.push_back({ pair[1], {}, width });
  }
  KeepOneOfEach(feet);
  for (Foot & foot : feet)
  {
    foot.position = Slide(place, foot.point, foot.distance);
    foot.distance = Distance(place, foot.position);
  }
}

void
FootFinder::Settle(const Vector3 & place, std::span<const PointPair> pairs, std::vector<Foot> & feet) const
{
  feet.clear();
  for (const PointPair & pair : pairs)
  {
    feet.push_back({ pair[0], {}, 0 });
    feet.push_back({ pair[1], {}, 0 });
  }
  KeepOneOfEach(feet);
  for (Foot & foot : feet)
  {
    foot.position = Descend(place, foot.point);
    foot.distance = Distance(place, foot.position);
  }
}

// Strides that are not shorter than the ripples and facets of an estimate, which would hold the foot up. However little the
// surface falls, it goes on: nearly opposite the nearest point, or from a place near the axis of a tube, it falls little.
Vector3
FootFinder::Descend(const Vector3 & place, std::uint32_t point) const
{
  constexpr int    steps = 60;
  constexpr double shortest = 0.1; // voxels
  double           stride = 0.5;
  SurfacePoint     foot = m_Anchors[point];
  if (!foot.found)
  {
    return Place(point);
  }
  double distance = Distance(place, foot.position);
  for (int step = 0; step < steps && stride >= shortest; ++step)
  {
    const Vector3 gap = Minus(place, foot.position);
    const Vector3 slide = Along(gap, -Dot(gap, foot.normal), foot.normal);
    const double  length = Length(slide);
    if (!(length > 0))
    {
      break;
    }
    const SurfacePoint next = m_Input.surface->Project(Along(foot.position, stride * m_Voxel / length, slide), m_Voxel);
    const double       nearer = next.found ? Distance(place, next.position) : distance;
    if (nearer >= distance || std::abs(Dot(next.normal, foot.normal)) < kTurn)
    {
      stride *= 0.5;
      continue;
    }
    foot = next;
    distance = nearer;
    stride = std::min(kLongestStride, 2 * stride);
  }
  return foot.position;
}

// From where the surface passes the boundary vertex downhill to where a ball about `place` touches it.
Vector3
FootFinder::Slide(const Vector3 & place, std::uint32_t point, double most) const
{
  constexpr int steps = 8;
  const Vector3 home = Place(point);
  SurfacePoint  foot = m_Anchors[point];
  if (!foot.found)
  {
    return home;
  }
  const double radius = Distance(place, home);
  const double reach = std::min(most, 1.5 * std::sqrt(2 * radius * m_Voxel) + 2 * m_Voxel);
  double       distance = Distance(place, foot.position);
  for (int step = 0; step < steps; ++step)
  {
    const Vector3 gap = Minus(place, foot.position);
    const Vector3 slide = Along(gap, -Dot(gap, foot.normal), foot.normal);
    const double  length = Length(slide);
    if (length < kClose * m_Voxel)
    {
      break;
    }
    const double       part = std::min(1.0, kLongestStride * m_Voxel / length);
    const SurfacePoint next = m_Input.surface->Project(Along(foot.position, part, slide), m_Voxel);
    if (!next.found || std::abs(Dot(next.normal, foot.normal)) < kTurn || Distance(next.position, home) > reach)
    {
      break;
    }
    const double closer = Distance(place, next.position);
    if (closer >= distance)
    {
      break;
    }
    foot = next;
    distance = closer;
  }
  return foot.position;
}

} // namespace voxelcore
