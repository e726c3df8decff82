#pragma once
// A shape or its background as runs of voxels along x, and the components that runs make.

#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <cstdint>
#include <vector>

namespace voxelcore
{

/** Runs of equal voxels, [begin, end) along x, row by row in scan order: run i comes before run i + 1. */
struct Runs
{
  std::int32_t              rowsY = 0;
  std::int32_t              rowsZ = 0;
  std::vector<std::int32_t> begin;
  std::vector<std::int32_t> end;
  std::vector<std::size_t>  rowStart; ///< rowsY * rowsZ + 1; row (y, z) is number z * rowsY + y
};

/** The voxels, box-relative. */
Runs
VoxelRuns(const VoxelShape & shape);

/** The complement in the box grown by one voxel on every side, so that the outside is one component, that of run 0.
 *  Row (0, 0) is the box-relative row (-1, -1); x stays box-relative. */
Runs
BackgroundRuns(const VoxelShape & shape);

/** The same of one slice (box-relative z), grown in y alone: row 0 is row -1 of the slice. */
Runs
SliceBackgroundRuns(const VoxelShape & shape, std::int32_t z);

/** Sets of runs that touch over faces, or with `diagonals` over faces, edges or corners. A set's representative is its
 *  first run in scan order. */
UnionFind
UniteRuns(const Runs & runs, bool diagonals);

inline std::int64_t
CountComponents(const Runs & runs, bool diagonals)
{
  return static_cast<std::int64_t>(UniteRuns(runs, diagonals).Count());
}

/** work(word, bits) for each word of a row that has voxels of [begin, end), which are the bits. */
template <typename TWork>
void
ForWordsOfRun(std::int32_t begin, std::int32_t end, const TWork & work)
{
  constexpr std::uint64_t all = ~std::uint64_t{ 0 };
  const auto              first = static_cast<std::size_t>(begin) / 64;
  const auto              last = static_cast<std::size_t>(end - 1) / 64;
  for (std::size_t word = first; word <= last; ++word)
  {
    const std::uint64_t from = word == first ? all << (static_cast<unsigned>(begin) & 63U) : all;
    const std::uint64_t to = word == last ? all >> (63U - (static_cast<unsigned>(end - 1) & 63U)) : all;
    work(word, from & to);
  }
}

/** Puts the voxels [begin, end) of a row in, or out. */
void
SetRun(const ShapeRow & row, std::int32_t begin, std::int32_t end, bool in);

} // namespace voxelcore
