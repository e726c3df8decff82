#include "voxelcore/Shape/BodyFrame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace voxelcore;

namespace
{

/** Of 40 x 50 x 60 voxels that are no cubes, its axes turned about z. */
ImageGeometry
TurnedScan()
{
  ImageGeometry scan;
  scan.size = { 40, 50, 60 };
  scan.spacing = { 0.3, 0.7, 1.1 };
  scan.origin = { -12.5, 3.25, 100.1 };
  const double c = std::cos(0.4);
  const double s = std::sin(0.4);
  scan.direction = { c, -s, 0, s, c, 0, 0, 0, 1 };
  return scan;
}

const VoxelBox kBody{ { 7, 11, 13 }, { 20, 5, 9 } };

} // namespace

TEST(BodyFrame, BeginsAtTheBodysBox)
{
  const BodyFrame frame(TurnedScan(), kBody);
  EXPECT_EQ(frame.Lower(), kBody.lower);
  EXPECT_EQ(frame.Geometry().size, (std::array<std::int64_t, 3>{ 20, 5, 9 }));
  EXPECT_EQ(frame.Geometry().origin, (Vector3{ 0, 0, 0 }));
  EXPECT_EQ(frame.Enter(kBody).lower, (std::array<std::int32_t, 3>{ 0, 0, 0 }));
  EXPECT_EQ(frame.Leave(frame.Enter(kBody)).lower, kBody.lower);
  EXPECT_EQ(frame.LeaveLattice({ 0.5, 0, 2 }), (Vector3{ 7.5, 11, 15 }));
}

TEST(BodyFrame, PlacesThatLeaveAndEnterAgainHaveTheSameBits)
{
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937                           random(seed);
  std::uniform_real_distribution<double> along(0, 20);
  const ImageGeometry                    scan = TurnedScan();
  const BodyFrame                        frame(scan, kBody);
  std::vector<Vector3>                   inScan;
  for (int i = 0; i < 1000; ++i)
  {
    const Vector3 lattice = OnPlaces({ along(random), along(random), along(random) });
    const Vector3 inFrame = LatticeToPhysical(frame.Geometry(), lattice);
    const Vector3 left = frame.Leave(inFrame);
    EXPECT_EQ(frame.Enter(left), inFrame);
    EXPECT_EQ(OnPlaces(PhysicalToLattice(scan, left)), frame.LeaveLattice(lattice));
    inScan.push_back(left);
  }
  std::vector<Vector3> places = inScan;
  frame.Enter(places);
  frame.Leave(places);
  EXPECT_EQ(places, inScan);
}

TEST(BodyFrame, AMovedShapeHasTheSameVoxels)
{
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937                random(seed);
  std::bernoulli_distribution isIn(0.3);
  VoxelShape                  shape(VoxelBox{ { 3, -4, 5 }, { 70, 9, 10 } });
  const auto                  visit = [&](auto && each) {
    for (std::int32_t z = 5; z < 15; ++z)
    {
      for (std::int32_t y = -4; y < 5; ++y)
      {
        for (std::int32_t x = 3; x < 73; ++x)
        {
          each(x, y, z);
        }
      }
    }
  };
  visit([&](std::int32_t x, std::int32_t y, std::int32_t z) {
    if (isIn(random))
    {
      shape.Insert(x, y, z);
    }
  });
  const VoxelShape moved = MovedTo({ 0, 100, -7 }, shape);
  EXPECT_EQ(moved.CountVoxels(), shape.CountVoxels());
  visit([&](std::int32_t x, std::int32_t y, std::int32_t z) {
    EXPECT_EQ(moved.Contains(x - 3, y + 104, z - 12), shape.Contains(x, y, z));
  });
}
