#include "Uses/Phantom/PhantomFixtures.h"

#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <iostream>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

struct Grid
{
  std::array<std::int32_t, 3> size;
  Vector3                     spacing;
};

const std::vector<Grid> kGrids{ { { 64, 64, 64 }, { 1, 1, 1 } },
                                { { 110, 90, 150 }, { 0.3, 0.3, 0.3 } },
                                { { 160, 160, 60 }, { 0.5, 0.5, 1.5 } },
                                { { 12, 40, 14 }, { 2, 1, 1 } } };

Vector3
InMillimetres(const CentreLinePoint & point, const PhantomOptions & options)
{
  return { point.position[0] * options.spacing[0],
           point.position[1] * options.spacing[1],
           point.position[2] * options.spacing[2] };
}

} // namespace

TEST(RootSystem, IsOnePieceWithoutCavitiesAndNearlyATree)
{
  for (const Grid & grid : kGrids)
  {
    for (std::uint64_t seed = 1; seed <= 12; ++seed)
    {
      PhantomOptions options = Options("root", grid.size, grid.spacing);
      options.seed = seed;
      const TopologyNumbers topology = ComputeShapeTopology(MakePhantom(options));
      EXPECT_EQ(topology.betti[0], 1) << "seed " << seed;
      EXPECT_EQ(topology.betti[2], 0) << "seed " << seed;
      EXPECT_LE(topology.betti[1], 4) << "seed " << seed; // where a lateral leaves its parent a voxel may stay open
    }
  }
}

TEST(RootSystem, CentreLinesAreTreesThatTaperAndLieInside)
{
  for (const Grid & grid : kGrids)
  {
    const PhantomOptions               options = Options("root", grid.size, grid.spacing);
    const VoxelShape                   shape = MakePhantom(options);
    const std::vector<CentreLinePoint> lines = RootCentreLines(options);
    ASSERT_GT(lines.size(), 50U);
    std::array<int, 3> branches{ 0, 0, 0 };
    for (std::size_t i = 0; i < lines.size(); ++i)
    {
      const CentreLinePoint & point = lines[i];
      EXPECT_TRUE(shape.Contains(static_cast<std::int32_t>(std::floor(point.position[0])),
                                 static_cast<std::int32_t>(std::floor(point.position[1])),
                                 static_cast<std::int32_t>(std::floor(point.position[2]))));
      EXPECT_GT(point.radius, 0);
      if (i == 0)
      {
        EXPECT_EQ(point.parent, -1);
        EXPECT_EQ(point.order, 0);
        EXPECT_EQ(point.branch, 0);
        ++branches[0];
        continue;
      }
      ASSERT_GE(point.parent, 0);
      ASSERT_LT(point.parent, static_cast<std::int64_t>(i));
      const CentreLinePoint & parent = lines[static_cast<std::size_t>(point.parent)];
      EXPECT_LE(point.radius, parent.radius);
      if (point.branch == parent.branch)
      {
        EXPECT_EQ(point.order, parent.order);
        EXPECT_EQ(point.parent, static_cast<std::int64_t>(i) - 1);
      }
      else
      {
        EXPECT_EQ(point.order, parent.order + 1);
        EXPECT_EQ(point.position, parent.position); // a lateral springs from its parent's centre line
        ++branches[static_cast<std::size_t>(point.order)];
      }
    }
    EXPECT_EQ(branches[0], 1);
    EXPECT_GE(branches[1], 2);
    EXPECT_GE(branches[2], 1);
  }
}

TEST(RootSystem, VoxelsAreThoseNearTheCentreLines)
{
  const PhantomOptions               options = Options("root", { 60, 50, 40 }, { 0.5, 0.6, 0.9 });
  const VoxelShape                   shape = MakePhantom(options);
  const std::vector<CentreLinePoint> lines = RootCentreLines(options);
  std::uint64_t                      inside = 0;
  for (std::int32_t z = 0; z < 40; ++z)
  {
    for (std::int32_t y = 0; y < 50; ++y)
    {
      for (std::int32_t x = 0; x < 60; ++x)
      {
        // Points are close together, so balls at the points tell nearly the same as the cones between them.
        bool near = false;
        bool far = true;
        for (const CentreLinePoint & point : lines)
        {
          const Vector3 p = InMillimetres(point, options);
          const double  distance = std::sqrt(std::pow((x + 0.5) * 0.5 - p[0], 2) + std::pow((y + 0.5) * 0.6 - p[1], 2) +
                                            std::pow((z + 0.5) * 0.9 - p[2], 2));
          near |= distance < point.radius * 0.999999;
          far &= distance > point.radius + 0.16; // more than a step of 0.15 mm
        }
        const bool in = shape.Contains(x, y, z);
        inside += in;
        EXPECT_TRUE(in || !near);
        EXPECT_TRUE(!in || !far);
      }
    }
  }
  EXPECT_GT(inside, 300U);
}

TEST(RootSystem, TheSameDetailGivesTheSameBodyOnEveryGrid)
{
  PhantomOptions fine = Options("root", { 90, 96, 120 });
  PhantomOptions coarse = Options("root", { 90, 96, 40 }, { 1, 1, 3 });
  fine.detail = coarse.detail = 2;
  const VoxelShape a = MakePhantom(fine);
  const VoxelShape b = MakePhantom(coarse);
  EXPECT_GT(b.CountVoxels(), 1000U);
  std::uint64_t differences = 0;
  for (std::int32_t z = 0; z < 40; ++z)
  {
    for (std::int32_t y = 0; y < 96; ++y)
    {
      for (std::int32_t x = 0; x < 90; ++x)
      {
        differences += a.Contains(x, y, 3 * z + 1) != b.Contains(x, y, z);
      }
    }
  }
  EXPECT_EQ(differences, 0U);
  const auto linesA = RootCentreLines(fine);
  const auto linesB = RootCentreLines(coarse);
  ASSERT_EQ(linesA.size(), linesB.size());
  EXPECT_DOUBLE_EQ(linesA.back().position[2], linesB.back().position[2] * 3);
}

TEST(RootSystem, NumbersOfLateralsAreHeeded)
{
  PhantomOptions options = Options("root", { 150, 150, 150 });
  options.laterals = 5;
  options.subLaterals = 0;
  std::int32_t last = 0;
  for (const CentreLinePoint & point : RootCentreLines(options))
  {
    last = std::max(last, point.branch);
    EXPECT_LE(point.order, 1);
  }
  EXPECT_EQ(last, 5);
  options.laterals = 0;
  const TopologyNumbers stem = ComputeShapeTopology(MakePhantom(options));
  EXPECT_EQ(stem.betti, (std::array<std::int64_t, 3>{ 1, 0, 0 }));
  EXPECT_EQ(RootCentreLines(options).back().branch, 0);
}

TEST(HeavyRootSystem, AScanOfTwoMillionBoundaryVerticesTakesSeconds)
{
  const auto       start = std::chrono::steady_clock::now();
  const VoxelShape shape = MakePhantom(Options("root", { 1560, 789, 1041 }));
  const double     seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto       vertices = CountBoundaryVertices(shape);
  std::cout << vertices << " boundary vertices in " << seconds << " s\n";
  EXPECT_NEAR(static_cast<double>(vertices), 2e6, 0.2e6);
  EXPECT_LT(seconds, 10);
  EXPECT_EQ(ComputeShapeTopology(shape).betti[0], 1);
}
