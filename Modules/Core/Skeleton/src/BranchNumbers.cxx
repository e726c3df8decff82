#include "BranchNumbers.h"

#include "voxelcore/Lattice/Vectors.h"


#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{

namespace
{

constexpr double kPi = 3.14159265358979323846;

/** Sums along a branch, of the segments that count. */
struct BranchSums
{
  double length = 0;
  double radius = 0;  ///< integral
  double squares = 0; ///< integral
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
  double volume = 0;
  double surface = 0;

  void
  Add(double h, double r, double s)
  {
    length += h;
    radius += 0.5 * h * (r + s);
    squares += h * (r * r + r * s + s * s) / 3;
    least = std::min({ least, r, s });
    most = std::max({ most, r, s });
    volume += kPi / 3 * h * (r * r + r * s + s * s);
    surface += kPi * (r + s) * std::sqrt(h * h + (r - s) * (r - s));
  }

  double
  Mean() const
  {
    return length > 0 ? radius / length : least;
  }
};

bool
HasBall(NodeKind kind)
{
  return kind == NodeKind::Junction || kind == NodeKind::Surface;
}

} // namespace

BranchRecord
MeasureBranch(const SkeletonGraph & graph, std::size_t branch)
{
  const auto   points = graph.Branch(branch);
  const auto & nodes = graph.branchNodes[branch];
  const auto   kind = [&](std::size_t end) { return graph.nodeKinds[nodes[end]]; };
  const auto   inBall = [&](const Vector3 & p, std::size_t end) {
    const ElementIndex centre = graph.nodePoints[nodes[end]];
    return HasBall(kind(end)) && Distance(p, graph.positions[centre]) < graph.radius[centre];
  };
  const auto & widths = SectionRadii(graph);
  BranchSums   all;
  BranchSums   outside;
  BranchSums   ballsOfAll;
  BranchSums   ballsOutside;
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    const Vector3 & a = graph.positions[points[i - 1]];
    const Vector3 & b = graph.positions[points[i]];
    const double    h = Distance(a, b);
    const auto      add = [&](BranchSums & sums, const std::vector<double> & radius) {
      sums.Add(h, radius[points[i - 1]], radius[points[i]]);
    };
    add(all, widths);
    add(ballsOfAll, graph.radius);
    if (!inBall(a, 0) && !inBall(a, 1) && !inBall(b, 0) && !inBall(b, 1))
    {
      add(outside, widths);
      add(ballsOutside, graph.radius);
    }
  }
  const BranchSums & along = outside.length > 0 ? outside : all;
  const BranchSums & balls = outside.length > 0 ? ballsOutside : ballsOfAll;
  BranchRecord       record;
  record.length = all.length;
  record.freeLength = outside.length;
  record.chord = Distance(graph.positions[points.front()], graph.positions[points.back()]);
  record.tortuosity = record.chord > 0 ? record.length / record.chord : std::numeric_limits<double>::infinity();
  record.minRadius = along.least;
  record.maxRadius = along.most;
  record.meanRadius = along.Mean();
  record.meanBallRadius = balls.Mean();
  record.minBallRadius = balls.least;
  record.maxBallRadius = balls.most;
  if (along.length > 0)
  {
    const double variance = along.squares / along.length - record.meanRadius * record.meanRadius;
    record.sdRadius = std::sqrt(std::max(0.0, variance));
  }
  record.volume = outside.volume;
  record.surface = outside.surface;
  const int tips = (kind(0) == NodeKind::Tip) + (kind(1) == NodeKind::Tip);
  record.type = nodes[0] == nodes[1] ? BranchType::Cycle
                : tips == 2          ? BranchType::TipToTip
                : tips == 1          ? BranchType::TipToJunction
                                     : BranchType::JunctionToJunction;
  record.parentAngle = std::numeric_limits<double>::quiet_NaN();
  return record;
}

} // namespace voxelcore
