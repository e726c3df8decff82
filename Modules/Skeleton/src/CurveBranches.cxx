#include "CurveBranches.h"

#include "voxelcore/Vectors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

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
// short for the rules above. It stands out of a body of its own width, so it needs a part of what others need. Thicker
// ones are not told so: in the webs of forks are ridges as even as they.
constexpr double kTubeRadius = 2;
constexpr double kTubeWindow = 3;
constexpr double kTubeGrowth = 0.15;
constexpr double kTubeStandOut = 0.6;

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

ElementIndex
Across(const CellComplex & cells, ElementIndex edge, ElementIndex vertex)
{
  return cells.edges[edge][0] ^ cells.edges[edge][1] ^ vertex;
}

/** Looks for the end of the body along the path of a branch. */
class EndSearch
{
public:
  EndSearch(const MedialComplex &       surface,
            const CurveFire &           fire,
            const std::vector<double> & surfaceTime,
            const BranchScale &         scale,
            CurveBranch &               branch)
    : m_Surface(surface)
    , m_Fire(fire)
    , m_SurfaceTime(surfaceTime)
    , m_Scale(scale)
    , m_Branch(branch)
    , m_Path(branch.path)
  {}

  /** False when the curve nowhere runs along the middle of the surface: it is the way into a corner. */
  bool
  Run()
  {
    return FindFrom(m_Scale.window, [this](std::size_t start, std::size_t end) { return RunsAlong(start, end); }) ||
           FindFrom(std::min(m_Scale.window, kThinWindow * m_Scale.voxel), [this](std::size_t start, std::size_t end) {
             return RunsAlong(start, end) && Growth(start, end) <= kThinGrowth * Way(start, end) &&
                    !IsBulge(start, end);
           });
  }

  /** Whether the curve is the axis of a tube all along; false for one that joins another sooner than the window. */
  bool
  RunAsTube()
  {
    std::size_t end = 0;
    double      voxels = 0;
    while (GoesOn(end))
    {
      voxels += Way(end, end + 1) / m_Scale.voxel;
      ++end;
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
    CapCentre(0, kTubeWindow * m_Scale.voxel);
    return true;
  }

  /** Whether the curve is the axis of a round tube whose last ball stands out of all others by `standOut`:
   *  standsOut(place, radius) says by how much it does. */
  template <typename StandsOut>
  bool
  RunAsEnd(double standOut, const StandsOut & standsOut)
  {
    std::size_t end = 0;
    while (GoesOn(end))
    {
      ++end;
    }
    CapCentre(0, kTubeWindow * m_Scale.voxel);
    const std::size_t first = m_Branch.end + (m_Branch.part > 0 ? 1 : 0);
    if (first >= end)
    {
      return false;
    }
    const double radius = m_Surface.radius[m_Path[first]];
    const double least = std::max(standOut, kEndOfRadius * radius);
    const double way = Way(first, end);
    return way >= least && std::abs(Growth(first, end)) <= kTubeGrowth * way && IsRound(first, end) &&
           standsOut(m_Surface.positions[m_Path[first]], radius) >= least;
  }

private:
  double
  Way(std::size_t from, std::size_t to) const
  {
    return Distance(m_Surface.positions[m_Path[from]], m_Surface.positions[m_Path[to]]);
  }

  double
  Growth(std::size_t from, std::size_t to) const
  {
    return m_Surface.radius[m_Path[to]] - m_Surface.radius[m_Path[from]];
  }

  /** The greatest radius where the fire goes on from the path's last place. */
  double
  RadiusBehind() const
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
  IsRound(std::size_t from, std::size_t to) const
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
  IsBulge(std::size_t from, std::size_t to) const
  {
    return Growth(from, to) < -kBulge * Way(from, to);
  }

  double
  FallsBehind(std::size_t start, std::size_t end) const
  {
    const auto late = [&](std::size_t at) { return m_Fire.time[m_Path[at]] - m_SurfaceTime[m_Path[at]]; };
    return late(end) - late(start);
  }

  bool
  RunsAlong(std::size_t start, std::size_t end) const
  {
    return FallsBehind(start, end) >= kRunsAlongTheMiddle * Way(start, end);
  }

  /** From the first window on of which that holds. Short branches may end within one, where fire falls behind as far as
   *  it must over a whole one: in the middle of a plate times of the surface end, too. */
  template <typename Holds>
  bool
  FindFrom(double window, const Holds & holds)
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
        CapCentre(start, window);
        return true;
      }
    }
    return false;
  }

  // Where the fire of another branch took over, the ways before and after cannot be compared.
  bool
  GoesOn(std::size_t at) const
  {
    return at + 1 < m_Path.size() && m_Fire.winner[m_Path[at + 1]] == m_Fire.nextEdge[m_Path[at]];
  }

  /** The first place on the path, from `start` on, that is as far from the path's end as the radius has grown since:
   *  there, whatever way the end lies, is the centre of the ball that closes a tube. The radius is a mean over
   *  `window`. */
  void
  CapCentre(std::size_t start, double window)
  {
    m_Branch.end = start;
    m_Branch.part = 0;
    double before = Excess(start, window);
    if (before >= 0)
    {
      return;
    }
    for (std::size_t at = start; at + 2 < m_Path.size(); ++at)
    {
      const double after = Excess(at + 1, window);
      if (after >= 0)
      {
        m_Branch.end = at;
        m_Branch.part = before / (before - after);
        return;
      }
      before = after;
      m_Branch.end = at + 1;
    }
  }

  /** How much further from the end a point lies than it must. */
  double
  Excess(std::size_t from, double window) const
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

  const MedialComplex &             m_Surface;
  const CurveFire &                 m_Fire;
  const std::vector<double> &       m_SurfaceTime;
  const BranchScale                 m_Scale;
  CurveBranch &                     m_Branch;
  const std::vector<ElementIndex> & m_Path;
};

/** What a branch is before its end is looked for. */
struct Candidate
{
  ElementIndex tip = 0;
  ElementIndex parent = kNoEdge; ///< the branch it lost to
  double       standOut = 0;     ///< mm: the most by which its fire fell behind the surface's
  bool         isAxis = false;   ///< goes on to where fire ended
  bool         isStanding = false;
};

/** The branches in the order of their ends' fire, and per vertex its branch; kNoEdge where fire never came. */
std::vector<Candidate>
FindBranches(const CellComplex & cells, const CurveFire & fire, std::vector<ElementIndex> & branchOf)
{
  std::vector<Candidate> all;
  branchOf.assign(cells.vertexCount, kNoEdge);
  for (const ElementIndex vertex : fire.order)
  {
    const ElementIndex before = fire.winner[vertex];
    if (before == kNoEdge)
    {
      branchOf[vertex] = static_cast<ElementIndex>(all.size());
      all.push_back({ vertex });
    }
    else
    {
      branchOf[vertex] = branchOf[Across(cells, before, vertex)];
    }
  }
  for (const ElementIndex vertex : fire.order)
  {
    Candidate &        branch = all[branchOf[vertex]];
    const ElementIndex edge = fire.nextEdge[vertex];
    if (edge == kNoEdge)
    {
      branch.standOut = fire.prominence[vertex];
      branch.isAxis = true;
      continue;
    }
    const ElementIndex next = Across(cells, edge, vertex);
    if (branchOf[next] == kNoEdge)
    {
      branch.standOut = fire.prominence[vertex]; // on a cycle or a face that stays
    }
    else if (fire.winner[next] != edge)
    {
      branch.isAxis = fire.nextEdge[next] == kNoEdge && fire.runnerUp[next] == edge;
      branch.standOut = fire.prominence[branch.isAxis ? next : vertex];
      branch.parent = branch.isAxis ? kNoEdge : branchOf[next];
    }
  }
  return all;
}

} // namespace

std::vector<CurveBranch>
StandingBranches(const MedialComplex &       surface,
                 const CurveFire &           fire,
                 const std::vector<double> & surfaceTime,
                 const BranchScale &         scale,
                 double                      standOut)
{
  std::vector<ElementIndex> branchOf;
  std::vector<Candidate>    all = FindBranches(surface.cells, fire, branchOf);
  std::vector<CurveBranch>  branches;
  std::vector<ElementIndex> numbers; // of these
  for (ElementIndex number = 0; number < all.size(); ++number)
  {
    Candidate & candidate = all[number];
    if (candidate.standOut < kTubeStandOut * standOut)
    {
      continue;
    }
    CurveBranch branch;
    branch.path.push_back(candidate.tip);
    while (fire.nextEdge[branch.path.back()] != kNoEdge && branchOf[branch.path.back()] == number)
    {
      branch.path.push_back(Across(surface.cells, fire.nextEdge[branch.path.back()], branch.path.back()));
    }
    EndSearch  search(surface, fire, surfaceTime, scale, branch);
    const bool standsOut = candidate.standOut >= standOut;
    const auto standsOutBy = [&](const Vector3 & place, double radius) {
      double least = std::numeric_limits<double>::infinity();
      for (const ElementIndex vertex : fire.order)
      {
        if (all[branchOf[vertex]].standOut > candidate.standOut)
        {
          least = std::min(least, Distance(place, surface.positions[vertex]) + radius - surface.radius[vertex]);
        }
      }
      return least;
    };
    const bool isFound = (standsOut && search.Run()) || search.RunAsTube() ||
                         (!candidate.isAxis && search.RunAsEnd(standOut, standsOutBy));
    if (!isFound)
    {
      branch.end = branch.path.size() - 1;
      branch.part = 0;
    }
    candidate.isStanding = isFound || (standsOut && candidate.isAxis);
    branches.push_back(std::move(branch));
    numbers.push_back(number);
  }
  for (const ElementIndex number : numbers)
  {
    if (all[number].isStanding)
    {
      for (ElementIndex at = all[number].parent; at != kNoEdge; at = all[at].parent)
      {
        all[at].isStanding = true;
      }
    }
  }
  std::vector<CurveBranch> standing;
  for (std::size_t i = 0; i < branches.size(); ++i)
  {
    if (all[numbers[i]].isStanding)
    {
      standing.push_back(std::move(branches[i]));
    }
  }
  return standing;
}

} // namespace voxelcore
