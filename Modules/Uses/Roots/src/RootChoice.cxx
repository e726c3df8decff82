#include "RootChoice.h"

#include "RootNumbers.h"
#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <limits>

namespace voxelcore
{

namespace
{

/** Partners of each of some arms by their numbers; an arm without one is its own. */
using Partners = std::vector<std::uint8_t>;

void
AddPartners(Partners & now, std::size_t at, std::vector<Partners> & all)
{
  while (at < now.size() && now[at] != at)
  {
    ++at; // has one
  }
  if (at >= now.size())
  {
    all.push_back(now);
    return;
  }
  AddPartners(now, at + 1, all);
  for (std::size_t other = at + 1; other < now.size(); ++other)
  {
    if (now[other] == other)
    {
      now[at] = static_cast<std::uint8_t>(other);
      now[other] = static_cast<std::uint8_t>(at);
      AddPartners(now, at + 1, all);
      now[at] = static_cast<std::uint8_t>(at);
      now[other] = static_cast<std::uint8_t>(other);
    }
  }
}

/** All choices of partners among so many arms, none first. */
const std::vector<Partners> &
AllPartners(std::size_t arms)
{
  static const auto kAll = [] {
    std::array<std::vector<Partners>, kMostArms + 1> all;
    for (std::size_t count = 0; count < all.size(); ++count)
    {
      Partners now;
      while (now.size() < count)
      {
        now.push_back(static_cast<std::uint8_t>(now.size()));
      }
      AddPartners(now, 0, all[count]);
    }
    return all;
  }();
  return kAll[arms];
}

} // namespace

HierarchyChoice::HierarchyChoice(const RootBranches &        branches,
                                 const RootFlow &            flow,
                                 const RootPairing &         pairing,
                                 std::vector<ElementIndex> & partner)
  : m_Branches(branches)
  , m_Flow(flow)
  , m_Pairing(pairing)
  , m_Partner(partner)
  , m_Arms(branches.HubCount())
  , m_Free(branches.HubCount())
  , m_Direction(partner.size())
  , m_RootOf(partner.size() / 2, kNoRoot)
{
  double total = 0;
  for (ElementIndex arm = 0; arm < partner.size(); ++arm)
  {
    const ElementIndex branch = arm / 2;
    total += 0.5 * branches.LengthOf(branch);
    m_PlaceOf.push_back(pairing.contact[branches.HubOf(EndOf(arm))]);
    if (!pairing.inside[branch])
    {
      m_Direction[arm] = branches.DirectionFrom(EndOf(arm));
      m_Arms[PlaceOf(arm)].push_back(arm);
      if (!flow.isStem[branch])
      {
        m_Free[PlaceOf(arm)].push_back(arm);
      }
    }
  }
  const auto tips = ranges::count(m_Arms, std::size_t{ 1 }, &std::vector<ElementIndex>::size);
  m_Usual = total > 0 ? total / static_cast<double>(std::max<std::ptrdiff_t>(1, tips)) : 1;
}

double
HierarchyChoice::PairCost(ElementIndex a, ElementIndex b) const
{
  return RootBranches::Crooked(-Dot(m_Direction[a], m_Direction[b]), m_Branches.Likeness(a / 2, b / 2)) - kGoingOn;
}

/** Branches put together to roots as partners say. */
void
HierarchyChoice::FollowAll()
{
  m_Roots.clear();
  m_Pairs = 0;
  ranges::fill(m_RootOf, kNoRoot);
  for (ElementIndex branch = 0; branch < m_RootOf.size(); ++branch)
  {
    if (m_Pairing.inside[branch] || m_RootOf[branch] != kNoRoot)
    {
      continue;
    }
    ElementIndex first = 2 * branch;
    while (m_Partner[first] != kNoRoot && m_Partner[first] != 2 * branch + 1)
    {
      first = m_Partner[first] ^ 1U;
    }
    ChosenRoot root;
    root.arms = { first, first ^ 1U };
    for (ElementIndex arm = first;; arm = m_Partner[root.arms[1]])
    {
      m_RootOf[arm / 2] = static_cast<ElementIndex>(m_Roots.size());
      root.length += m_Branches.LengthOf(arm / 2);
      root.arms[1] = arm ^ 1U;
      const ElementIndex next = m_Partner[root.arms[1]];
      if (next == kNoRoot || next == first)
      {
        break;
      }
      m_Pairs += PairCost(root.arms[1], next);
    }
    m_Roots.push_back(root);
  }
}

/** What ends at a place that something reaches springs from that. */
void
HierarchyChoice::Reach(ElementIndex place, ElementIndex parent, std::int32_t level, std::int32_t * children)
{
  if (m_IsReached[place])
  {
    return;
  }
  m_IsReached[place] = 1;
  for (const ElementIndex arm : m_Arms[place])
  {
    const ElementIndex number = m_RootOf[arm / 2];
    ChosenRoot &       root = m_Roots[number];
    if (m_Partner[arm] == kNoRoot && root.level < 0)
    {
      root.level = level;
      root.parent = parent;
      root.arms = root.arms[0] == arm ? root.arms : std::array{ root.arms[1], root.arms[0] };
      m_Order.push_back(number);
      *children += 1;
    }
  }
}

void
HierarchyChoice::FindLevels()
{
  m_Order.clear();
  m_IsReached.assign(m_Arms.size(), 0);
  std::int32_t none = 0;
  for (const BranchEnd & source : m_Flow.sources)
  {
    const ElementIndex number = m_RootOf[source.branch];
    if (number != kNoRoot && m_Roots[number].level < 0)
    {
      ChosenRoot & root = m_Roots[number];
      root.level = 0;
      root.arms = root.arms[1] == ArmOf(source) ? std::array{ root.arms[1], root.arms[0] } : root.arms;
      m_Order.push_back(number);
    }
  }
  for (ElementIndex hub = 0; hub < m_Flow.nearStem.size(); ++hub)
  {
    if (m_Flow.nearStem[hub] != kNoRoot)
    {
      const BranchEnd & source = m_Flow.sources[m_Flow.nearStem[hub]];
      Reach(m_Pairing.contact[hub], source.branch, 1, &m_Roots[m_RootOf[source.branch]].children);
    }
  }
  for (const BranchEnd & source : m_Flow.sources)
  {
    if (m_RootOf[source.branch] == kNoRoot)
    {
      Reach(PlaceOf(ArmOf(source)), source.branch, 1, &none); // a piece that is all contact
    }
  }
  for (std::size_t i = 0; i < m_Order.size(); ++i)
  {
    const ElementIndex number = m_Order[i];
    const auto         level = m_Roots[number].level + 1;
    const auto         last = m_Roots[number].arms[1];
    for (ElementIndex arm = m_Roots[number].arms[0];; arm = m_Partner[arm ^ 1U])
    {
      Reach(PlaceOf(arm), arm / 2, level, &m_Roots[number].children);
      Reach(PlaceOf(arm ^ 1U), arm / 2, level, &m_Roots[number].children);
      if ((arm ^ 1U) == last)
      {
        break;
      }
    }
  }
}

double
HierarchyChoice::Cost()
{
  FollowAll();
  FindLevels();
  double cost = m_Pairs;
  for (const ChosenRoot & root : m_Roots)
  {
    if (root.level < 0)
    {
      cost += kUnreachedCost;
    }
    else if (root.level > 0)
    {
      const bool   isTip[2] = { m_Arms[PlaceOf(root.arms[0])].size() == 1, m_Arms[PlaceOf(root.arms[1])].size() == 1 };
      const double length = root.length / m_Usual;
      cost += kOfLevel * length * (root.level - 1);
      cost += isTip[0] && isTip[1] ? kTwoTipsCost : 0;
      cost += isTip[0] || isTip[1] ? 0 : kNoTipCost * std::min(1.0, length / kShortRoot);
    }
  }
  return cost;
}

/** The least cost of other choices at a place; takes it if it is less than now. */
double
HierarchyChoice::Best(ElementIndex place, bool takes)
{
  const std::vector<ElementIndex> & free = m_Free[place];
  std::vector<ElementIndex>         now;
  for (const ElementIndex arm : free)
  {
    now.push_back(m_Partner[arm]);
  }
  std::vector<ElementIndex> best = now;
  double                    least = std::numeric_limits<double>::infinity();
  const auto                take = [&](const std::vector<ElementIndex> & partners) {
    for (std::size_t i = 0; i < free.size(); ++i)
    {
      m_Partner[free[i]] = partners[i];
    }
  };
  std::vector<ElementIndex> tried(free.size());
  for (const Partners & partners : AllPartners(free.size()))
  {
    bool isSelf = false;
    for (std::size_t i = 0; i < free.size(); ++i)
    {
      tried[i] = partners[i] == i ? kNoRoot : free[partners[i]];
      isSelf = isSelf || tried[i] == (free[i] ^ 1U);
    }
    if (isSelf || tried == now)
    {
      continue;
    }
    take(tried);
    const double cost = Cost();
    if (cost < least)
    {
      least = cost;
      best = tried;
    }
  }
  const bool isBetter = takes && least < m_Now - kLeastGain;
  take(isBetter ? best : now);
  m_Now = isBetter ? least : m_Now;
  return least;
}

void
HierarchyChoice::Search()
{
  m_Now = Cost();
  for (double before = std::numeric_limits<double>::infinity(); m_Now < before;)
  {
    before = m_Now;
    for (ElementIndex place = 0; place < m_Free.size(); ++place)
    {
      if (m_Arms[place].size() > 2 && m_Free[place].size() > 1 && m_Free[place].size() <= kMostArms)
      {
        Best(place, true);
      }
    }
  }
}

double
HierarchyChoice::Margin(ElementIndex place)
{
  return m_Free[place].size() > kMostArms ? 0 : Best(place, false) - m_Now;
}

void
HierarchyChoice::ReachAll()
{
  const auto isCutOff = [&](ElementIndex arm) {
    return m_Partner[arm] != kNoRoot && m_IsReached[PlaceOf(arm)] && m_Roots[m_RootOf[arm / 2]].level < 0;
  };
  for (bool goesOn = true; goesOn;)
  {
    m_Now = Cost();
    goesOn = false;
    for (ElementIndex arm = 0; arm < m_Partner.size() && !goesOn; ++arm)
    {
      goesOn = !m_Pairing.inside[arm / 2] && isCutOff(arm);
      if (goesOn)
      {
        m_Partner[m_Partner[arm]] = kNoRoot;
        m_Partner[arm] = kNoRoot;
      }
    }
  }
}

std::vector<ChosenRoot>
HierarchyChoice::Roots()
{
  m_Now = Cost();
  std::vector<ChosenRoot> roots;
  for (const ElementIndex number : m_Order)
  {
    roots.push_back(m_Roots[number]);
  }
  ranges::copy_if(m_Roots, std::back_inserter(roots), [](const ChosenRoot & root) { return root.level < 0; });
  return roots;
}

} // namespace voxelcore
