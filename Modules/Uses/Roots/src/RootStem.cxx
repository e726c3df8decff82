#include "RootStem.h"

#include "RootNumbers.h"
#include "voxelcore/Skeleton/UnitVector.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/UnionFind.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace voxelcore
{

namespace
{

class StemFinder
{
public:
  StemFinder(const RootBranches & branches, const std::optional<Vector3> & up)
    : m_Branches(branches)
    , m_Up(up)
    , m_Forest(branches.HubCount())
    , m_Worth(branches.Graph().BranchCount(), 0)
    , m_Taken(branches.Graph().BranchCount(), 0)
  {
    const SkeletonGraph & graph = branches.Graph();
    for (ElementIndex branch = 0; branch < m_Worth.size(); ++branch)
    {
      const auto points = graph.Branch(branch);
      for (std::size_t i = 1; i < points.size(); ++i)
      {
        const double radius = std::min(graph.radius[points[i - 1]], graph.radius[points[i]]);
        m_Worth[branch] +=
          radius * radius * radius * Distance(graph.positions[points[i - 1]], graph.positions[points[i]]);
      }
    }
    std::vector<ElementIndex> order(m_Worth.size());
    std::iota(order.begin(), order.end(), ElementIndex{ 0 });
    ranges::stable_sort(order, ranges::greater{}, [&](ElementIndex branch) { return branches.Radius(branch); });
    UnionFind sets(branches.HubCount());
    for (const ElementIndex branch : order)
    {
      const ElementIndex a = branches.HubOf({ branch, 0 });
      const ElementIndex b = branches.HubOf({ branch, 1 });
      if (sets.Find(a) != sets.Find(b))
      {
        sets.Unite(a, b);
        m_Forest[a].push_back({ branch, 0 });
        m_Forest[b].push_back({ branch, 1 });
      }
    }
    for (const ElementIndex point : graph.branchPoints)
    {
      m_Centre = AddScaled(m_Centre, 1.0 / static_cast<double>(graph.branchPoints.size()), graph.positions[point]);
    }
  }

  /** The best way of what no other has taken; empty where nothing is left. */
  StemWay
  TakeBest()
  {
    FindBest();
    BranchEnd middle;
    double    best = -1;
    for (ElementIndex branch = 0; branch < m_Worth.size(); ++branch)
    {
      const double value = m_Best[branch][0] + m_Best[branch][1] - m_Worth[branch];
      if (m_IsInForest[branch] && !m_Taken[branch] && value > best)
      {
        best = value;
        middle = { branch, 0 };
      }
    }
    if (best < 0)
    {
      return {};
    }
    StemWay way;
    for (BranchEnd back = middle.Other();; back = *m_Next[back.branch][back.last])
    {
      way.push_back(back.Other());
      if (!m_Next[back.branch][back.last])
      {
        break;
      }
    }
    ranges::reverse(way);
    Extend(way);
    if (Height(way.back().Other()) > Height(way.front()))
    {
      ranges::reverse(way);
      ranges::transform(way, way.begin(), [](const BranchEnd & end) { return end.Other(); });
    }
    return Take(way);
  }

  /** The best way that begins where the skeleton is nearest to the first place; through the others, where there are. */
  StemWay
  TakeThrough(const std::vector<Vector3> & places)
  {
    FindBest();
    StemWay      way;
    ElementIndex at = HubNear(places.front());
    if (places.size() == 1)
    {
      std::optional<BranchEnd> first;
      for (const BranchEnd & end : m_Forest[at])
      {
        if (!first || m_Best[end.branch][end.last] > m_Best[first->branch][first->last])
        {
          first = end;
        }
      }
      if (first)
      {
        way.push_back(*first);
        Extend(way);
      }
      return Take(way);
    }
    for (std::size_t i = 1; i < places.size(); ++i)
    {
      const ElementIndex goal = HubNear(places[i]);
      const StemWay      part = WayTo(at, goal);
      way.insert(way.end(), part.begin(), part.end());
      at = goal;
    }
    return Take(way);
  }

  /** A way up to where it is one of several roots: thinner than the stem from there on, and not much thicker than
   *  others that leave next to it. */
  StemWay
  UpToRoots(StemWay way) const
  {
    const double thickness = Thickness(way);
    std::size_t  first = way.size();
    while (first > 1 && m_Branches.Radius(way[first - 1].branch) < kEndOfStem * thickness)
    {
      --first;
    }
    if (first < way.size() && CountAlikeNear(way, first) >= kWhorl)
    {
      way.resize(first);
    }
    return way;
  }

  double
  HeightOf(const StemWay & way) const
  {
    return Height(way.front());
  }

  /** Mean radius, by worth. */
  double
  Thickness(const StemWay & way) const
  {
    double sum = 0;
    double worth = 0;
    for (const BranchEnd & end : way)
    {
      sum += m_Worth[end.branch] * m_Branches.Radius(end.branch);
      worth += m_Worth[end.branch];
    }
    return worth > 0 ? sum / worth : m_Branches.Radius(way.front().branch);
  }

private:
  /** Per branch and end the worth of the best way that begins there, and how it goes on: from the leaves inwards. */
  void
  FindBest()
  {
    const std::size_t count = m_Worth.size();
    m_Best.assign(count, { -1, -1 });
    m_Next.assign(count, {});
    m_IsInForest.assign(count, 0);
    std::vector<BranchEnd> open;
    for (const auto & ends : m_Forest)
    {
      for (const BranchEnd & end : ends)
      {
        m_IsInForest[end.branch] = 1;
        open.push_back(end);
        while (!open.empty())
        {
          const BranchEnd now = open.back();
          if (m_Best[now.branch][now.last] >= 0 || !OpenWhatFollows(now, open))
          {
            open.pop_back();
          }
        }
      }
    }
  }

  /** Whether something that follows has to be known first; else says what is best from here on. */
  bool
  OpenWhatFollows(const BranchEnd & now, std::vector<BranchEnd> & open)
  {
    const std::size_t        before = open.size();
    const BranchEnd          far = now.Other();
    double                   best = 0;
    std::optional<BranchEnd> follows;
    for (const BranchEnd & next : m_Forest[m_Branches.HubOf(far)])
    {
      if (next.branch == now.branch || m_Taken[next.branch] || !GoesOn(far, next))
      {
        continue;
      }
      const double beyond = m_Best[next.branch][next.last];
      if (beyond < 0)
      {
        open.push_back(next);
      }
      const double value = beyond < 0 ? beyond : beyond * 0.5 * (1 + Straightness(far, next));
      if (value > best)
      {
        best = value;
        follows = next;
      }
    }
    if (open.size() > before)
    {
      return true;
    }
    m_Best[now.branch][now.last] = m_Worth[now.branch] + best;
    m_Next[now.branch][now.last] = follows;
    return false;
  }

  /** cos(turn) from a branch that arrives to where the best way from another on leads beyond the ball there. What lies
   *  within a ball turns as it likes: 1. */
  double
  Straightness(const BranchEnd & arrives, const BranchEnd & leaves) const
  {
    const double ball = m_Branches.BallAt(arrives);
    if (m_Branches.LengthOf(arrives.branch) < ball)
    {
      return 1;
    }
    const auto &             positions = m_Branches.Graph().positions;
    const Vector3 &          start = positions[m_Branches.PointFrom(arrives, 0)];
    Vector3                  ahead = start;
    std::optional<BranchEnd> way = leaves;
    for (std::size_t i = 0; way && Distance(ahead, start) < kStraightReach * ball; ++i)
    {
      ahead = positions[m_Branches.PointFrom(*way, i)];
      if (i + 1 == m_Branches.Graph().Branch(way->branch).size())
      {
        way = m_Next[way->branch][way->last];
        i = 0;
      }
    }
    return -Dot(m_Branches.DirectionFrom(arrives), Unit(Minus(ahead, start)));
  }

  /** The roots about as thick as what follows that leave where a part of a way begins, within the stem's reach. */
  int
  CountAlikeNear(const StemWay & way, std::size_t first) const
  {
    const SkeletonGraph &     graph = m_Branches.Graph();
    std::vector<std::uint8_t> isOfStem(m_Worth.size(), 0);
    for (const BranchEnd & end : way)
    {
      isOfStem[end.branch] = 1;
    }
    const double    ball = m_Branches.BallAt(way[first]);
    const Vector3 & place = graph.positions[m_Branches.PointFrom(way[first], 0)];
    double          thick = 0;
    for (std::size_t i = first; i < way.size() && thick == 0; ++i)
    {
      thick = m_Branches.LengthOf(way[i].branch) > ball ? m_Branches.Radius(way[i].branch) : 0;
    }
    int count = 0;
    for (ElementIndex branch = 0; branch < m_Worth.size(); ++branch)
    {
      const bool isAlike =
        !isOfStem[branch] && m_Branches.LengthOf(branch) > 2 * ball && m_Branches.Radius(branch) > kAsThick * thick;
      for (std::uint8_t last = 0; isAlike && last < 2; ++last)
      {
        count += Distance(place, graph.positions[m_Branches.PointFrom({ branch, last }, 0)]) < kStemReach * ball;
      }
    }
    return count;
  }

  bool
  GoesOn(const BranchEnd & far, const BranchEnd & next) const
  {
    return m_Branches.Likeness(far.branch, next.branch) >= kStemLikeness;
  }

  void
  Extend(StemWay & way) const
  {
    while (const auto next = m_Next[way.back().branch][way.back().last])
    {
      way.push_back(*next);
    }
  }

  StemWay
  Take(const StemWay & way)
  {
    for (const BranchEnd & end : way)
    {
      m_Taken[end.branch] = 1;
    }
    return way;
  }

  /** How much an end looks like a base. */
  double
  Height(const BranchEnd & end) const
  {
    const Vector3 & place = m_Branches.Graph().positions[m_Branches.PointFrom(end, 0)];
    return m_Up ? Dot(place, *m_Up) : Distance(place, m_Centre) * m_Branches.Radius(end.branch);
  }

  /** The node nearest to a place; where the nearest point of the skeleton is within a branch, an end of that. */
  ElementIndex
  HubNear(const Vector3 & place) const
  {
    const SkeletonGraph & graph = m_Branches.Graph();
    ElementIndex          hub = 0;
    double                least = std::numeric_limits<double>::infinity();
    for (ElementIndex branch = 0; branch < m_Worth.size(); ++branch)
    {
      for (const std::uint8_t last : { std::uint8_t{ 0 }, std::uint8_t{ 1 } })
      {
        const double away = Distance(place, graph.positions[m_Branches.PointFrom({ branch, last }, 0)]);
        if (away < least)
        {
          least = away;
          hub = m_Branches.HubOf({ branch, last });
        }
      }
    }
    return hub;
  }

  /** The way in the forest. */
  StemWay
  WayTo(ElementIndex from, ElementIndex goal) const
  {
    std::vector<std::optional<BranchEnd>> by(m_Forest.size());
    std::vector<ElementIndex>             open{ goal };
    std::vector<std::uint8_t>             isSeen(m_Forest.size(), 0);
    isSeen[goal] = 1;
    while (!open.empty() && !isSeen[from])
    {
      const ElementIndex hub = open.back();
      open.pop_back();
      for (const BranchEnd & end : m_Forest[hub])
      {
        const ElementIndex other = m_Branches.HubOf(end.Other());
        if (!isSeen[other])
        {
          isSeen[other] = 1;
          by[other] = end.Other();
          open.push_back(other);
        }
      }
    }
    StemWay way;
    while (from != goal && by[from])
    {
      way.push_back(*by[from]);
      from = m_Branches.HubOf(way.back().Other());
    }
    return way;
  }

  const RootBranches &                                 m_Branches;
  std::optional<Vector3>                               m_Up;
  std::vector<std::vector<BranchEnd>>                  m_Forest; ///< per hub
  std::vector<double>                                  m_Worth;  ///< per branch
  std::vector<std::uint8_t>                            m_Taken;
  std::vector<std::uint8_t>                            m_IsInForest;
  std::vector<std::array<double, 2>>                   m_Best; ///< per branch, from either end on
  std::vector<std::array<std::optional<BranchEnd>, 2>> m_Next;
  Vector3                                              m_Centre{ 0, 0, 0 };
};

} // namespace

std::vector<StemWay>
FindStems(const RootBranches & branches, const std::optional<Vector3> & up, const RootRules & rules)
{
  StemFinder           finder(branches, up);
  std::vector<StemWay> stems;
  if (!rules.stem.empty())
  {
    stems.push_back(finder.TakeThrough(rules.stem));
    return stems.front().empty() ? std::vector<StemWay>() : stems;
  }
  const SkeletonGraph & graph = branches.Graph();
  double                lowest = std::numeric_limits<double>::infinity();
  double                highest = -lowest;
  for (const ElementIndex point : graph.branchPoints)
  {
    const double height = Dot(graph.positions[point], up.value_or(Vector3{ 0, 0, 0 }));
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  while (rules.stems == 0 || static_cast<int>(stems.size()) < rules.stems)
  {
    StemWay    way = finder.TakeBest();
    const bool isFurther = rules.stems == 0 && !stems.empty() && !way.empty();
    if (way.empty() || (isFurther && finder.Thickness(way) < kLeastOfStems * finder.Thickness(stems.front())))
    {
      break;
    }
    if (!isFurther || !up || finder.HeightOf(way) >= highest - kUpperPart * (highest - lowest))
    {
      stems.push_back(finder.UpToRoots(std::move(way)));
    }
  }
  return stems;
}

} // namespace voxelcore
