#include "voxelcore/Masks/DepthSimplification.h"

#include "BallDilation.h"
#include "EditedBits.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Shape/ShapeBits.h"
#include "voxelcore/Shape/ShapeRuns.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

constexpr double kMostDepth = 32; // voxels

/** The background in the shape's box and one voxel around it: beyond, no voxel is nearer to the shape's. */
VoxelShape
BackgroundAround(const VoxelShape & shape)
{
  VoxelBox box = shape.Box();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] -= 1;
    box.size[axis] += 2;
  }
  VoxelShape background(box);
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      SetRun(background.Row(y, z), 0, box.size[0], true);
    }
  }
  const Runs runs = VoxelRuns(shape);
  for (std::int32_t z = 0; z < runs.rowsZ; ++z)
  {
    for (std::int32_t y = 0; y < runs.rowsY; ++y)
    {
      const std::size_t row =
        static_cast<std::size_t>(z) * static_cast<std::size_t>(runs.rowsY) + static_cast<std::size_t>(y);
      for (std::size_t run = runs.rowStart[row]; run < runs.rowStart[row + 1]; ++run)
      {
        SetRun(background.Row(y + 1, z + 1), runs.begin[run] + 1, runs.end[run] + 1, false);
      }
    }
  }
  return background;
}

/** How far a voxel is from the nearest one on the other side of the boundary. */
class DistanceCost
{
public:
  DistanceCost(const VoxelShape & shape, const LatticeBall & ball)
    : m_Shape(shape)
  {
    const BallRows                               rows(ball);
    const auto &                                 w = ball.weight;
    const auto                                   smallest = static_cast<double>(*ranges::min_element(w));
    std::vector<std::pair<std::int64_t, Offset>> sorted;
    for (std::int32_t z = -rows.reach[2]; z <= rows.reach[2]; ++z)
    {
      for (std::int32_t y = -rows.reach[1]; y <= rows.reach[1]; ++y)
      {
        for (std::int32_t x = -rows.reach[0]; x <= rows.reach[0]; ++x)
        {
          const std::int64_t squared = w[0] * w[0] * x * x + w[1] * w[1] * y * y + w[2] * w[2] * z * z;
          if (squared > 0 && squared <= ball.squaredRadius)
          {
            const double cost = kCostOfOneVoxel * std::sqrt(static_cast<double>(squared)) / smallest;
            sorted.push_back({ squared, { { x, y, z }, static_cast<std::uint32_t>(std::llround(cost)) } });
          }
        }
      }
    }
    ranges::stable_sort(sorted, {}, &std::pair<std::int64_t, Offset>::first);
    for (const auto & [squared, offset] : sorted)
    {
      m_Offsets.push_back(offset);
    }
  }

  std::uint32_t
  operator()(std::int32_t x, std::int32_t y, std::int32_t z) const
  {
    const bool isIn = m_Shape.Contains(x, y, z);
    for (const Offset & offset : m_Offsets)
    {
      if (m_Shape.Contains(x + offset.step[0], y + offset.step[1], z + offset.step[2]) != isIn)
      {
        return offset.cost;
      }
    }
    return m_Offsets.empty() ? 1 : m_Offsets.back().cost + 1;
  }

private:
  struct Offset
  {
    std::array<std::int32_t, 3> step;
    std::uint32_t               cost;
  };

  const VoxelShape &  m_Shape;
  std::vector<Offset> m_Offsets; // nearest first
};

} // namespace

std::string
CountsText(const TopologyNumbers & numbers)
{
  const auto [pieces, loops, cavities] = numbers.betti;
  return Counted(static_cast<std::uint64_t>(pieces), "piece", "pieces") + ", " +
         Counted(static_cast<std::uint64_t>(loops), "loop", "loops") + " and " +
         Counted(static_cast<std::uint64_t>(cavities), "cavity", "cavities");
}

LatticeBall
BallOfDepth(const GapWidth & depth, const ImageGeometry & geometry)
{
  const LatticeBall ball = BallOfDiameter({ 2 * depth.value, depth.unit, depth.text }, geometry);
  const auto        most = kMostDepth * static_cast<double>(*ranges::min_element(ball.weight));
  if (static_cast<double>(ball.squaredRadius) > most * most)
  {
    throw InputError(depth.text + " is more than 32 voxels; give a smaller depth");
  }
  return ball;
}

VoxelShape
VoxelsAround(const VoxelShape & shape, const LatticeBall & ball, const ProgressCallback & progress)
{
  const BallRows rows(ball);
  return rows.IsOneVoxel() || shape.Box().size[0] == 0
           ? shape
           : CopyBox(Dilated(shape, rows, PartOfProgress(progress, 0, 0)), shape.Box());
}

ChangeCost
DepthCost(const VoxelShape & shape, const LatticeBall & ball)
{
  return DistanceCost(shape, ball);
}

DepthSimplified
SimplifyWithin(const VoxelShape &       shape,
               const LatticeBall &      ball,
               const TopologyRequest &  request,
               const ProgressCallback & progress)
{
  const BallRows rows(ball);
  VoxelShape     kernel = shape;
  VoxelShape     neighbourhood = VoxelsAround(shape, ball, progress);
  if (!rows.IsOneVoxel() && shape.Box().size[0] > 0)
  {
    const VoxelShape nearBackground =
      CopyBox(Dilated(BackgroundAround(shape), rows, PartOfProgress(progress, 0, 0)), shape.Box());
    ForWords(kernel, nearBackground, [](std::uint64_t & word, std::uint64_t near) { word &= ~near; });
  }
  const DistanceCost cost(shape, ball);
  DepthSimplified    result;
  result.simplified = SimplifyTopology(kernel, shape, neighbourhood, std::cref(cost), request, progress);
  if (!result.simplified.asAsked)
  {
    result.reason = "what is never cut has " + CountsText(ComputeShapeTopology(kernel)) +
                    "; with all that may be filled, " + CountsText(ComputeShapeTopology(neighbourhood));
  }
  return result;
}

} // namespace voxelcore
