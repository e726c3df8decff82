// Where refined sheets end.

#include "RefinedCores.h"

#include "voxelcore/TriangleTree.h"

#include <algorithm>
#include <cmath>

namespace voxelcore::testing
{
namespace
{

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
  const VoxelShape                          shape = ShapeWhere({ 53, 53, 53 }, [&](int x, int y, int z) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double along =
        axes[k][0] * (x + 0.5 - middle) + axes[k][1] * (y + 0.5 - middle) + axes[k][2] * (z + 0.5 - middle);
      sum += along * along / (k == 0 ? a * a : k == 1 ? b * b : c * c);
    }
    return sum <= 1;
  });
  const RefinedCore                         refined = Refine(shape, { 1, 1, 1 }, threshold);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t face = 0; face < refined.core.cells.FaceCount(); ++face)
  {
    const auto corners = refined.core.cells.FaceVertices(face);
    triangles.push_back({ corners[0], corners[1], corners[2] });
  }
  const TriangleTree tree(refined.core.positions, triangles);
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

} // namespace
} // namespace voxelcore::testing
