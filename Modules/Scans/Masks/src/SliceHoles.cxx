#include "voxelcore/Masks/SliceHoles.h"

#include "EditedBits.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Shape/ShapeRuns.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <utility>

namespace voxelcore
{

namespace
{

/** Bit i of word k becomes bit k of word i. */
void
Transpose(std::array<std::uint64_t, 64> & block)
{
  std::uint64_t mask = 0xFFFFFFFFU;
  for (unsigned half = 32; half != 0; half /= 2, mask ^= mask << half)
  {
    for (std::size_t k = 0; k < 64; k = ((k | half) + 1) & ~std::size_t{ half })
    {
      const std::uint64_t swapped = (block[k] >> half ^ block[k | half]) & mask;
      block[k] ^= swapped << half;
      block[k | half] ^= swapped;
    }
  }
}

VoxelShape
EmptyWithAxes(const VoxelShape & shape, std::size_t a, std::size_t b)
{
  VoxelBox box = shape.Box();
  std::swap(box.lower[a], box.lower[b]);
  std::swap(box.size[a], box.size[b]);
  return VoxelShape(box);
}

/** With x and z exchanged. */
VoxelShape
SwappedXZ(const VoxelShape & shape)
{
  VoxelShape   swapped = EmptyWithAxes(shape, 0, 2);
  const auto & size = shape.Box().size;
  RunEach(static_cast<std::size_t>(size[1]), [&](std::size_t row) {
    const auto                    y = static_cast<std::int32_t>(row);
    std::array<std::uint64_t, 64> block{};
    for (std::int32_t z = 0; z < size[2]; z += 64)
    {
      const std::int32_t rows = std::min(64, size[2] - z);
      for (std::size_t word = 0; word < shape.WordsPerRow(); ++word)
      {
        block.fill(0);
        std::uint64_t any = 0;
        for (std::int32_t k = 0; k < rows; ++k)
        {
          any |= block[static_cast<std::size_t>(k)] = shape.Row(y, z + k)[word];
        }
        if (any == 0)
        {
          continue;
        }
        Transpose(block);
        const auto         x = static_cast<std::int32_t>(64 * word);
        const std::int32_t columns = std::min(64, size[0] - x);
        for (std::int32_t i = 0; i < columns; ++i)
        {
          swapped.Row(y, x + i)[static_cast<std::size_t>(z) / 64] = block[static_cast<std::size_t>(i)];
        }
      }
    }
  });
  return swapped;
}

/** With y and z exchanged. */
VoxelShape
SwappedYZ(const VoxelShape & shape)
{
  VoxelShape   swapped = EmptyWithAxes(shape, 1, 2);
  const auto & size = shape.Box().size;
  RunInParts(true, static_cast<std::size_t>(size[1]), [&](std::size_t first, std::size_t last) {
    for (auto y = static_cast<std::int32_t>(first); y < static_cast<std::int32_t>(last); ++y)
    {
      for (std::int32_t z = 0; z < size[2]; ++z)
      {
        ranges::copy(shape.Row(y, z), swapped.Row(z, y).begin());
      }
    }
  });
  return swapped;
}

/** Holes of the slices across z. */
VoxelShape
HolesAcrossZ(const VoxelShape & shape, std::uint64_t & count, const ProgressCallback & progress)
{
  VoxelShape                 holes(shape.Box());
  std::atomic<std::uint64_t> found{ 0 };
  const std::int32_t         slices = shape.Box().size[2];
  constexpr std::int32_t     step = 64;
  for (std::int32_t first = 0; first < slices; first += step)
  {
    ReportProgress(progress, "filling slices", static_cast<double>(first) / slices);
    RunEach(static_cast<std::size_t>(std::min(slices - first, step)), [&](std::size_t i) {
      const std::int32_t z = first + static_cast<std::int32_t>(i);
      const Runs         runs = SliceBackgroundRuns(shape, z);
      UnionFind          sets = UniteRuns(runs, true);
      found += sets.Count() - 1;
      if (sets.Count() == 1)
      {
        return;
      }
      for (std::int32_t y = 0; y < shape.Box().size[1]; ++y)
      {
        const auto row = static_cast<std::size_t>(y + 1);
        for (std::size_t run = runs.rowStart[row]; run < runs.rowStart[row + 1]; ++run)
        {
          // Set 0 is the outside; no other one reaches the rim by which the rows are longer.
          if (sets.Find(run) != 0)
          {
            SetRun(holes.Row(y, z), runs.begin[run], runs.end[run], true);
          }
        }
      }
    });
  }
  count = found;
  return holes;
}

} // namespace

std::optional<SliceAxis>
SliceAxisNamed(std::string_view name)
{
  for (const SliceAxis axis : { SliceAxis::I, SliceAxis::J, SliceAxis::K })
  {
    if (name == SliceAxisName(axis))
    {
      return axis;
    }
  }
  return std::nullopt;
}

std::string_view
SliceAxisName(SliceAxis axis)
{
  return axis == SliceAxis::I ? "i" : axis == SliceAxis::J ? "j" : "k";
}

VoxelShape
FindSliceHoles(const VoxelShape & shape, SliceAxis axis, std::uint64_t & count, const ProgressCallback & progress)
{
  switch (axis)
  {
    case SliceAxis::I:
      return SwappedXZ(HolesAcrossZ(SwappedXZ(shape), count, progress));
    case SliceAxis::J:
      return SwappedYZ(HolesAcrossZ(SwappedYZ(shape), count, progress));
    case SliceAxis::K:
      break;
  }
  return HolesAcrossZ(shape, count, progress);
}

EditedShape
FillSlices(VoxelShape shape, SliceAxis axis, const ProgressCallback & progress)
{
  const Additions  before(shape);
  std::uint64_t    count = 0;
  const VoxelShape holes = FindSliceHoles(shape, axis, count, progress);
  ForWords(shape, holes, [](std::uint64_t & word, std::uint64_t more) { word |= more; });
  EditedShape edited = before.To(std::move(shape));
  edited.cavitiesFilled = count;
  return edited;
}

} // namespace voxelcore
