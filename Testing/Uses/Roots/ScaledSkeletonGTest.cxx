// Numbers of a skeleton do not depend on the unit: with voxels so many times as large, every length is so many times as
// large. With a power of two even the roundings are the same, so what differs has a length of its own in it.

#include "Core/Skeleton/TubeShapes.h"

#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Roots/RootTraits.h"
#include "voxelcore/Skeleton/BranchTable.h"
#include "voxelcore/Skeleton/ErosionThickness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace voxelcore::testing
{
namespace
{

struct Case
{
  const char * name;
  VoxelShape   shape;
  Spacing3     spacing;
};

/** A thick tube with a thin one at a slant, a cross, and a root system. */
std::vector<Case>
Cases()
{
  const auto line = [](const Spacing3 & from, const Spacing3 & to) {
    return SampleCurve(
      [=](double t) {
        return Spacing3{ from[0] + t * (to[0] - from[0]),
                         from[1] + t * (to[1] - from[1]),
                         from[2] + t * (to[2] - from[2]) };
      },
      200);
  };
  const auto both = [](const VoxelShape & a, const VoxelShape & b) {
    return ShapeWhere(a.Box().size, [&](int x, int y, int z) { return a.Contains(x, y, z) || b.Contains(x, y, z); });
  };
  const Spacing3 sides{ 48, 48, 60 };
  const auto     stem = Tube(line({ 20, 22, 8 }, { 24, 20, 52 }), 5.2, sides);
  const auto     lateral = Tube(line({ 22, 21, 30 }, { 42, 38, 44 }), 2.6, sides);
  const Spacing3 slices{ 1, 1, 1.5 };
  const auto     one = Tube(line({ 6, 8, 10 }, { 42, 38, 50 }), 3.3, sides, slices);
  const auto     other = Tube(line({ 42, 8, 12 }, { 6, 40, 48 }), 3.1, sides, slices);
  return { { "a lateral", both(stem, lateral), { 1, 1, 1 } },
           { "a cross", both(one, other), slices },
           { "a root system", PhantomShape("root", 64, 3), { 1, 1, 1 } } };
}

/** A skeleton in voxels of a unit: ties of the collapse go by a name that has the unit in it, so it is scaled after. */
SkeletonGraph
ScaledGraph(const VoxelShape & shape, const Spacing3 & spacing, double unit)
{
  SkeletonGraph graph = GraphOfSurface(SurfaceOf(shape, spacing), spacing);
  graph.positions = graph.medial;
  for (auto * places : { &graph.positions, &graph.medial })
  {
    for (Spacing3 & place : *places)
    {
      place = { unit * place[0], unit * place[1], unit * place[2] };
    }
  }
  for (auto * lengths : { &graph.radius, &graph.erosionThickness })
  {
    for (double & length : *lengths)
    {
      length *= unit;
    }
  }
  const Spacing3      voxel{ unit * spacing[0], unit * spacing[1], unit * spacing[2] };
  const ImageGeometry grid = GridFromOrigin(voxel);
  const double        window = 6 * Distance(voxel, { 0, 0, 0 }) / std::sqrt(3.0);
  FitBranches(graph, window, HalfAVoxel(voxel));
  PlaceTips(graph, shape, grid);
  PlaceJoints(graph, shape, grid);
  FitBranches(graph, window, HalfAVoxel(voxel));
  graph.sectionRadius = CrossSectionRadii(graph, shape, grid);
  return graph;
}

/** All numbers of a skeleton's tables; lengths first divided by the unit. */
std::vector<double>
NumbersOf(const SkeletonGraph & graph, double unit)
{
  std::vector<double> numbers;
  const auto          add = [&](double number, int dimension) {
    numbers.push_back(std::isnan(number) ? -1 : number / std::pow(unit, dimension));
  };
  for (std::size_t point = 0; point < graph.positions.size(); ++point)
  {
    for (const double along : graph.positions[point])
    {
      add(along, 1);
    }
    add(graph.radius[point], 1);
    add(graph.sectionRadius[point], 1);
    add(graph.erosionThickness[point], 1);
  }
  for (const BranchRecord & branch : MeasureBranches(graph).branches)
  {
    add(branch.length, 1);
    add(branch.freeLength, 1);
    add(branch.meanRadius, 1);
    add(branch.sdRadius, 1);
    add(branch.volume, 3);
    add(branch.surface, 2);
    add(branch.parentAngle, 0);
    add(branch.level, 0);
  }
  const RootHierarchy roots = FindRoots(graph);
  for (const RootRecord & root : MeasureRoots(graph, roots).roots)
  {
    add(root.length, 1);
    add(root.meanDiameter, 1);
    add(root.volume, 3);
    add(root.surface, 2);
    add(root.emergenceAngle, 0);
    add(root.alongParent, 1);
  }
  return numbers;
}

TEST(ScaledSkeleton, EveryLengthIsAsManyTimesAsLargeAsAVoxel)
{
  for (const Case & one : Cases())
  {
    const SkeletonGraph       graph = ScaledGraph(one.shape, one.spacing, 1);
    const std::vector<double> numbers = NumbersOf(graph, 1);
    EXPECT_GE(graph.BranchCount(), 3U) << one.name;
    for (const double unit : { std::ldexp(1.0, -10), std::ldexp(1.0, 8) })
    {
      const std::vector<double> others = NumbersOf(ScaledGraph(one.shape, one.spacing, unit), unit);
      ASSERT_EQ(others.size(), numbers.size()) << one.name << ", unit " << unit;
      for (std::size_t i = 0; i < numbers.size(); ++i)
      {
        ASSERT_NEAR(others[i], numbers[i], 1e-9 * (1 + std::abs(numbers[i])))
          << one.name << ", unit " << unit << ' ' << i;
      }
    }
  }
}

TEST(ScaledSkeleton, FireTakesAsManyTimesAsLong)
{
  for (const Case & one : Cases())
  {
    const MedialComplex surface = SurfaceOf(one.shape, one.spacing);
    const BurnTimes     times = ComputeBurnTimes(surface, 1.5);
    for (const double unit : { std::ldexp(1.0, -10), std::ldexp(1.0, 8) })
    {
      const Spacing3  voxel{ unit * one.spacing[0], unit * one.spacing[1], unit * one.spacing[2] };
      const BurnTimes others = ComputeBurnTimes(SurfaceOf(one.shape, voxel), 1.5 * unit);
      ASSERT_EQ(others.vertices.size(), times.vertices.size());
      for (std::size_t vertex = 0; vertex < times.vertices.size(); ++vertex)
      {
        ASSERT_EQ(others.vertices[vertex], unit * times.vertices[vertex]) << one.name << ", unit " << unit;
      }
    }
  }
}

} // namespace
} // namespace voxelcore::testing
