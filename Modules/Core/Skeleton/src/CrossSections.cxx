#include "voxelcore/Skeleton/CrossSections.h"

#include "BoundaryShares.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Skeleton/DomeBranches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

namespace voxelcore
{

namespace
{

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Zigzag tilts slabs: places are means over so many voxel diagonals to each side, or over a radius.
constexpr double kStraightInDiagonals = 2;

// So many extents of a voxel along the branch tell a section, to each side. With 1.5, the least radius of even tubes in
// thick slices is off by half as much again; with 2.5, short stenoses in thick slices come out wider.
constexpr double kWindowInExtents = 2;

// So many slabs in the extent of a voxel along the branch: with thicker ones, what changes within a slab is lost.
constexpr double kSlabsInExtent = 2;

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

/** The extent of a voxel along a unit vector. */
double
ExtentAlong(const Vector3 & direction, const Vector3 & spacing)
{
  return Dot({ std::abs(direction[0]), std::abs(direction[1]), std::abs(direction[2]) }, spacing);
}

/** A skeleton along the axes of the grid, branch by branch. */
class Sections
{
public:
  Sections(const SkeletonGraph & graph, const ImageGeometry & geometry)
    : m_Points(graph.positions.size())
    , m_Spacing(geometry.spacing)
    , m_Diagonal(Length(geometry.spacing))
  {
    m_Graph.positions = graph.positions;
    for (Vector3 & position : m_Graph.positions)
    {
      position = Times(PhysicalToLattice(geometry, position), geometry.spacing);
    }
    m_Graph.radius = graph.radius;
    m_IsBeyond.assign(m_Points, 0);
    m_Graph.nodePoints = graph.nodePoints;
    m_Graph.nodeKinds = graph.nodeKinds;
    m_Graph.branchNodes = graph.branchNodes;
    TakePoints(graph);
    FindDomes(graph);
    m_Excess.assign(m_Graph.positions.size(), kUnknown);
    for (std::size_t point = 0; point < m_Graph.positions.size(); ++point)
    {
      m_Sites.push_back({ m_Graph.positions[point], m_Graph.radius[point] * m_Graph.radius[point], {} });
    }
    PlaceAcrossBranches();
  }

  std::vector<double>
  Radii(const VoxelShape & shape)
  {
    const std::vector<BoundaryShare> shares = BoundaryShares(shape, m_Spacing, m_Sites);
    for (std::size_t branch = 0; branch < m_Graph.BranchCount(); ++branch)
    {
      if (IsRod(branch, m_Graph.Branch(branch).size()))
      {
        const auto   points = m_Graph.Branch(branch);
        const double radius = RodRadius(2 * shares[points.front()].volume / 3, m_Graph.BranchLength(branch));
        for (const ElementIndex point : points)
        {
          m_Excess[point] = radius - m_Graph.radius[point];
        }
        continue;
      }
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
        m_Excess[point] = RodRadius(2 * shares[point].volume / 3, 0) - m_Graph.radius[point];
      }
    }
    std::vector<double> radii(m_Graph.radius.begin(), m_Graph.radius.begin() + static_cast<std::ptrdiff_t>(m_Points));
    for (std::size_t point = 0; point < radii.size(); ++point)
    {
      const double radius = radii[point] + m_Excess[point];
      // What sections elsewhere are smaller than their balls may be more than a small ball has.
      radii[point] = radius > 0 ? radius : radii[point];
    }
    return radii;
  }

private:
  /** The points of the branches, and between those that lie farther apart than slabs should be thick, more of them: a
   *  core has few where a body is as wide as before. Beyond tips branches go on straight, as far as the body does: what
   *  lies there is in no slab before. */
  void
  TakePoints(const SkeletonGraph & graph)
  {
    for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
    {
      const auto points = graph.Branch(branch);
      if (IsRod(branch, points.size()))
      {
        m_Graph.branchPoints.insert(m_Graph.branchPoints.end(), points.begin(), points.end());
      }
      else
      {
        std::vector<ElementIndex> back(points.rbegin(), points.rend());
        std::vector<ElementIndex> beyond;
        AddBeyondTip(branch, 0, back, beyond);
        ranges::reverse(beyond);
        m_Graph.branchPoints.insert(m_Graph.branchPoints.end(), beyond.begin(), beyond.end());
        for (std::size_t i = 0; i + 1 < points.size(); ++i)
        {
          m_Graph.branchPoints.push_back(points[i]);
          AddBetween(m_Graph.positions[points[i]],
                     m_Graph.radius[points[i]],
                     m_Graph.positions[points[i + 1]],
                     m_Graph.radius[points[i + 1]],
                     m_Graph.branchPoints);
        }
        m_Graph.branchPoints.push_back(points.back());
        AddBeyondTip(branch, 1, { points.begin(), points.end() }, m_Graph.branchPoints);
      }
      m_Graph.branchOffsets.push_back(m_Graph.branchPoints.size());
    }
  }

  void
  AddPoint(Vector3 position, double radius, std::vector<ElementIndex> & points)
  {
    points.push_back(static_cast<ElementIndex>(m_Graph.positions.size()));
    m_Graph.positions.push_back(position);
    m_Graph.radius.push_back(radius);
    m_IsBeyond.push_back(0);
  }

  /** Points between two places and balls. */
  void
  AddBetween(Vector3                     from, // no reference: it may be one of the positions that are added to
             double                      fromRadius,
             Vector3                     to,
             double                      toRadius,
             std::vector<ElementIndex> & points)
  {
    const Vector3 way = Minus(to, from);
    const double  extent = ExtentAlong(way, m_Spacing); // times its length
    const double  parts = extent > 0 ? std::ceil(kSlabsInExtent * Dot(way, way) / extent) : 1;
    for (double part = 1; part < parts; ++part)
    {
      const double at = part / parts;
      AddPoint(AddScaled(from, at, way), (1 - at) * fromRadius + at * toRadius, points);
    }
  }

  /** Goes on beyond the last of a branch's points, where that is a tip. */
  void
  AddBeyondTip(std::size_t                       branch,
               std::size_t                       end,
               const std::vector<ElementIndex> & points,
               std::vector<ElementIndex> &       beyond)
  {
    const Vector3 tip = m_Graph.positions[points.back()];
    const double  radius = m_Graph.radius[points.back()];
    std::size_t   from = points.size() - 1;
    while (from > 0 && Distance(m_Graph.positions[points[from]], tip) < std::max(m_Diagonal, radius))
    {
      --from;
    }
    const Vector3 way = Minus(tip, m_Graph.positions[points[from]]);
    if (Kind(branch, end) == NodeKind::Tip && Length(way) > 0)
    {
      const Vector3     last = AddScaled(tip, (radius + kWindowInExtents * m_Diagonal) / Length(way), way);
      const std::size_t before = m_IsBeyond.size();
      AddBetween(tip, radius, last, radius, beyond);
      AddPoint(last, radius, beyond);
      std::fill(m_IsBeyond.begin() + static_cast<std::ptrdiff_t>(before), m_IsBeyond.end(), std::uint8_t{ 1 });
    }
  }

  /** A ball at a side that a tube's balls do not close off: within it no section of the tube is one. */
  struct Dome
  {
    std::size_t branch = 0; ///< that leads into it
    Vector3     middle{};
    double      radius = 0;
  };

  /** Of each node the greatest dome that a branch leads into there (DomeBranches.h). */
  void
  FindDomes(const SkeletonGraph & graph)
  {
    m_Domes.resize(graph.nodePoints.size());
    for (const DomeBranch & dome : DomesOf(graph))
    {
      const double radius = graph.radius[dome.greatest];
      if (!m_Domes[dome.node] || radius > m_Domes[dome.node]->radius)
      {
        m_Domes[dome.node] = { dome.branch, m_Graph.positions[dome.greatest], radius };
      }
    }
  }

  NodeKind
  Kind(std::size_t branch, std::size_t end) const
  {
    return m_Graph.nodeKinds[m_Graph.branchNodes[branch][end]];
  }

  /** Whether a branch is all of its component and has no section between its ends. */
  bool
  IsRod(std::size_t branch, std::size_t points) const
  {
    return Kind(branch, 0) == NodeKind::Tip && Kind(branch, 1) == NodeKind::Tip && points < 3;
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

  bool
  InJunction(std::size_t branch, ElementIndex point) const
  {
    for (const ElementIndex node : m_Graph.branchNodes[branch])
    {
      const NodeKind kind = m_Graph.nodeKinds[node];
      if (kind == NodeKind::Junction || kind == NodeKind::Surface)
      {
        const ElementIndex centre = m_Graph.nodePoints[node];
        const auto &       dome = m_Domes[node];
        if (Distance(m_Graph.positions[point], m_Graph.positions[centre]) < m_Graph.radius[centre] ||
            (dome && dome->branch != branch &&
             Distance(m_Graph.positions[point], dome->middle) < dome->radius + m_Graph.radius[point] + m_Diagonal))
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
      const double window = std::max(kStraightInDiagonals * m_Diagonal, m_Graph.radius[points[i]]);
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
          if (inside || !InJunction(branch, points[i]))
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
      if (IsRod(branch, m_Graph.Branch(branch).size()))
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

  double
  ExtentAt(ElementIndex point) const
  {
    const double extent = ExtentAlong(m_Sites[point].axis, m_Spacing);
    return extent > 0 ? extent : m_Diagonal; // tips and junctions have no axis
  }

  /** What lies about a point of a branch. */
  struct Slab
  {
    double        at = 0; ///< of the point, along the branch
    double        begin = 0;
    double        end = 0;
    double        length = 0; ///< across its axis; 0 where it is no section
    BoundaryShare share;
  };

  /** The integrals of (1 - x^2) x^k from `begin` to `end`, as far as these lie within -1 and 1. */
  static std::array<double, 5>
  WeightsIn(double begin, double end)
  {
    std::array<double, 5> weights{};
    double                sign = -1;
    for (double x : { std::clamp(begin, -1.0, 1.0), std::clamp(end, -1.0, 1.0) })
    {
      double power = sign * x;
      for (std::size_t k = 0; k < weights.size(); ++k, power *= x)
      {
        const auto n = static_cast<double>(k);
        weights[k] += power / (n + 1) - power * x * x / (n + 3);
      }
      sign = 1;
    }
    return weights;
  }

  /** The area at a point: that of the parabola along the branch that fits best what slabs within a window hold, the
   *  nearest counting most. A mean would widen narrow places and narrow wide ones. Where slabs lie to one side alone, a
   *  parabola could be anything: there it is the mean. What a slab holds reaches as far as the voxels it is in, by
   *  `extent` along the branch. 0 where there is no slab. */
  static double
  AreaAt(std::size_t at, const std::vector<Slab> & slabs, double extent)
  {
    const double          window = kWindowInExtents * extent;
    std::array<double, 5> left{};
    std::array<double, 3> right{};
    double                before = 0;
    double                behind = 0;
    const auto            add = [&](const Slab & slab) {
      if (slab.length <= 0)
      {
        return;
      }
      const auto place = [&](double way) { return (way - slabs[at].at) / window; };
      before = std::max(before, -place(slab.at));
      behind = std::max(behind, place(slab.at));
      const double off = slab.share.volume > 0 ? slab.share.moment / slab.share.volume : 0;
      const double middle = slab.at + std::clamp(off, -extent, extent);
      const auto   room = WeightsIn(place(slab.begin), place(slab.end));
      const auto   held = WeightsIn(place(middle - 0.5 * extent), place(middle + 0.5 * extent));
      for (std::size_t k = 0; k < left.size(); ++k)
      {
        left[k] += window * slab.length / (slab.end - slab.begin) * room[k];
      }
      for (std::size_t k = 0; k < right.size(); ++k)
      {
        right[k] += window * slab.share.volume / extent * held[k];
      }
    };
    const double reach = window + 1.5 * extent; // off its point, and half as long as a voxel
    for (std::size_t i = at; i < slabs.size() && slabs[i].at - slabs[at].at <= reach; ++i)
    {
      add(slabs[i]);
    }
    for (std::size_t i = at; i > 0 && slabs[at].at - slabs[i - 1].at <= reach; --i)
    {
      add(slabs[i - 1]);
    }
    const auto [a, b, c, d, e] = left;
    if (a > 0 && std::min(before, behind) >= 0.5)
    {
      // The parabola's value at 0, by Cramer's rule.
      const double whole = a * (c * e - d * d) - b * (b * e - c * d) + c * (b * d - c * c);
      const double area =
        right[0] * (c * e - d * d) - b * (right[1] * e - d * right[2]) + c * (right[1] * d - c * right[2]);
      if (whole > 1e-9 * a * a * a && area > 0)
      {
        return area / whole;
      }
    }
    return a > 0 ? right[0] / a : 0;
  }

  /** The excess of the section's radius over the ball's, at each point of a branch that lies outside the balls at its
   *  junctions. */
  void
  Measure(std::size_t branch, const std::vector<BoundaryShare> & shares)
  {
    const auto        points = m_Graph.Branch(branch);
    const bool        isLoop = IsLoop(branch);
    const std::size_t count = isLoop ? points.size() - 1 : points.size();
    // Of a closed curve three times around, so that windows need not end.
    const std::size_t rounds = isLoop ? 3 : 1;
    std::vector<Slab> slabs;
    double            way = 0;
    double            behind = 0;
    for (std::size_t i = 0; i < rounds * count; ++i)
    {
      const std::size_t at = i % count;
      const Vector3 &   here = m_Sites[points[at]].place;
      const Vector3 &   next = m_Sites[points[Step(points, at, true, isLoop)]].place;
      const Vector3 &   before = m_Sites[points[Step(points, at, false, isLoop)]].place;
      const bool        isEmpty = m_IsBeyond[points[at]] != 0 && shares[points[at]].volume <= 0;
      const bool   isSection = (isLoop || (at > 0 && at + 1 < count)) && !isEmpty && !InJunction(branch, points[at]);
      const double ahead = 0.5 * Distance(here, next);
      slabs.push_back({ way,
                        way - behind,
                        way + ahead,
                        isSection ? 0.5 * Dot(Minus(next, before), m_Sites[points[at]].axis) : 0,
                        shares[points[at]] });
      way += 2 * ahead;
      behind = ahead;
    }
    const std::size_t begin = isLoop ? count : 0;
    for (std::size_t i = begin; i < begin + count; ++i)
    {
      const ElementIndex point = points[i % count];
      if (InJunction(branch, point))
      {
        continue;
      }
      if (const double area = AreaAt(i, slabs, ExtentAt(point)); area > 0)
      {
        m_Excess[point] = std::sqrt(area / std::numbers::pi) - m_Graph.radius[point];
      }
    }
    if (isLoop)
    {
      m_Excess[points.back()] = m_Excess[points.front()];
    }
  }

  /** Beyond tips bodies close: what is missing there tells nothing of the branch. */
  bool
  IsKnown(ElementIndex point) const
  {
    return !std::isnan(m_Excess[point]) && m_IsBeyond[point] == 0;
  }

  /** Nodes that join branches get the mean of what these have nearest to them, but for what leads into a dome. */
  void
  FillNodes()
  {
    std::vector<double>      sum(m_Graph.nodePoints.size(), 0);
    std::vector<std::size_t> count(m_Graph.nodePoints.size(), 0);
    for (std::size_t branch = 0; branch < m_Graph.BranchCount(); ++branch)
    {
      const auto points = m_Graph.Branch(branch);
      const auto known = [&](ElementIndex point) { return IsKnown(point); };
      const auto add = [&](std::size_t end, auto from, auto to) {
        const auto        nearest = std::find_if(from, to, known);
        const std::size_t node = m_Graph.branchNodes[branch][end];
        if (nearest != to && !(m_Domes[node] && m_Domes[node]->branch == branch))
        {
          sum[node] += m_Excess[*nearest];
          ++count[node];
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
        if (IsKnown(points[i]))
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

  SkeletonGraph                    m_Graph;  ///< nodes, branches and radii; positions in mm along the axes of the grid
  std::size_t                      m_Points; ///< that are in the skeleton itself; the others follow
  std::vector<double>              m_Excess; ///< per point, of the section's radius over the ball's; NaN while unknown
  std::vector<std::uint8_t>        m_IsBeyond; ///< per point, whether it lies beyond a tip
  std::vector<std::optional<Dome>> m_Domes;    ///< per node
  Vector3                          m_Spacing;
  double                           m_Diagonal;
  std::vector<WeightedSite>        m_Sites; ///< per point
};

} // namespace

std::vector<double>
CrossSectionRadii(const SkeletonGraph & graph, const VoxelShape & shape, const ImageGeometry & geometry)
{
  return Sections(graph, geometry).Radii(shape);
}

} // namespace voxelcore
