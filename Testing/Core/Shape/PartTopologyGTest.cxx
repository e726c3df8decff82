#include "voxelcore/Shape/PartTopology.h"

#include "voxelcore/Shape/ShapeTopology.h"
#include "VoxelCoreTesting/Shapes.h"

#include <gtest/gtest.h>

#include <iostream>

namespace voxelcore
{
namespace
{

using testing::Random;
using testing::ShapeWhere;

/** Halves the box at random places until there are `count` parts. */
void
Cut(const VoxelBox & box, std::size_t count, Random & random, std::vector<VoxelBox> & parts)
{
  const auto axis = static_cast<std::size_t>(random.Between(0, 2));
  if (count < 2 || box.size[axis] < 2)
  {
    parts.push_back(box);
    return;
  }
  VoxelBox low = box;
  VoxelBox high = box;
  low.size[axis] = 1 + static_cast<std::int32_t>(random.Between(0, box.size[axis] - 2));
  high.lower[axis] += low.size[axis];
  high.size[axis] -= low.size[axis];
  Cut(low, count / 2, random, parts);
  Cut(high, count - count / 2, random, parts);
}

void
ExpectJoined(const VoxelShape & shape, const std::vector<VoxelBox> & boxes)
{
  std::vector<TopologyPart> parts;
  for (const VoxelBox & box : boxes)
  {
    parts.push_back(ComputeTopologyPart(shape, box));
  }
  const TopologyNumbers joined = JoinTopologyParts(parts);
  const TopologyNumbers whole = ComputeShapeTopology(shape);
  EXPECT_EQ(joined.euler, whole.euler);
  EXPECT_EQ(joined.betti, whole.betti);
}

TEST(PartTopology, PartsOfRandomVolumesAddUpToTheWhole)
{
  std::cout << "seeds 1 to 300\n";
  for (std::uint64_t seed = 1; seed <= 300; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random                            random(seed);
    const std::array<std::int32_t, 3> size{ 1 + static_cast<std::int32_t>(random.Between(0, 139)),
                                            1 + static_cast<std::int32_t>(random.Between(0, 13)),
                                            1 + static_cast<std::int32_t>(random.Between(0, 13)) };
    const double                      density = 0.1 + 0.2 * static_cast<double>(random.Between(0, 4));
    const VoxelShape shape = ShapeWhere(size, [&](int, int, int) { return random.Chance(density); }, { -70, 3, 1000 });
    for (const std::size_t count : { 1, 2, 5, 16 })
    {
      std::vector<VoxelBox> boxes;
      Cut(shape.Box(), count, random, boxes);
      ASSERT_NO_FATAL_FAILURE(ExpectJoined(shape, boxes));
    }
  }
}

TEST(PartTopology, LoopsAndCavitiesAcrossPartsAreSeen)
{
  // A frame around all parts, and a box with a cavity that the cut goes through.
  const auto            shape = ShapeWhere({ 20, 20, 20 }, [](int x, int y, int z) {
    const bool frame = z < 2 && (x < 2 || y < 2 || x > 17 || y > 17);
    const bool wall = x >= 5 && x < 15 && y >= 5 && y < 15 && z >= 5 && z < 15;
    const bool cavity = x >= 7 && x < 13 && y >= 7 && y < 13 && z >= 7 && z < 13;
    return frame || (wall && !cavity);
  });
  std::vector<VoxelBox> octants;
  for (std::int32_t i = 0; i < 8; ++i)
  {
    octants.push_back({ { 10 * (i & 1), 10 * (i >> 1 & 1), 10 * (i >> 2) }, { 10, 10, 10 } });
  }
  std::vector<TopologyPart> parts;
  for (const VoxelBox & box : octants)
  {
    parts.push_back(ComputeTopologyPart(shape, box));
  }
  const TopologyNumbers numbers = JoinTopologyParts(parts);
  EXPECT_EQ(numbers.betti, (std::array<std::int64_t, 3>{ 2, 1, 1 }));
  EXPECT_EQ(numbers.euler, 2 - 1 + 1);
}

TEST(PartTopology, PartsMayReachBeyondTheShapesBox)
{
  Random           random(7);
  const VoxelShape shape = ShapeWhere({ 50, 9, 8 }, [&](int, int, int) { return random.Chance(0.4); }, { 3, -5, 60 });
  const VoxelBox   scan{ { -100, -20, 55 }, { 300, 40, 30 } };
  for (int round = 0; round < 20; ++round)
  {
    std::vector<VoxelBox> boxes;
    Cut(scan, 9, random, boxes);
    boxes.push_back({ { 0, 0, 0 }, { 0, 0, 0 } });
    ASSERT_NO_FATAL_FAILURE(ExpectJoined(shape, boxes));
  }
}

TEST(PartTopology, WhatIsNotAtAFaceIsOnlyCounted)
{
  const VoxelShape   shape = ShapeWhere({ 100, 60, 50 }, [](int x, int y, int z) {
    return x % 4 == 2 && y % 4 == 2 && z % 4 == 2 && x > 1 && x < 98; // 24 x 15 x 12 voxels apart
  });
  const TopologyPart part = ComputeTopologyPart(shape, shape.Box());
  EXPECT_EQ(part.closedShape, 24 * 15 * 12);
  EXPECT_EQ(part.openShape, 0U);
  EXPECT_EQ(part.openBackground, 1U);
  for (const TopologyPart::Face & face : part.faces)
  {
    EXPECT_LE(face.background.size(), 60U) << "a run a row";
  }
}

} // namespace
} // namespace voxelcore
