#include "EndSearch.h"

#include "voxelcore/Skeleton/DomeBranches.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

// Where the curve runs along the middle of the surface, fire along it falls behind as fast as it goes; into a corner of
// the surface of 90 degrees by 0.29 of the way, into a corner of a box by 0.42 of it.
constexpr double kRunsAlongTheMiddle = 0.5;

// A thin branch on a thick body is short beside the edges within the body, and ways of a few voxels are too short for
// times to tell it from a corner. There the radius does: into a corner of 90 degrees it grows by 0.71 of the way, into
// that of a box by 0.58.
constexpr double kThinWindow = 6;
constexpr double kThinGrowth = 0.3;

// Ridges in the webs of forks are narrower where they leave than where they end. Of a short branch the radius falls
// from its end on by so much of the way, at most.
constexpr double kBulge = 0.1;

// A thin tube that ends a little behind where another leaves it is as wide at its tip as at its foot, over a way too
// short for the rules above. Thicker ones are not told so: in the webs of forks are ridges as even as they.
constexpr double kTubeRadius = 2;
constexpr double kTubeWindow = 3;
constexpr double kTubeGrowth = 0.15;

// A shorter way will do where the line of voxels is longer, from face to face, than those that noise makes, and the
// body behind is no thicker: a bump on a thicker one is as thin as the thinnest tube.
constexpr double kTubeLine = 3.25;
constexpr double kTubeBody = 1.16;
constexpr double kTubeBehind = 6; ///< voxels over which the body behind is looked at

// A thicker tube may end a little behind where a branch leaves it, too. Its last ball stands out of every other ball by
// so much of its radius; balls in the webs of forks do not. It is as wide at its tip as at its foot, and it is round:
// its surface burns soon after its balls, which that of a plate does not on the way into a corner.
constexpr double kEndOfRadius = 1.5;
constexpr double kEndRoundness = 0.8;
constexpr double kEndOfWay = 0.7; ///< up to here: the surface between two tubes is no part of the one

// Balls in a voxel shape end at the nearest corner, its caps do not. A curve that begins in a corner has so much
// further to go than its radius grows; one that begins with the ball it keeps, when that is as thin as a line of
// voxels, half of it; a thick one begins in the centre. Measured on tubes and tapering roots at all angles; voxels.
constexpr double kCornerBeyondBall = 1.25;
constexpr double kLineBeyondBall = 0.6;

} // namespace

template <typename Holds>
bool
EndSearch::FindFrom(double window, const Holds & holds)
{
  for (std::size_t start = 0; start + 1 < m_Path.size(); ++start)
  {
    std::size_t end = start;
    while (Way(start, end) < window && GoesOn(end))
    {
      ++end;
    }
    const double way = Way(start, end);
    const bool   isShort =
      Way(0, end) < 3 * window && FallsBehind(start, end) >= kRunsAlongTheMiddle * window && !IsBulge(start, end);
    if ((way >= window || (2 * way >= window && isShort)) && holds(start, end))
    {
      EndAt(CapCentre(start, window));
      return true;
    }
  }
  return false;
}

bool
EndSearch::Run()
{
  return FindFrom(m_Scale.window, [this](std::size_t start, std::size_t end) { return RunsAlong(start, end); }) ||
         FindFrom(std::min(m_Scale.window, kThinWindow * m_Scale.voxel), [this](std::size_t start, std::size_t end) {
           return RunsAlong(start, end) && Growth(start, end) <= kThinGrowth * Way(start, end) && !IsBulge(start, end);
         });
}

bool
EndSearch::RunAsTube()
{
  const std::size_t end = Last();
  double            voxels = 0;
  for (std::size_t at = 0; at < end; ++at)
  {
    voxels += Way(at, at + 1) / m_Scale.voxel;
  }
  const double way = Way(0, end);
  const double radius = m_Surface.radius[m_Path[end]];
  const bool   isThin = radius <= kTubeRadius * m_Scale.voxel;
  const bool   isLong =
    way >= kTubeWindow * m_Scale.voxel || (voxels >= kTubeLine && RadiusBehind() <= kTubeBody * radius);
  if (!isThin || !isLong || !RunsAlong(0, end) || std::abs(Growth(0, end)) > kTubeGrowth * way)
  {
    return false;
  }
  EndAt(CapCentre(0, kTubeWindow * m_Scale.voxel));
  return true;
}

bool
EndSearch::RunAsEnd(double standOut, const StandsOut & standsOut)
{
  const std::size_t end = Last();
  const auto        cap = CapCentre(0, kTubeWindow * m_Scale.voxel);
  const std::size_t first = cap.vertex + (cap.part > 0 ? 1 : 0);
  if (first >= end)
  {
    return false;
  }
  const double radius = m_Surface.radius[m_Path[first]];
  const double least = std::max(standOut, kEndOfRadius * radius);
  const double way = Way(first, end);
  if (way < least || std::abs(Growth(first, end)) > kTubeGrowth * way || !IsRound(first, end) ||
      !standsOut(m_Surface.positions[m_Path[first]], radius, least))
  {
    return false;
  }
  EndAt(cap);
  return true;
}

bool
EndSearch::RunAsDome(double standOut, const StandsOut & standsOut)
{
  std::size_t       greatest = 0;
  const std::size_t end = Last();
  for (std::size_t at = 0; at <= end; ++at)
  {
    if (m_Surface.radius[m_Path[at]] >= m_Surface.radius[m_Path[greatest]])
    {
      greatest = at;
    }
  }
  const double radius = m_Surface.radius[m_Path[greatest]];
  const double foot = m_Surface.radius[m_Path.back()];
  const double least = std::max(standOut, kDomeOfRadius * radius);
  if (radius <= foot || Way(greatest, m_Path.size() - 1) + radius - foot < least ||
      !standsOut(m_Surface.positions[m_Path[greatest]], radius, least))
  {
    return false;
  }
  EndAt({ greatest, 0 });
  return true;
}

void
EndSearch::EndAt(const PlaceOnPath & place)
{
  m_Branch.end = place.vertex;
  m_Branch.part = place.part;
}

double
EndSearch::Way(std::size_t from, std::size_t to) const
{
  return Distance(m_Surface.positions[m_Path[from]], m_Surface.positions[m_Path[to]]);
}

double
EndSearch::Growth(std::size_t from, std::size_t to) const
{
  return m_Surface.radius[m_Path[to]] - m_Surface.radius[m_Path[from]];
}

double
EndSearch::RadiusBehind() const
{
  double greatest = 0;
  for (ElementIndex at = m_Path.back();
       Distance(m_Surface.positions[at], m_Surface.positions[m_Path.back()]) <= kTubeBehind * m_Scale.voxel;
       at = Across(m_Surface.cells, m_Fire.nextEdge[at], at))
  {
    greatest = std::max(greatest, m_Surface.radius[at]);
    if (m_Fire.nextEdge[at] == kNoEdge)
    {
      break;
    }
  }
  return greatest;
}

bool
EndSearch::IsRound(std::size_t from, std::size_t to) const
{
  const double way = Way(from, to);
  for (std::size_t at = from; at < to && Way(from, at) <= kEndOfWay * way; ++at)
  {
    const double radius = m_Surface.radius[m_Path[at]];
    if (m_SurfaceTime[m_Path[at]] - radius > kEndRoundness * radius)
    {
      return false;
    }
  }
  return true;
}

bool
EndSearch::IsBulge(std::size_t from, std::size_t to) const
{
  return Growth(from, to) < -kBulge * Way(from, to);
}

double
EndSearch::FallsBehind(std::size_t start, std::size_t end) const
{
  const auto late = [&](std::size_t at) { return m_Fire.time[m_Path[at]] - m_SurfaceTime[m_Path[at]]; };
  return late(end) - late(start);
}

bool
EndSearch::RunsAlong(std::size_t start, std::size_t end) const
{
  return FallsBehind(start, end) >= kRunsAlongTheMiddle * Way(start, end);
}

std::size_t
EndSearch::Last() const
{
  std::size_t end = 0;
  while (GoesOn(end))
  {
    ++end;
  }
  return end;
}

bool
EndSearch::GoesOn(std::size_t at) const
{
  return at + 1 < m_Path.size() && m_Fire.winner[m_Path[at + 1]] == m_Fire.nextEdge[m_Path[at]];
}

EndSearch::PlaceOnPath
EndSearch::CapCentre(std::size_t start, double window) const
{
  double      before = Excess(start, window);
  std::size_t at = start;
  for (; before < 0 && at + 2 < m_Path.size(); ++at)
  {
    const double after = Excess(at + 1, window);
    if (after >= 0)
    {
      return { at, before / (before - after) };
    }
    before = after;
  }
  return { at, 0 };
}

double
EndSearch::Excess(std::size_t from, double window) const
{
  double      sum = 0;
  std::size_t at = from;
  for (; at < m_Path.size() && Way(from, at) <= window; ++at)
  {
    sum += m_Surface.radius[m_Path[at]];
  }
  const double first = m_Surface.radius[m_Path[0]];
  const double grown = sum / static_cast<double>(at - from) - first;
  const double beyond = grown > 0.1 * m_Scale.voxel ? kCornerBeyondBall
                        : first < 2 * m_Scale.voxel ? kLineBeyondBall
                                                    : 0;
  return Way(0, from) - grown - beyond * m_Scale.voxel;
}

} // namespace voxelcore
