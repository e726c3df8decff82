#include "voxelcore/Roots/RootHierarchy.h"

#include "ContactPairing.h"
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
            Add(lateral, static_cast<ElementIndex>(at), false);
          }
        }
      }
    }
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
  RootFlow    flow = FlowFrom(branches, stems);
  RootPairing pairing = PairBranches(branches, flow, rules);
  AxisBuilder(branches, flow, pairing, roots).Build();
  roots.meetings = std::move(pairing.meetings);
  FindWhorls(graph, rules, roots);
  return roots;
}

} // namespace voxelcore
