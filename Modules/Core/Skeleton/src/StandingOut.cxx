#include "StandingOut.h"

#include "voxelcore/VoxelCore/BallTree.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Skeleton/DomeBranches.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{

namespace
{

// From a place on, the balls into a corner of 60 degrees become smaller by half of the way. Fire along the way into it
// falls behind that on the surface by as much, which is where ends of branches begin (kRunsAlongTheMiddle).
constexpr double kWayIntoCorner = 2;

// Radii of one wall differ by about so many voxels.
constexpr double kGreater = 0.5;

} // namespace

StandingOut::StandingOut(const MedialComplex &             surface,
                         const CurveFire &                 fire,
                         const std::vector<double> &       surfaceTime,
                         const std::vector<std::uint8_t> & stays,
                         const BranchScale &               scale,
                         double                            standOut)
  : m_Surface(surface)
  , m_SurfaceTime(surfaceTime)
  , m_StandOut(standOut)
  , m_Noise(kGreater * scale.voxel)
{
  // Nearly every ball is held by the place to which its fire led.
  constexpr ElementIndex    none = std::numeric_limits<ElementIndex>::max();
  std::vector<ElementIndex> nearest(surface.cells.vertexCount, none);
  std::vector<ElementIndex> places;
  const auto                stay = [&](ElementIndex vertex) {
    nearest[vertex] = vertex;
    places.push_back(vertex);
  };
  for (ElementIndex vertex = 0; vertex < nearest.size(); ++vertex)
  {
    if (stays[vertex] != 0)
    {
      stay(vertex);
    }
  }
  for (auto vertex = fire.order.rbegin(); vertex != fire.order.rend(); ++vertex)
  {
    const ElementIndex edge = fire.nextEdge[*vertex];
    if (nearest[*vertex] == none)
    {
      if (edge == kNoEdge)
      {
        stay(*vertex);
      }
      else
      {
        nearest[*vertex] = nearest[Across(surface.cells, edge, *vertex)];
      }
    }
  }
  std::vector<ElementIndex> doubtful;
  std::vector<ElementIndex> domes;
  for (const ElementIndex vertex : fire.order)
  {
    const ElementIndex place = nearest[vertex];
    if (!Holds(place, vertex))
    {
      doubtful.push_back(vertex);
    }
    if (IsGreater(vertex, place) && !HoldsDome(place, vertex) && Beyond(place, vertex) > m_Noise)
    {
      domes.push_back(vertex);
    }
  }
  if (doubtful.empty() && domes.empty())
  {
    return;
  }
  std::vector<Vector3> centres;
  std::vector<double>  radii;
  std::vector<double>  reach;
  std::vector<double>  corner;
  for (const ElementIndex place : places)
  {
    centres.push_back(surface.positions[place]);
    radii.push_back(surface.radius[place]);
    reach.push_back(Reach(place));
    corner.push_back(kWayIntoCorner * reach.back());
  }
  const SpacingWeights inMm = ComputeSpacingWeights({ 1, 1, 1 });
  const BallTree       reaches(centres, reach, inMm);
  const BallTree       corners(centres, corner, inMm);
  for (const ElementIndex vertex : doubtful)
  {
    const Vector3 & place = surface.positions[vertex];
    const double    radius = surface.radius[vertex];
    const double    beyond = corners.Gap(place) + kWayIntoCorner * radius;
    if (beyond > 0 && reaches.Gap(place) + radius > standOut)
    {
      m_Out.push_back({ vertex, false, beyond });
    }
  }
  const BallTree balls(centres, radii, inMm);
  ranges::sort(places, ranges::greater(), [&](ElementIndex place) { return surface.radius[place]; });
  for (const ElementIndex vertex : domes)
  {
    const Vector3 & middle = surface.positions[vertex];
    const double    radius = surface.radius[vertex];
    const auto      begin = places.begin();
    const auto smaller = ranges::partition_point(places, [&](ElementIndex place) { return !IsGreater(vertex, place); });
    if (reaches.Gap(middle) + radius > m_Noise &&
        balls.Gap(middle) + radius > std::max(standOut, kDomeOfRadius * radius) &&
        std::none_of(begin, smaller, [&](ElementIndex place) { return HoldsDome(place, vertex); }))
    {
      m_Out.push_back({ vertex, true, corners.Gap(middle) + kWayIntoCorner * radius });
    }
  }
}

std::optional<ElementIndex>
StandingOut::Worst() const
{
  if (m_Out.empty())
  {
    return std::nullopt;
  }
  return ranges::max_element(m_Out, {}, &Ball::beyondCorner)->vertex;
}

void
StandingOut::Add(const std::vector<ElementIndex> & places)
{
  std::vector<Ball> still;
  for (Ball ball : m_Out)
  {
    if (ranges::any_of(places, [&](ElementIndex place) {
          return ball.isDome ? HoldsDome(place, ball.vertex) : Holds(place, ball.vertex);
        }))
    {
      continue;
    }
    for (const ElementIndex place : places)
    {
      ball.beyondCorner = std::min(ball.beyondCorner, Beyond(place, ball.vertex, kWayIntoCorner));
    }
    still.push_back(ball);
  }
  m_Out = std::move(still);
}

double
StandingOut::Reach(ElementIndex vertex) const
{
  return std::isfinite(m_SurfaceTime[vertex]) ? m_SurfaceTime[vertex] : m_Surface.radius[vertex];
}

double
StandingOut::Beyond(ElementIndex place, ElementIndex ball, double weight) const
{
  return Distance(m_Surface.positions[place], m_Surface.positions[ball]) +
         weight * (m_Surface.radius[ball] - Reach(place));
}

bool
StandingOut::Holds(ElementIndex place, ElementIndex ball) const
{
  return Beyond(place, ball) <= m_StandOut || Beyond(place, ball, kWayIntoCorner) <= 0;
}

bool
StandingOut::IsGreater(ElementIndex ball, ElementIndex place) const
{
  return m_Surface.radius[ball] > m_Surface.radius[place] + m_Noise;
}

bool
StandingOut::HoldsDome(ElementIndex place, ElementIndex ball) const
{
  const double radius = m_Surface.radius[ball];
  const double way = Distance(m_Surface.positions[place], m_Surface.positions[ball]);
  return (way <= kDomeGoesOn * radius && !IsGreater(ball, place)) ||
         way + radius - m_Surface.radius[place] <= std::max(m_StandOut, kDomeOfRadius * radius);
}

} // namespace voxelcore
