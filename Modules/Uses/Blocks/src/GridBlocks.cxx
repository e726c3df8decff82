#include "voxelcore/Blocks/GridBlocks.h"

#include "BlockParts.h"
#include "Checksum.h"
#include "HaloComponents.h"
#include "HaloRegion.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

namespace voxelcore
{
namespace
{

constexpr std::int64_t kMostInGrid = std::int64_t{ 1 } << 20;
constexpr std::int32_t kMargin = 16; // voxels read around a block at first: thin parts need no more

VoxelBox
Common(const VoxelBox & a, const VoxelBox & b)
{
  VoxelBox common;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int32_t end = std::min(a.lower[axis] + a.size[axis], b.lower[axis] + b.size[axis]);
    common.lower[axis] = std::max(a.lower[axis], b.lower[axis]);
    common.size[axis] = std::max(end - common.lower[axis], 0);
  }
  return common;
}

VoxelBox
Grown(const VoxelBox & box, std::int32_t by)
{
  VoxelBox grown = box;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    grown.lower[axis] -= by;
    grown.size[axis] += 2 * by;
  }
  return grown;
}

VoxelBox
Union(const VoxelBox & a, const VoxelBox & b)
{
  VoxelBox both;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int32_t end = std::max(a.lower[axis] + a.size[axis], b.lower[axis] + b.size[axis]);
    both.lower[axis] = std::min(a.lower[axis], b.lower[axis]);
    both.size[axis] = end - both.lower[axis];
  }
  return both;
}

/** The voxels around the lattice corners of a block, as far as the scan goes; at least one along each axis. */
VoxelBox
VoxelsAround(const HaloBlock & block, const VoxelBox & scan)
{
  const VoxelBox box{
    { block.lower.x - 1, block.lower.y - 1, block.lower.z - 1 },
    { block.upper.x - block.lower.x + 1, block.upper.y - block.lower.y + 1, block.upper.z - block.lower.z + 1 }
  };
  return Common(box, scan);
}

/** What a window shows, in just its box. */
VoxelShape
ReadWindow(const RegionReader & read, const VoxelBox & window)
{
  VoxelShape shape(window);
  Include(CropToBox(read(window), window).shape, shape);
  shape.Compact();
  return shape;
}

} // namespace

BlockPlan
PlanGrid(const VoxelBox & scan, const SpacingWeights & weights, std::int32_t side)
{
  if (side < 8)
  {
    throw UsageError("blocks must be at least 8 voxels long");
  }
  std::int64_t count = 1;
  for (const std::int32_t length : scan.size)
  {
    count *= (std::int64_t{ length } + side - 1) / side;
  }
  if (count > kMostInGrid)
  {
    throw UsageError("blocks of " + std::to_string(side) + " voxels would be more than " + std::to_string(kMostInGrid) +
                     "; make them larger");
  }
  RequireExactRange(scan.size, weights);
  BlockPlan plan;
  plan.weight = weights.weight;
  plan.boundaryVertices = kNotCounted;
  plan.boundarySquares = kNotCounted;
  for (std::int32_t z = 0; z < scan.size[2]; z += side)
  {
    for (std::int32_t y = 0; y < scan.size[1]; y += side)
    {
      for (std::int32_t x = 0; x < scan.size[0]; x += side)
      {
        const auto upper = [&](std::int32_t from, std::size_t axis) {
          return scan.lower[axis] + (from + side < scan.size[axis] ? from + side : scan.size[axis] + 1);
        };
        plan.blocks.push_back(
          { { scan.lower[0] + x, scan.lower[1] + y, scan.lower[2] + z }, { upper(x, 0), upper(y, 1), upper(z, 2) } });
      }
    }
  }
  std::array<Checksum, 2> sums{ Checksum(1), Checksum(2) };
  for (Checksum & sum : sums)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      sum.Add(static_cast<std::uint64_t>(scan.lower[axis]));
      sum.Add(static_cast<std::uint64_t>(scan.size[axis]));
      sum.Add(static_cast<std::uint64_t>(weights.weight[axis]));
    }
    sum.Add(static_cast<std::uint64_t>(side));
  }
  plan.digest = { sums[0].Value(), sums[1].Value() };
  return plan;
}

BlockShare
ComputeBlockShare(const RegionReader &     read,
                  const VoxelBox &         scan,
                  const SpacingWeights &   weights,
                  const BlockPlan &        plan,
                  std::size_t              block,
                  Engine                   engine,
                  const ProgressCallback & progress)
{
  RequireBlock(plan, block);
  const HaloBlock & own = plan.blocks[block];
  const VoxelBox    around = VoxelsAround(own, scan);
  std::int32_t      margin = kMargin;
  for (VoxelBox window = Common(Grown(around, margin), scan);;)
  {
    const VoxelShape shape = ReadWindow(read, window);
    VoxelBox         needed;
    if (const auto region = MakeHaloRegionWithin(shape, scan, weights, own, needed, progress))
    {
      return ShareOf(shape, *region, weights, plan, block, engine, progress);
    }
    margin *= 4;
    window = Union(window, needed.size[0] > 0 ? needed : Common(Grown(around, margin), scan));
  }
}

} // namespace voxelcore
