// Every check of geometry and measures is shown to fail on a core damaged in just that way.
#include "Core/Verification/DamagedCores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

using namespace voxelcore;
using namespace voxelcore::testing;

TEST(VerificationGeometryFailures, AVertexOutside)
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

TEST(VerificationGeometryFailures, AVertexALittleAside)
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

TEST(VerificationGeometryFailures, AGreaterRadius)
{
  VerificationCase subject = GoodCase();
  subject.core.radius[17] *= 1 + 1e-8;
  EXPECT_EQ(Failures(subject), (Names{ "nothing nearer", "radius", "true spacing" }));
}

TEST(VerificationGeometryFailures, ASmallerRadius)
{
  VerificationCase subject = GoodCase();
  subject.core.radius[17] *= 1 - 1e-8;
  EXPECT_EQ(Failures(subject), (Names{ "radius", "true spacing" }));
}

TEST(VerificationGeometryFailures, AnEdgeBetweenStrangers)
{
  VerificationCase subject = GoodCase();
  MedialComplex &  core = subject.core;
  core.cells.edges.push_back({ 0, static_cast<ElementIndex>(core.cells.vertexCount - 1) });
  core.edgeLambda.push_back(0.1);
  ExpectFails(subject, { "edges dual", "edge order", "topology" });
}

TEST(VerificationGeometryFailures, AFaceAmongStrangers)
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

TEST(VerificationGeometryFailures, ACornerOutOfThePlane)
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

TEST(VerificationGeometryFailures, ACornerThatTurnsInwards)
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

TEST(VerificationGeometryFailures, AStarIsNotConvexThoughItTurnsLeftEverywhere)
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

TEST(VerificationGeometryFailures, APolygonTheOtherWayRound)
{
  VerificationCase subject = GoodCase();
  ReversePolygon(subject.core.cells, 7);
  EXPECT_EQ(Failures(subject), Names{ "faces oriented" });
}

TEST(VerificationGeometryFailures, MeasuresThatAreOff)
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

TEST(VerificationGeometryFailures, MeasuresThatDoNotGrowTowardsVertices)
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
