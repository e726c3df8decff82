#include "UnitVector.h"

#include "voxelcore/RootHierarchy.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

constexpr double kLeastInto = 0.5;     // cos(60 degrees)
constexpr double kLeastOnward = 0.707; // cos(45 degrees)
constexpr double kLeastLikeness = 0.5;
constexpr double kAlong = 4; // radii over which a tip's direction is taken

struct TornEnd
{
  ElementIndex point = 0;
  ElementIndex branch = 0;
  double       radius = 0; ///< mean of the branch there
  Vector3      way{};      ///< out of the branch
};

TornEnd
EndAt(const SkeletonGraph & graph, ElementIndex branch, bool isLast)
{
  const auto   line = graph.Branch(branch);
  const auto & radii = SectionRadii(graph);
  const auto   at = [&](std::size_t i) { return isLast ? line[line.size() - 1 - i] : line[i]; };
  TornEnd      end{ at(0), branch, radii[at(0)], {} };
  double       along = 0;
  std::size_t  i = 0;
  for (double sum = radii[at(0)]; i + 1 < line.size() && along < kAlong * end.radius;)
  {
    ++i;
    along += Distance(graph.positions[at(i - 1)], graph.positions[at(i)]);
    sum += radii[at(i)];
    end.radius = sum / static_cast<double>(i + 1);
  }
  const Vector3 & tip = graph.positions[end.point];
  const Vector3 & inside = graph.positions[at(i)];
  end.way = Unit({ tip[0] - inside[0], tip[1] - inside[1], tip[2] - inside[2] });
  return end;
}

} // namespace

std::vector<double>
JoinTornRoots(SkeletonGraph & graph, const RootRules & rules)
{
  std::vector<TornEnd> ends;
  for (ElementIndex branch = 0; branch < graph.BranchCount(); ++branch)
  {
    for (const bool isLast : { false, true })
    {
      if (graph.nodeKinds[graph.branchNodes[branch][isLast ? 1 : 0]] == NodeKind::Tip)
      {
        ends.push_back(EndAt(graph, branch, isLast));
      }
    }
  }
  struct Gap
  {
    double      length = 0;
    std::size_t a = 0;
    std::size_t b = 0;
  };
  std::vector<Gap> gaps;
  for (std::size_t a = 0; a < ends.size(); ++a)
  {
    for (std::size_t b = 0; b < a; ++b)
    {
      const TornEnd & one = ends[a];
      const TornEnd & other = ends[b];
      const Vector3 & from = graph.positions[one.point];
      const Vector3 & to = graph.positions[other.point];
      const double    gap = Distance(from, to);
      const auto [thin, thick] = std::minmax(one.radius, other.radius);
      const double longest = rules.tornGap > 0 ? rules.tornGap * (thin + thick) + rules.tornSlack : 0;
      if (one.branch == other.branch || gap > longest || thin < kLeastLikeness * thick)
      {
        continue;
      }
      const Vector3 across = Unit({ to[0] - from[0], to[1] - from[1], to[2] - from[2] });
      const bool    isInto = Dot(one.way, across) >= kLeastInto && -Dot(other.way, across) >= kLeastInto;
      if ((isInto || gap <= thin) && -Dot(one.way, other.way) >= kLeastOnward)
      {
        gaps.push_back({ gap, a, b });
      }
    }
  }
  std::ranges::stable_sort(gaps, {}, &Gap::length);
  std::vector<char>                      isUsed(ends.size(), 0);
  std::vector<double>                    result;
  std::vector<std::vector<ElementIndex>> lines;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    lines.emplace_back(graph.Branch(branch).begin(), graph.Branch(branch).end());
  }
  for (const Gap & gap : gaps)
  {
    if (isUsed[gap.a] == 0 && isUsed[gap.b] == 0)
    {
      isUsed[gap.a] = isUsed[gap.b] = 1;
      lines.push_back({ ends[gap.a].point, ends[gap.b].point });
      result.push_back(gap.length);
    }
  }
  if (!result.empty())
  {
    SortBranches(graph, lines, true);
  }
  return result;
}

} // namespace voxelcore
