// FillHollows of ShapeClosing.h.

#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Masks/ShapeClosing.h"
#include "voxelcore/Masks/SliceHoles.h"

#include "BallDilation.h"
#include "EditedBits.h"
#include "EnclosedShare.h"
#include "voxelcore/Shape/ShapeBits.h"
#include "voxelcore/Shape/ShapeRuns.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

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
  VoxelBox slice = dilated.Box();
  slice.lower[axis] = at;
  slice.size[axis] = 1;
  std::uint64_t count = 0;
  PutInto(FindSliceHoles(CopyBox(dilated, slice), static_cast<SliceAxis>(axis), count), dilated);
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
