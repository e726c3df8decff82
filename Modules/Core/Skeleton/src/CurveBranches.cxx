#include "CurveBranches.h"

#include "EndSearch.h"

#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
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
    const auto standsOutOfAll = [&](const Vector3 & place, double radius, double least) {
      return std::ranges::none_of(fire.order, [&](ElementIndex vertex) {
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
