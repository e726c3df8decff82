// Where refined sheets end.

#include "RefinedCores.h"

#include "voxelcore/ComplexTopology.h"
#include "voxelcore/ShapeTopology.h"
#include "voxelcore/TriangleTree.h"

#include <algorithm>
#include <cmath>

namespace voxelcore::testing
{
namespace
{

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
  constexpr double             a = 24;
  constexpr double             b = 17;
  constexpr double             c = 11;
  constexpr double             middle = 26.3;
  constexpr double             threshold = 3;
  const std::array<Vector3, 3> axes{
    { { 0.8174, 0.4417, 0.3697 }, { -0.5683, 0.7221, 0.3938 }, { -0.0930, -0.5320, 0.8416 } }
  };
  const VoxelShape   shape = ShapeWhere({ 53, 53, 53 }, [&](int x, int y, int z) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double along =
        axes[k][0] * (x + 0.5 - middle) + axes[k][1] * (y + 0.5 - middle) + axes[k][2] * (z + 0.5 - middle);
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
      rim[k] += u * axes[0][k] + v * axes[1][k];
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

} // namespace
} // namespace voxelcore::testing
