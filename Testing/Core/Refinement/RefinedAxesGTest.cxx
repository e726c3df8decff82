// Refined cores of bodies whose medial axes are known: they are nearer to these.

#include "RefinedCores.h"

#include "voxelcore/VoxelCore/LambdaPruning.h"

#include <algorithm>
#include <cmath>

namespace voxelcore::testing
{
namespace
{

using Triangle3 = std::array<std::uint32_t, 3>;

// The axis of this slab, off the grid's directions, is the plane through its middle. It is wide enough that its sharp
// rim, which labels do not show, is far from where it is looked at; counted in voxels it is 7.6 thick on the thick
// slices.
TEST(RefineCore, BringsASlabsCoreToItsMiddlePlaneAndItsRadiusToHalfItsThickness)
{
  constexpr double middle = 22;
  const Vector3    n{ 0.36, 0.48, 0.8 };
  for (const Spacing3 & spacing : { Spacing3{ 1, 1, 1 }, Spacing3{ 0.8, 0.8, 1.6 } })
  {
    const auto height = [&](const Vector3 & p) {
      return n[0] * (p[0] * spacing[0] - middle) + n[1] * (p[1] * spacing[1] - middle) +
             n[2] * (p[2] * spacing[2] - middle);
    };
    const auto side = [&](std::size_t axis) { return static_cast<std::int32_t>(2 * middle / spacing[axis]); };
    const auto fromAxis = [&](double x, double y) {
      return std::hypot(x * spacing[0] - middle, y * spacing[1] - middle);
    };
    const VoxelShape shape = ShapeWhere({ side(0), side(1), side(2) }, [&](int x, int y, int z) {
      return std::abs(height({ x + 0.5, y + 0.5, z + 0.5 })) <= 5.2 && fromAxis(x + 0.5, y + 0.5) < 18;
    });
    // Mean distance from the plane and mean error of the radius, away from the rim.
    const auto score = [&](const MedialComplex & core) {
      std::array<double, 3> sum{ 0, 0, 0 };
      for (std::size_t vertex = 0; vertex < core.positions.size(); ++vertex)
      {
        const Vector3 & p = core.positions[vertex];
        if (fromAxis(p[0], p[1]) < 6)
        {
          sum[0] += 1;
          sum[1] += std::abs(height(p));
          sum[2] += core.radius[vertex] - 5.2;
        }
      }
      return std::array{ sum[1] / sum[0], sum[2] / sum[0] };
    };
    const auto raw = score(PruneByLambda(CoreOf(shape, spacing), { 3 })[0]);
    const auto refined = score(Refine(shape, spacing, 3).core);
    EXPECT_LT(refined[0], 0.5 * raw[0]);
    EXPECT_LT(std::abs(refined[1]), 0.15);
    EXPECT_LT(raw[1], -0.2);
  }
}

// Beside the axis of a tube the feet of a wing of the core meet, so that wings go: what is left lies near the axis.
// What the guard holds back beside it has met there as well, and goes.
TEST(RefineCore, LeavesOfATubeALineOnItsAxis)
{
  constexpr double radius = 6.3;
  const Vector3    along{ 0.36, 0.48, 0.8 };
  const auto       fromAxis = [&](const Vector3 & p) {
    const Vector3 q{ p[0] - 20, p[1] - 20, p[2] - 20 };
    const double  t = q[0] * along[0] + q[1] * along[1] + q[2] * along[2];
    return std::array{ std::hypot(q[0] - t * along[0], q[1] - t * along[1], q[2] - t * along[2]), t };
  };
  const auto contains = [&](const Vector3 & p) {
    const auto [distance, t] = fromAxis(p);
    return distance <= radius && std::abs(t) < 16;
  };
  const VoxelShape shape = ShapeWhere({ 40, 40, 40 }, [&](int x, int y, int z) {
    return contains({ x + 0.5, y + 0.5, z + 0.5 });
  });
  // By area, of faces in the middle of the tube.
  const auto spread = [&](const MedialComplex & core) {
    double sum = 0;
    double area = 0;
    for (std::size_t face = 0; face < core.cells.FaceCount(); ++face)
    {
      const auto corners = core.cells.FaceVertices(face);
      for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      {
        const Vector3 & a = core.positions[corners[0]];
        const Vector3 & b = core.positions[corners[i]];
        const Vector3 & c = core.positions[corners[i + 1]];
        const auto [distance, t] =
          fromAxis({ (a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, (a[2] + b[2] + c[2]) / 3 });
        if (std::abs(t) < 6)
        {
          const Vector3 normal = Normal(a, b, c, { 1, 1, 1 });
          const double  size = 0.5 * std::hypot(normal[0], normal[1], normal[2]);
          sum += size * distance;
          area += size;
        }
      }
    }
    return std::array{ area > 0 ? sum / area : 0.0, area };
  };
  const auto farthest = [&](const MedialComplex & core) {
    double most = 0;
    for (const Vector3 & p : core.positions)
    {
      const auto [distance, t] = fromAxis(p);
      most = std::abs(t) < 6 ? std::max(most, distance) : most;
    }
    return most;
  };
  const auto raw = spread(PruneByLambda(CoreOf(shape, { 1, 1, 1 }), { 2.5 })[0]);
  const auto fromLabels = spread(Refine(shape, { 1, 1, 1 }, 2.5).core);
  EXPECT_LT(fromLabels[0], 0.5 * raw[0]);
  EXPECT_LT(fromLabels[1], 0.5 * raw[1]);

  const auto grey =
    SurfaceFromGrey(shape, { 1, 1, 1 }, shape.Box(), [&](std::int32_t x, std::int32_t y, std::int32_t z, auto values) {
      constexpr int parts = 4;
      for (float & value : values)
      {
        int in = 0;
        for (int i = 0; i < parts * parts * parts; ++i)
        {
          const auto at = [&](int voxel, int k) { return voxel + (k % parts + 0.5) / parts; };
          in += contains({ at(x, i), at(y, i / parts), at(z, i / parts / parts) }) ? 1 : 0;
        }
        ++x;
        value = static_cast<float>(in) / (parts * parts * parts) - 0.5F;
      }
    });
  const MedialComplex fromGrey = Refine(shape, { 1, 1, 1 }, 2.5, grey.get()).core;
  EXPECT_LT(spread(fromGrey)[0], 0.2 * raw[0]);
  EXPECT_LT(spread(fromGrey)[1], 0.2 * raw[1]);
  EXPECT_LT(farthest(fromGrey), 0.4);
}

constexpr double kMiddle = 20;

// `x` and `y` across and `t` along a line off the grid's directions through the middle.
Vector3
FromTilted(double x, double y, double t)
{
  return { kMiddle + 0.8 * x + 0.48 * y + 0.36 * t,
           kMiddle - 0.6 * x + 0.64 * y + 0.48 * t,
           kMiddle - 0.6 * y + 0.8 * t };
}

Vector3
ToTilted(const Vector3 & p)
{
  const Vector3 q{ p[0] - kMiddle, p[1] - kMiddle, p[2] - kMiddle };
  return { 0.8 * q[0] - 0.6 * q[1], 0.48 * q[0] + 0.64 * q[1] - 0.6 * q[2], 0.36 * q[0] + 0.48 * q[1] + 0.8 * q[2] };
}

// Near the axis the surface of a tube is hardly nearer on one side than on the other: less so than a facet is high.
TEST(RefineCore, LeavesOfATubeOfFlatFacetsALineOnItsAxis)
{
  constexpr double       radius = 9.3;
  constexpr int          facets = 120;
  std::vector<Vector3>   vertices;
  std::vector<Triangle3> triangles;
  for (std::uint32_t i = 0; i < facets; ++i)
  {
    const double angle = 2 * std::acos(-1.0) * i / facets;
    for (const double t : { -40.0, 40.0 })
    {
      vertices.push_back(FromTilted(radius * std::cos(angle), radius * std::sin(angle), t));
    }
    const std::uint32_t next = 2 * ((i + 1) % facets);
    triangles.push_back({ 2 * i, 2 * i + 1, next });
    triangles.push_back({ 2 * i + 1, next + 1, next });
  }
  const auto fromAxis = [](const Vector3 & p) {
    const Vector3 q = ToTilted(p);
    return std::hypot(q[0], q[1]);
  };
  const VoxelShape shape = ShapeWhere({ 40, 40, 40 }, [&](int x, int y, int z) {
    return fromAxis({ x + 0.5, y + 0.5, z + 0.5 }) <= radius;
  });
  const auto       surface = SurfaceFromTriangles(vertices, triangles);
  const auto       refined = Refine(shape, { 1, 1, 1 }, 4, surface.get());
  double           most = 0;
  for (const Vector3 & p : refined.core.positions)
  {
    most = std::abs(ToTilted(p)[2]) < 6 ? std::max(most, fromAxis(p)) : most;
  }
  EXPECT_LT(most, 0.15);
}

// The exact surface of a capsule along a line off the grid's directions.
class CapsuleSurface : public SurfaceEstimate
{
public:
  static constexpr double kHalf = 19.2;
  static constexpr double kRadius = 8.96;

  static Vector3
  FromAxis(const Vector3 & p)
  {
    const Vector3 q{ p[0] - kCentre[0], p[1] - kCentre[1], p[2] - kCentre[2] };
    const double  t = std::clamp(q[0] * kAlong[0] + q[1] * kAlong[1] + q[2] * kAlong[2], -kHalf, kHalf);
    return { q[0] - t * kAlong[0], q[1] - t * kAlong[1], q[2] - t * kAlong[2] };
  }

  static double
  Distance(const Vector3 & p)
  {
    const Vector3 q = FromAxis(p);
    return std::hypot(q[0], q[1], q[2]);
  }

  SurfacePoint
  Project(const Vector3 & place, double reach) const override
  {
    const Vector3 q = FromAxis(place);
    const double  away = std::hypot(q[0], q[1], q[2]);
    SurfacePoint  point;
    point.found = away > 0 && std::abs(away - kRadius) <= reach;
    for (std::size_t i = 0; i < 3 && away > 0; ++i)
    {
      point.normal[i] = q[i] / away;
      point.position[i] = place[i] + (kRadius - away) * point.normal[i];
    }
    return point;
  }

private:
  static constexpr Vector3 kCentre{ 30.46, 30.23, 32.21 };
  static constexpr Vector3 kAlong{ 0.25, 0.87, 0.42510 };
};

// Where all feet meet beside the axis, measures do not tell what is nearest to it; and what has been moved as a line is
// measured where it is.
TEST(RefineCore, LeavesOfACapsuleNothingBesideItsAxis)
{
  const CapsuleSurface surface;
  for (const Spacing3 & spacing : { Spacing3{ 1, 1, 1 }, Spacing3{ 0.8, 0.8, 1.6 } })
  {
    const auto distance = [&](double x, double y, double z) {
      return CapsuleSurface::Distance({ x * spacing[0], y * spacing[1], z * spacing[2] });
    };
    const VoxelShape shape = ShapeWhere({ 80, 80, 80 }, [&](int x, int y, int z) {
      return distance(x + 0.5, y + 0.5, z + 0.5) <= CapsuleSurface::kRadius;
    });
    const auto       refined = Refine(shape, spacing, 2.5, &surface);
    double           most = 0;
    for (const Vector3 & p : refined.core.positions)
    {
      most = std::max(most, distance(p[0], p[1], p[2]));
    }
    EXPECT_LT(most, 0.3) << "voxels " << spacing[2] << " thick";
  }
}

// Around the middle of two slabs that cross, balls touch the creases where their walls meet.
TEST(RefineCore, BringsTheSheetsOfCrossingSlabsToTheirMiddlePlanesUpToWhereTheyMeet)
{
  constexpr double       half = 5.2;
  std::vector<Vector3>   vertices;
  std::vector<Triangle3> triangles;
  for (const double a : { -1.0, 1.0 })
  {
    for (const double b : { -1.0, 1.0 })
    {
      // From a crease outwards, along either slab.
      for (const auto & out : { std::array{ 40.0, half }, std::array{ half, 40.0 } })
      {
        const auto first = static_cast<std::uint32_t>(vertices.size());
        for (const auto & [x, y] : { std::array{ half, half }, out })
        {
          for (const double t : { -40.0, 40.0 })
          {
            vertices.push_back(FromTilted(a * x, b * y, t));
          }
        }
        triangles.push_back({ first, first + 1, first + 2 });
        triangles.push_back({ first + 1, first + 3, first + 2 });
      }
    }
  }
  const VoxelShape shape = ShapeWhere({ 40, 40, 40 }, [&](int x, int y, int z) {
    const Vector3 at = ToTilted({ x + 0.5, y + 0.5, z + 0.5 });
    return std::min(std::abs(at[0]), std::abs(at[1])) <= half;
  });
  const auto       surface = SurfaceFromTriangles(vertices, triangles);
  const auto       refined = Refine(shape, { 1, 1, 1 }, 3, surface.get());
  double           sum = 0;
  int              count = 0;
  for (const Vector3 & p : refined.core.positions)
  {
    const Vector3 at = ToTilted(p);
    if (std::abs(at[2]) < 6 && std::max(std::abs(at[0]), std::abs(at[1])) < half)
    {
      sum += std::min(std::abs(at[0]), std::abs(at[1]));
      ++count;
    }
  }
  ASSERT_GT(count, 100);
  EXPECT_LT(sum / count, 0.05);
}

} // namespace
} // namespace voxelcore::testing
