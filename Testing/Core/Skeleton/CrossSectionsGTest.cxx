#include "Uses/Roots/RootScore.h"
#include "VoxelCoreTesting/BodyVoxels.h"

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/BodyFrame.h"
#include "voxelcore/Shape/LabelContacts.h"
#include "voxelcore/Skeleton/BranchTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <omp.h>
#include <random>

namespace voxelcore::testing
{

namespace
{

/** The radius in the table of the longest branch. */
double
RadiusOf(const SkeletonGraph & graph)
{
  BranchRecord longest;
  for (const BranchRecord & branch : MeasureBranches(graph).branches)
  {
    longest = branch.length > longest.length ? branch : longest;
  }
  return longest.meanRadius;
}

/** Radius of a tube with round ends in voxels. */
double
TubeRadius(double radius, Spacing3 way, const Spacing3 & spacing, const Spacing3 & shift)
{
  const double length = std::max(8 * radius, 30.0);
  way = AddScaled({}, 1 / Length(way), way);
  Spacing3 half{};
  for (std::size_t k = 0; k < 3; ++k)
  {
    half[k] = 0.5 * length * std::abs(way[k]) + radius;
  }
  const VoxelShape shape = VoxelsAround(half, spacing, shift, [&](const Spacing3 & p) {
    const double along = std::clamp(Dot(p, way), -0.5 * length, 0.5 * length);
    return Length(AddScaled(p, -along, way)) <= radius;
  });
  return RadiusOf(GraphOf(shape, spacing));
}

} // namespace

TEST(CrossSections, TubesOfAnyRadiusAndDirectionHaveTheirRadiusOnAverage)
{
  for (const double slice : { 1.0, 3.0 })
  {
    for (const double radius : { 0.87, 1.5, 3.0, 8.0 })
    {
      if (slice > 1 && radius < slice)
      {
        continue; // voxels of such tubes fall apart
      }
      double sum = 0;
      int    count = 0;
      for (const Spacing3 & way : std::initializer_list<Spacing3>{ { 1, 0, 0 },
                                                                   { 0, 0, 1 },
                                                                   { 1, 1, 0 },
                                                                   { 1, 0, 1 },
                                                                   { 1, 1, 1 },
                                                                   { 1, 2, 3 },
                                                                   { 3, 1, -2 },
                                                                   { 0, 2, 5 } })
      {
        for (const Spacing3 & shift : std::initializer_list<Spacing3>{ { .11, .37, -.23 }, { -.41, .05, .29 } })
        {
          const double found = TubeRadius(radius, way, { 1, 1, slice }, shift);
          EXPECT_NEAR(found, radius, 0.25 * std::cbrt(slice)) << way[0] << way[1] << way[2];
          sum += found;
          ++count;
        }
      }
      EXPECT_NEAR(sum / count, radius, 0.06) << "slice " << slice;
    }
  }
}

TEST(CrossSections, OfAFlatTubeItIsTheRadiusOfACircleOfThatArea)
{
  const VoxelShape    shape = VoxelsAround({ 60, 12, 4 }, { 1, 1, 1 }, { .2, .3, .4 }, [](const Spacing3 & p) {
    return std::abs(p[0]) <= 60 && p[1] * p[1] / 144 + p[2] * p[2] / 16 <= 1;
  });
  const SkeletonGraph graph = GraphOf(shape, { 1, 1, 1 });
  const double        area = static_cast<double>(shape.CountVoxels()) / shape.Box().size[0]; // equal in all slices
  EXPECT_NEAR(RadiusOf(graph), std::sqrt(area / std::numbers::pi), 0.12);
  const BranchTable table = MeasureBranches(graph);
  for (const BranchRecord & branch : table.branches)
  {
    EXPECT_LT(branch.maxBallRadius, 4.2);
    EXPECT_LE(branch.minBallRadius, branch.meanBallRadius + 1e-9); // all are equal here but for rounding
    EXPECT_LE(branch.meanBallRadius, branch.maxBallRadius + 1e-9);
  }
}

TEST(CrossSections, WhatHasNoSectionIsARodOfItsVolume)
{
  const VoxelShape ball =
    VoxelsAround({ 9, 9, 9 }, { 1, 1, 1 }, { 0, 0, 0 }, [](const Spacing3 & p) { return Length(p) <= 9; });
  const SkeletonGraph graph = GraphOf(ball, { 1, 1, 1 });
  ASSERT_EQ(graph.positions.size(), 1U);
  EXPECT_NEAR(graph.sectionRadius[0],
              std::cbrt(0.75 * static_cast<double>(ball.CountVoxels()) / std::numbers::pi),
              1e-9);
}

TEST(CrossSections, StenosesAndBulgesKeepTheirDepth)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  const auto   within = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int body = 0; body < 8; ++body)
  {
    const double radius = within(5, 8);
    const double depth = body % 2 == 0 ? within(0.3, 0.7) : -within(0.3, 0.8); // narrower, wider
    const double width = within(3, 8);
    const double length = std::max(10 * width, 50.0);
    Spacing3     way{ within(-1, 1), within(-1, 1), within(-1, 1) };
    way = AddScaled({}, 1 / Length(way), way);
    Spacing3 half{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      half[k] = 0.5 * length * std::abs(way[k]) + 2 * radius;
    }
    const Spacing3      shift{ within(-0.5, 0.5), within(-0.5, 0.5), within(-0.5, 0.5) };
    const VoxelShape    shape = VoxelsAround(half, { 1, 1, 1 }, shift, [&](const Spacing3 & p) {
      const double along = Dot(p, way);
      const double here = radius * (1 - depth * std::exp(-0.5 * along * along / (width * width)));
      return std::abs(along) <= 0.5 * length && Length(AddScaled(p, -along, way)) <= here;
    });
    const SkeletonGraph graph = GraphOf(shape, { 1, 1, 1 });
    double              least = radius;
    double              most = radius;
    for (std::size_t point = 0; point < graph.positions.size(); ++point)
    {
      const Spacing3 & place = graph.positions[point];
      // Lines end in corners here, as nothing puts their ends where the tube ends.
      if (std::all_of(graph.nodePoints.begin(), graph.nodePoints.end(), [&](ElementIndex end) {
            return Distance(place, graph.positions[end]) > 1.5 * radius;
          }))
      {
        least = std::min(least, graph.sectionRadius[point]);
        most = std::max(most, graph.sectionRadius[point]);
      }
    }
    const double at = radius * (1 - depth);
    EXPECT_NEAR(least, std::min(radius, at), 0.3) << "radius " << radius << ", " << at << " within " << width;
    EXPECT_NEAR(most, std::max(radius, at), 0.3) << "radius " << radius << ", " << at << " within " << width;
  }
}

TEST(CrossSections, OfAForkTheyDoNotDependOnWhereTheGridBegins)
{
  const Spacing3                         fork{ 30, 30, 30 };
  std::vector<LabelShape>                tubes;
  SkeletonGraph                          graph;
  std::vector<std::vector<ElementIndex>> lines;
  graph.positions = { fork };
  for (const Spacing3 & end : { Spacing3{ 52, 30, 30 }, Spacing3{ 30, 52, 30 }, Spacing3{ 10, 10, 10 } })
  {
    const auto at = [&](double t) { return AddScaled(fork, t, Minus(end, fork)); };
    tubes.push_back({ 1, "tube", 0, Tube(SampleCurve(at, 200), 4, { 60, 60, 60 }) });
    lines.push_back({ 0 });
    for (int step = 1; step <= 20; ++step)
    {
      lines.back().push_back(static_cast<ElementIndex>(graph.positions.size()));
      graph.positions.push_back(at(0.05 * step));
    }
  }
  graph.radius.assign(graph.positions.size(), 3.5);
  SortBranches(graph, lines, false);
  const VoxelShape          shape = UnionOfLabels(tubes);
  const std::vector<double> radii = SectionRadiiOf(graph, shape, { 1, 1, 1 });
  // The last branch now leads past the grid's origin.
  VoxelBox box = shape.Box();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] -= 18;
  }
  for (Spacing3 & position : graph.positions)
  {
    position = AddScaled(position, -18, { 1, 1, 1 });
  }
  const std::vector<double> moved = SectionRadiiOf(graph, MovedTo(box.lower, shape), { 1, 1, 1 });
  for (std::size_t point = 0; point < radii.size(); ++point)
  {
    EXPECT_NEAR(moved[point], radii[point], 1e-9) << point;
  }
}

TEST(CrossSections, AClosedTubeIsMeasuredAllAround)
{
  const Curve ring = SampleCurve(
    [](double t) {
      const double angle = 2 * std::numbers::pi * t;
      return Turned({ 20 * std::cos(angle), 20 * std::sin(angle), 0 }, 0.3, 0.7, { 30, 30, 30 });
    },
    600);
  const VoxelShape    shape = Tube(ring, 4, { 60, 60, 60 });
  const SkeletonGraph graph = GraphOf(shape, { 1, 1, 1 });
  ASSERT_EQ(graph.BranchCount(), 1U);
  for (const double radius : graph.sectionRadius)
  {
    EXPECT_NEAR(radius, 4, 0.25);
  }
  EXPECT_NEAR(RadiusOf(graph), 4, 0.06);
}

TEST(CrossSections, ThreadsDoNotMatterAndNothingHasNone)
{
  PhantomOptions options;
  options.size = { 96, 96, 96 };
  options.kind = "root";
  const VoxelShape    shape = MakePhantom(options);
  const SkeletonGraph graph = GraphOf(shape);
  const int           threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const std::vector<double> one = SectionRadiiOf(graph, shape, { 1, 1, 1 });
  omp_set_num_threads(4);
  EXPECT_EQ(SectionRadiiOf(graph, shape, { 1, 1, 1 }), one);
  omp_set_num_threads(threads);
  EXPECT_TRUE(std::all_of(one.begin(), one.end(), [](double radius) { return radius > 0 && radius < 100; }));
  EXPECT_TRUE(SectionRadiiOf(SkeletonGraph(), VoxelShape(), { 1, 1, 1 }).empty());
}

} // namespace voxelcore::testing
