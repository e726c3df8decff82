#include "EnclosedShare.h"

#include "BallDilation.h"
#include "EditedBits.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

/** A word of voxels that one step gives to the two regions. */
struct Given
{
  std::int32_t  y;
  std::int32_t  z;
  std::size_t   word;
  std::uint64_t toOutside;
  std::uint64_t toEnclosed;
};

/** The voxels within a step of a region, of one row. */
void
WithinAStep(const VoxelShape & region, std::int32_t y, std::int32_t z, BitRow & row, BitRow & spare)
{
  ranges::fill(row, 0);
  for (std::int32_t nextZ = std::max(z - 1, 0); nextZ <= std::min(z + 1, region.Box().size[2] - 1); ++nextZ)
  {
    for (std::int32_t nextY = std::max(y - 1, 0); nextY <= std::min(y + 1, region.Box().size[1] - 1); ++nextY)
    {
      const auto beside = region.Row(nextY, nextZ);
      ranges::transform(row, beside, row.begin(), [](std::uint64_t a, std::uint64_t b) { return a | b; });
    }
  }
  Spread<true>(row, spare);
}

} // namespace

VoxelShape
EnclosedShare(VoxelShape               between,
              VoxelShape               enclosed,
              VoxelShape               outside,
              const ProgressCallback & progress,
              const ClosedSides &      closed)
{
  const auto & size = between.Box().size;
  const auto   isRim = [&](std::int32_t y, std::int32_t z) {
    return (y == 0 && !closed[1][0]) || (z == 0 && !closed[2][0]) || (y + 1 == size[1] && !closed[1][1]) ||
           (z + 1 == size[2] && !closed[2][1]);
  };
  bool isFirst = true; // later steps find the rim of the box taken
  for (bool wentOn = true; wentOn; isFirst = false)
  {
    ReportProgress(progress, "filling", 1);
    std::vector<Given> given;
    std::mutex         guard;
    RunInParts(true, static_cast<std::size_t>(size[2]), [&](std::size_t first, std::size_t last) {
      std::vector<Given> own;
      BitRow             out;
      BitRow             in;
      BitRow             spare;
      for (auto z = static_cast<std::int32_t>(first); z < static_cast<std::int32_t>(last); ++z)
      {
        for (std::int32_t y = 0; y < size[1]; ++y)
        {
          const auto row = std::as_const(between).Row(y, z);
          if (ranges::all_of(row, [](std::uint64_t word) { return word == 0; }))
          {
            continue;
          }
          out.resize(row.size());
          in.resize(row.size());
          spare.resize(row.size());
          WithinAStep(outside, y, z, out, spare);
          WithinAStep(enclosed, y, z, in, spare);
          if (isFirst)
          {
            out.front() |= closed[0][0] ? 0 : 1;
            out.back() |= closed[0][1] ? 0 : std::uint64_t{ 1 } << (static_cast<unsigned>(size[0] - 1) & 63U);
          }
          for (std::size_t word = 0; word < row.size(); ++word)
          {
            const std::uint64_t toOutside = row[word] & (isFirst && isRim(y, z) ? ~std::uint64_t{ 0 } : out[word]);
            const std::uint64_t toEnclosed = row[word] & in[word] & ~toOutside;
            if ((toOutside | toEnclosed) != 0)
            {
              own.push_back({ y, z, word, toOutside, toEnclosed });
            }
          }
        }
      }
      const std::scoped_lock lock(guard);
      given.insert(given.end(), own.begin(), own.end());
    });
    for (const Given & one : given)
    {
      outside.Row(one.y, one.z)[one.word] |= one.toOutside;
      enclosed.Row(one.y, one.z)[one.word] |= one.toEnclosed;
      between.Row(one.y, one.z)[one.word] &= ~(one.toOutside | one.toEnclosed);
    }
    wentOn = !given.empty();
  }
  ForWords(enclosed, between, [](std::uint64_t & word, std::uint64_t left) { word |= left; });
  return enclosed;
}

} // namespace voxelcore
