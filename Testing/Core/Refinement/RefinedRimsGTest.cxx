// Where refined sheets end.

#include "RefinedCores.h"
#include "VoxelCoreTesting/Threads.h"

#include "voxelcore/Complex/ComplexTopology.h"
#include "voxelcore/Refinement/TriangleTree.h"
#include "voxelcore/Shape/ShapeTopology.h"
#include "voxelcore/Verification/BallCoverage.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace voxelcore::testing
{
namespace
{

/** Directions that lie askew in the grid. */
constexpr std::array<Vector3, 3> kAskewAxes{
  { { 0.8174, 0.4417, 0.3697 }, { -0.5683, 0.7221, 0.3938 }, { -0.0930, -0.5320, 0.8416 } }
};

TriangleTree
TreeOf(const MedialComplex & core)
{
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t face = 0; face < core.cells.FaceCount(); ++face)
  {
    const auto corners = core.cells.FaceVertices(face);
    triangles.push_back({ corners[0], corners[1], corners[2] });
  }
  return { core.positions, triangles };
}

// An ellipsoid's axis is the disc of the centres of curvature along its shortest axis. The part of measure lambda and
// more is that disc scaled by sqrt(1 - lambda^2 / c^2). Triangles go as a whole, and left its rim half a voxel off in
// the mean, and 1.45 at most, before its vertices went on.
TEST(RefineCore, LeavesASheetAsFarAsItsMeasureIsAboveTheThreshold)
{
  constexpr double   a = 24;
  constexpr double   b = 17;
  constexpr double   c = 11;
  constexpr double   middle = 26.3;
  constexpr double   threshold = 3;
  const VoxelShape   shape = ShapeWhere({ 53, 53, 53 }, [&](int x, int y, int z) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double along = kAskewAxes[k][0] * (x + 0.5 - middle) + kAskewAxes[k][1] * (y + 0.5 - middle) +
                           kAskewAxes[k][2] * (z + 0.5 - middle);
      sum += along * along / (k == 0 ? a * a : k == 1 ? b * b : c * c);
    }
    return sum <= 1;
  });
  const RefinedCore  refined = Refine(shape, { 1, 1, 1 }, threshold);
  const TriangleTree tree = TreeOf(refined.core);
  const double       scale = std::sqrt(1 - threshold * threshold / (c * c));
  double             sum = 0;
  double             most = 0;
  constexpr int      count = 720;
  for (int i = 0; i < count; ++i)
  {
    const double angle = i * 2 * 3.14159265358979323846 / count;
    const double u = scale * (a * a - c * c) / a * std::cos(angle);
    const double v = scale * (b * b - c * c) / b * std::sin(angle);
    Vector3      rim{ middle, middle, middle };
    for (std::size_t k = 0; k < 3; ++k)
    {
      rim[k] += u * kAskewAxes[0][k] + v * kAskewAxes[1][k];
    }
    const double gap = std::sqrt(tree.FindNearest(rim, 1e9).squaredDistance);
    sum += gap;
    most = std::max(most, gap);
  }
  EXPECT_LT(sum / count, 0.35);
  EXPECT_LT(most, 1);
}

// Between two walls of a box the measure at depth d is d / sqrt(2), and nothing but the size of triangles and what
// labels show of edges keeps a rim from where it is lambda. Where a triangle lay across it and went as a whole, no
// vertex beside it could go on far enough: before such triangles came back, the rims of three turns lay up to 0.85
// behind, and 2.1 % of their length by more than half a voxel (now 0.74, and 1.4 %).
TEST(RefineCore, TakesTrianglesAcrossARimBack)
{
  constexpr std::array<double, 3> half{ 22, 16, 10 };
  constexpr double                middle = 28.3;
  constexpr double                threshold = 3;
  double                          most = 0;
  int                             behind = 0; ///< of all, those by more than half a voxel
  int                             all = 0;
  for (const double turn : { 0.3, 0.9, 1.4 })
  {
    const double                 s = std::sin(turn);
    const double                 c = std::cos(turn);
    const std::array<Vector3, 3> axes{ { { c, 0.6 * s, 0.8 * s }, { -s, 0.6 * c, 0.8 * c }, { 0, -0.8, 0.6 } } };
    const VoxelShape             shape = ShapeWhere({ 57, 57, 57 }, [&](int x, int y, int z) {
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k)
      {
        const double along =
          axes[k][0] * (x + 0.5 - middle) + axes[k][1] * (y + 0.5 - middle) + axes[k][2] * (z + 0.5 - middle);
        inside = inside && std::abs(along) <= half[k];
      }
      return inside;
    });
    const RefinedCore            refined = Refine(shape, { 1, 1, 1 }, threshold);
    EXPECT_EQ(ComputeComplexTopology(refined.core.cells), ComputeShapeTopology(shape));
    for (std::size_t face = 0; face < refined.core.cells.FaceCount(); ++face)
    {
      EXPECT_GE(refined.core.faceLambda[face], threshold);
    }
    const TriangleTree tree = TreeOf(refined.core);
    const double       depth = std::sqrt(2.0) * threshold;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::size_t next = (axis + 1) % 3;
      const std::size_t last = (axis + 2) % 3;
      for (const int signs : { 0, 1, 2, 3 })
      {
        for (double along = -(half[axis] - depth); along < half[axis] - depth; along += 0.1)
        {
          Vector3 rim{ middle, middle, middle };
          for (std::size_t k = 0; k < 3; ++k)
          {
            rim[k] += along * axes[axis][k] + (signs % 2 == 0 ? -1 : 1) * (half[next] - depth) * axes[next][k] +
                      (signs / 2 == 0 ? -1 : 1) * (half[last] - depth) * axes[last][k];
          }
          const double gap = std::sqrt(tree.FindNearest(rim, 1e9).squaredDistance);
          most = std::max(most, gap);
          behind += gap > 0.5 ? 1 : 0;
          ++all;
        }
      }
    }
  }
  EXPECT_LT(most, 0.8);
  EXPECT_LT(behind, 0.017 * all);
}

constexpr double kMiddleOfAskew = 22.3; ///< of askew bodies, on each axis, mm

/** A body askew in the grid: `inside` is asked of places along kAskewAxes from its middle, mm. */
struct AskewBody
{
  const char *                         name;
  std::function<bool(const Vector3 &)> inside;
};

/** What reaches no farther than 20 mm from its middle. */
VoxelShape
VoxelsOf(const AskewBody & body, const Spacing3 & spacing, const Size3 & lower = { 0, 0, 0 })
{
  const auto side = [&](std::size_t axis) { return static_cast<std::int32_t>(2 * kMiddleOfAskew / spacing[axis]) + 1; };
  return ShapeWhere(
    { side(0), side(1), side(2) },
    [&](int x, int y, int z) {
      const Vector3 from{ (x + 0.5) * spacing[0] - kMiddleOfAskew,
                          (y + 0.5) * spacing[1] - kMiddleOfAskew,
                          (z + 0.5) * spacing[2] - kMiddleOfAskew };
      Vector3       along{};
      for (std::size_t k = 0; k < 3; ++k)
      {
        along[k] = kAskewAxes[k][0] * from[0] + kAskewAxes[k][1] * from[1] + kAskewAxes[k][2] * from[2];
      }
      return body.inside(along);
    },
    lower);
}

/** Bodies whose sheets end in smooth closed curves. */
const std::vector<AskewBody> &
BodiesWithRims()
{
  static const std::vector<AskewBody> bodies{
    { "ellipsoid", [](const Vector3 & p) { return p[0] * p[0] / 240 + p[1] * p[1] / 130 + p[2] * p[2] / 42 <= 1; } },
    // What two balls of radius 22 mm share, 12 mm thick.
    { "lens", [](const Vector3 & p) { return std::hypot(p[0], p[1], std::abs(p[2]) + 16) <= 22; } },
    // 6 mm thick.
    { "disc", [](const Vector3 & p) { return std::hypot(p[0], p[1]) <= 15 && std::abs(p[2]) <= 3; } },
  };
  return bodies;
}

constexpr double kVoxelDiagonals = 1.2; // the tolerance that is used by default

/** Of a refined core's rim vertices, where two edges of one triangle each meet, the part at which the rim turns by more
 *  than 60 degrees; measured in mm. */
double
PartOfSharpTurns(const RefinedCore & refined, const Spacing3 & spacing)
{
  const CellComplex &      cells = refined.core.cells;
  std::vector<std::size_t> facesAt(cells.edges.size(), 0);
  for (const ElementIndex edge : cells.faceEdges)
  {
    ++facesAt[edge];
  }
  std::vector<std::vector<ElementIndex>> rimAt(cells.vertexCount);
  for (std::size_t edge = 0; edge < facesAt.size(); ++edge)
  {
    if (facesAt[edge] == 1)
    {
      rimAt[cells.edges[edge][0]].push_back(cells.edges[edge][1]);
      rimAt[cells.edges[edge][1]].push_back(cells.edges[edge][0]);
    }
  }
  const auto way = [&](ElementIndex from, ElementIndex to) {
    Vector3 d = Minus(refined.core.positions[to], refined.core.positions[from]);
    for (std::size_t k = 0; k < 3; ++k)
    {
      d[k] *= spacing[k];
    }
    return d;
  };
  int all = 0;
  int sharp = 0;
  for (ElementIndex vertex = 0; vertex < rimAt.size(); ++vertex)
  {
    if (rimAt[vertex].size() == 2)
    {
      const Vector3 in = way(rimAt[vertex][0], vertex);
      const Vector3 out = way(vertex, rimAt[vertex][1]);
      const double  dot = in[0] * out[0] + in[1] * out[1] + in[2] * out[2];
      ++all;
      sharp +=
        dot < std::cos(std::numbers::pi / 3) * std::hypot(in[0], in[1], in[2]) * std::hypot(out[0], out[1], out[2]);
    }
  }
  EXPECT_GT(all, 50); // else there is no rim to speak of
  return static_cast<double>(sharp) / std::max(all, 1);
}

// What a tolerance leaves ends along the zigzag of polygons that are taken or left as a whole: a third to a half of the
// vertices along such a rim turn by more than 60 degrees before rims are smoothed.
TEST(RefineByTolerance, LeavesRimsThatAreCurvesAndTheBoundaryCovered)
{
  for (const Spacing3 & spacing : { Spacing3{ 1, 1, 1 }, Spacing3{ 0.8, 0.8, 1.6 } })
  {
    const double height = kVoxelDiagonals * std::hypot(spacing[0], spacing[1], spacing[2]);
    for (const AskewBody & body : BodiesWithRims())
    {
      SCOPED_TRACE(std::string(body.name) + ", slices of " + std::to_string(spacing[2]));
      const VoxelShape  shape = VoxelsOf(body, spacing);
      const RefinedCore refined = RefineByTolerance(shape, spacing, height);
      EXPECT_LE(PartOfSharpTurns(refined, spacing), 0.05);
      EXPECT_EQ(ComputeComplexTopology(refined.core.cells), ComputeShapeTopology(shape));
      const BoundaryGap gap =
        LargestWeighedGap(shape, ComputeSpacingWeights(spacing), refined.core.positions, refined.core.radius);
      EXPECT_LE(gap.largest, height * (1 + 1e-9));
    }
  }
}

TEST(RefineByTolerance, LeavesTheSameRimsForAnyNumberOfThreads)
{
  for (const AskewBody & body : BodiesWithRims())
  {
    SCOPED_TRACE(body.name);
    const VoxelShape shape = VoxelsOf(body, { 1, 1, 1 });
    const auto       with = [&](int count) {
      const Threads threads(count);
      return RefineByTolerance(shape, { 1, 1, 1 }, kVoxelDiagonals * std::sqrt(3.0));
    };
    const RefinedCore one = with(1);
    const RefinedCore two = with(2);
    EXPECT_EQ(one.core.positions, two.core.positions);
    EXPECT_EQ(one.core.radius, two.core.radius);
    EXPECT_EQ(one.core.faceLambda, two.core.faceLambda);
    EXPECT_EQ(one.core.cells.edges, two.core.cells.edges);
    EXPECT_EQ(one.core.cells.faceVertices, two.core.cells.faceVertices);
    EXPECT_EQ(one.kept, two.kept);
    EXPECT_EQ(one.polygons, two.polygons);
    EXPECT_EQ(one.polygons.size(), one.core.cells.FaceCount());
    EXPECT_EQ(one.hairsTaken, two.hairsTaken);
  }
}

// The middle sheet of a flat box has corners, and from each of them the line on which sheets meet leads to a corner of
// the box, as far as a ball must for that corner to lie within the tolerance. The former stay within 0.1 voxel;
// the latter may end as a hair, and lie up to 1.03 voxels before there.
TEST(RefineByTolerance, KeepsTheCornersOfABoxsSheets)
{
  constexpr Vector3 half{ 17, 11, 5 };
  const AskewBody   box{ "box", [&](const Vector3 & p) {
                        return std::abs(p[0]) <= half[0] && std::abs(p[1]) <= half[1] && std::abs(p[2]) <= half[2];
                      } };
  const double      height = kVoxelDiagonals * std::sqrt(3.0);
  const VoxelShape  shape = VoxelsOf(box, { 1, 1, 1 });
  const RefinedCore refined = RefineByTolerance(shape, { 1, 1, 1 }, height);
  EXPECT_EQ(ComputeComplexTopology(refined.core.cells), ComputeShapeTopology(shape));
  const TriangleTree tree = TreeOf(refined.core);
  // The radius of the middle sheet's balls, and of the last one on the way to a corner; how far off it may be.
  for (const auto & [radius, most] : { std::pair{ half[2], 0.5 }, std::pair{ height / (std::sqrt(3.0) - 1), 1.25 } })
  {
    for (int signs = 0; signs < 8; ++signs)
    {
      Vector3 corner{ kMiddleOfAskew, kMiddleOfAskew, kMiddleOfAskew };
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const double along = ((signs >> axis) % 2 == 0 ? -1 : 1) * (half[axis] - radius);
        for (std::size_t k = 0; k < 3; ++k)
        {
          corner[k] += along * kAskewAxes[axis][k];
        }
      }
      double gap = std::sqrt(tree.FindNearest(corner, 1e9).squaredDistance);
      for (const Vector3 & place : refined.core.positions) // of lines, too
      {
        const Vector3 from = Minus(place, corner);
        gap = std::min(gap, std::hypot(from[0], from[1], from[2]));
      }
      EXPECT_LT(gap, most) << "radius " << radius << ", " << signs;
    }
  }
}

} // namespace
} // namespace voxelcore::testing
