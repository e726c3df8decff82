#include "voxelcore/Skeleton/UnitVector.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Roots/RootHierarchy.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace voxelcore
{

namespace
{

constexpr double kLeastInto = 0.5;     // cos(60 degrees)
constexpr double kLeastOnward = 0.707; // cos(45 degrees)
constexpr double kLeastLikeness = 0.5;
constexpr double kTipReach = 4;    // radii over which a tip's direction is taken
constexpr double kSlicesAlong = 3; // at least

struct TornEnd
{
  ElementIndex point = 0;
  ElementIndex branch = 0;
  double       radius = 0; ///< mean of the branch there
  Vector3      way{};      ///< out of the branch
};

TornEnd
EndAt(const SkeletonGraph & graph, ElementIndex branch, bool isLast, double slice)
{
  const auto   line = graph.Branch(branch);
  const auto & radii = SectionRadii(graph);
  const auto   at = [&](std::size_t i) { return isLast ? line[line.size() - 1 - i] : line[i]; };
  TornEnd      end{ at(0), branch, radii[at(0)], {} };
  double       along = 0;
  std::size_t  i = 0;
  for (double sum = radii[at(0)];
       i + 1 < line.size() && along < std::max(kTipReach * end.radius, kSlicesAlong * slice);)
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

/** Where a tip runs into the side of a root. */
struct SideGap
{
  double      length = 0;
  std::size_t end = 0;
  std::size_t branch = 0;
  std::size_t at = 0; ///< of the branch's points
};

/** The point of another branch that a tip runs into, if the two bodies are not a slice apart. */
std::optional<SideGap>
SideBefore(const SkeletonGraph & graph, const TornEnd & end, double slice)
{
  const auto &           radii = SectionRadii(graph);
  const Vector3 &        from = graph.positions[end.point];
  std::optional<SideGap> best;
  const auto             shareNode = [&](ElementIndex a, ElementIndex b) {
    const auto & one = graph.branchNodes[a];
    const auto & other = graph.branchNodes[b];
    return ranges::any_of(one, [&](auto node) { return ranges::find(other, node) != other.end(); });
  };
  for (ElementIndex branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto points = graph.Branch(branch);
    // What a twig springs from is no other root.
    if (graph.nodeKinds[graph.branchNodes[branch][0]] == NodeKind::Loop || shareNode(branch, end.branch))
    {
      continue;
    }
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
    {
      const Vector3 & to = graph.positions[points[i]];
      const double    away = Distance(from, to);
      if (away > end.radius + radii[points[i]] + slice || (best && away >= best->length))
      {
        continue;
      }
      if (Dot(end.way, Unit({ to[0] - from[0], to[1] - from[1], to[2] - from[2] })) >= kLeastInto)
      {
        best = SideGap{ away, 0, branch, i };
      }
    }
  }
  return best;
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
        ends.push_back(EndAt(graph, branch, isLast, rules.tornSlack));
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
  ranges::stable_sort(gaps, {}, &Gap::length);
  std::vector<char>                      isUsed(ends.size(), 0);
  std::vector<double>                    result;
  std::vector<std::vector<ElementIndex>> lines;
  for (const Gap & gap : gaps)
  {
    if (isUsed[gap.a] == 0 && isUsed[gap.b] == 0)
    {
      isUsed[gap.a] = isUsed[gap.b] = 1;
      lines.push_back({ ends[gap.a].point, ends[gap.b].point });
      result.push_back(gap.length);
    }
  }
  std::vector<std::vector<std::size_t>> splits(graph.BranchCount());
  for (std::size_t end = 0; end < ends.size() && rules.tornGap > 0 && rules.tornSlack > 0; ++end)
  {
    const auto side = isUsed[end] == 0 ? SideBefore(graph, ends[end], rules.tornSlack) : std::nullopt;
    if (side)
    {
      lines.push_back({ ends[end].point, graph.Branch(side->branch)[side->at] });
      splits[side->branch].push_back(side->at);
      result.push_back(side->length);
    }
  }
  if (!result.empty())
  {
    for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
    {
      const auto points = graph.Branch(branch);
      auto &     at = splits[branch];
      at.push_back(points.size() - 1);
      ranges::sort(at);
      at.erase(std::unique(at.begin(), at.end()), at.end());
      std::size_t from = 0;
      for (const std::size_t to : at)
      {
        lines.emplace_back(points.begin() + static_cast<std::ptrdiff_t>(from),
                           points.begin() + static_cast<std::ptrdiff_t>(to + 1));
        from = to;
      }
    }
    SortBranches(graph, lines, true);
  }
  return result;
}

} // namespace voxelcore
