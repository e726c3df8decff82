#include "voxelcore/RootHierarchy.h"

#include "RootTurning.h"
#include "RootWhorls.h"

#include <algorithm>

namespace voxelcore
{

namespace
{

constexpr int kMostTurns = 8;

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
    // Where pairs of contacts bite their own tails a branch may be left: it is a lateral of what the way came from.
    for (;;)
    {
      const std::size_t done = m_Roots.axes.size();
      for (ElementIndex branch = 0; branch < m_Roots.rootOf.size(); ++branch)
      {
        const ElementIndex before = m_Flow.before[branch];
        if (m_Roots.rootOf[branch] == kNoRoot && !m_Pairing.inside[branch] && before != kNoRoot &&
            m_Roots.rootOf[before] != kNoRoot)
        {
          Add(branch, m_Roots.rootOf[before], false);
        }
      }
      if (m_Roots.axes.size() == done)
      {
        break;
      }
      Grow(done);
    }
    SortByLevel(m_Roots);
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
  const RootBranches     branches(graph);
  std::vector<BranchEnd> stems = FindStems(branches, rules.up, rules.stems);
  roots.upFound = !rules.up;
  if (rules.up)
  {
    roots.up = *rules.up;
  }
  else if (!stems.empty())
  {
    roots.up = FindUp(branches, stems.front());
    stems = FindStems(branches, roots.up, rules.stems);
  }
  RootFlow    flow = FlowFrom(branches, stems);
  RootPairing pairing = PairBranches(branches, flow, rules, false);
  for (int round = 0; round < kMostTurns && TurnBackRoots(branches, rules, pairing, flow) > 0; ++round)
  {
    pairing = PairBranches(branches, flow, rules, false);
  }
  pairing = PairBranches(branches, flow, rules, true);
  AxisBuilder(branches, flow, pairing, roots).Build();
  roots.meetings = std::move(pairing.meetings);
  FindWhorls(graph, rules, roots);
  return roots;
}

} // namespace voxelcore
