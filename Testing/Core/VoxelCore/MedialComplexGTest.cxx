// Where core elements lie and what they measure, judged by the boundary vertices nearest to them, found by looking at
// all of them in true millimetres.

#include "VoxelCoreTesting/Cores.h"

#include "voxelcore/Shape/BoundaryVertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <limits>

namespace voxelcore
{
namespace
{

using Point = std::array<double, 3>;

Point
operator-(const Point & a, const Point & b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

double
Dot(const Point & a, const Point & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Point
Cross(const Point & a, const Point & b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

double
Length(const Point & a)
{
  return std::sqrt(Dot(a, a));
}

// The centre of the smallest sphere through 2, 3 or 4 points; false when they are not affinely independent.
bool
CentreThrough(const std::vector<Point> & p, Point & centre)
{
  const Point u = p[1] - p[0];
  Point       offset{ u[0] / 2, u[1] / 2, u[2] / 2 };
  if (p.size() == 3)
  {
    const Point  v = p[2] - p[0];
    const Point  n = Cross(u, v);
    const double nn = Dot(n, n);
    if (nn < 1e-12 * Dot(u, u) * Dot(v, v))
    {
      return false;
    }
    const Point a = Cross(n, u);
    const Point b = Cross(v, n);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      offset[axis] = (Dot(v, v) * a[axis] + Dot(u, u) * b[axis]) / (2 * nn);
    }
  }
  if (p.size() == 4)
  {
    const Point  v = p[2] - p[0];
    const Point  w = p[3] - p[0];
    const double det = Dot(u, Cross(v, w));
    if (std::abs(det) < 1e-9 * Length(u) * Length(v) * Length(w))
    {
      return false;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      offset[axis] =
        (Dot(u, u) * Cross(v, w)[axis] + Dot(v, v) * Cross(w, u)[axis] + Dot(w, w) * Cross(u, v)[axis]) / (2 * det);
    }
  }
  centre = { p[0][0] + offset[0], p[0][1] + offset[1], p[0][2] + offset[2] };
  return true;
}

// The radius of the smallest ball that holds all points: the least of all balls on 2, 3 or 4 of them that do.
double
SmallestBall(const std::vector<Point> & points)
{
  double     best = std::numeric_limits<double>::infinity();
  const auto consider = [&](const std::vector<Point> & support) {
    Point centre{};
    if (!CentreThrough(support, centre))
    {
      return;
    }
    const double radius = Length(support[0] - centre);
    if (radius < best && std::all_of(points.begin(), points.end(), [&](const Point & p) {
          return Length(p - centre) <= radius * (1 + 1e-10);
        }))
    {
      best = radius;
    }
  };
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i)
  {
    for (std::size_t j = i + 1; j < n; ++j)
    {
      consider({ points[i], points[j] });
      for (std::size_t k = j + 1; k < n; ++k)
      {
        consider({ points[i], points[j], points[k] });
      }
    }
  }
  // The points are cospherical here: every four that span give one and the same ball.
  for (std::size_t i = 1; n > 3 && i + 2 < n; ++i)
  {
    for (std::size_t j = i + 1; j + 1 < n; ++j)
    {
      for (std::size_t k = j + 1; k < n; ++k)
      {
        consider({ points[0], points[i], points[j], points[k] });
      }
    }
  }
  return best;
}

// A core beside the nearest boundary vertices of its elements.
struct Judged
{
  Point                                 spacing{};
  MedialComplex                         core;
  std::vector<LatticePoint>             boundary;
  std::vector<std::vector<std::size_t>> nearest; // of each core vertex, ascending
  std::vector<double>                   distance;

  explicit Judged(const testing::RandomVolume & volume)
    : spacing(volume.spacing)
    , core(testing::CoreOf(volume.shape, volume.spacing))
    , boundary(BoundaryVertices(volume.shape))
  {
    for (const Point & position : core.positions)
    {
      double                   least = std::numeric_limits<double>::infinity();
      std::vector<double>      all;
      std::vector<std::size_t> own;
      for (std::size_t b = 0; b < boundary.size(); ++b)
      {
        all.push_back(Length(InMillimetres(position) - Place(b)));
        least = std::min(least, all.back());
      }
      for (std::size_t b = 0; b < boundary.size(); ++b)
      {
        if (all[b] <= least * (1 + 1e-11))
        {
          own.push_back(b);
        }
      }
      nearest.push_back(own);
      distance.push_back(least);
    }
  }

  Point
  InMillimetres(const Point & lattice) const
  {
    return { lattice[0] * spacing[0], lattice[1] * spacing[1], lattice[2] * spacing[2] };
  }

  Point
  Place(std::size_t b) const
  {
    return InMillimetres(
      { static_cast<double>(boundary[b].x), static_cast<double>(boundary[b].y), static_cast<double>(boundary[b].z) });
  }

  // Points nearest to an element are those nearest to all its corners.
  std::vector<std::size_t>
  NearestToAll(std::span<const ElementIndex> corners) const
  {
    std::vector<std::size_t> common = nearest[corners[0]];
    for (const ElementIndex corner : corners.subspan(1))
    {
      std::vector<std::size_t> both;
      std::set_intersection(common.begin(),
                            common.end(),
                            nearest[corner].begin(),
                            nearest[corner].end(),
                            std::back_inserter(both));
      common.swap(both);
    }
    return common;
  }

  double
  Measure(const std::vector<std::size_t> & indices) const
  {
    std::vector<Point> points;
    for (const std::size_t index : indices)
    {
      points.push_back(Place(index));
    }
    return SmallestBall(points);
  }
};

void
ExpectMeasures(const Judged & j)
{
  const MedialComplex & core = j.core;
  for (std::size_t v = 0; v < core.cells.vertexCount; ++v)
  {
    ASSERT_GE(j.nearest[v].size(), 4U) << "vertex " << v;
    ASSERT_NEAR(core.radius[v], j.distance[v], 1e-11 * j.distance[v]) << "vertex " << v;
    const double measure = j.Measure(j.nearest[v]);
    ASSERT_NEAR(core.vertexLambda[v], measure, 1e-9 * measure) << "vertex " << v;
  }
  for (std::size_t e = 0; e < core.cells.edges.size(); ++e)
  {
    const auto common = j.NearestToAll(core.cells.edges[e]);
    ASSERT_GE(common.size(), 3U) << "edge " << e;
    const double measure = j.Measure(common);
    ASSERT_NEAR(core.edgeLambda[e], measure, 1e-9 * measure) << "edge " << e;
    for (const ElementIndex end : core.cells.edges[e])
    {
      ASSERT_LE(core.edgeLambda[e], core.vertexLambda[end]);
      ASSERT_LE(core.vertexLambda[end], core.radius[end]);
    }
  }
  for (std::size_t f = 0; f < core.cells.FaceCount(); ++f)
  {
    const auto common = j.NearestToAll(core.cells.FaceVertices(f));
    ASSERT_EQ(common.size(), 2U) << "face " << f;
    const double measure = j.Measure(common);
    ASSERT_NEAR(core.faceLambda[f], measure, 1e-12 * measure) << "face " << f;
    for (const ElementIndex edge : core.cells.FaceEdges(f))
    {
      ASSERT_LE(core.faceLambda[f], core.edgeLambda[edge]);
    }
  }
}

// Faces are plane and strictly convex, and their normal, right-handed, points from the smaller to the
// greater of their two boundary vertices.
void
ExpectOrientedConvexFaces(const Judged & j)
{
  for (std::size_t f = 0; f < j.core.cells.FaceCount(); ++f)
  {
    SCOPED_TRACE("face " + std::to_string(f));
    const auto        polygon = j.core.cells.FaceVertices(f);
    const std::size_t n = polygon.size();
    const auto        common = j.NearestToAll(polygon);
    ASSERT_EQ(common.size(), 2U);
    const bool  ascending = j.boundary[common[0]] < j.boundary[common[1]];
    const Point from = j.Place(common[ascending ? 0 : 1]);
    const Point to = j.Place(common[ascending ? 1 : 0]);
    const Point along = to - from;
    const auto  corner = [&](std::size_t i) { return j.InMillimetres(j.core.positions[polygon[i % n]]); };
    for (std::size_t i = 0; i < n; ++i)
    {
      // On the bisector of the two.
      const Point p = corner(i);
      ASSERT_NEAR(Length(p - from), Length(p - to), 1e-10 * Length(along));
      const Point turn = Cross(corner(i + 1) - p, corner(i + 2) - corner(i + 1));
      ASSERT_GT(Dot(turn, along), 0.0) << "corner " << i + 1;
      // Every other corner on the inner side of this side: convex, and wound once.
      const Point inward = Cross(along, corner(i + 1) - p);
      for (std::size_t k = 2; k < n; ++k)
      {
        ASSERT_GT(Dot(inward, corner(i + k) - p), 0.0);
      }
    }
  }
}

void
ExpectCanonicalOrder(const MedialComplex & core)
{
  const CellComplex & cells = core.cells;
  ASSERT_EQ(core.positions.size(), cells.vertexCount);
  ASSERT_EQ(core.radius.size(), cells.vertexCount);
  ASSERT_EQ(core.vertexLambda.size(), cells.vertexCount);
  ASSERT_EQ(core.edgeLambda.size(), cells.edges.size());
  ASSERT_EQ(core.faceLambda.size(), cells.FaceCount());
  ASSERT_EQ(cells.faceEdges.size(), cells.faceVertices.size());
  ASSERT_TRUE(std::is_sorted(core.positions.begin(), core.positions.end()));
  for (std::size_t e = 0; e < cells.edges.size(); ++e)
  {
    ASSERT_LT(cells.edges[e][0], cells.edges[e][1]);
    ASSERT_TRUE(e == 0 || cells.edges[e - 1] < cells.edges[e]) << "edge " << e;
  }
  std::vector<ElementIndex> before;
  for (std::size_t f = 0; f < cells.FaceCount(); ++f)
  {
    const auto polygon = cells.FaceVertices(f);
    ASSERT_GE(polygon.size(), 3U);
    ASSERT_EQ(std::min_element(polygon.begin(), polygon.end()), polygon.begin()) << "face " << f;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const std::array<ElementIndex, 2> ends{ std::min(polygon[i], polygon[(i + 1) % polygon.size()]),
                                              std::max(polygon[i], polygon[(i + 1) % polygon.size()]) };
      ASSERT_EQ(cells.edges[cells.FaceEdges(f)[i]], ends) << "face " << f;
    }
    std::vector<ElementIndex> sorted(polygon.begin(), polygon.end());
    std::sort(sorted.begin(), sorted.end());
    ASSERT_LT(before, sorted) << "face " << f;
    before.swap(sorted);
  }
}

TEST(MedialComplex, MeasuresAreSmallestBallsOfTheNearestBoundaryVertices)
{
  std::cout << "seeds from 7000\n";
  for (std::uint64_t seed = 7000; seed < 7080; ++seed)
  {
    const testing::RandomVolume volume = testing::MakeRandomVolume(seed, 2, 7);
    SCOPED_TRACE(volume.Describe());
    ASSERT_NO_FATAL_FAILURE(ExpectMeasures(Judged(volume)));
  }
}

TEST(MedialComplex, MeasuresAreRightInThickShapesToo)
{
  for (const auto & spacing : testing::TestSpacings())
  {
    testing::RandomVolume volume;
    volume.spacing = spacing;
    for (const VoxelShape & shape : { testing::Box({ 6, 5, 4 }), testing::Ellipsoid(16) })
    {
      volume.shape = shape;
      SCOPED_TRACE(volume.Describe());
      const Judged judged(volume);
      ASSERT_NO_FATAL_FAILURE(ExpectMeasures(judged));
      ASSERT_NO_FATAL_FAILURE(ExpectOrientedConvexFaces(judged));
      ASSERT_NO_FATAL_FAILURE(ExpectCanonicalOrder(judged.core));
    }
  }
}

TEST(MedialComplex, FacesAreConvexOrientedAndInCanonicalOrder)
{
  std::cout << "seeds from 7200\n";
  for (std::uint64_t seed = 7200; seed < 7400; ++seed)
  {
    const testing::RandomVolume volume = testing::MakeRandomVolume(seed, 2, 8);
    SCOPED_TRACE(volume.Describe());
    const Judged judged(volume);
    ASSERT_NO_FATAL_FAILURE(ExpectOrientedConvexFaces(judged));
    ASSERT_NO_FATAL_FAILURE(ExpectCanonicalOrder(judged.core));
  }
}

TEST(MedialComplex, HasTolerancesWhereThereIsOneForEachVertex)
{
  const VoxelShape shape = testing::Ellipsoid(12);
  EXPECT_FALSE(testing::CoreOf(shape).HasTolerances());
  MedialComplex core = testing::CoreWithTolerancesOf(shape);
  EXPECT_TRUE(core.HasTolerances());
  const double        middle = *std::max_element(core.tolerances.vertices.begin(), core.tolerances.vertices.end()) / 2;
  const MedialComplex pruned = PruneByTolerance(core, middle);
  EXPECT_TRUE(pruned.HasTolerances());
  EXPECT_LT(pruned.cells.vertexCount, core.cells.vertexCount);
  EXPECT_GE(*std::min_element(pruned.tolerances.vertices.begin(), pruned.tolerances.vertices.end()), middle);
  core.tolerances.vertices.pop_back();
  EXPECT_FALSE(core.HasTolerances());
  EXPECT_FALSE(MedialComplex{}.HasTolerances()) << "nothing has no heights";
}

} // namespace
} // namespace voxelcore
