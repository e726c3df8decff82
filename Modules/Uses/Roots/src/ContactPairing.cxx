#include "ContactPairing.h"

#include "RootChoice.h"
#include "RootNumbers.h"

#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

namespace voxelcore
{

namespace
{

class Pairer
{
public:
  Pairer(const RootBranches & branches, RootFlow & flow, const RootRules & rules)
    : m_Branches(branches)
    , m_Flow(flow)
    , m_Rules(rules)
    , m_Clusters(branches.HubCount())
    , m_Partner(2 * branches.Graph().BranchCount(), kNoRoot)
  {
    const std::size_t count = branches.Graph().BranchCount();
    m_Pairing.next.assign(count, kNoRoot);
    m_Pairing.parent.assign(count, kNoRoot);
    m_Pairing.inside.assign(count, 0);
    m_Pairing.ways.resize(count);
    m_Pairing.undecided.assign(count, 0);
    m_Pairing.endsAtMeeting.assign(count, 0);
  }

  RootPairing
  Pair()
  {
    for (ElementIndex hub = 0; hub < m_Branches.HubCount(); ++hub)
    {
      if (m_Flow.arrivals[hub].size() > 1)
      {
        Gather(hub);
      }
    }
    FindPlaces();
    Begin();
    HierarchyChoice choice(m_Branches, m_Flow, m_Pairing, m_Partner);
    choice.Search();
    choice.ReachAll();
    const std::vector<ChosenRoot> roots = choice.Roots();
    Direct(roots);
    FindBridges(roots, choice);
    for (ElementIndex place = 0; place < m_Members.size(); ++place)
    {
      if (!m_Members[place].empty())
      {
        Note(m_Members[place], choice.ArmsAt(place), choice);
      }
    }
    for (ElementIndex branch = 0; branch < m_IsBridge.size(); ++branch)
    {
      m_Pairing.inside[branch] = m_Pairing.inside[branch] || m_IsBridge[branch];
      m_Pairing.parent[branch] = m_IsBridge[branch] ? kNoRoot : m_Pairing.parent[branch];
    }
    return std::move(m_Pairing);
  }

private:
  /** Which hubs are one contact, and the branches within it. */
  void
  FindPlaces()
  {
    m_Members.assign(m_Branches.HubCount(), {});
    m_Pairing.contact.clear();
    for (ElementIndex hub = 0; hub < m_Branches.HubCount(); ++hub)
    {
      m_Pairing.contact.push_back(static_cast<ElementIndex>(m_Clusters.Find(hub)));
      m_Members[m_Pairing.contact.back()].push_back(hub);
    }
    // Branches with both ends in one contact lie within it, however they came to.
    for (ElementIndex branch = 0; branch < m_Pairing.next.size(); ++branch)
    {
      const ElementIndex a = m_Branches.HubOf({ branch, 0 });
      const ElementIndex b = m_Branches.HubOf({ branch, 1 });
      m_Pairing.inside[branch] = a != b && m_Clusters.Find(a) == m_Clusters.Find(b) && !m_Flow.isStem[branch];
    }
  }

  /** Joins to a hub where branches meet what belongs to the same contact. */
  void
  Gather(ElementIndex hub)
  {
    const auto & arrivals = m_Flow.arrivals[hub];
    double       radii = 0;
    for (const BranchEnd & end : arrivals)
    {
      radii = std::max(radii, m_Branches.Radius(end.branch));
    }
    bool bridged = false;
    for (const BranchEnd & end : arrivals)
    {
      const ElementIndex other = m_Branches.HubOf(end.Other());
      if (other == hub || m_Flow.isStem[end.branch] || !m_Branches.IsJunction(other) || m_Flow.arrivals[other].empty())
      {
        continue;
      }
      // A bridge ends between two roots: its own radius says nothing, theirs do.
      double here = 0;
      for (const BranchEnd & one : arrivals)
      {
        here = one.branch == end.branch ? here : std::max(here, m_Branches.Radius(one.branch));
      }
      const double there = m_Branches.Radius(m_Flow.arrivals[other].front().branch);
      // What arrives first is a root's own piece, unless all that meets there is as thin as a bridge is short.
      const double sum = end.branch == arrivals.front().branch ? 2 * std::min(here, there) : here + there;
      if (m_Branches.LengthOf(end.branch) <= m_Rules.bridgeLength * sum)
      {
        m_Clusters.Unite(hub, other);
        bridged = true;
      }
    }
    if (bridged)
    {
      return;
    }
    std::vector<BranchEnd> leaving;
    for (const BranchEnd & end : m_Branches.EndsAt(hub))
    {
      if (m_Flow.base[end.branch] == end.last)
      {
        leaving.push_back(end);
      }
    }
    if (leaving.size() >= arrivals.size())
    {
      return;
    }
    double sum = 0;
    for (const BranchEnd & end : arrivals)
    {
      sum += m_Branches.Radius(end.branch);
    }
    for (const BranchEnd & end : leaving)
    {
      const ElementIndex other = m_Branches.HubOf(end.Other());
      if (other != hub && !m_Flow.isStem[end.branch] && m_Branches.IsJunction(other) &&
          m_Branches.LengthOf(end.branch) <= m_Rules.sharedLength * sum * 2 / static_cast<double>(arrivals.size()))
      {
        m_Clusters.Unite(hub, other);
      }
    }
  }

  void
  MakePair(const BranchEnd & arrives, const BranchEnd & leaves)
  {
    m_Partner[ArmOf(arrives)] = ArmOf(leaves);
    m_Partner[ArmOf(leaves)] = ArmOf(arrives);
  }

  /** Where the choice begins: the stems; where one branch arrives, what has most junctions beyond it goes on, of
   *  several such the longest; in contacts what is least crooked. */
  void
  Begin()
  {
    const std::vector<WhatFollows> beyond = FindWhatFollows(m_Branches, m_Flow);
    for (const auto & hubs : m_Members)
    {
      std::vector<BranchEnd> arriving;
      std::vector<BranchEnd> leaving;
      for (const ElementIndex hub : hubs)
      {
        for (const BranchEnd & end : m_Branches.EndsAt(hub))
        {
          const ElementIndex next = m_Flow.stemNext[end.branch];
          const bool         arrives = m_Flow.base[end.branch] != end.last;
          if (arrives && next != kNoRoot)
          {
            MakePair(end, m_Flow.Base(next));
          }
          if (!m_Pairing.inside[end.branch] && !m_Flow.isStem[end.branch])
          {
            (arrives ? arriving : leaving).push_back(end);
          }
        }
      }
      if (arriving.size() == 1)
      {
        const auto heir = ranges::max_element(leaving, {}, [&](const BranchEnd & end) {
          return std::pair(beyond[end.branch].junctions, beyond[end.branch].length);
        });
        if (heir != leaving.end())
        {
          MakePair(arriving.front(), *heir);
        }
        continue;
      }
      std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
      for (std::size_t i = 0; i < arriving.size(); ++i)
      {
        for (std::size_t k = 0; k < leaving.size(); ++k)
        {
          const double likeness = m_Branches.Likeness(arriving[i].branch, leaving[k].branch);
          const double crooked = RootBranches::Crooked(m_Branches.Straightness(arriving[i], leaving[k]), likeness);
          if (crooked < kGoingOn)
          {
            pairs.emplace_back(crooked, i, k);
          }
        }
      }
      ranges::sort(pairs);
      for (const auto & [crooked, i, k] : pairs)
      {
        if (m_Partner[ArmOf(arriving[i])] == kNoRoot && m_Partner[ArmOf(leaving[k])] == kNoRoot)
        {
          MakePair(arriving[i], leaving[k]);
        }
      }
    }
  }

  /** Every root is run through from where it springs. */
  void
  Direct(const std::vector<ChosenRoot> & roots)
  {
    for (const ChosenRoot & root : roots)
    {
      ElementIndex before = root.parent;
      m_Pairing.parent[root.arms[0] / 2] = root.parent;
      for (ElementIndex arm = root.arms[0];; arm = m_Partner[arm ^ 1U])
      {
        const ElementIndex branch = arm / 2;
        m_Flow.base[branch] = EndOf(arm).last;
        m_Flow.before[branch] = before;
        before = branch;
        if ((arm ^ 1U) == root.arms[1])
        {
          break;
        }
        m_Pairing.next[branch] = m_Partner[arm ^ 1U] / 2;
      }
    }
  }

  /** What leads from a root to another, nothing springing from it, and is no longer than they are thick. */
  void
  FindBridges(const std::vector<ChosenRoot> & roots, const HierarchyChoice & choice)
  {
    m_IsBridge.assign(m_Pairing.next.size(), 0);
    for (const ChosenRoot & root : roots)
    {
      const ElementIndex branch = root.arms[0] / 2;
      double             other = 0;
      for (const ElementIndex arm : choice.ArmsAt(choice.PlaceOf(root.arms[1])))
      {
        other = std::max(other, arm / 2 == branch ? 0 : m_Branches.Radius(arm / 2));
      }
      if (root.level > 0 && root.children == 0 && root.arms[1] / 2 == branch)
      {
        const double thinner = std::min(other, m_Branches.Radius(root.parent));
        m_IsBridge[branch] = m_Branches.LengthOf(branch) <= m_Rules.bridgeLength * 2 * thinner;
      }
    }
  }

  /** What goes on as what at a place, and the contact that is there where more than one branch arrives. */
  void
  Note(const std::vector<ElementIndex> & hubs, const std::vector<ElementIndex> & arms, HierarchyChoice & choice)
  {
    std::vector<BranchEnd> arriving;
    std::vector<BranchEnd> leaving;
    for (const ElementIndex arm : arms)
    {
      (m_Flow.base[arm / 2] == EndOf(arm).last ? leaving : arriving).push_back(EndOf(arm));
    }
    for (const BranchEnd & end : arriving)
    {
      if (m_Partner[ArmOf(end)] != kNoRoot)
      {
        NoteWay(end, EndOf(m_Partner[ArmOf(end)]), hubs);
      }
    }
    if (arriving.size() < 2)
    {
      return;
    }
    ranges::stable_sort(arriving, ranges::greater{}, [&](const BranchEnd & end) {
      return m_Branches.Radius(end.branch);
    });
    RootMeeting meeting;
    meeting.margin = choice.Margin(m_Pairing.contact[hubs.front()]);
    meeting.undecided = !leaving.empty() && meeting.margin < m_Rules.undecided;
    for (const ElementIndex hub : hubs)
    {
      const ElementIndex point = m_Branches.PointFrom(m_Branches.EndsAt(hub).front(), 0);
      meeting.position =
        AddScaled(meeting.position, 1.0 / static_cast<double>(hubs.size()), m_Branches.Graph().positions[point]);
      meeting.radius = std::max(meeting.radius, m_Branches.Graph().radius[point]);
    }
    for (const ElementIndex hub : hubs)
    {
      const ElementIndex point = m_Branches.PointFrom(m_Branches.EndsAt(hub).front(), 0);
      const double       away = Distance(m_Branches.Graph().positions[point], meeting.position);
      meeting.reach = std::max(meeting.reach, away + kOutsideBall * m_Branches.Graph().radius[point]);
    }
    for (const BranchEnd & end : arriving)
    {
      if (m_IsBridge[end.branch]) // its contact reaches to the root it comes from
      {
        const ElementIndex base = m_Branches.PointFrom(end.Other(), 0);
        meeting.arms.push_back(m_Pairing.parent[end.branch]);
        meeting.reach = std::max(meeting.reach,
                                 Distance(m_Branches.Graph().positions[base], meeting.position) +
                                   kOutsideBall * m_Branches.Graph().radius[base]);
      }
      const ElementIndex partner = m_Partner[ArmOf(end)];
      meeting.arms.push_back(end.branch);
      m_Pairing.endsAtMeeting[end.branch] = partner == kNoRoot;
      if (partner != kNoRoot)
      {
        m_Pairing.undecided[end.branch] = meeting.undecided;
        meeting.pairs.push_back({ end.branch, partner / 2 });
      }
    }
    ranges::transform(leaving, std::back_inserter(meeting.arms), &BranchEnd::branch);
    m_Pairing.meetings.push_back(meeting);
  }

  /** The shortest way within a contact from a branch to the one it goes on as. */
  void
  NoteWay(const BranchEnd & from, const BranchEnd & to, const std::vector<ElementIndex> & hubs)
  {
    const ElementIndex start = m_Branches.HubOf(from);
    const ElementIndex goal = m_Branches.HubOf(to);
    if (start == goal || hubs.size() == 1)
    {
      return;
    }
    using Entry = std::pair<double, ElementIndex>;
    std::vector<double>       cost(hubs.size(), std::numeric_limits<double>::infinity());
    std::vector<ElementIndex> by(hubs.size(), kNoRoot);
    const auto                number = [&](ElementIndex hub) {
      return static_cast<std::size_t>(std::lower_bound(hubs.begin(), hubs.end(), hub) - hubs.begin());
    };
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    cost[number(start)] = 0;
    queue.emplace(0.0, start);
    while (!queue.empty())
    {
      const auto [way, hub] = queue.top();
      queue.pop();
      if (way > cost[number(hub)])
      {
        continue;
      }
      for (const BranchEnd & end : m_Branches.EndsAt(hub))
      {
        if (!m_Pairing.inside[end.branch])
        {
          continue;
        }
        const ElementIndex other = m_Branches.HubOf(end.Other());
        const double       sum = way + m_Branches.LengthOf(end.branch);
        if (sum < cost[number(other)])
        {
          cost[number(other)] = sum;
          by[number(other)] = end.branch;
          queue.emplace(sum, other);
        }
      }
    }
    auto & way = m_Pairing.ways[from.branch];
    for (ElementIndex hub = goal; hub != start;)
    {
      const ElementIndex branch = by[number(hub)];
      way.push_back(branch);
      const ElementIndex a = m_Branches.HubOf({ branch, 0 });
      hub = a == hub ? m_Branches.HubOf({ branch, 1 }) : a;
    }
    std::reverse(way.begin(), way.end());
  }

  const RootBranches &                   m_Branches;
  RootFlow &                             m_Flow;
  const RootRules &                      m_Rules;
  UnionFind                              m_Clusters; ///< hubs of one contact
  std::vector<std::vector<ElementIndex>> m_Members;  ///< per contact its hubs
  std::vector<ElementIndex>              m_Partner;  ///< per arm
  std::vector<std::uint8_t>              m_IsBridge; ///< per branch
  RootPairing                            m_Pairing;
};

} // namespace

RootPairing
PairBranches(const RootBranches & branches, RootFlow & flow, const RootRules & rules)
{
  return Pairer(branches, flow, rules).Pair();
}

} // namespace voxelcore
