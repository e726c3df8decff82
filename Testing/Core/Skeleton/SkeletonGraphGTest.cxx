#include "GraphBuilder.h"
#include "TubeShapes.h"

#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Skeleton/BranchTable.h"

#include <iostream>
#include <numeric>
#include <set>

namespace voxelcore::testing
{
namespace
{

using Line = std::vector<ElementIndex>;

/** Nodes joined by lines at random, some of them loops; points between have no other line. */
struct RandomLines
{
  explicit RandomLines(std::uint64_t seed)
    : random(seed)
  {
    const auto nodes = static_cast<ElementIndex>(random.Between(1, 8));
    const auto point = [&] {
      graph.positions.push_back({ random.Unit(), random.Unit(), random.Unit() });
      graph.radius.push_back(0.1 + random.Unit());
      graph.erosionThickness.push_back(random.Unit());
      return static_cast<ElementIndex>(graph.positions.size() - 1);
    };
    for (ElementIndex node = 0; node < nodes; ++node)
    {
      point();
    }
    degree.assign(nodes, 0);
    for (auto count = random.Between(0, 12); count > 0; --count)
    {
      const auto a = static_cast<ElementIndex>(random.Between(0, nodes - 1));
      const auto b = static_cast<ElementIndex>(random.Between(0, nodes - 1));
      Line       line{ a };
      for (auto between = random.Between(a == b ? 2 : 0, 4); between > 0; --between)
      {
        line.push_back(point());
      }
      line.push_back(b);
      ++degree[a];
      ++degree[b];
      lines.push_back(line);
    }
  }

  /** The same lines cut where nothing meets, in any order and direction. */
  std::vector<Line>
  Pieces()
  {
    std::vector<Line> pieces;
    for (const Line & line : lines)
    {
      Line piece{ line.front() };
      for (std::size_t i = 1; i < line.size(); ++i)
      {
        piece.push_back(line[i]);
        if (i + 1 == line.size() || random.Chance(0.4))
        {
          pieces.push_back(piece);
          piece = { line[i] };
        }
      }
    }
    for (Line & piece : pieces)
    {
      if (random.Chance(0.5))
      {
        std::reverse(piece.begin(), piece.end());
      }
    }
    for (std::size_t i = pieces.size(); i > 1; --i)
    {
      std::swap(pieces[i - 1], pieces[static_cast<std::size_t>(random.Between(0, static_cast<std::int64_t>(i) - 1))]);
    }
    return pieces;
  }

  Random            random;
  SkeletonGraph     graph; ///< points alone
  std::vector<Line> lines;
  std::vector<int>  degree; ///< of the nodes, which are the first points
};

/** Cycles that no other ones make up, of branches. */
std::size_t
CountCycles(const SkeletonGraph & graph)
{
  UnionFind   sets(graph.nodePoints.size());
  std::size_t cycles = 0;
  for (const auto & nodes : graph.branchNodes)
  {
    if (sets.Find(nodes[0]) == sets.Find(nodes[1]))
    {
      ++cycles;
    }
    else
    {
      sets.Unite(nodes[0], nodes[1]);
    }
  }
  return cycles;
}

TEST(SkeletonGraph, BranchesRunFromNodeToNodeHoweverTheLinesWereCut)
{
  constexpr std::uint64_t firstSeed = 20261122;
  std::cout << "seeds from " << firstSeed << '\n';
  for (std::uint64_t seed = firstSeed; seed < firstSeed + 500; ++seed)
  {
    RandomLines   made(seed);
    SkeletonGraph graph = made.graph;
    SortBranches(graph, made.lines, true);
    // Nodes are in the order of their points, of the kind that the number of branch ends says.
    ASSERT_TRUE(std::is_sorted(graph.nodePoints.begin(), graph.nodePoints.end())) << "seed " << seed;
    std::map<ElementIndex, int> ends;
    for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
    {
      const auto points = graph.Branch(branch);
      ASSERT_GE(points.size(), 2U);
      ASSERT_EQ(points.front(), graph.nodePoints[graph.branchNodes[branch][0]]) << "seed " << seed;
      ASSERT_EQ(points.back(), graph.nodePoints[graph.branchNodes[branch][1]]) << "seed " << seed;
      ASSERT_LE(points.front(), points.back()) << "seed " << seed;
      if (branch > 0)
      {
        ASSERT_LE(graph.Branch(branch - 1).front(), points.front()) << "seed " << seed;
      }
      ++ends[points.front()];
      ++ends[points.back()];
    }
    for (std::size_t node = 0; node < graph.nodePoints.size(); ++node)
    {
      const ElementIndex point = graph.nodePoints[node];
      const int          count = ends[point];
      const NodeKind     kind = graph.nodeKinds[node];
      ASSERT_EQ(kind == NodeKind::Isolated, count == 0) << "seed " << seed;
      ASSERT_EQ(kind == NodeKind::Tip, count == 1) << "seed " << seed;
      ASSERT_EQ(kind == NodeKind::Loop, count == 2) << "seed " << seed;
      ASSERT_EQ(kind == NodeKind::Junction, count >= 3) << "seed " << seed;
      if (kind != NodeKind::Loop)
      {
        ASSERT_LT(point, made.degree.size()) << "seed " << seed;
        ASSERT_EQ(count, made.degree[point]) << "seed " << seed;
      }
    }
    for (int round = 0; round < 3; ++round)
    {
      SkeletonGraph again = made.graph;
      SortBranches(again, made.Pieces(), true);
      ASSERT_EQ(again.branchPoints, graph.branchPoints) << "seed " << seed;
      ASSERT_EQ(again.branchOffsets, graph.branchOffsets) << "seed " << seed;
      ASSERT_EQ(again.branchNodes, graph.branchNodes) << "seed " << seed;
      ASSERT_EQ(again.nodePoints, graph.nodePoints) << "seed " << seed;
      ASSERT_EQ(again.nodeKinds, graph.nodeKinds) << "seed " << seed;
    }
  }
}

TEST(SkeletonGraph, LinesThatAreNotJoinedStayApart)
{
  for (std::uint64_t seed = 1; seed <= 100; ++seed)
  {
    RandomLines   made(seed);
    SkeletonGraph graph = made.graph;
    const auto    pieces = made.Pieces();
    SortBranches(graph, pieces, false);
    ASSERT_EQ(graph.BranchCount(), pieces.size()) << "seed " << seed;
    std::multiset<std::set<ElementIndex>> expected;
    std::multiset<std::set<ElementIndex>> found;
    for (std::size_t branch = 0; branch < pieces.size(); ++branch)
    {
      expected.insert({ pieces[branch].begin(), pieces[branch].end() });
      found.insert({ graph.Branch(branch).begin(), graph.Branch(branch).end() });
    }
    ASSERT_EQ(found, expected) << "seed " << seed;
  }
}

TEST(SkeletonGraph, WhatHangsLooseAfterACutStaysOnlyWhereItStandsOut)
{
  // A line of balls of radius 3 with a bypass at each of two places, one of 6, one of 26 in height.
  const auto make = [] {
    SkeletonGraph     graph;
    std::vector<Line> lines;
    const auto        point = [&](double x, double y, double radius) {
      graph.positions.push_back({ x, y, 0 });
      graph.radius.push_back(radius);
      graph.erosionThickness.push_back(0);
      return static_cast<ElementIndex>(graph.positions.size() - 1);
    };
    std::vector<ElementIndex> main;
    for (int x = 0; x <= 60; x += 10)
    {
      main.push_back(point(x, 0, 3));
    }
    lines.push_back({ main[0], main[1] });
    lines.push_back({ main[1], main[2] });
    lines.push_back({ main[2], main[3], main[4] });
    lines.push_back({ main[4], main[5] });
    lines.push_back({ main[5], main[6] });
    lines.push_back({ main[1], point(15, 3, 1), main[2] });
    lines.push_back({ main[4], point(45, 26, 1), main[5] });
    SortBranches(graph, lines, true);
    return graph;
  };
  const auto tips = [](const SkeletonGraph & graph) {
    return std::count(graph.nodeKinds.begin(), graph.nodeKinds.end(), NodeKind::Tip);
  };
  for (const auto & [standOut, expected] : std::vector<std::pair<double, int>>{ { 0, 6 }, { 5, 4 }, { 30, 2 } })
  {
    SkeletonGraph graph = make();
    const auto    cuts = CutLoops(graph);
    ASSERT_EQ(cuts.size(), 2U);
    EXPECT_EQ(tips(graph), 6);
    PruneCutEnds(graph, cuts, standOut);
    EXPECT_EQ(tips(graph), expected) << standOut;
  }
}

TEST(SkeletonGraph, CuttingLeavesAForestOfTheSameLength)
{
  for (std::uint64_t seed = 1; seed <= 300; ++seed)
  {
    RandomLines   made(seed);
    SkeletonGraph graph = made.graph;
    SortBranches(graph, made.lines, true);
    const std::size_t cycles = CountCycles(graph);
    const double      length = TotalLength(graph);
    const double      thickest = *std::max_element(graph.radius.begin(), graph.radius.end());
    const auto        cuts = CutLoops(graph);
    ASSERT_EQ(cuts.size(), cycles) << "seed " << seed;
    ASSERT_EQ(CountCycles(graph), 0U) << "seed " << seed;
    ASSERT_NEAR(TotalLength(graph), length, 1e-12 * (1 + length)) << "seed " << seed;
    for (const LoopCut & cut : cuts)
    {
      ASSERT_LE(cut.radius, thickest);
      // The point became two tips; lines side by side may be cut in one place.
      const auto tips = std::count(graph.positions.begin(), graph.positions.end(), cut.position);
      ASSERT_TRUE(tips >= 2 && tips % 2 == 0) << "seed " << seed;
    }
    ASSERT_TRUE(CutLoops(graph).empty()) << "seed " << seed;
  }
}

TEST(SkeletonGraph, ShortBranchesArePrunedShortestFirst)
{
  SkeletonGraph graph = SmallRoot().Graph();
  // 10 and 20 mm branches go one after another; the 10 goes first, and what it hung on becomes one lateral of 40.
  EXPECT_EQ(PruneBranches(graph, { 12, 0 }), 1U);
  EXPECT_EQ(MeasureBranches(graph).numbers.branches, 5);
  EXPECT_EQ(PruneBranches(graph, { 35, 0 }), 2U); // both ends of the stem; then the laterals are one line
  const BranchTable table = MeasureBranches(graph);
  EXPECT_EQ(table.numbers.branches, 1);
  EXPECT_NEAR(table.numbers.totalLength, 30 + 20 + 40, 1e-9);
}

TEST(SkeletonGraph, MarkedEndsGoAndNothingElse)
{
  constexpr std::uint64_t firstSeed = 20261130;
  std::cout << "seeds from " << firstSeed << '\n';
  std::size_t gone = 0;
  for (std::uint64_t seed = firstSeed; seed < firstSeed + 500; ++seed)
  {
    RandomLines   made(seed);
    SkeletonGraph graph = made.graph;
    SortBranches(graph, made.lines, true);
    const SkeletonGraph       before = graph;
    const SkeletonNumbers     numbers = MeasureBranches(graph).numbers;
    std::vector<std::uint8_t> marked;
    std::set<Vector3>         unmarked; // places on branches that stay whatever happens
    double                    length = 0;
    for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
    {
      marked.push_back(made.random.Chance(0.6) ? 1 : 0);
      length += marked.back() == 0 ? graph.BranchLength(branch) : 0;
      for (const ElementIndex point : graph.Branch(branch))
      {
        if (marked.back() == 0)
        {
          unmarked.insert(graph.positions[point]);
        }
      }
    }
    const std::size_t count = PruneMarked(graph, marked);
    gone += count;
    ASSERT_LE(count, static_cast<std::size_t>(std::count(marked.begin(), marked.end(), 1))) << "seed " << seed;
    ASSERT_GE(TotalLength(graph), length - 1e-12) << "seed " << seed;
    const std::set<Vector3> left(graph.positions.begin(), graph.positions.end());
    ASSERT_TRUE(std::includes(left.begin(), left.end(), unmarked.begin(), unmarked.end())) << "seed " << seed;
    const SkeletonNumbers now = MeasureBranches(graph).numbers;
    ASSERT_EQ(now.components, numbers.components) << "seed " << seed;
    ASSERT_EQ(now.cycles, numbers.cycles) << "seed " << seed;
    if (count == 0)
    {
      ASSERT_EQ(graph.branchPoints, before.branchPoints) << "seed " << seed;
      for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
      {
        const auto isTip = [&](std::size_t end) {
          return graph.nodeKinds[graph.branchNodes[branch][end]] == NodeKind::Tip;
        };
        ASSERT_FALSE(marked[branch] != 0 && isTip(0) != isTip(1)) << "seed " << seed;
      }
    }
  }
  EXPECT_GT(gone, 100U);
}

TEST(SkeletonGraph, BranchesSplitAtJunctionsShareNoPoint)
{
  SkeletonGraph graph = SmallRoot().Graph();
  SplitAtJunctions(graph);
  EXPECT_EQ(graph.BranchCount(), 7U);
  std::vector<int> uses(graph.positions.size(), 0);
  for (const ElementIndex point : graph.branchPoints)
  {
    EXPECT_EQ(++uses[point], 1);
  }
  EXPECT_EQ(MeasureBranches(graph).numbers.components, 7);
}

TEST(SkeletonGraph, PruningGoesByTheRadiusAtTheOtherEndToo)
{
  // Both ends of the stem, of 20, begin at a radius of 3, and the last lateral, of 10, at one of 1.5.
  for (const auto & [ratio, gone] :
       std::vector<std::pair<double, std::size_t>>{ { 0, 0 }, { 6.6, 0 }, { 6.7, 3 }, { 1000, 3 } })
  {
    SkeletonGraph graph = SmallRoot().Graph();
    const double  before = TotalLength(graph);
    EXPECT_EQ(PruneBranches(graph, { 0, ratio }), gone) << ratio;
    EXPECT_EQ(TotalLength(graph) < before, gone > 0) << ratio;
    EXPECT_GE(graph.BranchCount(), 1U) << "a branch between two tips stays";
    std::set<ElementIndex> used(graph.branchPoints.begin(), graph.branchPoints.end());
    EXPECT_EQ(used.size(), graph.positions.size()) << "points on no branch are removed";
  }
}

TEST(SkeletonGraph, PruningFurtherLeavesPartOfWhatWasLeft)
{
  std::size_t shrunk = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
  {
    RandomLines   made(seed);
    SkeletonGraph whole = made.graph;
    SortBranches(whole, made.lines, true);
    for (const bool isRatio : { false, true })
    {
      std::set<Spacing3> before(whole.positions.begin(), whole.positions.end());
      std::int64_t       tipsBefore = MeasureBranches(whole).numbers.tips;
      for (const double limit : { 0.3, 0.6, 0.9, 1.2, 1.6, 2.1, 3.0, 5.0 })
      {
        SkeletonGraph graph = whole;
        PruneBranches(graph, isRatio ? BranchLimit{ 0, limit } : BranchLimit{ limit, 0 });
        const std::set<Spacing3> after(graph.positions.begin(), graph.positions.end());
        ASSERT_TRUE(std::includes(before.begin(), before.end(), after.begin(), after.end()))
          << "seed " << seed << ", limit " << limit << (isRatio ? " radii" : " mm");
        const std::int64_t tips = MeasureBranches(graph).numbers.tips;
        ASSERT_LE(tips, tipsBefore) << "seed " << seed << ", limit " << limit;
        shrunk += tips < tipsBefore ? 1 : 0;
        before = after;
        tipsBefore = tips;
      }
    }
  }
  EXPECT_GT(shrunk, 100U);
}

TEST(SkeletonGraph, PruningToAnyLengthKeepsComponentsAndCycles)
{
  for (std::uint64_t seed = 1; seed <= 300; ++seed)
  {
    RandomLines   made(seed);
    SkeletonGraph graph = made.graph;
    SortBranches(graph, made.lines, true);
    const auto components = [&] { return MeasureBranches(graph).numbers.components; };
    const auto cycles = CountCycles(graph);
    const auto pieces = components();
    PruneBranches(graph, { std::numeric_limits<double>::infinity(), 0 });
    ASSERT_EQ(components(), pieces) << "seed " << seed;
    ASSERT_EQ(CountCycles(graph), cycles) << "seed " << seed;
    for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
    {
      const auto isTip = [&](ElementIndex node) { return graph.nodeKinds[node] == NodeKind::Tip; };
      ASSERT_EQ(isTip(graph.branchNodes[branch][0]), isTip(graph.branchNodes[branch][1])) << "seed " << seed;
    }
  }
}

TEST(SkeletonGraph, NodesOnOneSurfaceAreOneHub)
{
  // Two sheets side by side; a curve from one to the other, one that leaves the first, and one by itself.
  SurfaceBuilder builder;
  builder.Sheet({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2);
  builder.Sheet({ 10, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2);
  builder.Edge(builder.Point(2, 0, 0), builder.Point(6, 0, 0));
  builder.Edge(builder.Point(6, 0, 0), builder.Point(10, 0, 0));
  builder.Edge(builder.Point(0, 2, 0), builder.Point(-4, 2, 0));
  builder.Edge(builder.Point(0, 20, 0), builder.Point(5, 20, 0));
  CurveSkeleton skeleton;
  skeleton.complex = builder.Surface();
  skeleton.places = skeleton.complex.positions;
  skeleton.erosionThickness.assign(skeleton.places.size(), 0);
  skeleton.closedFace.assign(skeleton.complex.cells.FaceCount(), 0);
  const SkeletonGraph graph = BuildSkeletonGraph(skeleton);
  EXPECT_EQ(graph.FaceCount(), 8U);
  ASSERT_EQ(graph.BranchCount(), 3U) << "edges of faces are none";
  const auto                       hubs = NodeHubs(graph);
  std::map<Spacing3, ElementIndex> hubAt;
  for (std::size_t node = 0; node < hubs.size(); ++node)
  {
    const ElementIndex point = graph.nodePoints[node];
    hubAt[graph.positions[point]] = hubs[node];
    EXPECT_EQ(graph.nodeKinds[node] == NodeKind::Surface,
              std::count(graph.faceVertices.begin(), graph.faceVertices.end(), point) > 0);
  }
  ASSERT_EQ(hubAt.size(), 6U);
  EXPECT_EQ(hubAt.at({ 2, 0, 0 }), hubAt.at({ 0, 2, 0 })) << "on one sheet";
  const std::set<ElementIndex> different(hubs.begin(), hubs.end());
  EXPECT_EQ(different.size(), 5U) << "all others are their own";
}

} // namespace
} // namespace voxelcore::testing
