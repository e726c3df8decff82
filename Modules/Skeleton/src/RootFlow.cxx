#include "RootFlow.h"

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

Vector3
UnitVector(const Vector3 & a)
{
  const double length = Length(a);
  return length > 0 ? Vector3{ a[0] / length, a[1] / length, a[2] / length } : Vector3{ 0, 0, 0 };
}

/** Mean radius along the way from a tip inwards, at each junction on by the thickest branch, for `length` mm. */
double
ThicknessFrom(const RootBranches & branches, BranchEnd end, double length)
{
  std::vector<std::uint8_t> taken(branches.Graph().BranchCount(), 0);
  double                    sum = 0;
  double                    way = 0;
  for (;;)
  {
    taken[end.branch] = 1;
    const double step = std::min(branches.LengthOf(end.branch), length - way);
    sum += step * branches.Radius(end.branch);
    way += step;
    std::optional<BranchEnd> next;
    for (const BranchEnd & other : branches.EndsAt(branches.HubOf(end.Other())))
    {
      if (!taken[other.branch] && (!next || branches.Radius(other.branch) > branches.Radius(next->branch)))
      {
        next = other;
      }
    }
    if (!next || way >= length)
    {
      return way > 0 ? sum / way : branches.Radius(end.branch);
    }
    end = *next;
  }
}

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
                              Distance(graph.positions[point], graph.positions[end]) > 1.2 * balls[last]);
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
  const double    near = IsJunction(HubOf(end)) ? 1.2 * BallAt(end) + skip : 0;
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
          std::ranges::none_of(pieces, [&](const BranchEnd & piece) { return piece.branch == other.branch; });
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
  const double far = near + 5 * radius;
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
  return UnitVector(Distance(from, to) < 2 * radius ? Minus(to, start) : Minus(to, from));
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
  return Straightness(arrives, leaves) + 2 * ratio;
}

double
RootBranches::PairValue(const BranchEnd & arrives, const BranchEnd & leaves) const
{
  return Straightness(arrives, leaves) + Likeness(arrives.branch, leaves.branch) - 1;
}

std::vector<BranchEnd>
FindStems(const RootBranches & branches, const std::optional<Vector3> & up, int stems)
{
  struct Candidate
  {
    BranchEnd end;
    double    radius = 0;
    double    height = 0;
  };
  std::vector<Candidate> tips;
  Vector3                least{ 1e300, 1e300, 1e300 };
  Vector3                most{ -1e300, -1e300, -1e300 };
  for (const ElementIndex point : branches.Graph().branchPoints)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      least[axis] = std::min(least[axis], branches.Graph().positions[point][axis]);
      most[axis] = std::max(most[axis], branches.Graph().positions[point][axis]);
    }
  }
  double thickest = 0;
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (ElementIndex hub = 0; hub < branches.HubCount(); ++hub)
  {
    if (branches.EndsAt(hub).size() != 1)
    {
      continue;
    }
    const BranchEnd end = branches.EndsAt(hub).front();
    const Vector3 & place = branches.Graph().positions[branches.PointFrom(end, 0)];
    tips.push_back({ end, ThicknessFrom(branches, end, 0.1 * Distance(least, most)), up ? Dot(place, *up) : 0 });
    thickest = std::max(thickest, tips.back().radius);
    lowest = std::min(lowest, tips.back().height);
    highest = std::max(highest, tips.back().height);
  }
  const double range = highest > lowest ? highest - lowest : 1;
  const auto   value = [&](const Candidate & tip) { return tip.radius / thickest + (tip.height - lowest) / range; };
  std::stable_sort(tips.begin(), tips.end(), [&](const Candidate & a, const Candidate & b) {
    return value(a) > value(b);
  });
  std::vector<BranchEnd> found;
  for (const Candidate & tip : tips)
  {
    const bool isStem = stems > 0 ? static_cast<int>(found.size()) < stems
                                  : found.empty() || (tip.radius >= 0.6 * tips.front().radius &&
                                                      (!up || (tip.height - lowest) / range >= 0.75));
    if (isStem)
    {
      found.push_back(tip.end);
    }
  }
  return found;
}

Vector3
FindUp(const RootBranches & branches, const BranchEnd & stem)
{
  const SkeletonGraph & graph = branches.Graph();
  Vector3               centre{};
  for (const ElementIndex point : graph.branchPoints)
  {
    centre = AddScaled(centre, 1.0 / static_cast<double>(graph.branchPoints.size()), graph.positions[point]);
  }
  const Vector3 away = Minus(graph.positions[branches.PointFrom(stem, 0)], centre);
  std::size_t   axis = 2;
  for (const std::size_t other : { std::size_t{ 1 }, std::size_t{ 0 } })
  {
    axis = std::abs(away[other]) > std::abs(away[axis]) ? other : axis;
  }
  Vector3 up{};
  up[axis] = away[axis] < 0 ? -1 : 1;
  return up;
}

RootFlow
FlowFrom(const RootBranches & branches, const std::vector<BranchEnd> & stems)
{
  const std::size_t count = branches.Graph().BranchCount();
  RootFlow          flow;
  flow.base.assign(count, 0);
  flow.before.assign(count, kNoRoot);
  flow.arrivals.resize(branches.HubCount());
  double total = 0;
  for (ElementIndex branch = 0; branch < count; ++branch)
  {
    total += branches.LengthOf(branch);
  }
  std::vector<std::uint8_t> settled(count, 0);

  // Cost, branch, its base, from where, whether it springs there.
  using Entry = std::tuple<double, ElementIndex, std::uint8_t, ElementIndex, bool>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto                                                     spread = [&] {
    while (!queue.empty())
    {
      const auto [cost, branch, base, before, springs] = queue.top();
      queue.pop();
      if (settled[branch])
      {
        continue;
      }
      settled[branch] = 1;
      flow.base[branch] = base;
      flow.before[branch] = before;
      const BranchEnd far = BranchEnd{ branch, base }.Other();
      flow.arrivals[branches.HubOf(far)].push_back(far);
      // A piece within the root it springs from: what springs there springs from that root.
      const bool isStub = springs && branches.LengthOf(branch) < branches.BallAt({ branch, base });
      // Which of them it goes on as; the others spring from it.
      ElementIndex heir = kNoRoot;
      double       best = -std::numeric_limits<double>::infinity();
      for (const BranchEnd & next : branches.EndsAt(branches.HubOf(far)))
      {
        const double value = branches.Onward(far, next);
        if (!settled[next.branch] && value > best)
        {
          best = value;
          heir = next.branch;
        }
      }
      for (const BranchEnd & next : branches.EndsAt(branches.HubOf(far)))
      {
        if (settled[next.branch])
        {
          continue;
        }
        const double turn = 0.5 * (1 - branches.Straightness(far, next));
        const double thinning = 1 - branches.Likeness(branch, next.branch);
        const bool   thickens = branches.Radius(next.branch) > 1.5 * branches.Radius(branch);
        const double crooked = std::min(1.0, turn + 0.5 * thinning);
        const bool   springsNext = next.branch != heir && !isStub;
        const double step = (springsNext ? 1 : crooked * crooked) + (thickens ? 1 : 0);
        queue.emplace(cost + step + 0.5 * branches.LengthOf(next.branch) / total,
                      next.branch,
                      next.last,
                      branch,
                      springsNext);
      }
    }
  };
  const auto start = [&](const BranchEnd & end, bool isLoose) {
    flow.sources.push_back(end);
    flow.loose.push_back(isLoose);
    queue.emplace(0.0, end.branch, end.last, kNoRoot, false);
  };
  for (const BranchEnd & stem : stems)
  {
    start(stem, false);
  }
  spread();
  // Pieces without a stem: from their thickest tip, or where there is none from any branch.
  for (;;)
  {
    std::optional<BranchEnd> best;
    bool                     bestIsTip = false;
    for (ElementIndex branch = 0; branch < count; ++branch)
    {
      for (const std::uint8_t last : { std::uint8_t{ 0 }, std::uint8_t{ 1 } })
      {
        const BranchEnd end{ branch, last };
        const bool      isTip = branches.EndsAt(branches.HubOf(end)).size() == 1;
        if (!settled[branch] &&
            (!best || std::pair(isTip, branches.Radius(branch)) > std::pair(bestIsTip, branches.Radius(best->branch))))
        {
          best = end;
          bestIsTip = isTip;
        }
      }
    }
    if (!best)
    {
      break;
    }
    start(*best, true);
    spread();
  }
  return flow;
}

std::vector<double>
LengthsBeyond(const RootBranches & branches, const RootFlow & flow)
{
  const std::size_t        count = flow.before.size();
  std::vector<double>      beyond(count, 0);
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
      beyond[branch] += branches.LengthOf(branch);
      open[branch] = count; // done
      const ElementIndex before = flow.before[branch];
      if (before != kNoRoot)
      {
        beyond[before] = std::max(beyond[before], beyond[branch]);
        --open[before];
      }
    }
  }
  return beyond;
}

} // namespace voxelcore
