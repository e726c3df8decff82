#include "voxelcore/RootHierarchy.h"

#include "ContactPairing.h"

#include <algorithm>
#include <limits>

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
    SortByLevel();
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
      const auto &    line = m_Roots.axes[parent].points;
      const Vector3 & base = m_Branches.Graph().positions[axis.points.front()];
      double          nearest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < line.size(); ++i)
      {
        const double away = Distance(m_Branches.Graph().positions[line[i]], base);
        if (away < nearest)
        {
          nearest = away;
          axis.parentPoint = i;
        }
      }
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

  void
  SortByLevel()
  {
    std::vector<ElementIndex> order(m_Roots.axes.size());
    for (ElementIndex i = 0; i < order.size(); ++i)
    {
      order[i] = i;
    }
    std::stable_sort(order.begin(), order.end(), [&](ElementIndex a, ElementIndex b) {
      return m_Roots.axes[a].level < m_Roots.axes[b].level;
    });
    std::vector<ElementIndex> place(order.size());
    std::vector<RootAxis>     sorted;
    for (ElementIndex i = 0; i < order.size(); ++i)
    {
      place[order[i]] = i;
      sorted.push_back(std::move(m_Roots.axes[order[i]]));
    }
    for (RootAxis & axis : sorted)
    {
      axis.parent = axis.parent == kNoRoot ? kNoRoot : place[axis.parent];
      axis.stem = place[axis.stem];
    }
    for (ElementIndex & root : m_Roots.rootOf)
    {
      root = root == kNoRoot ? kNoRoot : place[root];
    }
    m_Roots.axes = std::move(sorted);
  }

  const RootBranches &                   m_Branches;
  const RootFlow &                       m_Flow;
  const RootPairing &                    m_Pairing;
  RootHierarchy &                        m_Roots;
  std::vector<std::vector<ElementIndex>> m_Laterals; ///< per branch
  std::vector<std::vector<ElementIndex>> m_Chains;   ///< per axis its branches
  ElementIndex                           m_LastHub = 0;
};

/** Laterals of each stem, gathered by where they spring from it. */
void
FindWhorls(const SkeletonGraph & graph, const RootRules & rules, RootHierarchy & roots)
{
  const std::vector<double> & radii = SectionRadii(graph);
  for (ElementIndex stem = 0; stem < roots.axes.size() && roots.axes[stem].level == 0; ++stem)
  {
    const auto &        line = roots.axes[stem].points;
    std::vector<double> way(line.size(), 0);
    for (std::size_t i = 1; i < line.size(); ++i)
    {
      way[i] = way[i - 1] + Distance(graph.positions[line[i - 1]], graph.positions[line[i]]);
    }
    std::vector<std::pair<double, ElementIndex>> laterals;
    for (ElementIndex axis = 0; axis < roots.axes.size(); ++axis)
    {
      if (roots.axes[axis].parent == stem)
      {
        laterals.emplace_back(way[roots.axes[axis].parentPoint], axis);
      }
    }
    std::sort(laterals.begin(), laterals.end());
    for (std::size_t first = 0; first < laterals.size();)
    {
      RootWhorl   whorl{ stem, 0, {}, {} };
      std::size_t last = first;
      for (;; ++last)
      {
        const auto [along, axis] = laterals[last];
        const ElementIndex point = line[roots.axes[axis].parentPoint];
        whorl.roots.push_back(axis);
        whorl.along += along;
        whorl.position = AddScaled(whorl.position, 1, graph.positions[point]);
        if (last + 1 == laterals.size() || laterals[last + 1].first - along > rules.whorlGap * radii[point])
        {
          break;
        }
      }
      const auto count = static_cast<double>(whorl.roots.size());
      whorl.along /= count;
      whorl.position = { whorl.position[0] / count, whorl.position[1] / count, whorl.position[2] / count };
      if (whorl.roots.size() >= static_cast<std::size_t>(rules.whorlSize))
      {
        roots.whorls.push_back(std::move(whorl));
      }
      first = last + 1;
    }
  }
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
  const RootFlow flow = FlowFrom(branches, stems);
  RootPairing    pairing = PairBranches(branches, flow, rules);
  AxisBuilder(branches, flow, pairing, roots).Build();
  roots.meetings = std::move(pairing.meetings);
  FindWhorls(graph, rules, roots);
  return roots;
}

} // namespace voxelcore
