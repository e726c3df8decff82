// Curves put off the middle of tubes whose grey values are known.

#include "voxelcore/Roots/RootCentring.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>

namespace voxelcore::testing
{
namespace
{

/** The share of a voxel that is within `radius` of a line through `through` along x, y, z / 2, by 6^3 places in it. */
double
TubeShare(const Vector3 & voxel, const Vector3 & spacing, const Vector3 & through, const Vector3 & along, double radius)
{
  int inside = 0;
  for (int i = 0; i < 216; ++i)
  {
    const Vector3 part{ (i % 6 + 0.5) / 6, (i / 6 % 6 + 0.5) / 6, (i / 36 + 0.5) / 6 };
    const Vector3 away = Minus(Times(AddScaled(voxel, 1, part), spacing), through);
    const double  forward = Dot(away, along);
    inside += Length(AddScaled(away, -forward, along)) <= radius ? 1 : 0;
  }
  return inside / 216.0;
}

struct Line
{
  SkeletonGraph graph;
  RootHierarchy roots;

  /** A root whose points lie every 0.7 mm from `from` along `along`, 60 of them, each put off by `off`. */
  void
  AddRoot(const Vector3 & from, const Vector3 & along, double radius, const std::function<Vector3(int)> & off)
  {
    RootAxis axis;
    for (int i = 0; i < 60; ++i)
    {
      axis.points.push_back(static_cast<ElementIndex>(graph.positions.size()));
      graph.positions.push_back(AddScaled(AddScaled(from, 0.7 * i, along), 1, off(i)));
      graph.radius.push_back(radius);
    }
    roots.axes.push_back(axis);
  }
};

ImageGeometry
Geometry(const Vector3 & spacing)
{
  ImageGeometry geometry;
  geometry.spacing = spacing;
  geometry.origin = { 0.5 * spacing[0], 0.5 * spacing[1], 0.5 * spacing[2] }; // mm from the corner of the grid
  return geometry;
}

/** Mean distance of a root's points from a line. */
double
MeanDistance(const Line & line, std::size_t axis, const Vector3 & through, const Vector3 & along)
{
  double sum = 0;
  for (const ElementIndex point : line.roots.axes[axis].points)
  {
    const Vector3 away = Minus(line.graph.positions[point], through);
    sum += Length(AddScaled(away, -Dot(away, along), along));
  }
  return sum / static_cast<double>(line.roots.axes[axis].points.size());
}

} // namespace

TEST(RootCentring, ThinRootsGoToTheMiddleOfWhatIsBright)
{
  std::mt19937 random(7);
  for (const double slice : { 1.0, 2.0 })
  {
    for (const Vector3 & way : { Vector3{ 1, 0, 0 }, Vector3{ 1, 2, 2 }, Vector3{ 0, 0.6, 0.8 }, Vector3{ 0.1, 0, 1 } })
    {
      SCOPED_TRACE(::testing::Message() << "slices of " << slice << ", along " << way[0] << " " << way[1] << " "
                                        << way[2]);
      const Vector3 spacing{ 1, 1, slice };
      const Vector3 along = AddScaled({ 0, 0, 0 }, 1 / Length(way), way);
      const Vector3 from{ 20.3, 20.6, 21.1 };
      Line          line;
      // As voxels put it off: here and there, for a few points each, by half a slice along an axis.
      std::uniform_int_distribution<int> which(-2, 2);
      Vector3                            off{ 0, 0, 0 };
      line.AddRoot(from, along, 1.1, [&](int i) {
        if (i % 6 == 0)
        {
          off = { 0.2 * which(random), 0.2 * which(random), 0.2 * slice * which(random) };
        }
        return off;
      });
      const double                     before = MeanDistance(line, 0, from, along);
      std::normal_distribution<double> noise(0, 0.08);
      CentreRoots(line.graph, line.roots, Geometry(spacing), [&](std::int32_t x, std::int32_t y, std::int32_t z) {
        return TubeShare({ 1.0 * x, 1.0 * y, 1.0 * z }, spacing, from, along, 1.1) + noise(random);
      });
      EXPECT_LT(MeanDistance(line, 0, from, along), 0.6 * before);
      EXPECT_LT(MeanDistance(line, 0, from, along), 0.15 * (1 + slice));
    }
  }
}

TEST(RootCentring, ARootBesideAnotherIsNotDrawnToIt)
{
  const Vector3 along{ 1, 0, 0 };
  const Vector3 from{ 5, 20.5, 20.5 };
  const Vector3 beside{ 5, 23.1, 20.5 };
  Line          line;
  const auto    none = [](int) { return Vector3{ 0, 0, 0 }; };
  line.AddRoot(from, along, 1.2, none);
  line.AddRoot(beside, along, 1.2, none);
  CentreRoots(line.graph, line.roots, Geometry({ 1, 1, 1 }), [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    const Vector3 voxel{ 1.0 * x, 1.0 * y, 1.0 * z };
    return TubeShare(voxel, { 1, 1, 1 }, from, along, 1.2) + TubeShare(voxel, { 1, 1, 1 }, beside, along, 1.2);
  });
  EXPECT_LT(MeanDistance(line, 0, from, along), 0.05);
  EXPECT_LT(MeanDistance(line, 1, beside, along), 0.05);
}

TEST(RootCentring, ThickRootsAndTheDarkAreLeftAloneAndNoPointGoesFar)
{
  const Vector3 along{ 0, 0, 1 };
  const Vector3 from{ 20, 20, 5 };
  const auto    off = [](int) { return Vector3{ 0.4, 0, 0 }; };
  Line          thick;
  thick.AddRoot(from, along, 3.2, off);
  const auto bright = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    return TubeShare({ 1.0 * x, 1.0 * y, 1.0 * z }, { 1, 1, 1 }, from, along, 3.2);
  };
  CentreRoots(thick.graph, thick.roots, Geometry({ 1, 1, 1 }), bright);
  EXPECT_NEAR(MeanDistance(thick, 0, from, along), 0.4, 1e-9);
  Line dark;
  dark.AddRoot(from, along, 1, off);
  CentreRoots(dark.graph, dark.roots, Geometry({ 1, 1, 1 }), [](auto, auto, auto) { return 0.1; });
  EXPECT_NEAR(MeanDistance(dark, 0, from, along), 0.4, 1e-9);
  Line far;
  far.AddRoot(from, along, 1, [](int) { return Vector3{ 1.5, 0, 0 }; });
  CentreRoots(far.graph, far.roots, Geometry({ 1, 1, 1 }), [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    return TubeShare({ 1.0 * x, 1.0 * y, 1.0 * z }, { 1, 1, 1 }, from, along, 1.1);
  });
  EXPECT_NEAR(MeanDistance(far, 0, from, along), 1.0, 0.05) << "half a voxel";
  Line nothing;
  CentreRoots(nothing.graph, nothing.roots, Geometry({ 1, 1, 1 }), bright);
  EXPECT_TRUE(nothing.graph.positions.empty());
}

} // namespace voxelcore::testing
