#include "voxelcore/Refinement/TriangleTree.h"

#include "VoxelCoreTesting/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace voxelcore::testing
{
namespace
{

TEST(TriangleTree, FindsWhatTryingAllTrianglesFinds)
{
  Random                                    random(7);
  std::vector<Vector3>                      vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (int i = 0; i < 90; ++i)
  {
    vertices.push_back({ random.Unit(), random.Unit(), random.Unit() });
  }
  for (int i = 0; i < 200; ++i)
  {
    const auto any = [&] { return static_cast<std::uint32_t>(random.Between(0, 89)); };
    triangles.push_back({ any(), any(), any() }); // some degenerate
  }
  const TriangleTree tree(vertices, triangles);
  for (int i = 0; i < 300; ++i)
  {
    const Vector3 place{ 2 * random.Unit() - 0.5, 2 * random.Unit() - 0.5, 2 * random.Unit() - 0.5 };
    double        least = 1e9;
    for (const auto & [a, b, c] : triangles)
    {
      const Vector3 at = NearestOnTriangle(place, { vertices[a], vertices[b], vertices[c] });
      const double  gap = std::hypot(at[0] - place[0], at[1] - place[1], at[2] - place[2]);
      least = std::min(least, gap);
      // No point of the triangle that one happens to look at is nearer.
      const double u = random.Unit();
      const double v = (1 - u) * random.Unit();
      double       other = 0;
      for (std::size_t k = 0; k < 3; ++k)
      {
        const double d = (1 - u - v) * vertices[a][k] + u * vertices[b][k] + v * vertices[c][k] - place[k];
        other += d * d;
      }
      EXPECT_LE(gap, std::sqrt(other) + 1e-12);
    }
    EXPECT_NEAR(std::sqrt(tree.FindNearest(place, 10).squaredDistance), least, 1e-12);
    EXPECT_LT(tree.FindNearest(place, 10).triangle, triangles.size());
    EXPECT_GE(tree.FindNearest(place, 0.5 * least).triangle, triangles.size());
  }
}

TEST(TriangleTree, OfNoTrianglesFindsNone)
{
  const TriangleTree tree({}, {});
  EXPECT_EQ(tree.FindNearest({ 1, 2, 3 }, 5).triangle, TriangleTree({}, {}).FindNearest({ 0, 0, 0 }, 1e9).triangle);
  EXPECT_GT(tree.FindNearest({ 1, 2, 3 }, 5).triangle, 1000000U);
  EXPECT_EQ(tree.FindNearest({ 1, 2, 3 }, 5).squaredDistance, 25);
}

// Many triangles, large and tiny, some as thin as a thread, far from the origin, asked for from near and far: the one
// that is found is that of trying all, to the last bit.
TEST(TriangleTree, FindsTheVeryTriangleThatTryingAllFinds)
{
  Random random(23);
  for (const double size : { 1e-3, 1.0, 200.0 })
  {
    const Vector3                             middle{ 40 * size, -7 * size, 1e3 * random.Unit() };
    std::vector<Vector3>                      vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const auto                                near = [&](const Vector3 & at, double far) {
      Vector3 place = at;
      for (double & along : place)
      {
        along += far * (2 * random.Unit() - 1);
      }
      return place;
    };
    for (std::uint32_t i = 0; i < 3000; ++i)
    {
      const Vector3 at = near(middle, size);
      const double  side = size * (i % 7 == 0 ? 0.5 : 0.02);
      vertices.push_back(at);
      vertices.push_back(near(at, side));
      vertices.push_back(i % 11 == 0 ? near(vertices.back(), 1e-9 * size) : near(at, side));
      triangles.push_back({ 3 * i, 3 * i + 1, 3 * i + 2 });
      if (i % 13 == 0) // a neighbour over a side, and a second one of the same
      {
        triangles.push_back({ 3 * i, 3 * i + 1, static_cast<std::uint32_t>(3 * random.Between(0, i)) });
        triangles.push_back({ 3 * i + 1, 3 * i + 2, 3 * i });
      }
    }
    const TriangleTree tree(vertices, triangles);
    for (int i = 0; i < 300; ++i)
    {
      const Vector3 place = near(i % 3 == 0 ? vertices[static_cast<std::size_t>(i)] : middle,
                                 i % 3 == 0 ? 1e-3 * size : (i % 3 == 1 ? size : 30 * size));
      TriangleTree::Nearest asked;
      asked.squaredDistance = 1e300;
      for (std::uint32_t triangle = 0; triangle < triangles.size(); ++triangle)
      {
        const auto & [a, b, c] = triangles[triangle];
        const Vector3 at = NearestOnTriangle(place, { vertices[a], vertices[b], vertices[c] });
        const double  x = place[0] - at[0];
        const double  y = place[1] - at[1];
        const double  z = place[2] - at[2];
        const double  squared = x * x + y * y + z * z;
        if (squared < asked.squaredDistance)
        {
          asked = { at, squared, triangle };
        }
      }
      const auto likely = static_cast<std::uint32_t>(random.Between(0, static_cast<std::int64_t>(triangles.size())));
      for (const auto & found : { tree.FindNearest(place, 1e9), tree.FindNearest(place, 1e9, likely) })
      {
        ASSERT_EQ(found.triangle, asked.triangle) << "seed 23, size " << size << ", place " << i;
        ASSERT_EQ(found.squaredDistance, asked.squaredDistance);
        ASSERT_EQ(found.point, asked.point);
      }
    }
  }
}

TEST(TriangleTree, OfEquallyNearTrianglesTheFirstIsFound)
{
  const std::vector<Vector3>                      vertices{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  const std::vector<std::array<std::uint32_t, 3>> triangles(9, { 0, 1, 2 });
  const TriangleTree                              tree(vertices, triangles);
  EXPECT_EQ(tree.TriangleCount(), 9U);
  const auto nearest = tree.FindNearest({ 0.25, 0.25, 2 }, 5);
  EXPECT_EQ(nearest.triangle, 0U);
  EXPECT_EQ(nearest.squaredDistance, 4);
  EXPECT_EQ(nearest.point, (Vector3{ 0.25, 0.25, 0 }));
}

TEST(TriangleTree, NormalsFollowTheCornersAndADegenerateTriangleHasNone)
{
  const std::vector<Vector3>                      vertices{ { 0, 0, 0 }, { 2, 0, 0 }, { 0, 3, 0 } };
  const std::vector<std::array<std::uint32_t, 3>> triangles{ { 0, 1, 2 }, { 0, 2, 1 }, { 0, 1, 1 } };
  const TriangleTree                              tree(vertices, triangles);
  EXPECT_EQ(tree.Normal(0), (Vector3{ 0, 0, 6 }));
  EXPECT_EQ(tree.Normal(1), (Vector3{ 0, 0, -6 }));
  EXPECT_EQ(tree.Normal(2), (Vector3{ 0, 0, 0 }));
}

} // namespace
} // namespace voxelcore::testing
