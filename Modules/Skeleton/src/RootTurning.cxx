#include "RootTurning.h"

#include <algorithm>

namespace voxelcore
{

namespace
{

constexpr double kLeastPair = 0.2; // value of a pair for which a root is turned
constexpr double kMoreForwards = 0.5;
constexpr double kOfSpringing = 0.3; // of cos(turn) of a lateral, beside the value of a pair
constexpr double kMoreWorth = 0.1;

class RootTurner
{
public:
  RootTurner(const RootBranches & branches, const RootRules & rules, const RootPairing & pairing, RootFlow & flow)
    : m_Branches(branches)
    , m_Pairing(pairing)
    , m_Flow(flow)
    , m_Rules(rules)
    , m_Turned(pairing.next.size(), 0)
    , m_Partner(pairing.next.size(), kNoRoot)
    , m_Members(branches.HubCount())
  {
    for (ElementIndex branch = 0; branch < pairing.next.size(); ++branch)
    {
      if (pairing.next[branch] != kNoRoot)
      {
        m_Partner[pairing.next[branch]] = branch;
      }
    }
    for (ElementIndex hub = 0; hub < branches.HubCount(); ++hub)
    {
      m_Members[pairing.contact[hub]].push_back(hub);
    }
  }

  std::size_t
  Turn()
  {
    std::size_t count = 0;
    for (ElementIndex first = 0; first < m_Pairing.next.size(); ++first)
    {
      if (m_Pairing.parent[first] != kNoRoot && TurnFrom(first))
      {
        ++count;
      }
    }
    return count;
  }

private:
  ElementIndex
  ContactAt(const BranchEnd & end) const
  {
    return m_Pairing.contact[m_Branches.HubOf(end)];
  }

  bool
  TurnFrom(ElementIndex first)
  {
    std::vector<ElementIndex> chain{ first };
    while (m_Pairing.next[chain.back()] != kNoRoot)
    {
      chain.push_back(m_Pairing.next[chain.back()]);
      if (chain.size() > m_Pairing.next.size())
      {
        return false; // pairs that bite their tails
      }
    }
    // It may go on beyond the root that it springs from, as another that springs there.
    for (std::size_t count = 1; count < chain.size(); ++count)
    {
      const std::vector<ElementIndex> piece(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(count));
      if (PassesAnother(piece.back(), chain[count]) && TurnPassing(piece, chain[count]))
      {
        return true;
      }
    }
    if (!m_Pairing.endsAtMeeting[chain.back()] ||
        std::ranges::any_of(chain, [&](ElementIndex branch) { return m_Turned[branch] != 0; }))
    {
      return false;
    }
    // It may begin with a bridge from the root that it touches.
    const double bridge = m_Rules.bridgeLength * 2 * m_Branches.Radius(chain.back());
    double       way = 0;
    while (!chain.empty() && way <= bridge)
    {
      if (TurnChain(chain))
      {
        return true;
      }
      way += m_Branches.LengthOf(chain.front());
      chain.erase(chain.begin());
    }
    return false;
  }

  /** Whether a branch goes on as `next` where another root arrives, too. */
  bool
  PassesAnother(ElementIndex branch, ElementIndex next) const
  {
    for (const ElementIndex hub : m_Members[ContactAt(m_Flow.Base(next))])
    {
      for (const BranchEnd & end : m_Flow.arrivals[hub])
      {
        if (end.branch != branch && !m_Pairing.inside[end.branch])
        {
          return true;
        }
      }
    }
    return false;
  }

  /** Turns a piece that seems to start at one contact and to go on as `next` from another, where both rather spring
   *  from what they pass there. */
  bool
  TurnPassing(const std::vector<ElementIndex> & piece, ElementIndex next)
  {
    const BranchEnd start = m_Flow.Base(piece.front());
    const BranchEnd stop = m_Flow.Base(piece.back()).Other();
    if (ContactAt(start) == ContactAt(stop) ||
        std::ranges::any_of(piece, [&](ElementIndex branch) { return m_Turned[branch] != 0; }))
    {
      return false;
    }
    const ElementIndex heir = HeirOf(start, piece);
    const ElementIndex before = m_Flow.before[piece.front()];
    if (heir == kNoRoot || before == kNoRoot || heir == next)
    {
      return false;
    }
    const ElementIndex parent = ParentAt(stop, piece, heir);
    if (parent == kNoRoot)
    {
      return false;
    }
    const BranchEnd here = m_Flow.Base(before).Other();
    const BranchEnd there = m_Flow.Base(parent).Other();
    const double    now =
      m_Branches.PairValue(stop, m_Flow.Base(next)) +
      kOfSpringing * (m_Branches.Straightness(here, start) + m_Branches.Straightness(here, m_Flow.Base(heir)));
    const double turned =
      m_Branches.PairValue(start, m_Flow.Base(heir)) - OfPassing(start) +
      kOfSpringing * (m_Branches.Straightness(there, stop) + m_Branches.Straightness(there, m_Flow.Base(next)));
    if (turned < now + kMoreWorth)
    {
      return false;
    }
    Reverse(piece, parent, heir);
    return true;
  }

  bool
  TurnChain(const std::vector<ElementIndex> & chain)
  {
    const BranchEnd start = m_Flow.Base(chain.front());
    const BranchEnd stop = m_Flow.Base(chain.back()).Other();
    if (ContactAt(start) == ContactAt(stop))
    {
      return false;
    }
    if (HeirOf(stop, chain) != kNoRoot)
    {
      return false; // a contact where another pairing is wanting
    }
    const ElementIndex heir = HeirOf(start, chain);
    const ElementIndex parent = ParentAt(stop, chain, heir);
    if (parent == kNoRoot || (heir == kNoRoot && !SpringsRather(stop, parent, start)))
    {
      return false;
    }
    Reverse(chain, parent, heir);
    return true;
  }

  void
  Reverse(const std::vector<ElementIndex> & chain, ElementIndex parent, ElementIndex heir)
  {
    ElementIndex before = parent;
    for (auto branch = chain.rbegin(); branch != chain.rend(); ++branch)
    {
      const BranchEnd base = m_Flow.Base(*branch);
      auto &          left = m_Flow.arrivals[m_Branches.HubOf(base.Other())];
      std::erase_if(left, [&](const BranchEnd & end) { return end.branch == *branch && end.last != base.last; });
      m_Flow.arrivals[m_Branches.HubOf(base)].push_back(base);
      // What springs on the way comes from the other side now.
      for (const BranchEnd & end : m_Branches.EndsAt(m_Branches.HubOf(base.Other())))
      {
        if (m_Flow.before[end.branch] == *branch && m_Flow.base[end.branch] == end.last)
        {
          m_Flow.before[end.branch] = before;
        }
      }
      m_Flow.base[*branch] = base.Other().last;
      m_Flow.before[*branch] = before;
      m_Turned[*branch] = 1;
      before = *branch;
    }
    if (heir != kNoRoot)
    {
      m_Flow.before[heir] = chain.front();
      m_Turned[heir] = 1;
    }
  }

  /** Whether a piece without heir springs from `parent`, where it seems to stop, rather than from what it seems to
   *  start at: laterals leave forwards. */
  bool
  SpringsRather(const BranchEnd & stop, ElementIndex parent, const BranchEnd & start) const
  {
    const ElementIndex before = m_Flow.before[start.branch];
    if (before == kNoRoot)
    {
      return false;
    }
    const double there = m_Branches.Straightness(m_Flow.Base(parent).Other(), stop);
    const double here = m_Branches.Straightness(m_Flow.Base(before).Other(), start);
    return there - here > kMoreForwards;
  }

  /** The hubs of the contact, with those at the other end of a stretch that two roots may share. */
  std::vector<ElementIndex>
  HubsNear(const BranchEnd & start) const
  {
    std::vector<ElementIndex> hubs = m_Members[ContactAt(start)];
    const std::size_t         count = hubs.size();
    for (std::size_t i = 0; i < count; ++i)
    {
      for (const BranchEnd & end : m_Branches.EndsAt(hubs[i]))
      {
        const ElementIndex other = m_Branches.HubOf(end.Other());
        if (m_Branches.LengthOf(end.branch) <=
              m_Rules.sharedLength * (m_Branches.Radius(start.branch) + m_Branches.Radius(end.branch)) &&
            std::ranges::find(hubs, other) == hubs.end())
        {
          hubs.push_back(other);
        }
      }
    }
    return hubs;
  }

  /** What a pair that begins with this piece turned is worth less: beside a thick root, as in PairBranches(). */
  double
  OfPassing(const BranchEnd & start) const
  {
    const ElementIndex before = m_Flow.before[start.branch];
    return before != kNoRoot && m_Branches.Radius(start.branch) < kThinBeside * m_Branches.Radius(before) ? kOfPassing
                                                                                                          : 0;
  }

  /** What goes on as this piece does when it is turned: a root that seems to spring at the contact, or one that another
   *  goes on as which may go on as such a root instead. */
  ElementIndex
  HeirOf(const BranchEnd & start, const std::vector<ElementIndex> & chain) const
  {
    std::vector<BranchEnd> leaving;
    for (const ElementIndex hub : HubsNear(start))
    {
      for (const BranchEnd & end : m_Branches.EndsAt(hub))
      {
        if (!m_Pairing.inside[end.branch] && m_Flow.base[end.branch] == end.last && !m_Turned[end.branch] &&
            std::ranges::find(chain, end.branch) == chain.end())
        {
          leaving.push_back(end);
        }
      }
    }
    ElementIndex heir = kNoRoot;
    double       best = kLeastPair;
    const double passing = OfPassing(start);
    for (const BranchEnd & end : leaving)
    {
      const ElementIndex partner = m_Partner[end.branch];
      const double       value = m_Branches.PairValue(start, end) - passing;
      if (partner == kNoRoot && value > best)
      {
        best = value;
        heir = end.branch;
      }
      for (const BranchEnd & other : leaving)
      {
        if (partner == kNoRoot || m_Partner[other.branch] != kNoRoot || value <= kLeastPair)
        {
          continue;
        }
        const BranchEnd from = m_Flow.Base(partner).Other();
        const double    both = value + m_Branches.PairValue(from, other) - m_Branches.PairValue(from, end);
        if (m_Branches.PairValue(from, other) > kLeastPair && both > best)
        {
          best = both;
          heir = end.branch;
        }
      }
    }
    return heir;
  }

  /** The thickest branch that comes to the piece's end on another way than by the contact it seems to spring at. */
  ElementIndex
  ParentAt(const BranchEnd & stop, const std::vector<ElementIndex> & chain, ElementIndex heir) const
  {
    ElementIndex parent = kNoRoot;
    for (const ElementIndex hub : m_Members[ContactAt(stop)])
    {
      for (const BranchEnd & end : m_Flow.arrivals[hub])
      {
        if (!m_Pairing.inside[end.branch] && !ComesBy(end.branch, chain, heir) &&
            (parent == kNoRoot || m_Branches.Radius(end.branch) > m_Branches.Radius(parent)))
        {
          parent = end.branch;
        }
      }
    }
    return parent;
  }

  bool
  ComesBy(ElementIndex branch, const std::vector<ElementIndex> & chain, ElementIndex heir) const
  {
    for (; branch != kNoRoot; branch = m_Flow.before[branch])
    {
      if (branch == heir || std::ranges::find(chain, branch) != chain.end())
      {
        return true;
      }
    }
    return false;
  }

  const RootBranches &                   m_Branches;
  const RootPairing &                    m_Pairing;
  RootFlow &                             m_Flow;
  const RootRules &                      m_Rules;
  std::vector<std::uint8_t>              m_Turned;  ///< per branch: it, or what follows it, was turned
  std::vector<ElementIndex>              m_Partner; ///< per branch the one that goes on as it
  std::vector<std::vector<ElementIndex>> m_Members; ///< per contact its hubs
};

} // namespace

std::size_t
TurnBackRoots(const RootBranches & branches, const RootRules & rules, const RootPairing & pairing, RootFlow & flow)
{
  return RootTurner(branches, rules, pairing, flow).Turn();
}

} // namespace voxelcore
