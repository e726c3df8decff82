#include "CurveBranches.h"

#include "EndSearch.h"
#include "StandingOut.h"

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

namespace voxelcore
{

namespace
{

// A thin tube stands out of a body of its own width, so it needs a part of what others need.
constexpr double kTubeStandOut = 0.6;

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

/** The way into a corner of 60 degrees or more is no part of a branch: it ends where the ball that holds its end lies,
 *  out of which that reaches by less than thin tubes must. */
void
EndBeforeCorner(const MedialComplex & surface, double standOut, CurveBranch & branch)
{
  const auto   at = [&](std::size_t i) -> const Vector3 & { return surface.positions[branch.path[i]]; };
  const auto   radius = [&](std::size_t i) { return surface.radius[branch.path[i]]; };
  const double end = radius(branch.end);
  std::size_t  greatest = branch.end;
  for (std::size_t i = branch.end + 1; i < branch.path.size(); ++i)
  {
    const double way = Distance(at(branch.end), at(i));
    if (radius(i) > radius(greatest) && way + 2 * (end - radius(i)) <= 0 &&
        way + end - radius(i) <= kTubeStandOut * standOut)
    {
      greatest = i;
    }
  }
  if (greatest != branch.end)
  {
    branch.end = greatest;
    branch.part = 0;
  }
}

/** From the tip on to where it lost or fire ended. */
std::vector<ElementIndex>
PathOf(ElementIndex                      number,
       const std::vector<Candidate> &    all,
       const CellComplex &               cells,
       const CurveFire &                 fire,
       const std::vector<ElementIndex> & branchOf)
{
  std::vector<ElementIndex> path{ all[number].tip };
  while (fire.nextEdge[path.back()] != kNoEdge && branchOf[path.back()] == number)
  {
    path.push_back(Across(cells, fire.nextEdge[path.back()], path.back()));
  }
  return path;
}

} // namespace

std::vector<CurveBranch>
StandingBranches(const MedialComplex &       surface,
                 const CurveFire &           fire,
                 const std::vector<double> & surfaceTime,
                 const BranchScale &         scale,
                 double                      standOut)
{
  std::vector<ElementIndex>           branchOf;
  std::vector<Candidate>              all = FindBranches(surface.cells, fire, branchOf);
  std::map<ElementIndex, CurveBranch> branches; // by number
  for (ElementIndex number = 0; number < all.size(); ++number)
  {
    Candidate & candidate = all[number];
    if (candidate.standOut < kTubeStandOut * standOut)
    {
      continue;
    }
    CurveBranch & branch = branches[number];
    branch.path = PathOf(number, all, surface.cells, fire, branchOf);
    EndSearch  search(surface, fire, surfaceTime, scale, branch);
    const bool standsOut = candidate.standOut >= standOut;
    const auto standsOutOfAll = [&](const Vector3 & place, double radius, double least) {
      return ranges::none_of(fire.order, [&](ElementIndex vertex) {
        return all[branchOf[vertex]].standOut > candidate.standOut &&
               Distance(place, surface.positions[vertex]) + radius - surface.radius[vertex] < least;
      });
    };
    const bool isFound = (standsOut && search.Run()) || search.RunAsTube() ||
                         (!candidate.isAxis && search.RunAsEnd(standOut, standsOutOfAll)) ||
                         (!candidate.isAxis && standsOut && search.RunAsDome(standOut, standsOutOfAll));
    if (!isFound)
    {
      branch.end = branch.path.size() - 1;
      branch.part = 0;
    }
    else
    {
      EndBeforeCorner(surface, standOut, branch);
    }
    candidate.isStanding = isFound || (standsOut && candidate.isAxis);
  }
  for (const auto & [number, branch] : branches)
  {
    if (all[number].isStanding)
    {
      for (ElementIndex at = all[number].parent; at != kNoEdge; at = all[at].parent)
      {
        all[at].isStanding = true;
      }
    }
  }
  std::erase_if(branches, [&](const auto & one) { return !all[one.first].isStanding; });

  // What of the core stands out of these has a branch, too, up to the ball that does so most.
  std::vector<std::uint8_t> stays(surface.cells.vertexCount, 1);
  for (const ElementIndex vertex : fire.order)
  {
    stays[vertex] = 0;
  }
  for (const auto & [number, branch] : branches)
  {
    for (std::size_t at = branch.end + (branch.part > 0 ? 1 : 0); at < branch.path.size(); ++at)
    {
      stays[branch.path[at]] = 1;
    }
  }
  StandingOut out(surface, fire, surfaceTime, stays, scale, standOut);
  while (const auto ball = out.Worst())
  {
    std::vector<ElementIndex> places;
    ElementIndex              from = *ball;
    for (ElementIndex number = branchOf[from]; number != kNoEdge; number = all[number].parent)
    {
      CurveBranch & branch = branches[number];
      if (branch.path.empty())
      {
        branch.path = PathOf(number, all, surface.cells, fire, branchOf);
        branch.end = branch.path.size() - 1;
      }
      const auto at = ranges::find(branch.path, from);
      places.insert(places.end(), at, branch.path.end());
      if (from == *ball)
      {
        branch.end = static_cast<std::size_t>(at - branch.path.begin());
        branch.part = 0;
      }
      from = branch.path.back();
    }
    out.Add(places);
  }
  std::vector<CurveBranch> standing;
  for (auto & [number, branch] : branches)
  {
    standing.push_back(std::move(branch));
  }
  return standing;
}

} // namespace voxelcore
