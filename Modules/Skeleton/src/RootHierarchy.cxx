#include "voxelcore/RootHierarchy.h"

#include "ContactPairing.h"
#include "RootNumbers.h"
#include "RootStem.h"
#include "RootSteps.h"
#include "RootWhorls.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

/** Puts branches together to axes. */
class AxisBuilder
{
public:
  AxisBuilder(const RootBranches & branches, const RootFlow & flow, const RootPairing & pairing, RootHierarchy & roots)
    : m_Branches(branches)
    , m_Flow(flow)
    , m_Pairing(pairing)
    , m_Roots(roots)
    , m_Laterals(pairing.next.size())
  {}

  void
  Build()
  {
    m_Roots.rootOf.assign(m_Pairing.next.size(), kNoRoot);
    for (ElementIndex branch = 0; branch < m_Pairing.parent.size(); ++branch)
    {
      if (m_Pairing.parent[branch] != kNoRoot)
      {
        m_Laterals[m_Pairing.parent[branch]].push_back(branch);
      }
    }
    for (std::size_t i = 0; i < m_Flow.sources.size(); ++i)
    {
      const ElementIndex first = m_Flow.sources[i].branch;
      if (m_Roots.rootOf[first] == kNoRoot)
      {
        Add(first, kNoRoot, m_Flow.loose[i] != 0);
      }
    }
    Grow(0);
    // Where pairs of contacts bite their own tails a branch may be left: it is a lateral of what the way came from, in
    // the order of that.
    for (const ElementIndex first : FirstToLast())
    {
      if (m_Roots.rootOf[first] == kNoRoot && !m_Pairing.inside[first])
      {
        const std::size_t done = m_Roots.axes.size();
        ElementIndex      before = m_Flow.before[first];
        while (before != kNoRoot && m_Roots.rootOf[before] == kNoRoot)
        {
          before = m_Flow.before[before]; // through a contact
        }
        Add(first, before == kNoRoot ? kNoRoot : m_Roots.rootOf[before], before == kNoRoot);
        Grow(done);
      }
    }
    SortByLevel(m_Roots);
    const RootSteps steps(m_Roots);
    m_Roots.leftOut.assign(m_Roots.rootOf.size(), LeftOut::No);
    for (ElementIndex branch = 0; branch < m_Roots.rootOf.size(); ++branch)
    {
      if (m_Pairing.inside[branch] && steps.OwnerOf(m_Branches.Graph().Branch(branch)) == kNoRoot)
      {
        m_Roots.leftOut[branch] = LeftOut::Bridge;
      }
    }
  }

private:
  /** All branches, each behind the one that its way comes from. */
  std::vector<ElementIndex>
  FirstToLast() const
  {
    std::vector<std::vector<ElementIndex>> after(m_Flow.before.size());
    std::vector<ElementIndex>              order;
    for (ElementIndex branch = 0; branch < after.size(); ++branch)
    {
      m_Flow.before[branch] == kNoRoot ? order.push_back(branch) : after[m_Flow.before[branch]].push_back(branch);
    }
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      order.insert(order.end(), after[order[i]].begin(), after[order[i]].end());
    }
    return order;
  }

  /** The laterals of axes from number `at` on, and theirs. */
  void
  Grow(std::size_t at)
  {
    for (; at < m_Roots.axes.size(); ++at)
    {
      for (const ElementIndex branch : m_Chains[at])
      {
        for (const ElementIndex lateral : m_Laterals[branch])
        {
          if (m_Roots.rootOf[lateral] == kNoRoot)
          {
            Add(lateral, ParentOf(lateral, static_cast<ElementIndex>(at)), false);
          }
        }
      }
    }
  }

  /** What springs from a root where that is still within its own parent springs from the parent: of a stem as far as
   *  roots of a whorl run fused. */
  ElementIndex
  ParentOf(ElementIndex lateral, ElementIndex root) const
  {
    const SkeletonGraph & graph = m_Branches.Graph();
    const Vector3 &       place = graph.positions[m_Branches.PointFrom(m_Flow.Base(lateral), 0)];
    for (ElementIndex above = m_Roots.axes[root].parent; above != kNoRoot; above = m_Roots.axes[root].parent)
    {
      const auto &       points = m_Roots.axes[above].points;
      const ElementIndex near = points[NearestPoint(graph, points, place)];
      const double       reach = m_Roots.axes[above].level == 0 ? kStemReach : kOutsideBall;
      if (Distance(graph.positions[near], place) > reach * graph.radius[near])
      {
        break;
      }
      root = above;
    }
    return root;
  }

  void
  Add(ElementIndex first, ElementIndex parent, bool isLoose)
  {
    const auto number = static_cast<ElementIndex>(m_Roots.axes.size());
    RootAxis   axis;
    axis.parent = parent;
    axis.loose = isLoose;
    axis.stem = number;
    if (parent != kNoRoot)
    {
      RootAxis & above = m_Roots.axes[parent];
      axis.level = above.level + 1;
      axis.stem = above.stem;
      axis.loose = above.loose;
      ++above.children;
    }
    std::vector<ElementIndex> chain;
    for (ElementIndex branch = first; branch != kNoRoot && m_Roots.rootOf[branch] == kNoRoot;
         branch = m_Pairing.next[branch])
    {
      m_Roots.rootOf[branch] = number;
      chain.push_back(branch);
      Append(axis.points, m_Flow.Base(branch));
      axis.endsAtContact = m_Pairing.endsAtMeeting[branch] != 0;
      axis.undecided = axis.undecided || m_Pairing.undecided[branch] != 0;
      const ElementIndex next = m_Pairing.next[branch];
      if (next != kNoRoot && m_Roots.rootOf[next] == kNoRoot)
      {
        for (const ElementIndex inside : m_Pairing.ways[branch])
        {
          const ElementIndex hub = m_Branches.HubOf({ inside, 0 });
          const bool         forward = hub == m_LastHub;
          Append(axis.points, { inside, static_cast<std::uint8_t>(forward ? 0 : 1) });
        }
      }
    }
    if (parent != kNoRoot)
    {
      axis.parentPoint = NearestPoint(m_Branches.Graph(),
                                      m_Roots.axes[parent].points,
                                      m_Branches.Graph().positions[axis.points.front()]);
    }
    m_Roots.axes.push_back(std::move(axis));
    m_Chains.push_back(std::move(chain));
  }

  void
  Append(std::vector<ElementIndex> & points, const BranchEnd & from)
  {
    const std::size_t count = m_Branches.Graph().Branch(from.branch).size();
    for (std::size_t i = points.empty() || points.back() != m_Branches.PointFrom(from, 0) ? 0 : 1; i < count; ++i)
    {
      points.push_back(m_Branches.PointFrom(from, i));
    }
    m_LastHub = m_Branches.HubOf(from.Other());
  }

  const RootBranches &                   m_Branches;
  const RootFlow &                       m_Flow;
  const RootPairing &                    m_Pairing;
  RootHierarchy &                        m_Roots;
  std::vector<std::vector<ElementIndex>> m_Laterals; ///< per branch
  std::vector<std::vector<ElementIndex>> m_Chains;   ///< per axis its branches
  ElementIndex                           m_LastHub = 0;
};

/** The coordinate axis, or its opposite, that points most from the centre of the skeleton to the base of the stem. */
Vector3
UpFrom(const SkeletonGraph & graph, ElementIndex base)
{
  Vector3 away = graph.positions[base];
  for (const ElementIndex point : graph.branchPoints)
  {
    away = AddScaled(away, -1.0 / static_cast<double>(graph.branchPoints.size()), graph.positions[point]);
  }
  std::size_t axis = 2;
  for (const std::size_t other : { std::size_t{ 1 }, std::size_t{ 0 } })
  {
    axis = std::abs(away[other]) > std::abs(away[axis]) ? other : axis;
  }
  Vector3 up{ 0, 0, 0 };
  up[axis] = away[axis] < 0 ? -1 : 1;
  return up;
}

} // namespace

RootHierarchy
FindRoots(const SkeletonGraph & graph, const RootRules & rules)
{
  RootHierarchy roots;
  if (graph.BranchCount() == 0)
  {
    roots.up = rules.up.value_or(roots.up);
    return roots;
  }
  const RootBranches   branches(graph);
  std::vector<StemWay> stems = FindStems(branches, rules.up, rules);
  roots.upFound = !rules.up;
  if (rules.up)
  {
    roots.up = *rules.up;
  }
  else if (!stems.empty())
  {
    roots.up = UpFrom(graph, branches.PointFrom(stems.front().front(), 0));
    stems = rules.stems == 1 ? stems : FindStems(branches, roots.up, rules);
  }
  const RootFlow flow = FlowFrom(branches, stems);
  RootPairing    pairing = PairBranches(branches, flow, rules);
  AxisBuilder(branches, flow, pairing, roots).Build();
  roots.meetings = std::move(pairing.meetings);
  FindWhorls(graph, rules, roots);
  return roots;
}

} // namespace voxelcore
