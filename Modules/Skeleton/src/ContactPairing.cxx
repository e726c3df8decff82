#include "ContactPairing.h"

#include "ContactMatching.h"
#include "RootNumbers.h"

#include "voxelcore/UnionFind.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace voxelcore
{

namespace
{

class Pairer
{
public:
  Pairer(const RootBranches & branches, const RootFlow & flow, const RootRules & rules)
    : m_Branches(branches)
    , m_Flow(flow)
    , m_Rules(rules)
    , m_Clusters(branches.HubCount())
    , m_Beyond(FindWhatFollows(branches, flow))
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
    std::vector<std::vector<ElementIndex>> members(m_Branches.HubCount());
    for (ElementIndex hub = 0; hub < m_Branches.HubCount(); ++hub)
    {
      m_Pairing.contact.push_back(static_cast<ElementIndex>(m_Clusters.Find(hub)));
      members[m_Pairing.contact.back()].push_back(hub);
    }
    // Branches with both ends in one contact lie within it, however they came to.
    for (ElementIndex branch = 0; branch < m_Pairing.next.size(); ++branch)
    {
      const ElementIndex a = m_Branches.HubOf({ branch, 0 });
      const ElementIndex b = m_Branches.HubOf({ branch, 1 });
      m_Pairing.inside[branch] = a != b && m_Clusters.Find(a) == m_Clusters.Find(b) && !m_Flow.isStem[branch];
    }
    for (const auto & hubs : members)
    {
      if (!hubs.empty())
      {
        Resolve(hubs);
      }
    }
    return std::move(m_Pairing);
  }

private:
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

  /** Whether `branch` is `later` or comes before it on its way from the stem. */
  bool
  IsBefore(ElementIndex branch, ElementIndex later) const
  {
    for (; later != kNoRoot; later = m_Flow.before[later])
    {
      if (later == branch)
      {
        return true;
      }
    }
    return false;
  }

  void
  Resolve(const std::vector<ElementIndex> & hubs)
  {
    std::vector<BranchEnd> arriving;
    std::vector<BranchEnd> leaving;
    for (const ElementIndex hub : hubs)
    {
      for (const BranchEnd & end : m_Branches.EndsAt(hub))
      {
        if (!m_Pairing.inside[end.branch])
        {
          (m_Flow.base[end.branch] == end.last ? leaving : arriving).push_back(end);
        }
      }
    }
    std::stable_sort(arriving.begin(), arriving.end(), [&](const BranchEnd & a, const BranchEnd & b) {
      return m_Branches.Radius(a.branch) > m_Branches.Radius(b.branch);
    });
    if (arriving.empty())
    {
      // Where a stem begins: the others spring from it.
      const auto stem =
        std::ranges::find_if(leaving, [&](const BranchEnd & end) { return m_Flow.before[end.branch] == kNoRoot; });
      for (auto end = leaving.begin(); stem != leaving.end() && end != leaving.end(); ++end)
      {
        m_Pairing.parent[end->branch] = end != stem ? stem->branch : kNoRoot;
      }
      return;
    }
    if (arriving.size() == 1)
    {
      ContinueBest(arriving.front(), leaving, hubs);
      return;
    }
    std::vector<std::vector<double>> values(arriving.size(), std::vector<double>(leaving.size(), 0));
    for (std::size_t i = 0; i < arriving.size(); ++i)
    {
      for (std::size_t k = 0; k < leaving.size(); ++k)
      {
        const ElementIndex next = m_Flow.stemNext[arriving[i].branch];
        if (m_Flow.isStem[arriving[i].branch] || m_Flow.isStem[leaving[k].branch])
        {
          values[i][k] = next == leaving[k].branch ? kOfStem : kNoPair;
        }
        else if (!IsBefore(leaving[k].branch, arriving[i].branch))
        {
          // Thin roots to both sides of a thick one rather spring from it.
          const double thick = m_Branches.Radius(arriving.front().branch);
          const bool   passes = m_Branches.Radius(arriving[i].branch) < kThinBeside * thick;
          values[i][k] = m_Branches.PairValue(arriving[i], leaving[k]) - (passes ? kOfPassing : 0);
        }
      }
    }
    const Matcher matcher(values);
    RootMeeting   meeting;
    meeting.margin = matcher.second >= 0 ? matcher.best.value - matcher.second : matcher.best.value;
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
      meeting.reach = std::max(meeting.reach, away + 1.2 * m_Branches.Graph().radius[point]);
    }
    for (const auto * ends : { &arriving, &leaving })
    {
      for (const BranchEnd & end : *ends)
      {
        meeting.arms.push_back(end.branch);
      }
    }
    std::vector<std::uint8_t> hasPartner(leaving.size(), 0);
    for (std::size_t i = 0; i < arriving.size(); ++i)
    {
      const int partner = matcher.best.partner[i];
      if (partner < 0)
      {
        m_Pairing.endsAtMeeting[arriving[i].branch] = 1;
        continue;
      }
      const BranchEnd & to = leaving[static_cast<std::size_t>(partner)];
      hasPartner[static_cast<std::size_t>(partner)] = 1;
      Follow(arriving[i], to, hubs);
      m_Pairing.undecided[arriving[i].branch] = meeting.undecided;
      meeting.pairs.push_back({ arriving[i].branch, to.branch });
    }
    for (std::size_t k = 0; k < leaving.size(); ++k)
    {
      if (!hasPartner[k])
      {
        // A lateral of what it came from, if that arrives here; else of the thickest.
        m_Pairing.parent[leaving[k].branch] = arriving.front().branch;
        for (const BranchEnd & end : arriving)
        {
          if (m_Branches.HubOf(end) == m_Branches.HubOf(leaving[k]) && !IsBefore(leaving[k].branch, end.branch))
          {
            m_Pairing.parent[leaving[k].branch] = end.branch;
            break;
          }
        }
      }
    }
    m_Pairing.meetings.push_back(meeting);
  }

  void
  ContinueBest(const BranchEnd & from, const std::vector<BranchEnd> & leaving, const std::vector<ElementIndex> & hubs)
  {
    double              farthest = 0;
    std::vector<double> radii{ 0 };
    for (const BranchEnd & end : leaving)
    {
      farthest = std::max(farthest, m_Beyond[end.branch].length);
      radii.push_back(m_Branches.Radius(end.branch));
    }
    std::ranges::sort(radii, std::ranges::greater{});
    const double likeness = radii[0] > 0 ? radii[1] / radii[0] : 1;
    const double ofLength = farthest > 0 ? kOfLength * likeness * likeness / farthest : 0;
    std::size_t  heir = leaving.size();
    double       best = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < leaving.size(); ++k)
    {
      const WhatFollows & beyond = m_Beyond[leaving[k].branch];
      const double        value =
        m_Branches.Onward(from, leaving[k]) + kOfJunctions * beyond.junctions + ofLength * beyond.length;
      const bool isNext = m_Flow.stemNext[from.branch] == leaving[k].branch;
      if (isNext || (!m_Flow.isStem[from.branch] && value > best))
      {
        best = isNext ? std::numeric_limits<double>::infinity() : value;
        heir = k;
      }
    }
    for (std::size_t k = 0; k < leaving.size(); ++k)
    {
      if (k == heir)
      {
        Follow(from, leaving[k], hubs);
      }
      else
      {
        m_Pairing.parent[leaving[k].branch] = from.branch;
      }
    }
  }

  /** Notes that a branch goes on as another, and the shortest way between them within the contact. */
  void
  Follow(const BranchEnd & from, const BranchEnd & to, const std::vector<ElementIndex> & hubs)
  {
    m_Pairing.next[from.branch] = to.branch;
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

  const RootBranches &     m_Branches;
  const RootFlow &         m_Flow;
  const RootRules &        m_Rules;
  UnionFind                m_Clusters; ///< hubs of one contact
  std::vector<WhatFollows> m_Beyond;   ///< per branch
  RootPairing              m_Pairing;
};

} // namespace

RootPairing
PairBranches(const RootBranches & branches, const RootFlow & flow, const RootRules & rules)
{
  return Pairer(branches, flow, rules).Pair();
}

} // namespace voxelcore
