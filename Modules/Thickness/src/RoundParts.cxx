#include "RoundParts.h"

#include "voxelcore/ParallelTasks.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace voxelcore
{

std::vector<std::uint8_t>
FindBends(const CellComplex & cells)
{
  std::vector<std::uint8_t> bends(cells.vertexCount, 2);
  for (const auto & ends : cells.edges)
  {
    bends[ends[0]] = 1;
    bends[ends[1]] = 1;
  }
  for (const ElementIndex corner : cells.faceVertices)
  {
    bends[corner] = 0;
  }
  return bends;
}

namespace
{

/** Vertices next to each other along edges with an end on a line. */
using Ways = std::map<ElementIndex, std::vector<ElementIndex>>;

Ways
WaysAlongLines(const CellComplex & cells, const std::vector<std::uint8_t> & bends)
{
  Ways next;
  for (const auto & [one, other] : cells.edges)
  {
    if (bends[one] == 1 || bends[other] == 1)
    {
      next[one].push_back(other);
      next[other].push_back(one);
    }
  }
  return next;
}

class RoundFitter
{
public:
  RoundFitter(const CellComplex &               cells,
              const std::vector<std::uint8_t> & bends,
              const std::vector<Vector3> &      places,
              const std::vector<double> &       radii,
              const RoundParts &                sums,
              const RoundLimits &               limits)
    : m_Bends(bends)
    , m_Next(WaysAlongLines(cells, bends))
    , m_Places(places)
    , m_Radii(radii)
    , m_Sums(sums)
    , m_Limits(limits)
  {}

  RoundRadius
  At(ElementIndex vertex) const
  {
    switch (m_Bends[vertex])
    {
      case 0:
        return { m_Radii[vertex] };
      case 1:
        return OnLine(vertex);
      default:
        return OfPoint(vertex);
    }
  }

private:
  RoundRadius
  OfPoint(ElementIndex vertex) const
  {
    RoundRadius found{ m_Radii[vertex] };
    const auto  sums = m_Sums.find(vertex);
    if (sums != m_Sums.end() && sums->second.angle > 0 && sums->second.holds > 0)
    {
      found.after = std::cbrt(sums->second.holds / sums->second.angle);
      found.part = 1;
    }
    return found;
  }

  RoundRadius
  OnLine(ElementIndex vertex) const
  {
    const double own = m_Radii[vertex];
    RoundSums    about;
    double       balls = 0; // what they have where the voxels have `about.holds`
    double       toSheet = HUGE_VAL;
    double       ofSheet = 0; // radius where the line begins
    VisitAlong(vertex, [&](ElementIndex other, double way) {
      if (m_Bends[other] == 0)
      {
        ofSheet = way < toSheet ? m_Radii[other] : ofSheet;
        toSheet = std::min(toSheet, way);
        return;
      }
      const auto sums = m_Sums.find(other);
      if (sums != m_Sums.end() && std::abs(m_Radii[other] - own) <= m_Limits.noise)
      {
        const double left = 1 - way * way / (m_Limits.reach * m_Limits.reach);
        about.Add(sums->second, left * left);
        balls += left * left * sums->second.angle * m_Radii[other] * m_Radii[other];
      }
    });
    RoundRadius found;
    found.before = ofSheet + std::clamp(2 * toSheet / own - 1, 0.0, 1.0) * (own - ofSheet);
    if (about.angle > 0 && about.holds > 0 && balls > 0)
    {
      const double radius = std::sqrt(about.holds / about.angle);
      const double local = std::clamp(radius / m_Limits.longest - 1, 0.0, 1.0);
      found.after = radius + local * (own - std::sqrt(balls / about.angle));
      found.part = std::clamp(toSheet / radius - 1, 0.0, 1.0);
    }
    return found;
  }

  /** Calls visit(vertex, way) for what lies along lines, nearest first, and for what they begin at on sheets. */
  template <typename TVisit>
  void
  VisitAlong(ElementIndex from, TVisit visit) const
  {
    std::set<ElementIndex>                    done;
    std::set<std::pair<double, ElementIndex>> open{ { 0, from } };
    while (!open.empty())
    {
      const auto [way, vertex] = *open.begin();
      open.erase(open.begin());
      if (!done.insert(vertex).second)
      {
        continue;
      }
      visit(vertex, way);
      const auto next = m_Next.find(vertex);
      if (next == m_Next.end() || m_Bends[vertex] == 0)
      {
        continue;
      }
      for (const ElementIndex other : next->second)
      {
        const double there = way + Distance(m_Places[vertex], m_Places[other]);
        if (there < m_Limits.reach && done.count(other) == 0)
        {
          open.emplace(there, other);
        }
      }
    }
  }

  const std::vector<std::uint8_t> & m_Bends;
  Ways                              m_Next;
  const std::vector<Vector3> &      m_Places;
  const std::vector<double> &       m_Radii;
  const RoundParts &                m_Sums;
  const RoundLimits &               m_Limits;
};

} // namespace

std::vector<RoundRadius>
RoundRadii(const CellComplex &               cells,
           const std::vector<std::uint8_t> & bends,
           const std::vector<Vector3> &      places,
           const std::vector<double> &       radii,
           const RoundParts &                sums,
           const RoundLimits &               limits)
{
  const RoundFitter        fitter(cells, bends, places, radii, sums, limits);
  std::vector<RoundRadius> found(radii.size());
  RunInParts(found.size() > 1000, found.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t vertex = first; vertex < last; ++vertex)
    {
      found[vertex] = fitter.At(static_cast<ElementIndex>(vertex));
    }
  });
  return found;
}

} // namespace voxelcore
