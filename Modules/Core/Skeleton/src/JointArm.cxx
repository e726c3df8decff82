// A branch from a junction on.

#include "EndByVolume.h"
#include "JointAxes.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

// Directions are taken so far outside a junction's ball: half a radius, and two voxels, or steps of the grid tell.
constexpr double kNearInRadii = 0.5;
constexpr double kNearInVoxels = 2;

} // namespace

Arm
ArmOf(const SkeletonGraph & graph, std::size_t branch, std::size_t end, double diagonal)
{
  const double voxel = diagonal / std::sqrt(3.0);
  const double ball = graph.radius[graph.nodePoints[graph.branchNodes[branch][end]]];
  Arm          arm;
  arm.points.assign(graph.Branch(branch).begin(), graph.Branch(branch).end());
  if (end == 1)
  {
    std::reverse(arm.points.begin(), arm.points.end());
  }
  for (const ElementIndex point : arm.points)
  {
    arm.line.Add(graph.positions[point]);
    arm.radii.push_back(graph.radius[point] + kMeanExcess * diagonal);
  }
  const auto & [places, way] = arm.line;
  std::size_t out = 0;
  while (out < places.size() && Distance(places[out], places[0]) <= ball)
  {
    ++out;
  }
  if (out == places.size())
  {
    return arm;
  }
  arm.leaves = way[out];
  // The middle radius of those behind the ball.
  std::vector<double> radii;
  for (std::size_t i = out; i < places.size() && way[i] <= way[out] + std::max(ball, 3 * voxel); ++i)
  {
    radii.push_back(arm.radii[i]);
  }
  std::nth_element(radii.begin(), radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2), radii.end());
  arm.radius = radii[radii.size() / 2];
  const ElementIndex other = graph.branchNodes[branch][1 - end];
  arm.free = way.back();
  if (graph.nodeKinds[other] != NodeKind::Tip)
  {
    const double reach = graph.radius[graph.nodePoints[other]];
    std::size_t  near = out;
    while (near < places.size() && (way[near] <= 0.5 * way.back() || Distance(places[near], places.back()) > reach))
    {
      ++near;
    }
    arm.free = near < places.size() ? way[near] : way.back();
  }
  const double there = std::min(way[out] + std::max(kNearInRadii * arm.radius, kNearInVoxels * voxel), arm.free);
  arm.direction = Unit(Minus(arm.line.At(there), places[0]));
  return arm;
}

} // namespace voxelcore
