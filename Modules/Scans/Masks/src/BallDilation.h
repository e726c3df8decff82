#pragma once
// Dilation of a shape by a ball, a word of 64 voxels at a time.

#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/Progress.h"
#include "voxelcore/Masks/ShapeClosing.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** The largest n with (weight n)^2 <= squared. */
std::int32_t
LatticeReach(std::int64_t squared, std::int64_t weight);

/** The rows of a ball along x: each is 2 h + 1 voxels long, and they are kept by h. */
struct BallRows
{
  struct Offset
  {
    std::int32_t y;
    std::int32_t z;
  };
  LatticeBall                      ball;
  std::vector<std::vector<Offset>> ofHalfLength;
  std::array<std::int32_t, 3>      reach;

  explicit BallRows(const LatticeBall & of);

  bool
  IsOneVoxel() const
  {
    return reach == std::array<std::int32_t, 3>{ 0, 0, 0 };
  }

  /** By how much a box grows on each side so that the ball has room: in x by whole words. */
  std::array<std::int32_t, 3>
  Room() const
  {
    return { (reach[0] + 63) / 64 * 64, reach[1], reach[2] };
  }
};

using BitRow = std::vector<std::uint64_t>;

/** Each bit or'ed (and'ed) with its two neighbours; beyond the row is 0. */
template <bool grow>
void
Spread(BitRow & row, BitRow & spare)
{
  const std::size_t count = row.size();
  for (std::size_t word = 0; word < count; ++word)
  {
    const std::uint64_t lower = row[word] << 1U | (word > 0 ? row[word - 1] >> 63U : 0);
    const std::uint64_t upper = row[word] >> 1U | (word + 1 < count ? row[word + 1] << 63U : 0);
    spare[word] = grow ? row[word] | lower | upper : row[word] & lower & upper;
  }
  row.swap(spare);
}

/** Puts a ball's rows together in `row`: add(dy, dz) adds the source row there and says whether it holds anything. */
template <typename TAdd>
bool
AddBallRows(const BallRows & ball, BitRow & row, BitRow & spare, const TAdd & add)
{
  bool any = false;
  // The longest first: they grow with each step by one voxel at both ends.
  for (std::size_t half = ball.ofHalfLength.size(); half-- > 0;)
  {
    if (any)
    {
      Spread<true>(row, spare);
    }
    for (const auto [dy, dz] : ball.ofHalfLength[half])
    {
      any = add(dy, dz) || any;
    }
  }
  return any;
}

/** A box with so many voxels more on each side. */
inline VoxelBox
Grown(VoxelBox box, const std::array<std::int32_t, 3> & room)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] -= room[axis];
    box.size[axis] += 2 * room[axis];
  }
  return box;
}

/** Calls work(z) for all slices on all threads, and reports between them. */
template <typename TWork>
void
ForSlices(std::int32_t slices, const ProgressCallback & progress, const TWork & work)
{
  constexpr std::int32_t step = 32;
  for (std::int32_t first = 0; first < slices; first += step)
  {
    ReportProgress(progress, "closing", static_cast<double>(first) / slices);
    const std::int32_t end = std::min(slices, first + step);
    RunEach(static_cast<std::size_t>(end - first), [&](std::size_t i) { work(first + static_cast<std::int32_t>(i)); });
  }
}

/** All places within the ball's reach of a voxel, in the shape's box grown by the ball's room. */
VoxelShape
Dilated(const VoxelShape & shape, const BallRows & ball, const ProgressCallback & progress);

} // namespace voxelcore
