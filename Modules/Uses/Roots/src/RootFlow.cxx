#include "RootFlow.h"

#include "RootNumbers.h"
#include "voxelcore/Skeleton/UnitVector.h"
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

constexpr std::size_t kMostPieces = 4;

} // namespace

RootBranches::RootBranches(const SkeletonGraph & graph)
  : m_Graph(graph)
  , m_Hubs(NodeHubs(graph))
  , m_HubEnds(m_Hubs.empty() ? 0 : *std::max_element(m_Hubs.begin(), m_Hubs.end()) + std::size_t{ 1 })
  , m_Radius(graph.BranchCount(), 0)
  , m_Length(graph.BranchCount(), 0)
{
  const std::vector<double> & radii = SectionRadii(graph);
  for (ElementIndex branch = 0; branch < graph.BranchCount(); ++branch)
  {
    for (const std::uint8_t last : { std::uint8_t{ 0 }, std::uint8_t{ 1 } })
    {
      m_HubEnds[HubOf({ branch, last })].push_back({ branch, last });
    }
  }
  for (ElementIndex branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto points = graph.Branch(branch);
    m_Length[branch] = graph.BranchLength(branch);
    double                      sums[2] = { 0, 0 };
    int                         counts[2] = { 0, 0 };
    const std::array<double, 2> balls{ BallAt({ branch, 0 }), BallAt({ branch, 1 }) };
    for (const ElementIndex point : points)
    {
      bool outside = true;
      for (const std::uint8_t last : { std::uint8_t{ 0 }, std::uint8_t{ 1 } })
      {
        const ElementIndex end = last ? points.back() : points.front();
        outside = outside && (!IsJunction(HubOf({ branch, last })) ||
                              Distance(graph.positions[point], graph.positions[end]) > kOutsideBall * balls[last]);
      }
      // Of a short stretch between laterals the cross-section may be shared out wrongly; the ball lies within it.
      sums[outside] += std::max(radii[point], graph.radius[point]);
      ++counts[outside];
    }
    const int which = counts[1] > 0 ? 1 : 0;
    m_Radius[branch] = sums[which] / counts[which];
  }
}

Vector3
RootBranches::DirectionFrom(const BranchEnd & end, double skip) const
{
  const Vector3 & start = m_Graph.positions[PointFrom(end, 0)];
  const double    near = IsJunction(HubOf(end)) ? kOutsideBall * BallAt(end) + skip : 0;
  // A junction of many branches may come as several, a short piece apart within the ball: the piece leads where the
  // thickest branch does that leaves its other end.
  std::vector<BranchEnd> pieces{ end };
  while (pieces.size() < kMostPieces)
  {
    const BranchEnd          far = pieces.back().Other();
    std::optional<BranchEnd> next;
    if (IsJunction(HubOf(far)) && Distance(start, m_Graph.positions[PointFrom(far, 0)]) < BallAt(end))
    {
      for (const BranchEnd & other : EndsAt(HubOf(far)))
      {
        const bool isNew =
          ranges::none_of(pieces, [&](const BranchEnd & piece) { return piece.branch == other.branch; });
        if (isNew && HubOf(other.Other()) != HubOf(end) && (!next || m_Radius[other.branch] > m_Radius[next->branch]))
        {
          next = other;
        }
      }
    }
    if (!next)
    {
      break;
    }
    pieces.push_back(*next);
  }
  std::vector<ElementIndex> points;
  for (const BranchEnd & piece : pieces)
  {
    for (std::size_t i = points.empty() ? 0 : 1; i < m_Graph.Branch(piece.branch).size(); ++i)
    {
      points.push_back(PointFrom(piece, i));
    }
  }
  const double radius = m_Radius[pieces.back().branch];
  const double far = near + kDirectionReach * radius;
  std::size_t  first = 0;
  std::size_t  last = 1;
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    const double away = Distance(start, m_Graph.positions[points[i]]);
    first = first + 1 == i && away < near ? i : first;
    last = i;
    if (away >= far)
    {
      break;
    }
  }
  const Vector3 & to = m_Graph.positions[points[last]];
  // Too short to have much outside: from the end itself.
  const Vector3 & from = m_Graph.positions[points[first]];
  return Unit(Distance(from, to) < kLeastDirection * radius ? Minus(to, start) : Minus(to, from));
}

double
RootBranches::Likeness(ElementIndex a, ElementIndex b) const
{
  const double most = std::max(m_Radius[a], m_Radius[b]);
  return most > 0 ? std::min(m_Radius[a], m_Radius[b]) / most : 1;
}

double
RootBranches::Onward(const BranchEnd & arrives, const BranchEnd & leaves) const
{
  const double ratio = std::min(1.0, m_Radius[leaves.branch] / std::max(1e-300, m_Radius[arrives.branch]));
  return Straightness(arrives, leaves) + kOfLikeness * ratio;
}

double
RootBranches::Crooked(double straightness, double likeness)
{
  return 0.5 * (1 - straightness) + kThinningCost * (1 - likeness);
}

namespace
{

/** Spreads from the stems over the branches, always by the cheapest way. */
class FlowSpread
{
public:
  explicit FlowSpread(const RootBranches & branches)
    : m_Branches(branches)
    , m_Count(branches.Graph().BranchCount())
    , m_Settled(m_Count, 0)
  {
    m_Flow.base.assign(m_Count, 0);
    m_Flow.before.assign(m_Count, kNoRoot);
    m_Flow.stemNext.assign(m_Count, kNoRoot);
    m_Flow.isStem.assign(m_Count, 0);
    m_Flow.arrivals.resize(branches.HubCount());
    double total = 0;
    for (ElementIndex branch = 0; branch < m_Count; ++branch)
    {
      total += branches.LengthOf(branch);
      m_Radius += branches.LengthOf(branch) * branches.Radius(branch);
    }
    m_Radius = total > 0 && m_Radius > 0 ? m_Radius / total : 1;
  }

  RootFlow
  From(const std::vector<StemWay> & stems)
  {
    for (const StemWay & stem : stems)
    {
      m_Flow.sources.push_back(stem.front());
      m_Flow.loose.push_back(0);
      for (std::size_t i = 0; i < stem.size(); ++i)
      {
        Settle(stem[i].branch, stem[i].last, i > 0 ? stem[i - 1].branch : kNoRoot);
        m_Flow.isStem[stem[i].branch] = 1;
        m_Flow.stemNext[stem[i].branch] = i + 1 < stem.size() ? stem[i + 1].branch : kNoRoot;
      }
    }
    FindNearStems(stems);
    for (const StemWay & stem : stems)
    {
      for (const BranchEnd & end : stem)
      {
        SpreadBeyond(end.Other(), 0, false);
      }
      SpreadBeyond(stem.front(), 0, false);
    }
    Spread();
    // Pieces without a stem: from their thickest tip, or where there is none from any branch.
    while (const auto source = LooseSource())
    {
      m_Flow.sources.push_back(*source);
      m_Flow.loose.push_back(1);
      m_Queue.emplace(0.0, source->branch, source->last, kNoRoot, false);
      Spread();
    }
    return std::move(m_Flow);
  }

private:
  void
  FindNearStems(const std::vector<StemWay> & stems)
  {
    const SkeletonGraph & graph = m_Branches.Graph();
    m_Flow.nearStem.assign(m_Branches.HubCount(), kNoRoot);
    for (ElementIndex hub = 0; hub < m_Flow.nearStem.size(); ++hub)
    {
      double least = 1;
      for (std::size_t stem = 0; stem < stems.size() && !m_Branches.EndsAt(hub).empty(); ++stem)
      {
        const Vector3 & place = graph.positions[m_Branches.PointFrom(m_Branches.EndsAt(hub).front(), 0)];
        const auto [point, away] = NearestOf(stems[stem], place);
        const double fused = kFusedReach * m_Branches.BallAt(m_Branches.EndsAt(hub).front());
        const double reach = std::max(kStemReach * graph.radius[point], graph.radius[point] + fused);
        if (away < least * reach)
        {
          least = away / reach;
          m_Flow.nearStem[hub] = static_cast<ElementIndex>(stem);
        }
      }
    }
  }

  std::pair<ElementIndex, double>
  NearestOf(const StemWay & stem, const Vector3 & place) const
  {
    std::pair<ElementIndex, double> nearest{ 0, std::numeric_limits<double>::infinity() };
    for (const BranchEnd & end : stem)
    {
      for (const ElementIndex point : m_Branches.Graph().Branch(end.branch))
      {
        const double away = Distance(place, m_Branches.Graph().positions[point]);
        nearest = away < nearest.second ? std::pair(point, away) : nearest;
      }
    }
    return nearest;
  }

  void
  Settle(ElementIndex branch, std::uint8_t base, ElementIndex before)
  {
    m_Settled[branch] = 1;
    m_Flow.base[branch] = base;
    m_Flow.before[branch] = before;
    const BranchEnd far = BranchEnd{ branch, base }.Other();
    m_Flow.arrivals[m_Branches.HubOf(far)].push_back(far);
  }

  void
  Spread()
  {
    while (!m_Queue.empty())
    {
      const auto [cost, branch, base, before, springs] = m_Queue.top();
      m_Queue.pop();
      if (!m_Settled[branch])
      {
        Settle(branch, base, before);
        // A piece within the root it springs from: what springs there springs from that root.
        const bool isStub = springs && m_Branches.LengthOf(branch) < m_Branches.BallAt({ branch, base });
        SpreadBeyond(BranchEnd{ branch, base }.Other(), cost, isStub);
      }
    }
  }

  void
  SpreadBeyond(const BranchEnd & far, double cost, bool isStub)
  {
    // Which of them it goes on as; the others spring from it, all of them from a stem.
    const bool   isNear = m_Flow.nearStem[m_Branches.HubOf(far)] != kNoRoot;
    ElementIndex heir = kNoRoot;
    double       best = -std::numeric_limits<double>::infinity();
    for (const BranchEnd & next : m_Branches.EndsAt(m_Branches.HubOf(far)))
    {
      const double value = m_Branches.Onward(far, next);
      if (!m_Settled[next.branch] && !m_Flow.isStem[far.branch] && value > best)
      {
        best = value;
        heir = next.branch;
      }
    }
    for (const BranchEnd & next : m_Branches.EndsAt(m_Branches.HubOf(far)))
    {
      if (m_Settled[next.branch])
      {
        continue;
      }
      const double likeness = m_Branches.Likeness(far.branch, next.branch);
      const double crooked =
        isNear ? 0 : std::min(1.0, RootBranches::Crooked(m_Branches.Straightness(far, next), likeness));
      const bool springs = !isNear && next.branch != heir && !isStub;
      m_Queue.emplace(cost + crooked * crooked + (springs ? kSpringCost : 0) +
                        kLengthCost * m_Branches.LengthOf(next.branch) / m_Radius,
                      next.branch,
                      next.last,
                      far.branch,
                      springs);
    }
  }

  std::optional<BranchEnd>
  LooseSource() const
  {
    std::optional<BranchEnd> best;
    bool                     bestIsTip = false;
    for (ElementIndex branch = 0; branch < m_Count; ++branch)
    {
      for (const std::uint8_t last : { std::uint8_t{ 0 }, std::uint8_t{ 1 } })
      {
        const BranchEnd end{ branch, last };
        const bool      isTip = m_Branches.EndsAt(m_Branches.HubOf(end)).size() == 1;
        if (!m_Settled[branch] && (!best || std::pair(isTip, m_Branches.Radius(branch)) >
                                              std::pair(bestIsTip, m_Branches.Radius(best->branch))))
        {
          best = end;
          bestIsTip = isTip;
        }
      }
    }
    return best;
  }

  // Cost, branch, its base, from where, whether it springs there.
  using Entry = std::tuple<double, ElementIndex, std::uint8_t, ElementIndex, bool>;

  const RootBranches &                                           m_Branches;
  std::size_t                                                    m_Count;
  double                                                         m_Radius = 0; ///< mean, by length
  std::vector<std::uint8_t>                                      m_Settled;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> m_Queue;
  RootFlow                                                       m_Flow;
};

} // namespace

RootFlow
FlowFrom(const RootBranches & branches, const std::vector<StemWay> & stems)
{
  return FlowSpread(branches).From(stems);
}

std::vector<WhatFollows>
FindWhatFollows(const RootBranches & branches, const RootFlow & flow)
{
  const std::size_t        count = flow.before.size();
  std::vector<WhatFollows> beyond(count);
  std::vector<std::size_t> open(count, 0); // branches that follow and are not done
  for (const ElementIndex before : flow.before)
  {
    if (before != kNoRoot)
    {
      ++open[before];
    }
  }
  for (ElementIndex tip = 0; tip < count; ++tip)
  {
    // From where nothing follows back to where something still has to be done.
    for (ElementIndex branch = tip; branch != kNoRoot && open[branch] == 0; branch = flow.before[branch])
    {
      beyond[branch].length += branches.LengthOf(branch);
      beyond[branch].junctions += branches.IsJunction(branches.HubOf(flow.Base(branch).Other())) ? 1 : 0;
      open[branch] = count; // done
      const ElementIndex before = flow.before[branch];
      if (before != kNoRoot)
      {
        beyond[before].length = std::max(beyond[before].length, beyond[branch].length);
        beyond[before].junctions = std::max(beyond[before].junctions, beyond[branch].junctions);
        --open[before];
      }
    }
  }
  return beyond;
}

} // namespace voxelcore
