#include "voxelcore/ShapeTopology.h"

#include "voxelcore/UnionFind.h"

#include <bit>

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

// Runs of equal voxels along x, [begin, end), row by row.
struct Runs
{
  std::vector<std::int32_t> begin;
  std::vector<std::int32_t> end;
  std::vector<std::size_t>  rowStart; // rows + 1
};

void
AppendVoxelRuns(std::span<const std::uint64_t> row, Runs & runs)
{
  std::int32_t start = -1;
  for (std::size_t word = 0; word < row.size(); ++word)
  {
    const auto          base = static_cast<std::int32_t>(64 * word);
    const std::uint64_t bits = row[word];
    for (std::int32_t at = 0; at < 64;)
    {
      const std::uint64_t rest = (start < 0 ? bits : ~bits) >> at;
      if (rest == 0)
      {
        break;
      }
      at += std::countr_zero(rest);
      if (start < 0)
      {
        start = base + at;
      }
      else
      {
        runs.begin.push_back(start);
        runs.end.push_back(base + at);
        start = -1;
      }
    }
  }
  if (start >= 0)
  {
    runs.begin.push_back(start);
    runs.end.push_back(static_cast<std::int32_t>(64 * row.size()));
  }
}

Runs
VoxelRuns(const VoxelShape & shape)
{
  Runs runs;
  runs.rowStart.push_back(0);
  for (std::int32_t z = 0; z < shape.Box().size[2]; ++z)
  {
    for (std::int32_t y = 0; y < shape.Box().size[1]; ++y)
    {
      AppendVoxelRuns(shape.Row(y, z), runs);
      runs.rowStart.push_back(runs.begin.size());
    }
  }
  return runs;
}

// The complement in the box grown by one voxel on every side, so that the outside is one component.
Runs
BackgroundRuns(const VoxelShape & shape)
{
  const auto & size = shape.Box().size;
  const Runs   voxels = VoxelRuns(shape);
  Runs         runs;
  runs.rowStart.push_back(0);
  for (std::int32_t z = -1; z <= size[2]; ++z)
  {
    for (std::int32_t y = -1; y <= size[1]; ++y)
    {
      std::int32_t from = -1;
      if (y >= 0 && z >= 0 && y < size[1] && z < size[2])
      {
        const auto row = static_cast<std::size_t>(z) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(y);
        for (std::size_t run = voxels.rowStart[row]; run < voxels.rowStart[row + 1]; ++run)
        {
          // begin >= 0 > from for the first one, so no run is empty.
          runs.begin.push_back(from);
          runs.end.push_back(voxels.begin[run]);
          from = voxels.end[run];
        }
      }
      runs.begin.push_back(from);
      runs.end.push_back(size[0] + 1);
      runs.rowStart.push_back(runs.begin.size());
    }
  }
  return runs;
}

// Unites the runs of two rows that overlap when one is grown by `reach` voxels at both ends.
void
UniteRows(const Runs & runs, std::size_t rowA, std::size_t rowB, std::int32_t reach, UnionFind & sets)
{
  std::size_t a = runs.rowStart[rowA];
  std::size_t b = runs.rowStart[rowB];
  while (a < runs.rowStart[rowA + 1] && b < runs.rowStart[rowB + 1])
  {
    if (runs.end[a] + reach <= runs.begin[b])
    {
      ++a;
    }
    else if (runs.end[b] + reach <= runs.begin[a])
    {
      ++b;
    }
    else
    {
      sets.Unite(a, b);
      runs.end[a] < runs.end[b] ? ++a : ++b;
    }
  }
}

std::int64_t
CountComponents(const Runs & runs, std::int32_t rowsY, std::int32_t rowsZ, bool diagonals)
{
  UnionFind          sets(runs.begin.size());
  const std::int32_t reach = diagonals ? 1 : 0;
  const auto         rowOf = [&](std::int32_t y, std::int32_t z) {
    return static_cast<std::size_t>(z) * static_cast<std::size_t>(rowsY) + static_cast<std::size_t>(y);
  };
  for (std::int32_t z = 0; z < rowsZ; ++z)
  {
    for (std::int32_t y = 0; y < rowsY; ++y)
    {
      if (y > 0)
      {
        UniteRows(runs, rowOf(y, z), rowOf(y - 1, z), reach, sets);
      }
      if (z > 0)
      {
        UniteRows(runs, rowOf(y, z), rowOf(y, z - 1), reach, sets);
        if (diagonals && y > 0)
        {
          UniteRows(runs, rowOf(y, z), rowOf(y - 1, z - 1), reach, sets);
        }
        if (diagonals && y + 1 < rowsY)
        {
          UniteRows(runs, rowOf(y, z), rowOf(y + 1, z - 1), reach, sets);
        }
      }
    }
  }
  return static_cast<std::int64_t>(sets.Count());
}

} // namespace

TopologyNumbers
ComputeShapeTopology(const VoxelShape & shape)
{
  const auto &    size = shape.Box().size;
  TopologyNumbers numbers;
  numbers.euler = EulerNumber(shape);
  numbers.betti[0] = CountComponents(VoxelRuns(shape), size[1], size[2], false);
  numbers.betti[2] = CountComponents(BackgroundRuns(shape), size[1] + 2, size[2] + 2, true) - 1;
  numbers.betti[1] = numbers.betti[0] + numbers.betti[2] - numbers.euler;
  return numbers;
}

std::int64_t
CountComponents26(const VoxelShape & shape)
{
  return CountComponents(VoxelRuns(shape), shape.Box().size[1], shape.Box().size[2], true);
}

} // namespace voxelcore
