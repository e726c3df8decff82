#include "voxelcore/Verification/OctantScan.h"

#include "Core/Verification/VerificationFixtures.h"
#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <gtest/gtest.h>

#include <iostream>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

/** Voxels minus inner faces plus inner edges minus inner corners, element by element. */
std::int64_t
EulerByElements(const VoxelShape & shape)
{
  const VoxelBox & box = shape.Box();
  std::int64_t     euler = 0;
  // An element is named by its lower corner and, per axis, whether it extends along the axis (dimension).
  for (std::int32_t z = box.lower[2]; z <= box.lower[2] + box.size[2]; ++z)
  {
    for (std::int32_t y = box.lower[1]; y <= box.lower[1] + box.size[1]; ++y)
    {
      for (std::int32_t x = box.lower[0]; x <= box.lower[0] + box.size[0]; ++x)
      {
        for (int kind = 0; kind < 8; ++kind)
        {
          bool isInner = true;
          int  dimension = 0;
          for (int axis = 0; axis < 3; ++axis)
          {
            dimension += (kind >> axis) & 1;
          }
          for (int around = 0; around < 8; ++around)
          {
            if ((around & kind) == 0)
            {
              isInner = isInner && shape.Contains(x - (around & 1), y - ((around >> 1) & 1), z - ((around >> 2) & 1));
            }
          }
          euler += isInner ? (dimension % 2 == 1 ? 1 : -1) : 0;
        }
      }
    }
  }
  return euler;
}

} // namespace

TEST(OctantScan, ASingleVoxelHasEulerNumberOneAndEightCorners)
{
  const OctantScan scan = ScanOctants(SolidBox({ 1, 1, 1 }));
  EXPECT_EQ(scan.euler, 1);
  EXPECT_EQ(scan.boundary.size(), 8U);
  EXPECT_EQ(scan.boundary.front(), (LatticePoint{ 0, 0, 0 }));
  EXPECT_EQ(scan.boundary.back(), (LatticePoint{ 1, 1, 1 }));
}

TEST(OctantScan, AShellHasEulerNumberTwo)
{
  const VoxelShape shell =
    MakeShape({ 5, 5, 5 }, [](std::int32_t x, std::int32_t y, std::int32_t z) { return x != 2 || y != 2 || z != 2; });
  EXPECT_EQ(ScanOctants(shell).euler, 2);
}

TEST(OctantScan, AnEmptyShapeHasNothing)
{
  EXPECT_EQ(ScanOctants(VoxelShape()).boundary.size(), 0U);
  EXPECT_EQ(ScanOctants(VoxelShape({ { 0, 0, 0 }, { 70, 2, 2 } })).euler, 0);
}

TEST(OctantScan, RandomShapesAgreeWithCountingElementsAndWithTheShapeModule)
{
  std::cout << "seeds 1 to 120\n";
  for (std::uint32_t seed = 1; seed <= 120; ++seed)
  {
    // Rows that end before, at and after the end of a word.
    const std::int32_t length = std::array{ 5, 63, 64, 65, 130 }[seed % 5];
    const VoxelShape shape = RandomShape(seed, { length, 1 + static_cast<std::int32_t>(seed % 4), 3 }, seed * 7 % 101);
    OctantScan       scan = ScanOctants(shape);
    ASSERT_EQ(scan.euler, EulerByElements(shape)) << "seed " << seed;
    ASSERT_EQ(scan.euler, ComputeShapeTopology(shape).euler) << "seed " << seed;
    ASSERT_EQ(scan.boundary, BoundaryVertices(shape)) << "seed " << seed;
  }
}
