#include "Core/Skeleton/GraphBuilder.h"

#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Roots/RootContacts.h"
#include "voxelcore/Roots/RootHierarchy.h"
#include "voxelcore/Shape/ShapeOperations.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace voxelcore::testing
{
namespace
{

/** The voxels within a graph's balls, and the skeleton with its loop: a stem, and two laterals that touch at x = 30. */
struct Touching
{
  SkeletonGraph graph;
  VoxelShape    shape;
  ImageGeometry geometry;

  explicit Touching(const Spacing3 & spacing)
  {
    GraphBuilder builder;
    builder.Line({ 8, 14, 90 }, { 8, 14, 72 }, 4);
    builder.Line({ 8, 14, 72 }, { 8, 14, 48 }, 4);
    builder.Line({ 8, 14, 48 }, { 8, 14, 5 }, 4);
    // One in the plane y = 14, the other behind it in y = 18; where they touch the skeleton runs between.
    builder.Line({ 8, 14, 72 }, { 30, 16, 42 }, 2.5);
    builder.Line({ 8, 14, 48 }, { 30, 16, 42 }, 2.5);
    builder.Line({ 30, 16, 42 }, { 52, 14, 12 }, 2.5);
    builder.Line({ 30, 16, 42 }, { 52, 18, 36 }, 2.5);
    graph = builder.Graph();
    geometry.spacing = spacing;
    Size3 size{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      size[axis] = static_cast<std::int32_t>((axis == 1 ? 30 : axis == 2 ? 96 : 60) / spacing[axis]);
      geometry.size[axis] = size[axis];
    }
    const auto within = [](const Spacing3 & p, const Spacing3 & a, const Spacing3 & b, double radius) {
      double length = 0;
      double dot = 0;
      for (std::size_t k = 0; k < 3; ++k)
      {
        length += (b[k] - a[k]) * (b[k] - a[k]);
        dot += (b[k] - a[k]) * (p[k] - a[k]);
      }
      const double t = std::clamp(dot / length, 0.0, 1.0);
      double       away = 0;
      for (std::size_t k = 0; k < 3; ++k)
      {
        away += std::pow(p[k] - a[k] - t * (b[k] - a[k]), 2);
      }
      return away <= radius * radius;
    };
    shape = ShapeWhere(size, [&](int x, int y, int z) {
      const Vector3 place = LatticeToPhysical(geometry, { x + 0.5, y + 0.5, z + 0.5 });
      return within(place, { 8, 14, 90 }, { 8, 14, 5 }, 4) || within(place, { 8, 14, 72 }, { 52, 14, 12 }, 2.5) ||
             within(place, { 8, 14, 48 }, { 30, 18, 42 }, 2.5) || within(place, { 30, 18, 42 }, { 52, 18, 36 }, 2.5);
    });
  }
};

VoxelShape
Without(const VoxelShape & shape, const VoxelShape & other)
{
  const auto & box = shape.Box();
  return ShapeWhere(
    box.size,
    [&](int x, int y, int z) {
      return shape.Contains(x + box.lower[0], y + box.lower[1], z + box.lower[2]) &&
             !other.Contains(x + box.lower[0], y + box.lower[1], z + box.lower[2]);
    },
    box.lower);
}

TEST(RootContacts, WallsPartRootsThatTouchAndNothingElse)
{
  for (const Spacing3 & spacing : { Spacing3{ 1, 1, 1 }, Spacing3{ 0.8, 0.8, 1.6 } })
  {
    const Touching touching(spacing);
    ASSERT_EQ(ComputeShapeTopology(touching.shape).betti, (std::array<std::int64_t, 3>{ 1, 1, 0 }));
    RootRules rules;
    rules.up = Vector3{ 0, 0, 1 };
    const RootHierarchy roots = FindRoots(touching.graph, rules);
    ASSERT_EQ(roots.meetings.size(), 1U);
    EXPECT_LT(Distance(roots.meetings[0].position, { 30, 16, 42 }), 0.1);
    EXPECT_EQ(roots.meetings[0].arms.size(), 4U);
    EXPECT_GT(roots.meetings[0].reach, roots.meetings[0].radius);
    const VoxelShape walls = ContactWalls(touching.shape, touching.geometry, touching.graph, roots);
    EXPECT_GT(walls.CountVoxels(), 0U);
    EXPECT_LT(walls.CountVoxels() * 20, touching.shape.CountVoxels());
    const VoxelShape apart = Without(touching.shape, walls);
    EXPECT_EQ(ComputeShapeTopology(apart).betti[1], 0) << "slices " << spacing[2] << " mm";
    // Splinters between walls may come off, no root.
    const VoxelShape whole = SplitComponents(apart).front();
    EXPECT_LT(apart.CountVoxels() - whole.CountVoxels(), 10U) << "slices " << spacing[2] << " mm";
    for (const Spacing3 & tip : { Spacing3{ 51, 14, 13.4 }, Spacing3{ 51, 18, 36.3 } })
    {
      const Vector3 at = PhysicalToLattice(touching.geometry, tip);
      EXPECT_TRUE(whole.Contains(static_cast<int>(std::floor(at[0])),
                                 static_cast<int>(std::floor(at[1])),
                                 static_cast<int>(std::floor(at[2]))));
    }
  }
}

TEST(RootContacts, WithoutMeetingsThereAreNoWalls)
{
  const Touching      touching({ 1, 1, 1 });
  const SkeletonGraph tree = SmallRoot().Graph();
  const RootHierarchy roots = FindRoots(tree);
  EXPECT_EQ(ContactWalls(touching.shape, touching.geometry, tree, roots).CountVoxels(), 0U);
}

} // namespace
} // namespace voxelcore::testing
