#include "voxelcore/Shape/ShapeRuns.h"

#include <bit>

namespace voxelcore
{

namespace
{

void
AppendVoxelRuns(const ConstShapeRow & row, Runs & runs)
{
  std::int32_t start = -1;
  for (std::size_t word = 0; word < row.size(); ++word)
  {
    // What goes on as it was has no end of a run.
    if (row.Brick(word) == (start < 0 ? BitBricks::Out() : BitBricks::In()))
    {
      continue;
    }
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

/** The runs of a slice's complement, with a row and a voxel more on each side; of one that is not there, all. `voxels`
 *  is room for the runs of a row. */
void
AppendSliceBackground(const VoxelShape & shape, std::int32_t z, Runs & voxels, Runs & runs)
{
  const auto & size = shape.Box().size;
  for (std::int32_t y = -1; y <= size[1]; ++y)
  {
    std::int32_t from = -1;
    if (y >= 0 && z >= 0 && y < size[1] && z < size[2])
    {
      voxels.begin.clear();
      voxels.end.clear();
      AppendVoxelRuns(shape.Row(y, z), voxels);
      for (std::size_t run = 0; run < voxels.begin.size(); ++run)
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

} // namespace

Runs
VoxelRuns(const VoxelShape & shape)
{
  Runs runs;
  runs.rowsY = shape.Box().size[1];
  runs.rowsZ = shape.Box().size[2];
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

Runs
BackgroundRuns(const VoxelShape & shape)
{
  const auto & size = shape.Box().size;
  Runs         runs;
  Runs         voxels;
  runs.rowsY = size[1] + 2;
  runs.rowsZ = size[2] + 2;
  runs.rowStart.push_back(0);
  for (std::int32_t z = -1; z <= size[2]; ++z)
  {
    AppendSliceBackground(shape, z, voxels, runs);
  }
  return runs;
}

Runs
SliceBackgroundRuns(const VoxelShape & shape, std::int32_t z)
{
  Runs runs;
  Runs voxels;
  runs.rowsY = shape.Box().size[1] + 2;
  runs.rowsZ = 1;
  runs.rowStart.push_back(0);
  AppendSliceBackground(shape, z, voxels, runs);
  return runs;
}

UnionFind
UniteRuns(const Runs & runs, bool diagonals)
{
  UnionFind          sets(runs.begin.size());
  const std::int32_t reach = diagonals ? 1 : 0;
  const auto         rowOf = [&](std::int32_t y, std::int32_t z) {
    return static_cast<std::size_t>(z) * static_cast<std::size_t>(runs.rowsY) + static_cast<std::size_t>(y);
  };
  for (std::int32_t z = 0; z < runs.rowsZ; ++z)
  {
    for (std::int32_t y = 0; y < runs.rowsY; ++y)
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
        if (diagonals && y + 1 < runs.rowsY)
        {
          UniteRows(runs, rowOf(y, z), rowOf(y + 1, z - 1), reach, sets);
        }
      }
    }
  }
  return sets;
}

void
SetRun(const ShapeRow & row, std::int32_t begin, std::int32_t end, bool in)
{
  ForWordsOfRun(begin, end, [&](std::size_t word, std::uint64_t own) {
    row[word] = in ? row[word] | own : row[word] & ~own;
  });
}

} // namespace voxelcore
