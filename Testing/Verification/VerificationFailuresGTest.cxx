// Every check is shown to fail on a core damaged in just that way.
#include "Verification/VerificationFixtures.h"
#include "Complex/ComplexFixtures.h"
#include "voxelcore/SimplePairCollapse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

using Names = std::vector<std::string>;

VerificationCase
GoodCase(double threshold = 0)
{
  return MakeCase(EllipsoidWithRod(), { 0.5, 0.5, 1.0 }, threshold);
}

/** The checks that fail, with a sentence each; empty sentences count as failures of the test. */
Names
Failures(const VerificationCase & subject)
{
  const VerificationReport report = Verify(subject);
  for (const VerificationCheck & check : report.checks)
  {
    EXPECT_EQ(check.passed, check.firstOffender.empty()) << check.name;
    if (!check.passed && !check.firstOffender.empty())
    {
      EXPECT_TRUE(check.firstOffender[0] >= 'A' && check.firstOffender[0] <= 'Z') << check.firstOffender;
      EXPECT_EQ(check.firstOffender.back(), '.') << check.firstOffender;
    }
  }
  EXPECT_EQ(report.passed, FailedChecks(report).empty());
  return FailedChecks(report);
}

void
ExpectFails(const VerificationCase & subject, const Names & checks)
{
  const Names failed = Failures(subject);
  for (const std::string & check : checks)
  {
    EXPECT_TRUE(std::find(failed.begin(), failed.end(), check) != failed.end())
      << check << " did not fail, but " << ::testing::PrintToString(failed);
  }
}

/** A face with at least so many corners. */
std::size_t
FaceWithCorners(const CellComplex & cells, std::size_t corners)
{
  for (std::size_t f = 0; f < cells.FaceCount(); ++f)
  {
    if (cells.FaceVertices(f).size() >= corners)
    {
      return f;
    }
  }
  ADD_FAILURE() << "no face with " << corners << " corners";
  return 0;
}

std::size_t
EdgeWithoutFace(const CellComplex & cells)
{
  std::vector<bool> onFace(cells.edges.size(), false);
  for (const ElementIndex edge : cells.faceEdges)
  {
    onFace[edge] = true;
  }
  const auto found = std::find(onFace.begin(), onFace.end(), false);
  EXPECT_TRUE(found != onFace.end());
  return static_cast<std::size_t>(found - onFace.begin());
}

/** Drops elements; what is left keeps its order and measures. */
void
Keep(MedialComplex & core, const LiveElements & live)
{
  std::vector<ElementIndex> vertices;
  std::vector<ElementIndex> edges;
  std::vector<ElementIndex> faces;
  core.cells = ExtractLive(core.cells, live, vertices, edges, faces);
  const auto gather = [](auto & values, const std::vector<ElementIndex> & ids) {
    auto kept = values;
    kept.clear();
    for (const ElementIndex id : ids)
    {
      kept.push_back(values[id]);
    }
    values = kept;
  };
  gather(core.positions, vertices);
  gather(core.radius, vertices);
  gather(core.vertexLambda, vertices);
  gather(core.edgeLambda, edges);
  gather(core.faceLambda, faces);
}

LiveElements
AllOf(const CellComplex & cells)
{
  return { std::vector<std::uint8_t>(cells.vertexCount, 1),
           std::vector<std::uint8_t>(cells.edges.size(), 1),
           std::vector<std::uint8_t>(cells.FaceCount(), 1) };
}

/** Appends a face with the given corners; its sides must be edges already. */
void
AppendFace(MedialComplex & core, const std::vector<ElementIndex> & corners, double lambda)
{
  CellComplex & cells = core.cells;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const ElementIndex next = corners[(i + 1) % corners.size()];
    const std::array   ends{ std::min(corners[i], next), std::max(corners[i], next) };
    const auto         edge = std::find(cells.edges.begin(), cells.edges.end(), ends);
    ASSERT_TRUE(edge != cells.edges.end());
    cells.faceVertices.push_back(corners[i]);
    cells.faceEdges.push_back(static_cast<ElementIndex>(edge - cells.edges.begin()));
  }
  cells.faceOffsets.push_back(cells.faceVertices.size());
  core.faceLambda.push_back(lambda);
}

} // namespace

TEST(VerificationFailures, TheGoodCasesAreGood)
{
  EXPECT_EQ(Failures(GoodCase()), Names{});
  EXPECT_EQ(Failures(GoodCase(0.75)), Names{});
}

TEST(VerificationFailures, ArraysThatDoNotFitTogether)
{
  const auto damage = [](auto change) {
    VerificationCase subject = GoodCase();
    change(subject.core);
    const Names failed = Failures(subject);
    // Nothing can be checked on such data, and none of it is called good.
    EXPECT_EQ(failed.size(), 28U);
    EXPECT_EQ(failed.front(), "arrays");
  };
  damage([](MedialComplex & core) { core.positions.pop_back(); });
  damage([](MedialComplex & core) { core.radius.pop_back(); });
  damage([](MedialComplex & core) { core.vertexLambda.push_back(1); });
  damage([](MedialComplex & core) { core.edgeLambda.pop_back(); });
  damage([](MedialComplex & core) { core.faceLambda.pop_back(); });
  damage([](MedialComplex & core) { core.cells.faceEdges.pop_back(); });
  damage([](MedialComplex & core) { std::swap(core.cells.faceOffsets[3], core.cells.faceOffsets[4]); });
  damage([](MedialComplex & core) { core.cells.faceOffsets.back() -= 1; });
  damage([](MedialComplex & core) { core.cells.faceOffsets.clear(); });
  damage([](MedialComplex & core) { core.cells.edges[5][1] = static_cast<ElementIndex>(core.cells.vertexCount); });
  damage([](MedialComplex & core) { core.cells.faceVertices[5] = 0xFFFFFFFFU; });
  damage([](MedialComplex & core) { core.cells.faceEdges[5] = static_cast<ElementIndex>(core.cells.edges.size()); });
}

TEST(VerificationFailures, NumbersThatAreNone)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto   damage = [](auto change) {
    VerificationCase subject = GoodCase();
    change(subject.core);
    EXPECT_EQ(Failures(subject).front(), "numbers");
  };
  damage([&](MedialComplex & core) { core.positions[3][1] = nan; });
  damage([&](MedialComplex & core) { core.positions[3][2] = std::numeric_limits<double>::infinity(); });
  damage([&](MedialComplex & core) { core.radius[3] = nan; });
  damage([&](MedialComplex & core) { core.vertexLambda[3] = -1; });
  damage([&](MedialComplex & core) { core.faceLambda[3] = nan; });
  // The measure of an edge on no face is always in the file.
  damage([&](MedialComplex & core) { core.edgeLambda[EdgeWithoutFace(core.cells)] = nan; });
}

TEST(VerificationFailures, EdgesThatRunBackwards)
{
  VerificationCase subject = GoodCase();
  std::swap(subject.core.cells.edges[4][0], subject.core.cells.edges[4][1]);
  EXPECT_EQ(Failures(subject).front(), "edge ends");
}

TEST(VerificationFailures, PolygonsWithTwoCorners)
{
  VerificationCase subject = GoodCase();
  const auto       ends = subject.core.cells.edges[0];
  AppendFace(subject.core, { ends[0], ends[1] }, 0.25);
  EXPECT_EQ(Failures(subject).front(), "polygons");
}

TEST(VerificationFailures, PolygonsThatMeetACornerTwice)
{
  VerificationCase subject = GoodCase();
  const auto       corners = subject.core.cells.FaceVertices(0);
  AppendFace(subject.core, { corners[0], corners[1], corners[2], corners[1] }, subject.core.faceLambda[0]);
  EXPECT_EQ(Failures(subject).front(), "polygons");
}

TEST(VerificationFailures, PolygonsWithAWrongEdge)
{
  VerificationCase subject = GoodCase();
  std::swap(subject.core.cells.faceEdges[0], subject.core.cells.faceEdges[1]);
  EXPECT_EQ(Failures(subject).front(), "polygon edges");
}

TEST(VerificationFailures, AVertexTwice)
{
  VerificationCase subject = GoodCase();
  MedialComplex &  core = subject.core;
  core.cells.vertexCount += 1;
  core.positions.push_back(core.positions.back());
  core.radius.push_back(core.radius.back());
  core.vertexLambda.push_back(core.vertexLambda.back());
  EXPECT_EQ(Failures(subject), (Names{ "distinct vertices", "vertex order", "completeness", "topology" }));
}

TEST(VerificationFailures, AnEdgeTwice)
{
  VerificationCase subject = GoodCase();
  MedialComplex &  core = subject.core;
  core.cells.edges.push_back(core.cells.edges.back());
  core.edgeLambda.push_back(core.edgeLambda.back());
  EXPECT_EQ(Failures(subject), (Names{ "distinct edges", "edge order", "topology" }));
}

TEST(VerificationFailures, AFaceTwice)
{
  VerificationCase subject = GoodCase();
  MedialComplex &  core = subject.core;
  const auto       corners = core.cells.FaceVertices(core.cells.FaceCount() - 1);
  AppendFace(core, { corners.begin(), corners.end() }, core.faceLambda.back());
  EXPECT_EQ(Failures(subject), (Names{ "distinct faces", "face order", "topology" }));
}

TEST(VerificationFailures, APolygonCutInTwo)
{
  VerificationCase          subject = GoodCase();
  MedialComplex &           core = subject.core;
  const auto                face = FaceWithCorners(core.cells, 4);
  const auto                span = core.cells.FaceVertices(face);
  std::vector<ElementIndex> corners(span.begin(), span.end());
  const double              lambda = core.faceLambda[face];
  LiveElements              live = AllOf(core.cells);
  live.faces[face] = 0;
  Keep(core, live);
  core.cells.edges.push_back({ std::min(corners[0], corners[2]), std::max(corners[0], corners[2]) });
  core.edgeLambda.push_back(lambda);
  AppendFace(core, { corners[0], corners[1], corners[2] }, lambda);
  std::vector<ElementIndex> rest{ corners[0] };
  rest.insert(rest.end(), corners.begin() + 2, corners.end());
  AppendFace(core, rest, lambda);
  // The topology is that of the shape; only the extra edge and the shared dual give it away.
  const Names failed = Failures(subject);
  EXPECT_EQ(failed, (Names{ "distinct faces", "edges dual", "edge order", "face order" }));
}

TEST(VerificationFailures, AVertexOutside)
{
  VerificationCase subject = GoodCase();
  subject.core.positions[0][0] = -3.25;
  ExpectFails(subject, { "vertices inside", "vertices equidistant" });
  subject = GoodCase();
  subject.core.positions[0] = { 1e300, 0, 0 };
  ExpectFails(subject, { "vertices inside" });
  // On the boundary is not inside.
  subject = MakeCase(SolidBox({ 1, 1, 1 }), { 1, 1, 1 });
  subject.core.positions[0] = { 0.5, 0.5, 0.0 };
  ExpectFails(subject, { "vertices inside" });
}

TEST(VerificationFailures, AVertexALittleAside)
{
  for (const double step : { 1e-3, 1e-6, 1e-9, 1e-12 })
  {
    VerificationCase subject = GoodCase();
    subject.core.positions[40][1] += step;
    ExpectFails(subject, { "vertices equidistant" });
    // Positions known less well than that pass.
    subject.positionTolerance = 2 * step;
    EXPECT_EQ(Failures(subject), Names{}) << step;
  }
}

TEST(VerificationFailures, AGreaterRadius)
{
  VerificationCase subject = GoodCase();
  subject.core.radius[17] *= 1 + 1e-8;
  EXPECT_EQ(Failures(subject), (Names{ "nothing nearer", "radius" }));
}

TEST(VerificationFailures, ASmallerRadius)
{
  VerificationCase subject = GoodCase();
  subject.core.radius[17] *= 1 - 1e-8;
  EXPECT_EQ(Failures(subject), Names{ "radius" });
}

TEST(VerificationFailures, AnEdgeBetweenStrangers)
{
  VerificationCase subject = GoodCase();
  MedialComplex &  core = subject.core;
  core.cells.edges.push_back({ 0, static_cast<ElementIndex>(core.cells.vertexCount - 1) });
  core.edgeLambda.push_back(0.1);
  ExpectFails(subject, { "edges dual", "edge order", "topology" });
}

TEST(VerificationFailures, AFaceAmongStrangers)
{
  // The link of an inner vertex holds circles of edges that bound no face.
  VerificationCase                    subject = GoodCase();
  MedialComplex &                     core = subject.core;
  const CellComplex &                 cells = core.cells;
  std::set<std::vector<ElementIndex>> faces;
  for (std::size_t f = 0; f < cells.FaceCount(); ++f)
  {
    std::vector<ElementIndex> corners(cells.FaceVertices(f).begin(), cells.FaceVertices(f).end());
    std::sort(corners.begin(), corners.end());
    faces.insert(corners);
  }
  // Two faces with a common edge, without it: a circle of edges.
  for (std::size_t f = 0; f < cells.FaceCount(); ++f)
  {
    for (std::size_t g = f + 1; g < cells.FaceCount(); ++g)
    {
      const auto a = cells.FaceVertices(f);
      const auto b = cells.FaceVertices(g);
      for (std::size_t i = 0; i < a.size(); ++i)
      {
        for (std::size_t j = 0; j < b.size(); ++j)
        {
          const ElementIndex a1 = a[(i + 1) % a.size()];
          const ElementIndex b1 = b[(j + 1) % b.size()];
          if (a[i] != b1 || a1 != b[j])
          {
            continue;
          }
          std::vector<ElementIndex> circle;
          for (std::size_t k = 1; k <= a.size(); ++k)
          {
            circle.push_back(a[(i + k) % a.size()]);
          }
          for (std::size_t k = 2; k < b.size(); ++k)
          {
            circle.push_back(b[(j + k) % b.size()]);
          }
          std::vector<ElementIndex> sorted = circle;
          std::sort(sorted.begin(), sorted.end());
          if (faces.count(sorted) != 0 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
          {
            continue;
          }
          AppendFace(core, circle, core.faceLambda[f]);
          ExpectFails(subject, { "faces dual", "topology" });
          return;
        }
      }
    }
  }
  FAIL() << "no two faces share an edge";
}

TEST(VerificationFailures, ACornerOutOfThePlane)
{
  VerificationCase    subject = GoodCase();
  const CellComplex & cells = subject.core.cells;
  const auto          corners = cells.FaceVertices(FaceWithCorners(cells, 5));
  for (std::size_t a = 0; a < 3; ++a)
  {
    subject.core.positions[corners[1]][a] += 1e-4 * static_cast<double>(a + 1);
  }
  ExpectFails(subject, { "faces planar", "vertices equidistant" });
}

TEST(VerificationFailures, ACornerThatTurnsInwards)
{
  VerificationCase    subject = GoodCase();
  const CellComplex & cells = subject.core.cells;
  const auto          corners = cells.FaceVertices(FaceWithCorners(cells, 5));
  // In the plane, from a corner through the middle of its neighbours, a little beyond.
  auto & positions = subject.core.positions;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const double middle = (positions[corners[0]][a] + positions[corners[2]][a]) / 2;
    positions[corners[1]][a] += 1.2 * (middle - positions[corners[1]][a]);
  }
  ExpectFails(subject, { "faces convex", "vertices equidistant" });
}

TEST(VerificationFailures, AStarIsNotConvexThoughItTurnsLeftEverywhere)
{
  VerificationCase          subject = GoodCase();
  MedialComplex &           core = subject.core;
  const auto                face = FaceWithCorners(core.cells, 5);
  const auto                span = core.cells.FaceVertices(face);
  std::vector<ElementIndex> corners(span.begin(), span.end());
  ASSERT_EQ(corners.size() % 2, 1U) << "a star needs an odd number of corners";
  const double lambda = core.faceLambda[face];
  LiveElements live = AllOf(core.cells);
  live.faces[face] = 0;
  Keep(core, live);
  std::vector<ElementIndex> star;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    star.push_back(corners[2 * i % corners.size()]);
  }
  for (std::size_t i = 0; i < star.size(); ++i)
  {
    const auto [lower, upper] = std::minmax(star[i], star[(i + 1) % star.size()]);
    core.cells.edges.push_back({ lower, upper });
    core.edgeLambda.push_back(lambda);
  }
  AppendFace(core, star, lambda);
  const Names failed = Failures(subject);
  EXPECT_TRUE(std::count(failed.begin(), failed.end(), "faces convex")) << ::testing::PrintToString(failed);
  EXPECT_FALSE(std::count(failed.begin(), failed.end(), "faces planar"));
}

TEST(VerificationFailures, APolygonTheOtherWayRound)
{
  VerificationCase subject = GoodCase();
  CellComplex &    cells = subject.core.cells;
  const auto       first = static_cast<std::ptrdiff_t>(cells.faceOffsets[7]);
  const auto       last = static_cast<std::ptrdiff_t>(cells.faceOffsets[8]);
  std::reverse(cells.faceVertices.begin() + first + 1, cells.faceVertices.begin() + last);
  std::reverse(cells.faceEdges.begin() + first, cells.faceEdges.begin() + last);
  EXPECT_EQ(Failures(subject), Names{ "faces oriented" });
}

TEST(VerificationFailures, MeasuresThatAreOff)
{
  for (const double factor : { 1 - 1e-8, 1 + 1e-8 })
  {
    VerificationCase subject = GoodCase();
    subject.core.vertexLambda[9] *= factor;
    ExpectFails(subject, { "vertex measures" });
    subject = GoodCase();
    subject.core.edgeLambda[9] *= factor;
    ExpectFails(subject, { "edge measures" });
    subject = GoodCase();
    subject.core.faceLambda[9] *= factor;
    ExpectFails(subject, { "face measures" });
  }
}

TEST(VerificationFailures, MeasuresThatDoNotGrowTowardsVertices)
{
  // Within the tolerance of the measures, yet not monotone: the edge of a rod and its vertex exchange an ulp or two.
  VerificationCase subject = MakeCase(SolidBox({ 2, 1, 1 }), { 1, 1, 1 });
  subject.core.vertexLambda[0] = subject.core.edgeLambda[0] * (1 - 1e-12);
  ExpectFails(subject, { "measures monotone" });
  subject = GoodCase();
  const ElementIndex edge = subject.core.cells.FaceEdges(0)[0];
  subject.core.faceLambda[0] = subject.core.edgeLambda[edge] * (1 + 1e-12);
  ExpectFails(subject, { "measures monotone" });
  // Without the measures of edges, faces are still compared with vertices.
  for (const ElementIndex e : subject.core.cells.faceEdges)
  {
    subject.core.edgeLambda[e] = std::numeric_limits<double>::quiet_NaN();
  }
  subject.core.faceLambda[0] = 2 * subject.core.vertexLambda[subject.core.cells.FaceVertices(0)[0]];
  ExpectFails(subject, { "measures monotone", "face measures" });
}

TEST(VerificationFailures, VerticesInAnotherOrder)
{
  VerificationCase          subject = GoodCase();
  MedialComplex &           core = subject.core;
  std::vector<ElementIndex> numbers(core.cells.vertexCount);
  std::iota(numbers.begin(), numbers.end(), ElementIndex{ 0 });
  // The last two: at the end of the rod, on no face, so that only the last edge names them.
  std::swap(numbers[numbers.size() - 2], numbers[numbers.size() - 1]);
  const std::size_t n = numbers.size();
  std::swap(core.positions[n - 2], core.positions[n - 1]);
  std::swap(core.radius[n - 2], core.radius[n - 1]);
  std::swap(core.vertexLambda[n - 2], core.vertexLambda[n - 1]);
  core.cells.edges[core.cells.edges.size() - 2][1] = static_cast<ElementIndex>(n - 1);
  EXPECT_EQ(Failures(subject), Names{ "vertex order" });
}

TEST(VerificationFailures, EdgesInAnotherOrder)
{
  VerificationCase  subject = GoodCase();
  CellComplex &     cells = subject.core.cells;
  const std::size_t n = cells.edges.size();
  std::swap(cells.edges[n - 1], cells.edges[n - 2]); // of the rod: on no face
  std::swap(subject.core.edgeLambda[n - 1], subject.core.edgeLambda[n - 2]);
  EXPECT_EQ(Failures(subject), Names{ "edge order" });
}

TEST(VerificationFailures, FacesInAnotherOrder)
{
  VerificationCase                subject = GoodCase();
  MedialComplex &                 core = subject.core;
  const auto                      corners = core.cells.FaceVertices(0);
  const std::vector<ElementIndex> first(corners.begin(), corners.end());
  const double                    lambda = core.faceLambda[0];
  LiveElements                    live = AllOf(core.cells);
  live.faces[0] = 0;
  Keep(core, live);
  AppendFace(core, first, lambda);
  EXPECT_EQ(Failures(subject), Names{ "face order" });
}

TEST(VerificationFailures, APolygonThatStartsElsewhere)
{
  VerificationCase subject = GoodCase();
  CellComplex &    cells = subject.core.cells;
  const auto       last = static_cast<std::ptrdiff_t>(cells.faceOffsets[1]);
  std::rotate(cells.faceVertices.begin(), cells.faceVertices.begin() + 1, cells.faceVertices.begin() + last);
  std::rotate(cells.faceEdges.begin(), cells.faceEdges.begin() + 1, cells.faceEdges.begin() + last);
  EXPECT_EQ(Failures(subject), Names{ "face order" });
}

TEST(VerificationFailures, AMissingFace)
{
  VerificationCase subject = GoodCase();
  LiveElements     live = AllOf(subject.core.cells);
  live.faces[live.faces.size() / 2] = 0;
  Keep(subject.core, live);
  EXPECT_EQ(Failures(subject), (Names{ "completeness", "topology" }));
}

TEST(VerificationFailures, ACoreShortOfAPairHasTheRightTopologyButIsNotWhole)
{
  VerificationCase         subject = GoodCase();
  CellComplex &            cells = subject.core.cells;
  std::vector<std::size_t> cofaces(cells.edges.size(), 0);
  for (const ElementIndex edge : cells.faceEdges)
  {
    ++cofaces[edge];
  }
  LiveElements live = AllOf(cells);
  for (std::size_t f = 0; f < cells.FaceCount() && live.faces[0] == 1; ++f)
  {
    for (const ElementIndex edge : cells.FaceEdges(f))
    {
      if (cofaces[edge] == 1 && std::count(live.faces.begin(), live.faces.end(), 0) == 0)
      {
        live.faces[f] = 0;
        live.edges[edge] = 0;
      }
    }
  }
  ASSERT_EQ(std::count(live.edges.begin(), live.edges.end(), 0), 1);
  Keep(subject.core, live);
  EXPECT_EQ(Failures(subject), Names{ "completeness" });
  // And a loose end of the rod with its edge.
  subject = MakeCase(SolidBox({ 5, 1, 1 }), { 1, 1, 1 });
  live = AllOf(subject.core.cells);
  live.vertices[4] = 0;
  live.edges[3] = 0;
  Keep(subject.core, live);
  EXPECT_EQ(Failures(subject), Names{ "completeness" });
}

TEST(VerificationFailures, ACorePrunedTooFar)
{
  // Pruned to 1.5 mm, said to be pruned to 0.75 mm: elements with measures between are missing.
  VerificationCase subject = GoodCase(1.5);
  subject.threshold = 0.75;
  EXPECT_EQ(Failures(subject), Names{ "completeness" });
}

TEST(VerificationFailures, AWholeCoreSaidToBePruned)
{
  VerificationCase subject = GoodCase();
  subject.threshold = 1.5 * 0.5; // 1.5 voxels
  EXPECT_EQ(Failures(subject), Names{ "pruning" });
  // Also from a file that does not say the measures of edges on faces.
  for (const ElementIndex edge : subject.core.cells.faceEdges)
  {
    subject.core.edgeLambda[edge] = std::numeric_limits<double>::quiet_NaN();
  }
  EXPECT_EQ(Failures(subject), Names{ "pruning" });
}

TEST(VerificationFailures, AVertexPairLeftByPruning)
{
  VerificationCase subject = MakeCase(SolidBox({ 5, 1, 1 }), { 1, 1, 1 });
  subject.threshold = 10;
  EXPECT_EQ(Failures(subject), Names{ "pruning" });
}

TEST(VerificationFailures, AMissingComponent)
{
  const auto       twoBlocks = [](std::int32_t x, std::int32_t, std::int32_t) { return x != 2; };
  const auto       oneBlock = [](std::int32_t x, std::int32_t, std::int32_t) { return x < 2; };
  VerificationCase subject = MakeCase(MakeShape({ 5, 2, 2 }, oneBlock), { 1, 1, 1 });
  subject.shape = MakeShape({ 5, 2, 2 }, twoBlocks);
  EXPECT_EQ(Failures(subject), Names{ "topology" });
}
