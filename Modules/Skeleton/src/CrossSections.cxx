#include "voxelcore/CrossSections.h"

#include "BoundaryShares.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace voxelcore
{

namespace
{

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Sections are means over so many voxel diagonals to each side, or over a radius: what a single slab between two points
// of a skeleton gets is a matter of chance.
constexpr double kWindowInDiagonals = 2;

/** The radius of a round rod between two half balls, by its volume and the distance of their centres. */
double
RodRadius(double volume, double length)
{
  double low = 0;
  double high = std::cbrt(std::max(volume, 0.0));
  for (int step = 0; step < 60; ++step)
  {
    const double r = 0.5 * (low + high);
    (std::numbers::pi * r * r * (length + 4 * r / 3) < volume ? low : high) = r;
  }
  return 0.5 * (low + high);
}

/** A skeleton along the axes of the grid, branch by branch. */
class Sections
{
public:
  Sections(const SkeletonGraph & graph, const ImageGeometry & geometry)
    : m_Graph(graph)
    , m_Excess(graph.positions.size(), kUnknown)
    , m_Diagonal(Length(geometry.spacing))
    , m_Sites(graph.positions.size())
  {
    for (std::size_t point = 0; point < graph.positions.size(); ++point)
    {
      m_Sites[point] = { Times(PhysicalToLattice(geometry, graph.positions[point]), geometry.spacing),
                         graph.radius[point] * graph.radius[point],
                         {} };
    }
    PlaceAcrossBranches();
  }

  std::vector<double>
  Radii(const VoxelShape & shape, const Vector3 & spacing)
  {
    const std::vector<double> shares = BoundaryShares(shape, spacing, m_Sites);
    for (std::size_t branch = 0; branch < m_Graph.BranchCount(); ++branch)
    {
      if (IsRod(branch))
      {
        const auto   points = m_Graph.Branch(branch);
        const double radius = RodRadius(2 * shares[points.front()] / 3, m_Graph.BranchLength(branch));
        for (const ElementIndex point : points)
        {
          m_Excess[point] = radius - m_Graph.radius[point];
        }
        continue;
      }
      // The second time it is known how wide the body is.
      Measure(branch, shares);
      Measure(branch, shares);
    }
    FillNodes();
    for (std::size_t branch = 0; branch < m_Graph.BranchCount(); ++branch)
    {
      Fill(branch);
    }
    for (std::size_t node = 0; node < m_Graph.nodePoints.size(); ++node)
    {
      const ElementIndex point = m_Graph.nodePoints[node];
      if (m_Graph.nodeKinds[node] == NodeKind::Isolated)
      {
        m_Excess[point] = RodRadius(2 * shares[point] / 3, 0) - m_Graph.radius[point];
      }
    }
    std::vector<double> radii = m_Graph.radius;
    for (std::size_t point = 0; point < radii.size(); ++point)
    {
      const double radius = radii[point] + m_Excess[point];
      // What sections elsewhere are smaller than their balls may be more than a small ball has.
      radii[point] = radius > 0 ? radius : radii[point];
    }
    return radii;
  }

private:
  NodeKind
  Kind(std::size_t branch, std::size_t end) const
  {
    return m_Graph.nodeKinds[m_Graph.branchNodes[branch][end]];
  }

  /** Whether a branch is all of its component and has no section between its ends. */
  bool
  IsRod(std::size_t branch) const
  {
    return Kind(branch, 0) == NodeKind::Tip && Kind(branch, 1) == NodeKind::Tip && m_Graph.Branch(branch).size() < 3;
  }

  /** The point before or after one of a branch; of a closed curve beyond its ends, too. */
  std::size_t
  Step(std::span<const ElementIndex> points, std::size_t at, bool forward, bool isLoop) const
  {
    const std::size_t last = points.size() - 1;
    if (forward)
    {
      return at < last ? at + 1 : isLoop ? 1 : last;
    }
    return at > 0 ? at - 1 : isLoop ? last - 1 : 0;
  }

  /** The place so far along a branch from one of its points as the chord must be long. */
  Vector3
  Reach(std::span<const ElementIndex> points, std::size_t at, bool forward, bool isLoop, double reach) const
  {
    double way = 0;
    for (std::size_t steps = 0; way < reach && steps < points.size() / 2 + 1; ++steps)
    {
      const std::size_t next = Step(points, at, forward, isLoop);
      if (next == at)
      {
        break;
      }
      way += Distance(m_Sites[points[at]].place, m_Sites[points[next]].place);
      at = next;
    }
    return m_Sites[points[at]].place;
  }

  bool
  IsLoop(std::size_t branch) const
  {
    return Kind(branch, 0) == NodeKind::Loop;
  }

  /** Whether a point lies so near to a tip, for half a width of the body, that the slabs about it reach around the end:
   *  the zigzag of the points tilts them. */
  bool
  IsNearTip(std::size_t branch, double fromFirst, double toLast, double halfWidth) const
  {
    const double near = std::min(halfWidth, 0.25 * (fromFirst + toLast));
    return (Kind(branch, 0) == NodeKind::Tip && fromFirst < near) ||
           (Kind(branch, 1) == NodeKind::Tip && toLast < near);
  }

  /** Half the greatest width, of an ellipse: its area over the least. */
  double
  HalfWidth(ElementIndex point) const
  {
    const double least = m_Graph.radius[point];
    const double excess = std::isnan(m_Excess[point]) ? 0 : m_Excess[point];
    return least > 0 ? (least + excess) * (least + excess) / least : 0;
  }

  bool
  InJunctionBall(std::size_t branch, ElementIndex point) const
  {
    for (const ElementIndex node : m_Graph.branchNodes[branch])
    {
      const NodeKind kind = m_Graph.nodeKinds[node];
      if (kind == NodeKind::Junction || kind == NodeKind::Surface)
      {
        const ElementIndex centre = m_Graph.nodePoints[node];
        if (Distance(m_Graph.positions[point], m_Graph.positions[centre]) < m_Graph.radius[centre])
        {
          return true;
        }
      }
    }
    return false;
  }

  /** Puts each point of a branch into the mean of those before and behind it, as far as the branch goes on to both
   *  sides: zigzag would tilt slabs and axes by different angles, which makes flat bodies seem wider. */
  void
  Straighten(std::span<const ElementIndex> points, bool isLoop)
  {
    std::vector<Vector3> means;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const double window = std::max(kWindowInDiagonals * m_Diagonal, m_Graph.radius[points[i]]);
      Vector3      sum = m_Sites[points[i]].place;
      double       count = 1;
      std::size_t  before = i;
      std::size_t  after = i;
      for (std::size_t steps = 0; steps < points.size() / 2; ++steps)
      {
        const std::size_t nextBefore = Step(points, before, false, isLoop);
        const std::size_t nextAfter = Step(points, after, true, isLoop);
        const Vector3 &   a = m_Sites[points[nextBefore]].place;
        const Vector3 &   b = m_Sites[points[nextAfter]].place;
        const Vector3 &   here = m_Sites[points[i]].place;
        if (nextBefore == before || nextAfter == after || Distance(a, here) > window || Distance(b, here) > window)
        {
          break;
        }
        before = nextBefore;
        after = nextAfter;
        sum = AddScaled(AddScaled(sum, 1, a), 1, b);
        count += 2;
      }
      means.push_back(AddScaled({}, 1 / count, sum));
    }
    for (std::size_t i = isLoop ? 0 : 1; i + 1 < points.size(); ++i)
    {
      m_Sites[points[i]].place = means[i];
    }
  }

  /** Gives the points of each branch one weight, so that faces go to the section they lie in, and their directions.
   *  Points at junctions are as strong as the strongest of their branches. */
  void
  PlaceAcrossBranches()
  {
    std::vector<double> nodeWeight(m_Graph.nodePoints.size(), 0);
    for (std::size_t branch = 0; branch < m_Graph.BranchCount(); ++branch)
    {
      const auto  points = m_Graph.Branch(branch);
      const bool  isLoop = IsLoop(branch);
      double      sum = 0;
      std::size_t count = 0;
      for (const bool inside : { false, true })
      {
        for (std::size_t i = 0; i < points.size() && (!inside || count == 0); ++i)
        {
          if (inside || !InJunctionBall(branch, points[i]))
          {
            sum += m_Graph.radius[points[i]];
            ++count;
          }
        }
      }
      const double mean = sum / static_cast<double>(count);
      for (std::size_t i = 1; i + 1 < points.size(); ++i)
      {
        m_Sites[points[i]].weight = mean * mean;
      }
      for (const ElementIndex node : m_Graph.branchNodes[branch])
      {
        nodeWeight[node] = std::max(nodeWeight[node], mean * mean);
      }
      if (IsRod(branch))
      {
        // One site takes all.
        WeightedSite & one = m_Sites[points.front()];
        one.place = AddScaled(one.place, 0.5, Minus(m_Sites[points.back()].place, one.place));
        m_Sites[points.back()].place = one.place;
        continue;
      }
      Straighten(points, isLoop);
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        const double  reach = std::max(m_Diagonal, m_Graph.radius[points[i]]);
        const Vector3 chord = Minus(Reach(points, i, true, isLoop, reach), Reach(points, i, false, isLoop, reach));
        const double  length = Length(chord);
        if (length > 0 && (isLoop || (i > 0 && i + 1 < points.size())))
        {
          m_Sites[points[i]].axis = AddScaled({}, 1 / length, chord);
        }
      }
    }
    for (std::size_t node = 0; node < nodeWeight.size(); ++node)
    {
      if (nodeWeight[node] > 0)
      {
        m_Sites[m_Graph.nodePoints[node]].weight = nodeWeight[node];
      }
    }
  }

  /** The excess of the section's radius over the ball's, at each point of a branch that lies outside the balls at its
   *  junctions. */
  void
  Measure(std::size_t branch, const std::vector<double> & shares)
  {
    const auto        points = m_Graph.Branch(branch);
    const bool        isLoop = IsLoop(branch);
    const std::size_t count = isLoop ? points.size() - 1 : points.size();
    // Of a closed curve three times around, so that windows need not end.
    const std::size_t   rounds = isLoop ? 3 : 1;
    const double        whole = m_Graph.BranchLength(branch);
    std::vector<double> way(1, 0);
    std::vector<double> length(1, 0); // sums before each point
    std::vector<double> volume(1, 0);
    for (std::size_t i = 0; i < rounds * count; ++i)
    {
      const std::size_t at = i % count;
      const Vector3 &   here = m_Sites[points[at]].place;
      const Vector3 &   next = m_Sites[points[Step(points, at, true, isLoop)]].place;
      const Vector3 &   before = m_Sites[points[Step(points, at, false, isLoop)]].place;
      const bool        isSection = (isLoop || (at > 0 && at + 1 < count)) && !InJunctionBall(branch, points[at]) &&
                             !IsNearTip(branch, way.back(), whole - way.back(), HalfWidth(points[at]));
      const double slab = 0.5 * Dot(Minus(next, before), m_Sites[points[at]].axis);
      way.push_back(way.back() + Distance(here, next));
      length.push_back(length.back() + (isSection ? slab : 0));
      volume.push_back(volume.back() + (isSection ? shares[points[at]] : 0));
    }
    std::size_t       first = 0;
    std::size_t       last = 0;
    const std::size_t begin = isLoop ? count : 0;
    for (std::size_t i = begin; i < begin + count; ++i)
    {
      const ElementIndex point = points[i % count];
      if (InJunctionBall(branch, point))
      {
        continue;
      }
      const double window = std::max(kWindowInDiagonals * m_Diagonal, m_Graph.radius[point]);
      first = i;
      last = i;
      while (first > 0 && way[i] - way[first - 1] <= window)
      {
        --first;
      }
      while (last + 1 < rounds * count && way[last + 1] - way[i] <= window)
      {
        ++last;
      }
      const double stretch = length[last + 1] - length[first];
      const double content = volume[last + 1] - volume[first];
      if (stretch > 0 && content > 0)
      {
        m_Excess[point] = std::sqrt(content / (std::numbers::pi * stretch)) - m_Graph.radius[point];
      }
    }
    if (isLoop)
    {
      m_Excess[points.back()] = m_Excess[points.front()];
    }
  }

  /** Nodes that join branches get the mean of what these have nearest to them. */
  void
  FillNodes()
  {
    std::vector<double>      sum(m_Graph.nodePoints.size(), 0);
    std::vector<std::size_t> count(m_Graph.nodePoints.size(), 0);
    for (std::size_t branch = 0; branch < m_Graph.BranchCount(); ++branch)
    {
      const auto points = m_Graph.Branch(branch);
      const auto known = [&](ElementIndex point) { return !std::isnan(m_Excess[point]); };
      const auto add = [&](std::size_t end, auto from, auto to) {
        const auto nearest = std::find_if(from, to, known);
        if (nearest != to)
        {
          sum[m_Graph.branchNodes[branch][end]] += m_Excess[*nearest];
          ++count[m_Graph.branchNodes[branch][end]];
        }
      };
      if (points.size() > 2)
      {
        add(0, points.begin() + 1, points.end() - 1);
        add(1, points.rbegin() + 1, points.rend() - 1);
      }
    }
    for (std::size_t node = 0; node < sum.size(); ++node)
    {
      const ElementIndex point = m_Graph.nodePoints[node];
      if (std::isnan(m_Excess[point]) && count[node] > 0)
      {
        m_Excess[point] = sum[node] / static_cast<double>(count[node]);
      }
    }
  }

  /** Points without a section of their own get the excess of the nearest one that has one; where there is none, that of
   *  balls in voxels on average. */
  void
  Fill(std::size_t branch)
  {
    const auto          points = m_Graph.Branch(branch);
    std::vector<double> fromBefore(points.size(), std::numeric_limits<double>::infinity());
    std::vector<double> filled(points.size(), 0.25 * m_Diagonal);
    for (const bool forward : { true, false })
    {
      double away = std::numeric_limits<double>::infinity();
      double excess = kUnknown;
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        const std::size_t i = forward ? k : points.size() - 1 - k;
        if (k > 0)
        {
          const std::size_t before = forward ? i - 1 : i + 1;
          away += Distance(m_Graph.positions[points[before]], m_Graph.positions[points[i]]);
        }
        if (!std::isnan(m_Excess[points[i]]))
        {
          away = 0;
          excess = m_Excess[points[i]];
        }
        if (away < fromBefore[i])
        {
          fromBefore[i] = away;
          filled[i] = excess;
        }
      }
    }
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      m_Excess[points[i]] = filled[i];
    }
  }

  const SkeletonGraph &     m_Graph;
  std::vector<double>       m_Excess; ///< per point, of the section's radius over the ball's; NaN while unknown
  double                    m_Diagonal;
  std::vector<WeightedSite> m_Sites; ///< per point
};

} // namespace

std::vector<double>
CrossSectionRadii(const SkeletonGraph & graph, const VoxelShape & shape, const ImageGeometry & geometry)
{
  return Sections(graph, geometry).Radii(shape, geometry.spacing);
}

} // namespace voxelcore
