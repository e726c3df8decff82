// The operations on random volumes against flood fill.

#include "FloodFill.h"

#include "voxelcore/Shape/ShapeTopology.h"

#include <iostream>

namespace voxelcore::testing
{
namespace
{

/** All operations on one shape against flood fill. */
void
ExpectAsByFloodFill(const VoxelShape & shape, Random & random)
{
  const std::vector<Voxels> components = FloodBySize(shape);
  const TopologyNumbers     before = ComputeShapeTopology(shape);
  ASSERT_EQ(before.betti[0], static_cast<std::int64_t>(components.size()));

  const auto parts = SplitComponents(shape);
  ASSERT_EQ(parts.size(), components.size());
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    ExpectTight(parts[i], components[i]);
  }

  const auto count = static_cast<std::size_t>(random.Between(0, before.betti[0] + 1));
  const auto kept = std::min(count, components.size());
  const auto largest = KeepLargestComponents(shape, count);
  const auto split = components.begin() + static_cast<std::ptrdiff_t>(kept);
  ExpectTight(largest.shape, Joined({ components.begin(), split }));
  ExpectChange(largest, Joined({ split, components.end() }).size(), 0, components.size() - kept, 0, 0);
  EXPECT_EQ(ComputeShapeTopology(largest.shape).betti[0], static_cast<std::int64_t>(kept));

  const auto          least = static_cast<std::size_t>(random.Between(1, 12));
  std::vector<Voxels> enough = components;
  std::erase_if(enough, [least](const Voxels & component) { return component.size() < least; });
  const auto cleaned = RemoveSmallComponents(shape, least);
  ExpectTight(cleaned.shape, Joined(enough));
  ExpectChange(cleaned, Joined(components).size() - Joined(enough).size(), 0, components.size() - enough.size(), 0, 0);

  // The rim of one voxel makes the outside one component; it holds the very first voxel.
  const std::vector<Voxels> background = Flood(VoxelsOf(shape, false, 1), 3);
  const std::vector<Voxels> cavities(background.begin() + 1, background.end());
  Voxels                    solid = VoxelsOf(shape);
  const Voxels              added = Joined(cavities);
  solid.insert(solid.end(), added.begin(), added.end());
  std::sort(solid.begin(), solid.end());
  const auto filled = FillCavities(shape);
  ExpectTight(filled.shape, solid);
  const std::size_t left = Flood(solid, 1).size();
  ExpectChange(filled, 0, added.size(), 0, components.size() - left, cavities.size());
  const TopologyNumbers after = ComputeShapeTopology(filled.shape);
  EXPECT_EQ(after.betti[2], 0);
  EXPECT_EQ(after.betti[0], static_cast<std::int64_t>(left));
  EXPECT_LE(after.betti[1], before.betti[1]);

  VoxelBox box = shape.Box();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] += static_cast<std::int32_t>(random.Between(-2, box.size[axis]));
    box.size[axis] = static_cast<std::int32_t>(random.Between(0, box.size[axis] + 2));
  }
  Voxels inside = VoxelsOf(shape);
  std::erase_if(inside, [&box](const Voxel & voxel) {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::int32_t at = voxel[2 - axis];
      if (at < box.lower[axis] || at >= box.lower[axis] + box.size[axis])
      {
        return true;
      }
    }
    return false;
  });
  const auto cropped = CropToBox(shape, box);
  ExpectTight(cropped.shape, inside);
  ExpectChange(cropped, shape.CountVoxels() - inside.size(), 0, 0, 0, 0);
}

TEST(ShapeOperations, RandomVolumesComeOutAsByFloodFill)
{
  std::cout << "seeds 1 to 300\n";
  for (std::uint64_t seed = 1; seed <= 300; ++seed)
  {
    const auto volume = MakeRandomVolume(seed, 1, 9);
    SCOPED_TRACE(volume.Describe());
    Random random(seed + 1000);
    ExpectAsByFloodFill(volume.shape, random);
    if (HasFailure())
    {
      return;
    }
  }
}

TEST(ShapeOperations, RandomVolumesBehindWallsComeOutAsByFloodFill)
{
  // What is inside floats in cavities, which noise alone hardly ever makes.
  std::uint64_t joined = 0;
  for (std::uint64_t seed = 1001; seed <= 1060; ++seed)
  {
    Random      random(seed);
    const auto  side = [&] { return static_cast<std::int32_t>(random.Between(4, 10)); };
    const Size3 size{ side(), side(), side() };
    const auto  density = 0.05 * static_cast<double>(random.Between(1, 9));
    const auto  wall = random.Chance(0.5) ? 1.0 : 0.98;
    const auto  hollow = Hollow(size);
    const auto  shape =
      ShapeWhere(size, [&](int x, int y, int z) { return random.Chance(hollow.Contains(x, y, z) ? wall : density); });
    SCOPED_TRACE("seed " + std::to_string(seed));
    ExpectAsByFloodFill(shape, random);
    joined += FillCavities(shape).componentsJoined;
    if (HasFailure())
    {
      return;
    }
  }
  std::cout << "seeds 1001 to 1060; components joined by filling: " << joined << "\n";
  EXPECT_GT(joined, 0U) << "the volumes never had a component in a cavity";
}

TEST(ShapeOperations, RandomVolumesOfSeveralWordsComeOutAsByFloodFill)
{
  std::cout << "seeds 2001 to 2040\n";
  for (std::uint64_t seed = 2001; seed <= 2040; ++seed)
  {
    Random     random(seed);
    const auto width = static_cast<std::int32_t>(random.Between(60, 140));
    const auto density = 0.05 * static_cast<double>(random.Between(4, 19));
    SCOPED_TRACE("seed " + std::to_string(seed) + ", width " + std::to_string(width));
    ExpectAsByFloodFill(RandomShape(random, { width, 4, 5 }, density), random);
    if (HasFailure())
    {
      return;
    }
  }
}

} // namespace
} // namespace voxelcore::testing
