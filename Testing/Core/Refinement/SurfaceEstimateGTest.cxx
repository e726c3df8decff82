// Estimates of surfaces that are known.

#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Refinement/SurfaceEstimate.h"
#include "voxelcore/Shape/BoundaryVertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace voxelcore::testing
{
namespace
{

constexpr double kRadius = 11.3;
constexpr double kCentre = 14.37;

double
FromCentre(double x, double y, double z, const Vector3 & spacing)
{
  return std::hypot(spacing[0] * x - kCentre, spacing[1] * y - kCentre, spacing[2] * z - kCentre);
}

VoxelShape
Ball(const Vector3 & spacing)
{
  const auto side = [&](std::size_t axis) { return static_cast<std::int32_t>(2 * kCentre / spacing[axis]) + 1; };
  return ShapeWhere({ side(0), side(1), side(2) },
                    [&](int x, int y, int z) { return FromCentre(x + 0.5, y + 0.5, z + 0.5, spacing) <= kRadius; });
}

// Mean distance of the anchors of all boundary vertices from the sphere, in mm; counts those that were not found.
double
MeanError(const VoxelShape & shape, const SurfaceEstimate & surface, const Vector3 & spacing, int & missing)
{
  double sum = 0;
  int    found = 0;
  missing = 0;
  for (const LatticePoint & p : BoundaryVertices(shape))
  {
    const SurfacePoint point = surface.Project({ p.x * spacing[0], p.y * spacing[1], p.z * spacing[2] }, 3);
    missing += point.found ? 0 : 1;
    if (point.found)
    {
      ++found;
      const auto & at = point.position;
      sum += std::abs(std::hypot(at[0] - kCentre, at[1] - kCentre, at[2] - kCentre) - kRadius);
      EXPECT_NEAR(std::hypot(point.normal[0], point.normal[1], point.normal[2]), 1, 1e-12);
    }
  }
  return sum / found;
}

TEST(SurfaceEstimate, LabelsOfABallGiveItsSurfaceBackWithinATenthOfAVoxel)
{
  for (const Vector3 & spacing : { Vector3{ 1, 1, 1 }, Vector3{ 0.8, 0.8, 1.6 } })
  {
    const VoxelShape shape = Ball(spacing);
    int              missing = 0;
    EXPECT_LT(MeanError(shape, *SurfaceFromLabels(shape, spacing), spacing, missing), 0.1) << spacing[2];
    EXPECT_EQ(missing, 0);
  }
}

// The smoothing has as many voxels along each axis as its width in mm has.
TEST(SurfaceEstimate, LabelsOfABallInFlatVoxelsGiveItsSurfaceBackWithinATenthOfTheirLongestSide)
{
  for (const Vector3 & spacing :
       { Vector3{ 0.5, 1, 2 }, Vector3{ 2.5, 0.7, 0.7 }, Vector3{ 0.4, 2.4, 1.2 }, Vector3{ 3, 3, 0.8 } })
  {
    const VoxelShape shape = Ball(spacing);
    int              missing = 0;
    const double     longest = *std::max_element(spacing.begin(), spacing.end());
    EXPECT_LT(MeanError(shape, *SurfaceFromLabels(shape, spacing), spacing, missing), 0.1 * longest)
      << spacing[0] << " " << spacing[1] << " " << spacing[2];
    EXPECT_EQ(missing, 0);
  }
}

// Fields of many layers are made in slabs along z.
TEST(SurfaceEstimate, LabelsOfALongRodGiveTheSameSurfaceAlongEveryAxis)
{
  constexpr int    length = 230;
  constexpr double middle = 6.3;
  constexpr double radius = 4.2;
  const auto       rod = [&](std::size_t axis) {
    std::array<int, 3> size{ 13, 13, 13 };
    size[axis] = length;
    return ShapeWhere(size, [&](int x, int y, int z) {
      const std::array<int, 3> at{ x, y, z };
      return std::hypot(at[(axis + 1) % 3] + 0.5 - middle, at[(axis + 2) % 3] + 0.5 - middle) <= radius;
    });
  };
  std::vector<std::vector<double>> distances;
  for (const std::size_t axis : { 0U, 2U })
  {
    const VoxelShape shape = rod(axis);
    const auto       surface = SurfaceFromLabels(shape, { 1, 1, 1 });
    distances.emplace_back();
    for (int along = 10; along < length - 10; along += 3)
    {
      for (int around = 0; around < 8; ++around)
      {
        Vector3 place{};
        place[axis] = along;
        place[(axis + 1) % 3] = middle + 5 * std::cos(around);
        place[(axis + 2) % 3] = middle + 5 * std::sin(around);
        const SurfacePoint point = surface->Project(place, 3);
        ASSERT_TRUE(point.found);
        const double b = point.position[(axis + 1) % 3] - middle;
        const double c = point.position[(axis + 2) % 3] - middle;
        EXPECT_NEAR(std::hypot(b, c), radius, 0.25);
        distances.back().push_back(std::hypot(b, c));
      }
    }
  }
  for (std::size_t n = 0; n < distances[0].size(); ++n)
  {
    EXPECT_NEAR(distances[0][n], distances[1][n], 0.02) << n;
  }
}

TEST(SurfaceEstimate, OfNothingNoPlaceHasASurface)
{
  const VoxelShape none = ShapeWhere({ 3, 3, 3 }, [](int, int, int) { return false; });
  const Vector3    one{ 1, 1, 1 };
  EXPECT_FALSE(SurfaceFromLabels(none, one)->Project({ 1, 1, 1 }, 9).found);
  const GreyRows zeros = [](std::int32_t, std::int32_t, std::int32_t, std::span<float> values) {
    std::fill(values.begin(), values.end(), 0.0F);
  };
  EXPECT_FALSE(SurfaceFromGrey(none, one, { { 0, 0, 0 }, { 3, 3, 3 } }, zeros)->Project({ 1, 1, 1 }, 9).found);
  EXPECT_FALSE(SurfaceFromTriangles({}, {})->Project({ 1, 1, 1 }, 9).found);
  // A triangle without an area has no normal.
  const std::vector<Vector3>                      corners{ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 } };
  const std::vector<std::array<std::uint32_t, 3>> thin{ { 0, 1, 2 } };
  const std::vector<std::array<std::uint32_t, 3>> wide{ { 0, 1, 3 } };
  EXPECT_FALSE(SurfaceFromTriangles(corners, thin)->Project({ 1, 1, 0 }, 9).found);
  EXPECT_TRUE(SurfaceFromTriangles(corners, wide)->Project({ 1, 1, 0 }, 9).found);
  EXPECT_FALSE(SurfaceFromTriangles(corners, wide)->Project({ 1, 1, 30 }, 9).found);
}

TEST(SurfaceEstimate, OnlyThatOfLabelsSaysThatItIs)
{
  const VoxelShape shape = Ball({ 1, 1, 1 });
  EXPECT_TRUE(SurfaceFromLabels(shape, { 1, 1, 1 })->IsOfLabels());
  EXPECT_FALSE(SurfaceFromTriangles({}, {})->IsOfLabels());
}

TEST(SurfaceEstimate, GreyValuesThatLackARowAreAMistakeOfTheCaller)
{
  const VoxelShape shape = Ball({ 1, 1, 1 });
  GreyBoxRows      grey;
  grey.box = GreyBoxAround(shape.Box(), shape.Box());
  grey.visit = [&](const GreyRowTaker & take) {
    const std::vector<float> row(static_cast<std::size_t>(grey.box.size[0]), 1.0F);
    for (std::int32_t z = 1; z < grey.box.size[2]; ++z) // the first slice is left out
    {
      for (std::int32_t y = 0; y < grey.box.size[1]; ++y)
      {
        take(grey.box.lower[1] + y, grey.box.lower[2] + z, row);
      }
    }
  };
  EXPECT_THROW(SurfaceFromGrey(shape, { 1, 1, 1 }, shape.Box(), grey), std::logic_error);
}

// Passes that flatten long terraces must not move what is curved, nor what is near a wall, however large a ball is.
TEST(SurfaceEstimate, LabelsOfBallsOfAllSizesGiveNoneTooLargeOrTooSmall)
{
  for (const double radius : { 5.3, 8.1, 11.3, 16.2, 25.4 })
  {
    const double centre = radius + 3.07;
    const auto   side = static_cast<std::int32_t>(2 * centre) + 1;
    const auto   outside = [&](double x, double y, double z) {
      return std::hypot(x - centre, y - centre, z - centre) - radius;
    };
    const VoxelShape shape =
      ShapeWhere({ side, side, side }, [&](int x, int y, int z) { return outside(x + 0.5, y + 0.5, z + 0.5) <= 0; });
    const auto surface = SurfaceFromLabels(shape, { 1, 1, 1 });
    double     sum = 0;
    double     largest = 0;
    const auto points = BoundaryVertices(shape);
    for (const LatticePoint & p : points)
    {
      const SurfacePoint point = surface->Project({ 1.0 * p.x, 1.0 * p.y, 1.0 * p.z }, 1.5);
      ASSERT_TRUE(point.found);
      const double error = outside(point.position[0], point.position[1], point.position[2]);
      sum += error;
      largest = std::max(largest, std::abs(error));
    }
    EXPECT_LT(std::abs(sum / static_cast<double>(points.size())), radius < 8 ? 0.08 : 0.05) << radius;
    EXPECT_LT(largest, 0.2) << radius;
  }
}

// Edges are rounded no more than labels allow, walls swell little beside them, and far from edges walls are flat.
TEST(SurfaceEstimate, LabelsOfALargeBoxGiveItsWallsAndEdges)
{
  constexpr double             middle = 28;
  const std::array<Vector3, 3> axes{
    { { 0.8174, 0.4417, 0.3697 }, { -0.5683, 0.7221, 0.3938 }, { -0.0930, -0.5320, 0.8416 } }
  };
  const std::array<double, 3> half{ 19.3, 16.2, 14.1 };
  const auto                  depths = [&](const Vector3 & p) {
    std::array<double, 3> depth{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      depth[k] =
        half[k] - std::abs(axes[k][0] * (p[0] - middle) + axes[k][1] * (p[1] - middle) + axes[k][2] * (p[2] - middle));
    }
    std::sort(depth.begin(), depth.end());
    return depth;
  };
  const VoxelShape shape = ShapeWhere({ 56, 56, 56 }, [&](int x, int y, int z) {
    return depths({ x + 0.5, y + 0.5, z + 0.5 })[0] >= 0;
  });
  const auto       surface = SurfaceFromLabels(shape, { 1, 1, 1 });
  double           sum = 0;
  int              count = 0;
  double           outwards = 0;
  int              beside = 0;
  for (const LatticePoint & p : BoundaryVertices(shape))
  {
    const SurfacePoint point = surface->Project({ 1.0 * p.x, 1.0 * p.y, 1.0 * p.z }, 1.5);
    ASSERT_TRUE(point.found);
    const auto depth = depths(point.position);
    EXPECT_LT(std::abs(depth[0]), depth[1] < 3 ? 1.1 : 0.35);
    if (depth[1] >= 3 && depth[1] < 8 && depth[2] > 11)
    {
      outwards -= depth[0];
      ++beside;
    }
    if (depth[1] >= 11)
    {
      sum += std::abs(depth[0]);
      ++count;
    }
  }
  EXPECT_LT(sum / count, 0.04);
  EXPECT_LT(std::abs(outwards / beside), 0.08); // 0.17 after the same passes everywhere
}

// Which passes are taken goes with how thick a label is: thin, thick, thickest, in an order in which each comes after
// another.
TEST(SurfaceEstimate, OfManyLabelsEachHasTheSurfaceItHasAlone)
{
  const Vector3 spacing{ 1, 1, 1.5 };
  const auto    surfaces = SurfacesFromLabels(spacing);
  for (const double radius : { 4.3, 26.2, 11.7, 26.2, 4.3 })
  {
    const auto       side = static_cast<std::int32_t>(2 * radius) + 3;
    const double     middle = 0.5 * side;
    const VoxelShape shape = ShapeWhere({ side, side, side }, [&](int x, int y, int z) {
      return std::hypot(x + 0.5 - middle, y + 0.5 - middle, spacing[2] * (z + 0.5 - middle)) <= radius;
    });
    const auto       one = surfaces(shape, {});
    const auto       alone = SurfaceFromLabels(shape, spacing);
    for (const LatticePoint & p : BoundaryVertices(shape))
    {
      const Vector3      place{ 1.0 * p.x, 1.0 * p.y, spacing[2] * p.z };
      const SurfacePoint found = one->Project(place, 2);
      const SurfacePoint expected = alone->Project(place, 2);
      ASSERT_TRUE(found.found);
      ASSERT_EQ(found.position, expected.position) << radius;
    }
    EXPECT_EQ(one->Swelling({ 3, 0, 0 }), alone->Swelling({ 3, 0, 0 }));
  }
}

TEST(SurfaceEstimate, GreyValuesOfABallGiveItsSurfaceBackWithinAFiftiethOfAVoxel)
{
  const Vector3    spacing{ 1, 1, 1 };
  const VoxelShape shape = Ball(spacing);
  const auto       rows = [&](std::int32_t x, std::int32_t y, std::int32_t z, std::span<float> values) {
    for (float & value : values)
    {
      value = static_cast<float>(std::clamp(kRadius - FromCentre(x++ + 0.5, y + 0.5, z + 0.5, spacing), -0.7, 0.7));
    }
  };
  int missing = 0;
  EXPECT_LT(MeanError(shape, *SurfaceFromGrey(shape, spacing, shape.Box(), rows), spacing, missing), 0.02);
  EXPECT_EQ(missing, 0);
}

// The part of a voxel where `height` (of its place, in mm) is positive, of 6^3 samples, less a half.
template <typename THeight>
float
PartAbove(int x, int y, int z, THeight height)
{
  constexpr int parts = 6;
  int           in = 0;
  for (int i = 0; i < parts * parts * parts; ++i)
  {
    const auto at = [&](int voxel, int k) { return voxel + (k % parts + 0.5) / parts; };
    in += height(Vector3{ at(x, i), at(y, i / parts), at(z, i / parts / parts) }) > 0 ? 1 : 0;
  }
  return static_cast<float>(in) / (parts * parts * parts) - 0.5F;
}

template <typename THeight>
std::unique_ptr<SurfaceEstimate>
SurfaceOfParts(const VoxelShape & shape, THeight height)
{
  return SurfaceFromGrey(shape,
                         { 1, 1, 1 },
                         shape.Box(),
                         [=](std::int32_t x, std::int32_t y, std::int32_t z, auto values) {
                           for (float & value : values)
                           {
                             value = PartAbove(x++, y, z, height);
                           }
                         });
}

// What is interpolated between voxels has ripples a voxel long, a fiftieth high: these lean by several hundredths.
TEST(SurfaceEstimate, GreyValuesOfABallGiveNormalsWithinAHundredth)
{
  const auto height = [](const Vector3 & p) {
    return kRadius - std::hypot(p[0] - kCentre, p[1] - kCentre, p[2] - kCentre);
  };
  const VoxelShape shape = Ball({ 1, 1, 1 });
  const auto       surface = SurfaceOfParts(shape, height);
  double           sum = 0;
  int              count = 0;
  for (const LatticePoint & p : BoundaryVertices(shape))
  {
    const SurfacePoint point = surface->Project({ 1.0 * p.x, 1.0 * p.y, 1.0 * p.z }, 1.5);
    ASSERT_TRUE(point.found);
    const Vector3 out{ point.position[0] - kCentre, point.position[1] - kCentre, point.position[2] - kCentre };
    const double  along = out[0] * point.normal[0] + out[1] * point.normal[1] + out[2] * point.normal[2];
    sum += 1 - std::pow(along / std::hypot(out[0], out[1], out[2]), 2);
    ++count;
  }
  EXPECT_LT(std::sqrt(sum / count), 0.01);
}

// Wide smoothing alone would move the walls of this sheet by an eighth of a voxel.
TEST(SurfaceEstimate, GreyValuesOfASheetFourVoxelsThickGiveItsWallsWithinATwentiethOfAVoxel)
{
  constexpr double half = 2;
  const Vector3    n{ 0.36, 0.48, 0.8 };
  const auto aside = [=](const Vector3 & p) { return n[0] * (p[0] - 16) + n[1] * (p[1] - 16) + n[2] * (p[2] - 16); };
  const auto height = [=](const Vector3 & p) { return half - std::abs(aside(p)); };
  const VoxelShape shape = ShapeWhere({ 32, 32, 32 }, [&](int x, int y, int z) {
    return height({ x + 0.5, y + 0.5, z + 0.5 }) > 0;
  });
  const auto       surface = SurfaceOfParts(shape, height);
  int              count = 0;
  for (const LatticePoint & p : BoundaryVertices(shape))
  {
    if (std::min({ p.x, p.y, p.z, 32 - p.x, 32 - p.y, 32 - p.z }) < 6)
    {
      continue;
    }
    const SurfacePoint point = surface->Project({ 1.0 * p.x, 1.0 * p.y, 1.0 * p.z }, 1.5);
    ASSERT_TRUE(point.found);
    EXPECT_NEAR(std::abs(aside(point.position)), half, 0.05);
    ++count;
  }
  EXPECT_GT(count, 500);
}

TEST(SurfaceEstimate, AtTheScansBorderTheSurfaceIsTheBorder)
{
  const VoxelShape shape = Box({ 8, 8, 8 });
  const auto surface = SurfaceFromGrey(shape, { 1, 1, 1 }, shape.Box(), [](auto, auto, auto, std::span<float> values) {
    std::fill(values.begin(), values.end(), 100.0F);
  });
  const SurfacePoint point = surface->Project({ 4, 4, 0.3 }, 1);
  ASSERT_TRUE(point.found);
  EXPECT_NEAR(point.position[2], 0, 1e-3);
}

} // namespace
} // namespace voxelcore::testing
