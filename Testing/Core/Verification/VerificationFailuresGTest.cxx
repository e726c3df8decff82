// Every check of structure, order, completeness and topology is shown to fail on a core damaged in just that way.
#include "Core/Verification/DamagedCores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace voxelcore;
using namespace voxelcore::testing;

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
    EXPECT_EQ(failed.size(), 29U);
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

TEST(VerificationFailures, VerticesInAnotherOrder)
{
  VerificationCase subject = GoodCase();
  MedialComplex &  core = subject.core;
  // The last two: at the end of the rod, on no face. The last edge joins them whatever their order; the one before it
  // must follow the vertex it ends at.
  const std::size_t n = core.cells.vertexCount;
  std::swap(core.positions[n - 2], core.positions[n - 1]);
  std::swap(core.radius[n - 2], core.radius[n - 1]);
  std::swap(core.vertexLambda[n - 2], core.vertexLambda[n - 1]);
  core.cells.edges[core.cells.edges.size() - 2][1] = static_cast<ElementIndex>(n - 1);
  EXPECT_EQ(Failures(subject), Names{ "vertex order" });
}

TEST(VerificationFailures, VerticesInAnotherOrderThatDifferInOneCoordinateOnly)
{
  // A row of voxels along y: equal x, so that the next coordinate decides.
  VerificationCase subject = MakeCase(SolidBox({ 1, 4, 1 }), { 1, 1, 1 });
  ASSERT_EQ(Failures(subject), Names{});
  std::swap(subject.core.positions[0], subject.core.positions[1]);
  subject.core.cells.edges[1] = { 0, 2 };
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

TEST(VerificationFailures, AnEdgePairLeftByPruning)
{
  // A plate one voxel thick: every vertex lies on faces, so that only edges and faces make simple pairs.
  VerificationCase subject = MakeCase(SolidBox({ 4, 4, 1 }), { 1, 1, 1 });
  subject.threshold = 10;
  EXPECT_EQ(Failures(subject), Names{ "pruning" });
  // What has a measure of just the threshold stays: a face, or an edge of a face below it.
  for (const double measure : { subject.core.faceLambda[0], subject.core.edgeLambda[0] })
  {
    subject.threshold = measure;
    EXPECT_EQ(Failures(subject), Names{});
    subject.threshold = measure * (1 + 1e-9);
    EXPECT_EQ(Failures(subject).empty(), measure == subject.core.faceLambda[0]);
  }
}

TEST(VerificationFailures, LengthsThatTheSpacingDoesNotHave)
{
  // A core made with weights that are not those of the spacing agrees with itself, and with these weights.
  VerificationCase squeezed = MakeCase(EllipsoidWithRod(), { 1, 1, 2 });
  squeezed.spacing = { 1, 1, 2.01 };
  EXPECT_EQ(Failures(squeezed), Names{ "true spacing" });
  // Nor does it help to admit to the deviation.
  squeezed.weights.deviation = 0.005;
  EXPECT_EQ(Failures(squeezed), Names{ "true spacing" });
  // Within the deviation that the weights of a spacing may have, it is as good as they can be.
  squeezed.spacing = { 1, 1, 2 * (1 + 1e-4) };
  squeezed.weights.deviation = 1e-4;
  EXPECT_EQ(Failures(squeezed), Names{});
}

TEST(VerificationFailures, AMissingComponent)
{
  const auto       twoBlocks = [](std::int32_t x, std::int32_t, std::int32_t) { return x != 2; };
  const auto       oneBlock = [](std::int32_t x, std::int32_t, std::int32_t) { return x < 2; };
  VerificationCase subject = MakeCase(MakeShape({ 5, 2, 2 }, oneBlock), { 1, 1, 1 });
  subject.shape = MakeShape({ 5, 2, 2 }, twoBlocks);
  EXPECT_EQ(Failures(subject), Names{ "topology" });
}
