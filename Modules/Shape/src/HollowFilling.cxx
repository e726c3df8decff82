// FillHollows of ShapeClosing.h.

#include "voxelcore/ShapeClosing.h"

#include "BallDilation.h"
#include "EditedBits.h"
#include "PaddedShape.h"
#include "ShapeBits.h"
#include "ShapeRuns.h"

#include <algorithm>
#include <array>
#include <bit>
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

/** Shares the voxels of `between` out, box-relative and in layers, to the one of two regions they are nearer to by
 *  steps over faces, edges and corners; as near to both, to the outside. Beyond the box is outside. What is near
 *  neither is enclosed by the shape itself. */
class Shares
{
public:
  Shares(const VoxelShape & between, VoxelShape enclosed, VoxelShape outside)
    : m_Between(between)
    , m_Enclosed(std::move(enclosed))
    , m_Outside(std::move(outside))
  {}

  /** The enclosed region with its share. */
  VoxelShape
  Run(const ProgressCallback & progress)
  {
    std::array<std::vector<Voxel>, 2> layers;
    VisitVoxels(m_Between, [&](const Voxel & at) {
      bool isOut = false;
      bool isIn = false;
      VisitNeighbours(at, [&](const Voxel & next) {
        isOut = isOut || !IsInBox(next) || Contains(m_Outside, next);
        isIn = isIn || Contains(m_Enclosed, next);
      });
      if (isOut || isIn)
      {
        layers[isOut ? 0 : 1].push_back(at);
      }
    });
    for (const std::size_t side : { 0U, 1U })
    {
      for (const Voxel & at : layers[side])
      {
        Put(side == 0 ? m_Outside : m_Enclosed, at);
      }
    }
    while (!layers[0].empty() || !layers[1].empty())
    {
      ReportProgress(progress, "filling", 1);
      std::array<std::vector<Voxel>, 2> next;
      for (const std::size_t side : { 0U, 1U })
      {
        for (const Voxel & at : layers[side])
        {
          VisitNeighbours(at, [&](const Voxel & beside) {
            if (IsInBox(beside) && Contains(m_Between, beside) && !IsTaken(beside))
            {
              Put(side == 0 ? m_Outside : m_Enclosed, beside);
              next[side].push_back(beside);
            }
          });
        }
      }
      layers.swap(next);
    }
    VisitVoxels(m_Between, [&](const Voxel & at) {
      if (!IsTaken(at))
      {
        Put(m_Enclosed, at);
      }
    });
    return std::move(m_Enclosed);
  }

private:
  bool
  IsInBox(const Voxel & at) const
  {
    const auto & size = m_Between.Box().size;
    return at[0] >= 0 && at[1] >= 0 && at[2] >= 0 && at[0] < size[0] && at[1] < size[1] && at[2] < size[2];
  }
  bool
  IsTaken(const Voxel & at) const
  {
    return Contains(m_Enclosed, at) || Contains(m_Outside, at);
  }
  bool
  Contains(const VoxelShape & shape, const Voxel & at) const
  {
    const auto & lower = shape.Box().lower;
    return shape.Contains(lower[0] + at[0], lower[1] + at[1], lower[2] + at[2]);
  }
  static void
  Put(VoxelShape & shape, const Voxel & at)
  {
    const auto & lower = shape.Box().lower;
    shape.Insert(lower[0] + at[0], lower[1] + at[1], lower[2] + at[2]);
  }

  template <typename TVisit>
  static void
  VisitNeighbours(const Voxel & at, const TVisit & visit)
  {
    for (std::int32_t k = 0; k < 27; ++k)
    {
      visit(Voxel{ at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1 });
    }
  }

  template <typename TVisit>
  static void
  VisitVoxels(const VoxelShape & shape, const TVisit & visit)
  {
    for (std::int32_t z = 0; z < shape.Box().size[2]; ++z)
    {
      for (std::int32_t y = 0; y < shape.Box().size[1]; ++y)
      {
        const auto row = shape.Row(y, z);
        for (std::size_t word = 0; word < row.size(); ++word)
        {
          for (std::uint64_t bits = row[word]; bits != 0; bits &= bits - 1)
          {
            visit(Voxel{ static_cast<std::int32_t>(64 * word) + std::countr_zero(bits), y, z });
          }
        }
      }
    }
  }

  const VoxelShape & m_Between;
  VoxelShape         m_Enclosed;
  VoxelShape         m_Outside;
};

} // namespace

EditedShape
FillHollows(VoxelShape shape, const LatticeBall & ball, const ProgressCallback & progress)
{
  const Additions before(shape);
  const VoxelBox  box = shape.Box();
  const BallRows  rows(ball);
  VoxelShape      reached;
  Background      background;
  {
    // Where the ball's centre cannot be. A place that is enclosed lies in the shape's own box: from one beside it, all
    // ways lead on outwards.
    const VoxelShape dilated = Dilated(shape, rows, progress, 0, 0.5);
    background = BackgroundOf(dilated, box);
    reached = CopyBox(dilated, box);
  }
  ForWords(reached, shape, [](std::uint64_t & word, std::uint64_t own) { word &= ~own; });
  const VoxelShape filled =
    Shares(reached, std::move(background.enclosed), std::move(background.outside)).Run(progress);
  ForWords(shape, filled, [](std::uint64_t & word, std::uint64_t more) { word |= more; });
  EditedShape edited = before.To(std::move(shape));
  edited.cavitiesFilled = background.cavities;
  return edited;
}

} // namespace voxelcore
