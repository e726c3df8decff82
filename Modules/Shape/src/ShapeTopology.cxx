#include "voxelcore/ShapeTopology.h"

#include "ShapeRuns.h"

#include <bit>
#include <span>
#include <vector>

namespace voxelcore
{

namespace
{

std::int64_t
Ones(std::uint64_t word)
{
  return std::popcount(word);
}

// voxels - inner faces + inner edges - inner corners, 64 voxels at a time.
std::int64_t
EulerNumber(const VoxelShape & shape)
{
  const auto &                         size = shape.Box().size;
  const std::vector<std::uint64_t>     empty(shape.WordsPerRow(), 0);
  const std::span<const std::uint64_t> background(empty);
  std::int64_t                         euler = 0;
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      const auto row = shape.Row(y, z);
      const auto south = y > 0 ? shape.Row(y - 1, z) : background;
      const auto below = z > 0 ? shape.Row(y, z - 1) : background;
      const auto southBelow = y > 0 && z > 0 ? shape.Row(y - 1, z - 1) : background;
      // An element is counted at its greatest voxel: in x these are neighbours x - 1, with the bit carried over words.
      std::uint64_t carryRow = 0, carryY = 0, carryZ = 0, carryYZ = 0;
      for (std::size_t word = 0; word < row.size(); ++word)
      {
        const std::uint64_t r = row[word];
        const std::uint64_t faceY = r & south[word];
        const std::uint64_t faceZ = r & below[word];
        const std::uint64_t edgeX = faceY & faceZ & southBelow[word];
        euler += Ones(r) - Ones(r & ((r << 1) | carryRow)) - Ones(faceY) - Ones(faceZ) +
                 Ones(faceY & ((faceY << 1) | carryY)) + Ones(faceZ & ((faceZ << 1) | carryZ)) + Ones(edgeX) -
                 Ones(edgeX & ((edgeX << 1) | carryYZ));
        carryRow = r >> 63;
        carryY = faceY >> 63;
        carryZ = faceZ >> 63;
        carryYZ = edgeX >> 63;
      }
    }
  }
  return euler;
}

} // namespace

TopologyNumbers
ComputeShapeTopology(const VoxelShape & shape)
{
  TopologyNumbers numbers;
  numbers.euler = EulerNumber(shape);
  numbers.betti[0] = CountComponents(VoxelRuns(shape), false);
  numbers.betti[2] = CountComponents(BackgroundRuns(shape), true) - 1;
  numbers.betti[1] = numbers.betti[0] + numbers.betti[2] - numbers.euler;
  return numbers;
}

std::int64_t
CountComponents26(const VoxelShape & shape)
{
  return CountComponents(VoxelRuns(shape), true);
}

} // namespace voxelcore
