#include "MeasuredGraphs.h"
#include "VesselFixtures.h"

#include "voxelcore/Vessels/FlowNetwork.h"

#include <gtest/gtest.h>

#include <iostream>
#include <numbers>

namespace voxelcore::testing
{

namespace
{

constexpr double kViscosity = 0.0035; // Pa s

/** Steady flow after Poiseuille: pressures of all nodes and flows in all segments, from `from` to `to`. */
struct Flow
{
  std::vector<double> pressure;
  std::vector<double> flow;
};

double
ResistanceOf(const FlowSegment & segment)
{
  return 8 * kViscosity / std::numbers::pi * segment.perRadius4;
}

/** Pressure 1 at inlets and 0 at outlets; Gaussian elimination with pivots. */
Flow
Solve(const FlowNetwork & network)
{
  const std::size_t                n = network.nodes.size();
  std::vector<std::vector<double>> rows(n, std::vector<double>(n + 1, 0.0));
  const auto isInner = [&](std::size_t node) { return network.nodes[node].kind == FlowNodeKind::Inner; };
  for (std::size_t node = 0; node < n; ++node)
  {
    if (!isInner(node))
    {
      rows[node][node] = 1;
      rows[node][n] = network.nodes[node].kind == FlowNodeKind::Inlet ? 1 : 0;
    }
  }
  for (const FlowSegment & segment : network.segments)
  {
    const double conductance = 1 / ResistanceOf(segment);
    for (const auto & [at, other] : { std::pair(segment.from, segment.to), std::pair(segment.to, segment.from) })
    {
      if (isInner(at))
      {
        rows[at][at] += conductance;
        rows[at][other] -= conductance;
      }
    }
  }
  for (std::size_t k = 0; k < n; ++k)
  {
    std::size_t pivot = k;
    for (std::size_t row = k; row < n; ++row)
    {
      pivot = std::abs(rows[row][k]) > std::abs(rows[pivot][k]) ? row : pivot;
    }
    std::swap(rows[k], rows[pivot]);
    for (std::size_t row = 0; row < n; ++row)
    {
      const double factor = row == k ? 0 : rows[row][k] / rows[k][k];
      for (std::size_t column = k; column <= n && factor != 0; ++column)
      {
        rows[row][column] -= factor * rows[k][column];
      }
    }
  }
  Flow solution;
  for (std::size_t node = 0; node < n; ++node)
  {
    solution.pressure.push_back(rows[node][n] / rows[node][node]);
  }
  for (const FlowSegment & segment : network.segments)
  {
    solution.flow.push_back((solution.pressure[segment.from] - solution.pressure[segment.to]) / ResistanceOf(segment));
  }
  return solution;
}

/** The greatest sum of flows at an inner node, over the flow through the inlets. */
double
Imbalance(const FlowNetwork & network, const Flow & solution)
{
  std::vector<double> sum(network.nodes.size(), 0.0);
  double              through = 0;
  for (std::size_t i = 0; i < network.segments.size(); ++i)
  {
    sum[network.segments[i].from] -= solution.flow[i];
    sum[network.segments[i].to] += solution.flow[i];
  }
  double worst = 0;
  for (std::size_t node = 0; node < sum.size(); ++node)
  {
    const bool isInner = network.nodes[node].kind == FlowNodeKind::Inner;
    worst = std::max(worst, isInner ? std::abs(sum[node]) : 0.0);
    through += network.nodes[node].kind == FlowNodeKind::Inlet ? std::abs(sum[node]) : 0.0;
  }
  return worst / through;
}

double
Inflow(const FlowNetwork & network, const Flow & solution)
{
  double sum = 0;
  for (std::size_t i = 0; i < network.segments.size(); ++i)
  {
    const FlowSegment & segment = network.segments[i];
    sum += network.nodes[segment.from].kind == FlowNodeKind::Inlet ? solution.flow[i] : 0;
    sum -= network.nodes[segment.to].kind == FlowNodeKind::Inlet ? solution.flow[i] : 0;
  }
  return sum;
}

FlowNetwork
NetworkOf(const std::vector<MeasuredSkeleton> & parts, const std::vector<Vector3> & inlets)
{
  return MakeFlowNetwork(parts, FindInlets(parts, { inlets, {} }));
}

double
Pipe(double length, double radius)
{
  return 8 * kViscosity * length / (std::numbers::pi * std::pow(radius, 4));
}

} // namespace

TEST(FlowNetwork, AConeHasItsResistance)
{
  GraphOfLines lines;
  lines.Line(lines.Point({ 0, 0, 0 }, 3), lines.Point({ 0, 0, 50 }, 1), 7);
  const FlowNetwork network = NetworkOf({ lines.Measured() }, {});
  ASSERT_EQ(network.segments.size(), 1U);
  const FlowSegment & one = network.segments[0];
  EXPECT_NEAR(one.length, 50, 1e-12);
  EXPECT_NEAR(one.meanRadius, 2, 1e-12);
  EXPECT_EQ(one.leastRadius, 1);
  EXPECT_EQ(one.greatestRadius, 3);
  // The integral of 1 / (3 - 2 s / 50)^4, and of its square root.
  EXPECT_NEAR(one.perRadius4 / (50.0 / 2 * (1 - 1.0 / 27) / 3), 1, 1e-12);
  EXPECT_NEAR(one.perRadius2 / (50.0 / 2 * (1 - 1.0 / 3)), 1, 1e-12);
  EXPECT_NEAR(Pipe(50, one.PoiseuilleRadius()) / ResistanceOf(one), 1, 1e-12);
  EXPECT_EQ(network.nodes[one.from].kind, FlowNodeKind::Inlet);
  EXPECT_EQ(network.nodes[one.to].kind, FlowNodeKind::Outlet);
}

TEST(FlowNetwork, ATreeAndALoopCarryWhatTheirPipesAllow)
{
  // A pipe that parts into two, which meet again; then an outlet, and another one on one of them.
  GraphOfLines       lines;
  const ElementIndex in = lines.Point({ 0, 0, 0 }, 2);
  const ElementIndex split = lines.Point({ 10, 0, 0 }, 2);
  const ElementIndex join = lines.Point({ 30, 0, 0 }, 2);
  const ElementIndex out = lines.Point({ 40, 0, 0 }, 2);
  const ElementIndex way = lines.Point({ 20, 10, 0 }, 2);
  lines.Line(in, split, 5);
  lines.Line(split, way, 5);
  lines.Line(way, join, 5);
  lines.Line(split, join, 8);
  lines.Line(join, out, 5);
  const FlowNetwork network = NetworkOf({ lines.Measured() }, { { -1, 0, 0 } });
  ASSERT_EQ(network.segments.size(), 4U); // `way` is no node
  const Flow   solution = Solve(network);
  const double around = Pipe(2 * std::sqrt(200.0), 2);
  const double straight = Pipe(20, 2);
  const double whole = Pipe(20, 2) + around * straight / (around + straight);
  EXPECT_NEAR(Inflow(network, solution) * whole, 1, 1e-9);
  EXPECT_LT(Imbalance(network, solution), 1e-12);
  for (const double flow : solution.flow)
  {
    EXPECT_GT(flow, 0); // all from the inlet outwards
  }
}

TEST(FlowNetwork, SeveralInletsAndOutletsKeepTheBalance)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  const auto      within = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  GraphOfLines    lines;
  std::vector<ElementIndex> grid;
  for (int i = 0; i < 36; ++i)
  {
    grid.push_back(lines.Point({ 10.0 * (i % 6), 10.0 * (i / 6), 0 }, within(0.5, 2)));
  }
  for (std::size_t i = 0; i < 36; ++i)
  {
    if (i % 6 < 5)
    {
      lines.Line(grid[i], grid[i + 1], 3);
    }
    if (i < 30)
    {
      lines.Line(grid[i], grid[i + 6], 3);
    }
  }
  std::vector<Vector3> inlets;
  for (int i = 0; i < 3; ++i)
  {
    inlets.push_back({ -10, 10.0 * i, 0 });
    lines.Line(lines.Point(inlets.back(), 1), grid[static_cast<std::size_t>(6 * i)], 3);
    lines.Line(lines.Point({ 60, 10.0 * i + 20, 0 }, 1), grid[static_cast<std::size_t>(6 * i + 17)], 3);
  }
  const FlowNetwork network = NetworkOf({ lines.Measured() }, inlets);
  EXPECT_EQ(network.segments.size(), 63U); // three corners of the grid are no nodes
  EXPECT_EQ(std::ranges::count(network.nodes, FlowNodeKind::Inlet, &FlowNode::kind), 3);
  EXPECT_EQ(std::ranges::count(network.nodes, FlowNodeKind::Outlet, &FlowNode::kind), 3);
  const Flow solution = Solve(network);
  EXPECT_GT(Inflow(network, solution), 0);
  EXPECT_LT(Imbalance(network, solution), 1e-12);
}

TEST(FlowNetwork, OfVoxelsHasTheResistanceOfItsTube)
{
  const auto          turn = std::array<Vector3, 3>{ Unit({ 3, 1, 2 }), Unit({ 1, -3, 0 }), Unit({ 6, 2, -10 }) };
  VoxelShape          shape = VoxelsAround({ 45, 45, 45 }, { 1, 1, 1 }, { .1, .2, .3 }, [&](const Vector3 & p) {
    const double along = Dot(p, turn[0]);
    return std::abs(along) <= 40 && Length(AddScaled(p, -along, turn[0])) <= 6;
  });
  const ImageGeometry geometry = GridOf(shape, { 1, 1, 1 });
  MeasuredSkeleton    part;
  part.graph = MeasureBody(std::move(shape), geometry).graph;
  part.table = MeasureBranches(part.graph);
  const FlowNetwork network = NetworkOf({ part }, {});
  ASSERT_EQ(network.segments.size(), 1U);
  // Its ends are half a voxel before those of the tube, and the sections there are smaller by up to a tenth.
  EXPECT_NEAR(ResistanceOf(network.segments[0]) / Pipe(network.segments[0].length, 6), 1, 0.04);
  EXPECT_NEAR(network.segments[0].length, 79, 1.5);
}

} // namespace voxelcore::testing
