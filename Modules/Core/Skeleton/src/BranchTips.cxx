#include "voxelcore/Skeleton/BranchTips.h"

#include "EndByVolume.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Skeleton/OpenShape.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

// The ends of balls may be off by so much: steps of the grid, and bumps on the cap. On thick rough tubes curves were
// found to end up to half a radius short, on arms of narrow forks 0.7 of one and two diagonals.
constexpr double kMostDiagonals = 2;
constexpr double kMostRadii = 1;

// A branch thinner than this part of a body leaves it as it is. One whose radius differs by no more than this part of
// the body's is the body itself, going on.
constexpr double kThinPart = 0.35;

// Beyond so many of these the body is not looked at.
constexpr int kMostJoints = 4;

/** A branch from a tip on, and where that tip shall lie. */
struct Move
{
  std::vector<ElementIndex> points;
  std::vector<double>       way;
  double                    reach = 0; ///< points go along so far
  Vector3                   tip{};
};

class TipPlacing
{
public:
  TipPlacing(const SkeletonGraph & graph, const VoxelShape & shape, const ImageGeometry & geometry)
    : m_Graph(graph)
    , m_Shape(shape)
    , m_Geometry(geometry)
    , m_Diagonal(Length(geometry.spacing))
    , m_EndsAt(graph.nodePoints.size())
  {
    for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
    {
      for (const std::size_t end : { 0, 1 })
      {
        m_EndsAt[graph.branchNodes[branch][end]].emplace_back(branch, end);
      }
    }
  }

  std::optional<Move>
  Of(std::size_t branch, std::size_t end) const
  {
    Move move;
    move.points = PointsFrom({ branch, end });
    WayLine line;
    for (const ElementIndex point : move.points)
    {
      line.Add(OnGrid(m_Graph.positions[point]));
    }
    std::vector<ElementIndex> points = move.points;
    BranchEnd                 last{ branch, 1 - end };
    for (int step = 0; step < kMostJoints; ++step)
    {
      const auto next = GoesOn(last);
      if (!next)
      {
        break;
      }
      const auto more = PointsFrom(*next);
      for (std::size_t i = 1; i < more.size(); ++i)
      {
        points.push_back(more[i]);
        line.Add(OnGrid(m_Graph.positions[more[i]]));
      }
      last = { next->first, 1 - next->second };
    }
    const ElementIndex other = NodeOf(last);
    const double       free = FreeWay(line, other);
    const double       radius = RadiusNear(points, line, free) + kMeanExcess * m_Diagonal;
    // Where a branch leaves obliquely the other body reaches further along it.
    const bool   isBar = m_Graph.nodeKinds[other] == NodeKind::Tip;
    const double margin = isBar ? 0 : radius;
    const auto   place = FindEndByVolume(m_Shape, m_Geometry.spacing, line, free - margin, radius, isBar);
    if (!place)
    {
      return std::nullopt;
    }
    const Vector3 tip = Over(*place, m_Geometry.spacing);
    move.tip = LatticeToPhysical(m_Geometry, tip);
    const double by = Distance(move.tip, m_Graph.positions[move.points[0]]);
    move.reach = std::max(radius, 2 * by) + m_Diagonal;
    line.way.resize(move.points.size());
    move.way = std::move(line.way);
    const bool isEnd = by <= kMostDiagonals * m_Diagonal + kMostRadii * radius && ContainsInside(m_Shape, tip);
    return isEnd ? std::optional(std::move(move)) : std::nullopt;
  }

private:
  using BranchEnd = std::pair<std::size_t, std::size_t>; ///< a branch and which of its ends

  ElementIndex
  NodeOf(const BranchEnd & end) const
  {
    return m_Graph.branchNodes[end.first][end.second];
  }

  std::vector<ElementIndex>
  PointsFrom(const BranchEnd & end) const
  {
    const auto                points = m_Graph.Branch(end.first);
    std::vector<ElementIndex> from(points.begin(), points.end());
    if (end.second == 1)
    {
      std::reverse(from.begin(), from.end());
    }
    return from;
  }

  /** The radius in the middle of what leaves the ball of a node; 0 where nothing does. */
  double
  RadiusBehind(const BranchEnd & end) const
  {
    const auto         points = PointsFrom(end);
    const ElementIndex centre = m_Graph.nodePoints[NodeOf(end)];
    std::size_t        out = 0;
    while (out < points.size() &&
           Distance(m_Graph.positions[points[out]], m_Graph.positions[centre]) <= m_Graph.radius[centre])
    {
      ++out;
    }
    return out < points.size() ? m_Graph.radius[points[(out + points.size()) / 2]] : 0;
  }

  /** The branch in which a body goes on that ends in a junction, where all others are thin beside it. */
  std::optional<BranchEnd>
  GoesOn(const BranchEnd & here) const
  {
    const ElementIndex node = NodeOf(here);
    if (m_Graph.nodeKinds[node] != NodeKind::Junction)
    {
      return std::nullopt;
    }
    const double             ball = m_Graph.radius[m_Graph.nodePoints[node]];
    std::optional<BranchEnd> onwards;
    for (const BranchEnd & end : m_EndsAt[node])
    {
      const double radius = RadiusBehind(end);
      if (end == here || (radius > 0 && radius <= kThinPart * ball))
      {
        continue;
      }
      if (onwards || std::abs(radius - ball) > kThinPart * ball)
      {
        return std::nullopt;
      }
      onwards = end;
    }
    return onwards;
  }

  Vector3
  OnGrid(const Vector3 & place) const
  {
    return Times(PhysicalToLattice(m_Geometry, place), m_Geometry.spacing);
  }

  /** How far from the tip a branch is nothing but itself: up to where it comes near its other end. */
  double
  FreeWay(const WayLine & line, ElementIndex other) const
  {
    if (m_Graph.nodeKinds[other] == NodeKind::Tip)
    {
      return 0.6 * line.way.back();
    }
    const ElementIndex centre = m_Graph.nodePoints[other];
    const Vector3      place = OnGrid(m_Graph.positions[centre]);
    std::size_t        at = 0;
    while (at < line.way.size() && Distance(line.places[at], place) > m_Graph.radius[centre])
    {
      ++at;
    }
    return at > 0 ? line.way[at - 1] : 0;
  }

  /** That of the balls in a branch behind its cap. */
  double
  RadiusNear(const std::vector<ElementIndex> & points, const WayLine & line, double free) const
  {
    double cap = m_Graph.radius[points[0]];
    for (std::size_t i = 0; i < points.size() && line.way[i] <= std::min(free, 2 * cap); ++i)
    {
      cap = std::max(cap, m_Graph.radius[points[i]]);
    }
    double sum = 0;
    double count = 0;
    for (std::size_t i = 0; i < points.size() && line.way[i] <= std::min(free, 3 * cap + m_Diagonal); ++i)
    {
      const double weight = line.way[i] >= cap ? 1 : 1e-9;
      sum += weight * m_Graph.radius[points[i]];
      count += weight;
    }
    return sum / count;
  }

  const SkeletonGraph & m_Graph;
  const VoxelShape &    m_Shape;
  const ImageGeometry & m_Geometry;
  const double          m_Diagonal;

  std::vector<std::vector<BranchEnd>> m_EndsAt; ///< per node
};

} // namespace

std::size_t
PlaceTips(SkeletonGraph & graph, const VoxelShape & shape, const ImageGeometry & geometry)
{
  const TipPlacing  placing(graph, shape, geometry);
  std::vector<Move> moves;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    for (const std::size_t end : { 0, 1 })
    {
      if (graph.nodeKinds[graph.branchNodes[branch][end]] == NodeKind::Tip && graph.Branch(branch).size() > 2)
      {
        if (auto move = placing.Of(branch, end))
        {
          moves.push_back(std::move(*move));
        }
      }
    }
  }
  const OpenShape inside(shape, geometry);
  for (const Move & move : moves)
  {
    // Bumps on the cap pull the curve this way and that: it goes straight on to the tip.
    std::size_t last = 1;
    while (last + 1 < move.points.size() && move.way[last] < move.reach && 2 * move.way[last + 1] <= move.way.back())
    {
      ++last;
    }
    const Vector3 to = graph.positions[move.points[last]];
    for (std::size_t i = 0; i < last; ++i)
    {
      const double  part = move.way[i] / move.way[last];
      const Vector3 place =
        inside.Towards(graph.medial[move.points[i]], AddScaled(move.tip, part, Minus(to, move.tip)));
      graph.positions[move.points[i]] = place;
      graph.medial[move.points[i]] = place;
    }
  }
  return moves.size();
}

} // namespace voxelcore
