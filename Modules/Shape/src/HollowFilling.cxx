// FillHollows of ShapeClosing.h.

#include "voxelcore/ShapeClosing.h"
#include "voxelcore/StagePlan.h"

#include "BallDilation.h"
#include "EditedBits.h"
#include "EnclosedShare.h"
#include "ShapeBits.h"
#include "ShapeRuns.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

/** The background outside a shape, and all that the shape encloses, cut to a box. */
struct Background
{
  VoxelShape    enclosed;
  VoxelShape    outside;
  std::uint64_t cavities = 0;
};

Background
BackgroundOf(const VoxelShape & shape, const VoxelBox & box)
{
  Background background{ VoxelShape(box), VoxelShape(box), 0 };
  const Runs runs = BackgroundRuns(shape);
  UnionFind  sets = UniteRuns(runs, true);
  background.cavities = sets.Count() - 1;
  const std::int32_t shift = box.lower[0] - shape.Box().lower[0];
  const std::int32_t firstY = box.lower[1] - shape.Box().lower[1] + 1; // rows of runs begin at row -1
  const std::int32_t firstZ = box.lower[2] - shape.Box().lower[2] + 1;
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const std::size_t row = static_cast<std::size_t>(z + firstZ) * static_cast<std::size_t>(runs.rowsY) +
                              static_cast<std::size_t>(y + firstY);
      for (std::size_t run = runs.rowStart[row]; run < runs.rowStart[row + 1]; ++run)
      {
        const std::int32_t begin = std::max(runs.begin[run] - shift, 0);
        const std::int32_t end = std::min(runs.end[run] - shift, box.size[0]);
        if (begin < end)
        {
          SetRun((sets.Find(run) == 0 ? background.outside : background.enclosed).Row(y, z), begin, end, true);
        }
      }
    }
  }
  return background;
}

/** Puts into `dilated` what it encloses in its slice `at` across `axis`. */
void
CapLumens(std::size_t axis, std::int32_t at, VoxelShape & dilated)
{
  const VoxelBox &   box = dilated.Box();
  const std::size_t  first = axis == 0 ? 1 : 0;
  const std::size_t  second = axis == 2 ? 1 : 2;
  const std::int32_t width = box.size[first];
  const std::int32_t height = box.size[second];
  const auto         place = [&](std::int32_t u, std::int32_t v) {
    std::array<std::int32_t, 3> voxel{ at, at, at };
    voxel[first] = box.lower[first] + u;
    voxel[second] = box.lower[second] + v;
    return voxel;
  };
  const auto number = [&](std::int32_t u, std::int32_t v) {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  };
  std::vector<std::uint8_t>                          isOut(number(width - 1, height - 1) + 1, 0);
  std::vector<std::pair<std::int32_t, std::int32_t>> open;
  const auto                                         reach = [&](std::int32_t u, std::int32_t v) {
    if (u >= 0 && v >= 0 && u < width && v < height && isOut[number(u, v)] == 0)
    {
      const auto voxel = place(u, v);
      if (!dilated.Contains(voxel[0], voxel[1], voxel[2]))
      {
        isOut[number(u, v)] = 1;
        open.emplace_back(u, v);
      }
    }
  };
  for (std::int32_t u = 0; u < width; ++u)
  {
    reach(u, 0);
    reach(u, height - 1);
  }
  for (std::int32_t v = 0; v < height; ++v)
  {
    reach(0, v);
    reach(width - 1, v);
  }
  while (!open.empty())
  {
    const auto [u, v] = open.back();
    open.pop_back();
    for (std::int32_t step = 0; step < 9; ++step)
    {
      reach(u + step % 3 - 1, v + step / 3 - 1);
    }
  }
  for (std::int32_t v = 0; v < height; ++v)
  {
    for (std::int32_t u = 0; u < width; ++u)
    {
      if (isOut[number(u, v)] == 0)
      {
        const auto voxel = place(u, v);
        dilated.Insert(voxel[0], voxel[1], voxel[2]);
      }
    }
  }
}

} // namespace

EditedShape
FillHollows(VoxelShape                                         shape,
            const LatticeBall &                                ball,
            const ProgressCallback &                           progress,
            const std::optional<std::array<std::int64_t, 3>> & scan)
{
  const Additions before(shape);
  const VoxelBox  box = shape.Box();
  const BallRows  rows(ball);
  VoxelShape      reached;
  Background      background;
  ClosedSides     closed{};
  {
    // Where the ball's centre cannot be. A place that is enclosed lies in the shape's own box: from one beside it, all
    // ways lead on outwards.
    VoxelShape dilated = Dilated(shape, rows, PartOfProgress(progress, 0, 0.5));
    for (std::size_t axis = 0; scan && axis < 3; ++axis)
    {
      const std::int32_t last = box.lower[axis] + box.size[axis] - 1;
      closed[axis] = { box.lower[axis] == 0, last + 1 == (*scan)[axis] };
      if (closed[axis][0])
      {
        CapLumens(axis, 0, dilated);
      }
      if (closed[axis][1])
      {
        CapLumens(axis, last, dilated);
      }
    }
    background = BackgroundOf(dilated, box);
    reached = CopyBox(dilated, box);
  }
  ForWords(reached, shape, [](std::uint64_t & word, std::uint64_t own) { word &= ~own; });
  const VoxelShape filled =
    EnclosedShare(std::move(reached), std::move(background.enclosed), std::move(background.outside), progress, closed);
  ForWords(shape, filled, [](std::uint64_t & word, std::uint64_t more) { word |= more; });
  EditedShape edited = before.To(std::move(shape));
  edited.cavitiesFilled = background.cavities;
  return edited;
}

} // namespace voxelcore
