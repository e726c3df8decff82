#include "LabelChoices.h"

#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace voxelcore
{

namespace
{

/** A change of label costs so many radii: a piece of a label whose borders lie right across the branch stays where it
 *  is at least twice as long. */
constexpr double kChangeInRadii = 0.25;

/** Balls are sampled at about so many places along their radius at most; 8 keep shares to about a hundredth. */
constexpr double kSamplesAlongRadius = 8;

constexpr ElementIndex kNoPoint = 0xFFFFFFFFU;

struct GraphSegment
{
  ElementIndex a;
  ElementIndex b;
  double       length;
};

std::vector<GraphSegment>
GraphSegments(const SkeletonGraph & graph)
{
  std::vector<GraphSegment> segments;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto points = graph.Branch(branch);
    for (std::size_t i = 1; i < points.size(); ++i)
    {
      segments.push_back(
        { points[i - 1], points[i], Distance(graph.positions[points[i - 1]], graph.positions[points[i]]) });
    }
  }
  return segments;
}

const LabelShare &
LargestShare(const std::vector<LabelShare> & shares)
{
  return *std::max_element(shares.begin(), shares.end(), [](const LabelShare & a, const LabelShare & b) {
    return a.share < b.share;
  });
}

/** By how much the largest share exceeds the next. */
double
LeadOfLargest(const std::vector<LabelShare> & shares)
{
  const LabelShare & best = LargestShare(shares);
  double             next = 0;
  for (const LabelShare & one : shares)
  {
    next = one.label == best.label ? next : std::max(next, one.share);
  }
  return best.share - next;
}

/** Segments that make a forest: of each cycle the most certain one is left out. */
std::vector<GraphSegment>
ForestOf(const std::vector<GraphSegment> & segments, const LabelShares & shares)
{
  std::vector<double> certainty;
  for (const GraphSegment & segment : segments)
  {
    const bool isOne = LargestShare(shares[segment.a]).label == LargestShare(shares[segment.b]).label;
    certainty.push_back(isOne ? std::min(LeadOfLargest(shares[segment.a]), LeadOfLargest(shares[segment.b])) : -1);
  }
  std::vector<std::size_t> order(segments.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return certainty[a] < certainty[b];
  });
  UnionFind                 trees(shares.size());
  std::vector<GraphSegment> forest;
  for (const std::size_t i : order)
  {
    if (trees.Find(segments[i].a) != trees.Find(segments[i].b))
    {
      trees.Unite(segments[i].a, segments[i].b);
      forest.push_back(segments[i]);
    }
  }
  return forest;
}

/** The cheapest labels on a forest, from its leaves to its roots and back. */
class ForestChoice
{
public:
  ForestChoice(const SkeletonGraph &             graph,
               const std::vector<GraphSegment> & segments,
               const LabelShares &               shares,
               const LabelPairs &                touching)
    : m_Graph(graph)
    , m_Shares(shares)
    , m_Touching(touching)
    , m_Forest(ForestOf(segments, shares))
    , m_Weight(shares.size(), 0)
    , m_Up(shares.size(), kNoPoint)
  {
    double length = 0;
    for (const GraphSegment & segment : segments)
    {
      m_Weight[segment.a] += 0.5 * segment.length;
      m_Weight[segment.b] += 0.5 * segment.length;
      length += segment.length;
    }
    double change = 0;
    for (const double radius : graph.radius)
    {
      change = std::max(change, kChangeInRadii * radius);
    }
    m_Apart = 1 + length + change * static_cast<double>(shares.size());
    Order();
  }

  /** Points with a label in `pinned` have that. */
  std::vector<std::uint32_t>
  Choose(const std::vector<std::optional<std::uint32_t>> & pinned) const
  {
    const std::size_t                     count = m_Shares.size();
    std::vector<std::vector<double>>      costs(count);
    std::vector<std::vector<std::size_t>> choices(count); // of a point, by the choice of the one above
    for (std::size_t point = 0; point < count; ++point)
    {
      for (const LabelShare & one : m_Shares[point])
      {
        const bool isBarred = pinned[point] && *pinned[point] != one.label;
        costs[point].push_back(isBarred ? std::numeric_limits<double>::infinity() : m_Weight[point] * (1 - one.share));
      }
    }
    for (auto at = m_Order.rbegin(); at != m_Order.rend(); ++at)
    {
      const ElementIndex point = *at;
      const ElementIndex up = m_Up[point];
      if (up == kNoPoint)
      {
        continue;
      }
      for (std::size_t above = 0; above < m_Shares[up].size(); ++above)
      {
        std::size_t best = 0;
        double      least = std::numeric_limits<double>::infinity();
        for (std::size_t own = 0; own < m_Shares[point].size(); ++own)
        {
          const double cost =
            costs[point][own] + ChangeCost(point, up, m_Shares[point][own].label, m_Shares[up][above].label);
          if (cost < least)
          {
            least = cost;
            best = own;
          }
        }
        choices[point].push_back(best);
        costs[up][above] += least;
      }
    }
    std::vector<std::size_t>   chosen(count, 0);
    std::vector<std::uint32_t> labels(count, 0);
    for (const ElementIndex point : m_Order)
    {
      const ElementIndex up = m_Up[point];
      chosen[point] =
        up == kNoPoint
          ? static_cast<std::size_t>(std::min_element(costs[point].begin(), costs[point].end()) - costs[point].begin())
          : choices[point][chosen[up]];
      labels[point] = m_Shares[point][chosen[point]].label;
    }
    return labels;
  }

private:
  double
  ChangeCost(ElementIndex a, ElementIndex b, std::uint32_t of, std::uint32_t to) const
  {
    if (of == to)
    {
      return 0;
    }
    const bool touch = m_Touching.contains({ std::min(of, to), std::max(of, to) });
    return touch ? kChangeInRadii * 0.5 * (m_Graph.radius[a] + m_Graph.radius[b]) : m_Apart;
  }

  /** Points behind those they hang on. */
  void
  Order()
  {
    const std::size_t                      count = m_Shares.size();
    std::vector<std::vector<ElementIndex>> next(count);
    for (const GraphSegment & segment : m_Forest)
    {
      next[segment.a].push_back(segment.b);
      next[segment.b].push_back(segment.a);
    }
    std::vector<std::uint8_t> seen(count, 0);
    for (std::size_t root = 0; root < count; ++root)
    {
      if (seen[root])
      {
        continue;
      }
      seen[root] = 1;
      std::size_t at = m_Order.size();
      m_Order.push_back(static_cast<ElementIndex>(root));
      for (; at < m_Order.size(); ++at)
      {
        for (const ElementIndex other : next[m_Order[at]])
        {
          if (!seen[other])
          {
            seen[other] = 1;
            m_Up[other] = m_Order[at];
            m_Order.push_back(other);
          }
        }
      }
    }
  }

  const SkeletonGraph &     m_Graph;
  const LabelShares &       m_Shares;
  const LabelPairs &        m_Touching;
  std::vector<GraphSegment> m_Forest;
  std::vector<double>       m_Weight; ///< mm
  std::vector<ElementIndex> m_Up;
  std::vector<ElementIndex> m_Order;
  double                    m_Apart = 0; ///< more than any choice costs otherwise
};

} // namespace

double
ShareOf(const std::vector<LabelShare> & shares, std::uint32_t label)
{
  const auto found = ranges::find(shares, label, &LabelShare::label);
  return found == shares.end() ? 0 : found->share;
}

LabelShares
FindLabelShares(const SkeletonGraph & graph, const std::vector<LabelShape> & labels, const ImageGeometry & geometry)
{
  const LabelSlices slices(labels);
  const VoxelBox &  box = slices.Box();
  const double      diagonal = Length(geometry.spacing);
  LabelShares       shares(graph.positions.size());
  for (std::size_t point = 0; point < shares.size(); ++point)
  {
    const Vector3 centre = PhysicalToLattice(geometry, graph.positions[point]);
    for (double radius = std::max(graph.radius[point], diagonal); shares[point].empty(); radius *= 2)
    {
      std::array<std::int32_t, 3> lower{};
      std::array<std::int32_t, 3> upper{};
      std::array<std::int32_t, 3> step{};
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const double reach = radius / geometry.spacing[axis];
        step[axis] = std::max(1, static_cast<std::int32_t>(reach / kSamplesAlongRadius));
        lower[axis] = std::max(box.lower[axis], static_cast<std::int32_t>(std::floor(centre[axis] - reach)));
        upper[axis] =
          std::min(box.lower[axis] + box.size[axis] - 1, static_cast<std::int32_t>(std::floor(centre[axis] + reach)));
      }
      std::vector<std::uint32_t> near;
      for (std::uint32_t label = 0; label < labels.size(); ++label)
      {
        const VoxelBox & own = labels[label].shape.Box();
        bool             meets = true;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          meets = meets && own.lower[axis] <= upper[axis] && own.lower[axis] + own.size[axis] > lower[axis];
        }
        if (meets)
        {
          near.push_back(label);
        }
      }
      std::vector<std::uint64_t> counts(near.size(), 0);
      std::uint64_t              all = 0;
      for (std::int32_t z = lower[2]; z <= upper[2]; z += step[2])
      {
        for (std::int32_t y = lower[1]; y <= upper[1]; y += step[1])
        {
          for (std::int32_t x = lower[0]; x <= upper[0]; x += step[0])
          {
            const Vector3 off = Times(Minus({ x + 0.5, y + 0.5, z + 0.5 }, centre), geometry.spacing);
            if (Dot(off, off) > radius * radius)
            {
              continue;
            }
            const auto owner =
              ranges::find_if(near, [&](std::uint32_t label) { return labels[label].shape.Contains(x, y, z); });
            if (owner != near.end())
            {
              ++counts[static_cast<std::size_t>(owner - near.begin())];
              ++all;
            }
          }
        }
      }
      for (std::size_t i = 0; i < near.size(); ++i)
      {
        if (counts[i] > 0)
        {
          shares[point].push_back({ near[i], static_cast<double>(counts[i]) / static_cast<double>(all) });
        }
      }
    }
  }
  return shares;
}

std::vector<std::uint32_t>
ChooseLabels(const SkeletonGraph & graph, const LabelShares & shares, const LabelPairs & touching, std::size_t labels)
{
  const std::vector<GraphSegment>           segments = GraphSegments(graph);
  const ForestChoice                        choice(graph, segments, shares, touching);
  std::vector<std::optional<std::uint32_t>> pinned(shares.size());
  for (;;)
  {
    std::vector<std::uint32_t> chosen = choice.Choose(pinned);
    std::vector<std::uint8_t>  isThere(labels, 0);
    for (const std::uint32_t label : chosen)
    {
      isThere[label] = 1;
    }
    bool more = false;
    for (std::uint32_t label = 0; label < labels; ++label)
    {
      if (isThere[label])
      {
        continue;
      }
      double      most = 0;
      std::size_t best = 0;
      for (std::size_t point = 0; point < shares.size(); ++point)
      {
        const double share = pinned[point] ? 0 : ShareOf(shares[point], label);
        if (share > most)
        {
          most = share;
          best = point;
        }
      }
      if (most > 0)
      {
        pinned[best] = label;
        more = true;
      }
    }
    if (!more)
    {
      return chosen;
    }
  }
}

} // namespace voxelcore
