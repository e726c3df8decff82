#include "voxelcore/Shape/ShapeTopology.h"

#include "CornerRows.h"
#include "voxelcore/Shape/ShapeRuns.h"

#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Base/ParallelTasks.h"

namespace voxelcore
{

namespace
{

std::int64_t
Ones(std::uint64_t word)
{
  return CountBits(word);
}

// voxels - inner faces + inner edges - inner corners, 64 voxels at a time.
std::int64_t
EulerNumber(const VoxelShape & shape)
{
  const auto & size = shape.Box().size;
  CornerRows   around(shape);
  std::int64_t euler = 0;
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      around.MoveTo(y, z);
      const auto & [southBelow, below, south, row] = around.rows;
      // An element is counted at its greatest voxel: in x these are neighbours x - 1, with the bit carried over words.
      // Where all is in, the counts of a word cancel.
      for (const std::uint32_t word : around.Words())
      {
        const std::uint64_t r = row[word];
        const std::uint64_t faceY = r & south[word];
        const std::uint64_t faceZ = r & below[word];
        const std::uint64_t edgeX = faceY & faceZ & southBelow[word];
        std::uint64_t       carryRow = 0, carryY = 0, carryZ = 0, carryYZ = 0;
        if (word > 0)
        {
          carryRow = row[word - 1] >> 63;
          carryY = carryRow & (south[word - 1] >> 63);
          carryZ = carryRow & (below[word - 1] >> 63);
          carryYZ = carryY & carryZ & (southBelow[word - 1] >> 63);
        }
        euler += Ones(r) - Ones(r & ((r << 1) | carryRow)) - Ones(faceY) - Ones(faceZ) +
                 Ones(faceY & ((faceY << 1) | carryY)) + Ones(faceZ & ((faceZ << 1) | carryZ)) + Ones(edgeX) -
                 Ones(edgeX & ((edgeX << 1) | carryYZ));
      }
    }
  }
  return euler;
}

// corners - edges + faces - voxels of the closed union, 64 places at a time. What lies at place (x, y, z) is the corner
// before voxel (x, y, z), and the edges, faces and the voxel that go from there up each axis.
std::int64_t
ClosedEulerNumber(const VoxelShape & shape)
{
  const auto & size = shape.Box().size;
  CornerRows   around(shape);
  std::int64_t euler = 0;
  for (std::int32_t z = 0; z <= size[2]; ++z)
  {
    for (std::int32_t y = 0; y <= size[1]; ++y)
    {
      around.MoveTo(y, z);
      const auto & [southBelow, below, south, row] = around.rows;
      // Where all is in, the counts of a word cancel.
      for (const std::uint32_t word : around.Words())
      {
        const std::uint64_t r = row[word];
        const std::uint64_t faceY = r | south[word];
        const std::uint64_t faceZ = r | below[word];
        const std::uint64_t edgeX = faceY | faceZ | southBelow[word];
        std::uint64_t       carryRow = 0, carryY = 0, carryZ = 0, carryYZ = 0;
        if (word > 0)
        {
          carryRow = row[word - 1] >> 63;
          carryY = carryRow | (south[word - 1] >> 63);
          carryZ = carryRow | (below[word - 1] >> 63);
          carryYZ = carryY | carryZ | (southBelow[word - 1] >> 63);
        }
        euler += Ones(edgeX | edgeX << 1 | carryYZ) - Ones(edgeX) - Ones(faceY | faceY << 1 | carryY) -
                 Ones(faceZ | faceZ << 1 | carryZ) + Ones(faceY) + Ones(faceZ) + Ones(r | r << 1 | carryRow) - Ones(r);
      }
      // Behind the last voxel of a row that ends with its word: a corner, two edges along y and z, a face across x.
      if (const std::size_t last = row.size() - 1; (row.size() > 0) && size[0] % 64 == 0)
      {
        const std::uint64_t faceY = row[last] | south[last];
        const std::uint64_t faceZ = row[last] | below[last];
        euler += static_cast<std::int64_t>((faceY | faceZ | southBelow[last]) >> 63) -
                 static_cast<std::int64_t>(faceY >> 63) - static_cast<std::int64_t>(faceZ >> 63) +
                 static_cast<std::int64_t>(row[last] >> 63);
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
  const auto &    size = shape.Box().size;
  RunBoth(
    shape.WordsPerRow() * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]) > 10000,
    [&] {
      numbers.euler = EulerNumber(shape);
      numbers.betti[0] = CountComponents(VoxelRuns(shape), false);
    },
    [&] { numbers.betti[2] = CountComponents(BackgroundRuns(shape), true) - 1; });
  numbers.betti[1] = numbers.betti[0] + numbers.betti[2] - numbers.euler;
  return numbers;
}

TopologyNumbers
ComputeClosedTopology(const VoxelShape & shape)
{
  TopologyNumbers numbers;
  const auto &    size = shape.Box().size;
  RunBoth(
    shape.WordsPerRow() * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]) > 10000,
    [&] {
      numbers.euler = ClosedEulerNumber(shape);
      numbers.betti[0] = CountComponents26(shape);
    },
    [&] { numbers.betti[2] = CountComponents(BackgroundRuns(shape), false) - 1; });
  numbers.betti[1] = numbers.betti[0] + numbers.betti[2] - numbers.euler;
  return numbers;
}

std::int64_t
CountComponents26(const VoxelShape & shape)
{
  return CountComponents(VoxelRuns(shape), true);
}

} // namespace voxelcore
