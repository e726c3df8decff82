#include "voxelcore/Masks/DepthSimplification.h"

#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace voxelcore::testing
{
namespace
{

using Betti = std::array<std::int64_t, 3>;

LatticeBall
Depth(const char * text, const Vector3 & spacing = { 1, 1, 1 })
{
  ImageGeometry geometry;
  geometry.size = { 40, 40, 40 };
  geometry.spacing = spacing;
  return BallOfDepth(ParseGapWidth(text), geometry);
}

/** Squared weighted distance to the nearest voxel on the other side of the boundary, by trying all. */
std::int64_t
DistanceByTrying(const VoxelShape & shape, const LatticeBall & ball, int x, int y, int z)
{
  const auto & box = shape.Box();
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (int c = box.lower[2] - 1; c <= box.lower[2] + box.size[2]; ++c)
  {
    for (int b = box.lower[1] - 1; b <= box.lower[1] + box.size[1]; ++b)
    {
      for (int a = box.lower[0] - 1; a <= box.lower[0] + box.size[0]; ++a)
      {
        if (shape.Contains(a, b, c) != shape.Contains(x, y, z))
        {
          const std::array<std::int64_t, 3> step{ a - x, b - y, c - z };
          std::int64_t                      squared = 0;
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            squared += ball.weight[axis] * ball.weight[axis] * step[axis] * step[axis];
          }
          least = std::min(least, squared);
        }
      }
    }
  }
  return least;
}

TEST(DepthSimplification, TwoBlocksAreJoinedAcrossAGapWithinTheDepthAndNotBeyond)
{
  const auto shape = ShapeWhere({ 16, 5, 5 }, [](int x, int, int) { return x < 7 || x >= 9; }); // a gap of two voxels
  const DepthSimplified joined = SimplifyWithin(shape, Depth("1vox"), { 1, {}, {} });
  EXPECT_TRUE(joined.simplified.asAsked);
  EXPECT_EQ(joined.reason, "");
  EXPECT_EQ(joined.simplified.after.betti, (Betti{ 1, 0, 0 }));
  EXPECT_EQ(joined.simplified.voxelsAdded, 2U);
  EXPECT_EQ(joined.simplified.voxelsRemoved, 0U);
  EXPECT_EQ(joined.simplified.cost, 2 * static_cast<std::uint64_t>(kCostOfOneVoxel));

  const auto            wide = ShapeWhere({ 17, 5, 5 }, [](int x, int, int) { return x < 7 || x >= 10; });
  const DepthSimplified left = SimplifyWithin(wide, Depth("1vox"), { 1, {}, {} });
  EXPECT_FALSE(left.simplified.asAsked);
  EXPECT_EQ(left.simplified.after.betti, (Betti{ 2, 0, 0 }));
  EXPECT_EQ(left.reason,
            "what is never cut has 2 pieces, 0 loops and 0 cavities; with all that may be filled, 2 pieces, 0 loops "
            "and 0 cavities");
}

TEST(DepthSimplification, AVesselTreeLosesItsFalseBridgesAndKeepsBranchesAndTrueRing)
{
  // An upright vessel with three branches, a ring at its foot, and bridges a voxel thick from branch to branch.
  const auto isBridge = [](int x, int y, int z) {
    return y == 12 && ((x == 30 && z >= 16 && z <= 28) || (x == 2 && z >= 20 && z <= 40));
  };
  const auto isVessel = [](int x, int y, int z) {
    const double aside = y - 12;
    return (z >= 8 && std::hypot(x - 16, aside) <= 3.5) ||  // upright
           (x >= 16 && std::hypot(aside, z - 14) <= 2.2) || // branches to the right
           (x >= 16 && std::hypot(aside, z - 30 + (x - 16) * 0.1) <= 2.2) ||
           (x <= 16 && std::hypot(aside, z - 20) <= 1.8) || // and to the left
           (x <= 16 && std::hypot(aside, z - 40) <= 1.8) ||
           std::hypot(std::hypot(x - 16, aside) - 7, z - 6) <= 2.2 ||       // the ring
           (z >= 4 && z <= 8 && std::abs(aside) <= 2 && x >= 9 && x <= 16); // tied to the vessel
  };
  const auto shape =
    ShapeWhere({ 34, 24, 46 }, [&](int x, int y, int z) { return isVessel(x, y, z) || isBridge(x, y, z); });
  ASSERT_EQ(ComputeShapeTopology(shape).betti, (Betti{ 1, 3, 0 }));
  const DepthSimplified result = SimplifyWithin(shape, Depth("3vox"), { 1, 1, 0 });
  EXPECT_TRUE(result.simplified.asAsked);
  EXPECT_EQ(result.simplified.voxelsAdded, 0U);
  EXPECT_EQ(result.simplified.voxelsRemoved, 2U) << "a voxel of each bridge";
  for (const TopologyChange & change : result.simplified.changes)
  {
    EXPECT_FALSE(change.isFill);
    for (const auto & [x, y, z] : change.where)
    {
      EXPECT_TRUE(isBridge(x, y, z) && !isVessel(x, y, z)) << x << " " << y << " " << z;
    }
  }
}

TEST(DepthSimplification, ABridgeIsCutAndTheRingBesideItStays)
{
  // A ring with a hole of 9 x 9 voxels and walls of 5, and a bridge one voxel thick across the hole.
  const auto shape = ShapeWhere({ 19, 19, 5 }, [](int x, int y, int z) {
    const bool isHole = x >= 5 && x < 14 && y >= 5 && y < 14;
    return !isHole || (x == 9 && z == 2);
  });
  ASSERT_EQ(ComputeShapeTopology(shape).betti, (Betti{ 1, 2, 0 }));
  const DepthSimplified result = SimplifyWithin(shape, Depth("2vox"), { {}, 1, {} });
  EXPECT_TRUE(result.simplified.asAsked);
  EXPECT_EQ(result.simplified.after.betti, (Betti{ 1, 1, 0 }));
  EXPECT_EQ(result.simplified.voxelsRemoved, 1U);
  EXPECT_EQ(result.simplified.voxelsAdded, 0U);
  ASSERT_EQ(result.simplified.changes.size(), 1U);
  EXPECT_EQ(result.simplified.changes[0].difference, (Betti{ 0, -1, 0 }));
}

TEST(DepthSimplification, OnlyVoxelsWithinTheDepthChangeAndTheCostIsTheirDistance)
{
  std::mt19937 random(20261123);
  for (const Vector3 & spacing : { Vector3{ 1, 1, 1 }, Vector3{ 1, 1, 2 } })
  {
    for (int round = 0; round < 12; ++round)
    {
      const LatticeBall ball = Depth(round % 2 == 0 ? "1.5vox" : "2.3vox", spacing);
      const auto        shape = ShapeWhere({ 11, 10, 9 }, [&](int, int, int) { return random() % 100 < 60; });
      const auto        result = SimplifyWithin(shape, ball).simplified;
      EXPECT_EQ(ComputeShapeTopology(result.shape), result.after);
      double distance = 0;
      for (int z = -1; z < 10; ++z)
      {
        for (int y = -1; y < 11; ++y)
        {
          for (int x = -1; x < 12; ++x)
          {
            if (shape.Contains(x, y, z) != result.shape.Contains(x, y, z))
            {
              const std::int64_t squared = DistanceByTrying(shape, ball, x, y, z);
              ASSERT_LE(squared, ball.squaredRadius) << "round " << round;
              distance += std::sqrt(static_cast<double>(squared));
            }
          }
        }
      }
      const auto smallest = static_cast<double>(std::min({ ball.weight[0], ball.weight[1], ball.weight[2] }));
      const auto changed = static_cast<double>(result.voxelsAdded + result.voxelsRemoved);
      EXPECT_NEAR(static_cast<double>(result.cost) / kCostOfOneVoxel, distance / smallest, changed / 32);
      EXPECT_LE(result.after.betti[0] + result.after.betti[1] + result.after.betti[2],
                result.before.betti[0] + result.before.betti[1] + result.before.betti[2]);
    }
  }
}

TEST(DepthSimplification, ADepthBelowOneVoxelChangesNothing)
{
  const auto shape = ShapeWhere({ 5, 5, 5 }, [](int x, int y, int z) { return x != 2 || y != 2 || z != 2; });
  const auto result = SimplifyWithin(shape, Depth("0.5vox"), { {}, {}, 0 });
  EXPECT_FALSE(result.simplified.asAsked);
  EXPECT_EQ(result.simplified.voxelsAdded + result.simplified.voxelsRemoved, 0U);
  EXPECT_EQ(result.simplified.after.betti, (Betti{ 1, 0, 1 }));
}

TEST(DepthSimplification, DepthsAreLengthsUpTo32Voxels)
{
  EXPECT_EQ(Depth("2vox").squaredRadius, 4);
  EXPECT_EQ(Depth("1mm", { 0.5, 0.5, 1 }).squaredRadius, 4);
  EXPECT_NO_THROW(Depth("32vox"));
  EXPECT_THROW(Depth("33vox"), InputError);
  ImageGeometry inVoxels;
  inVoxels.size = { 9, 9, 9 };
  inVoxels.unit = SpatialUnit::Voxels;
  EXPECT_THROW(BallOfDepth(ParseGapWidth("2mm"), inVoxels), InputError);
}

} // namespace
} // namespace voxelcore::testing
