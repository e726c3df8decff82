#include "voxelcore/Blocks/BlockRegions.h"

#include "BoundaryBits.h"
#include "Checksum.h"
#include "HaloRegion.h"

#include <algorithm>
#include <bit>

namespace voxelcore
{
namespace
{

/** Calls visit(begin, end, y, z) for each run of voxels of the shape in a box, all in indices of the scan. Where the
 *  words of the shape begin makes no difference. */
template <typename TVisit>
void
VisitRunsIn(const VoxelShape & shape, const VoxelBox & box, TVisit visit)
{
  const auto & [origin, size] = shape.Box();
  std::array<std::int32_t, 3> lower{};
  std::array<std::int32_t, 3> upper{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lower[axis] = std::max(box.lower[axis] - origin[axis], 0);
    upper[axis] = std::min(box.lower[axis] + box.size[axis] - origin[axis], size[axis]);
  }
  for (std::int32_t z = lower[2]; z < upper[2]; ++z)
  {
    for (std::int32_t y = lower[1]; y < upper[1]; ++y)
    {
      const auto   row = shape.Row(y, z);
      std::int32_t begin = 0;
      std::int32_t end = -1;
      for (std::int32_t word = lower[0] >> 6; word << 6 < upper[0]; ++word)
      {
        std::uint64_t bits = row[static_cast<std::size_t>(word)] & BoundaryBits::Between(lower[0], upper[0], word);
        while (bits != 0)
        {
          const int          first = std::countr_zero(bits);
          const int          length = std::countr_one(bits >> first);
          const std::int32_t at = (word << 6) + first;
          if (at != end) // the one before has ended
          {
            if (begin < end)
            {
              visit(origin[0] + begin, origin[0] + end, origin[1] + y, origin[2] + z);
            }
            begin = at;
          }
          end = at + length;
          bits = first + length == 64 ? 0 : bits >> (first + length) << (first + length);
        }
      }
      if (begin < end)
      {
        visit(origin[0] + begin, origin[0] + end, origin[1] + y, origin[2] + z);
      }
    }
  }
}

BlockRegion
RegionOf(const VoxelShape & shape, const VoxelBox & box)
{
  BlockRegion             region{ box };
  std::array<Checksum, 2> sums{ Checksum(1), Checksum(2) };
  VisitRunsIn(shape, box, [&](std::int32_t begin, std::int32_t end, std::int32_t y, std::int32_t z) {
    region.voxels += static_cast<std::uint64_t>(end - begin);
    for (const std::int32_t number : { begin, end, y, z })
    {
      sums[0].Add(static_cast<std::uint64_t>(number));
      sums[1].Add(static_cast<std::uint64_t>(number));
    }
  });
  region.digest = { sums[0].Value(), sums[1].Value() };
  return region;
}

/** Both boxes, and the voxels around the lattice points of the block, as far as the shape goes. */
VoxelBox
BoxOf(const VoxelBox & around, const HaloBlock & block, const VoxelBox & shapeBox)
{
  const std::array<std::int32_t, 3> low{ block.lower.x, block.lower.y, block.lower.z };
  const std::array<std::int32_t, 3> high{ block.upper.x, block.upper.y, block.upper.z };
  VoxelBox                          box;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    std::int32_t begin = low[axis] - 1;
    std::int32_t end = high[axis];
    if (around.size[axis] > 0)
    {
      begin = std::min(begin, around.lower[axis]);
      end = std::max(end, around.lower[axis] + around.size[axis]);
    }
    begin = std::max(begin, shapeBox.lower[axis]);
    end = std::min(end, shapeBox.lower[axis] + shapeBox.size[axis]);
    if (low[axis] >= high[axis] || begin >= end)
    {
      return {};
    }
    box.lower[axis] = begin;
    box.size[axis] = end - begin;
  }
  return box;
}

} // namespace

std::vector<BlockRegion>
FindBlockRegions(const VoxelShape &       shape,
                 const SpacingWeights &   weights,
                 const BlockPlan &        plan,
                 const ProgressCallback & progress)
{
  const NearestVertex      nearest(shape, weights);
  std::vector<BlockRegion> regions;
  regions.reserve(plan.blocks.size());
  for (const HaloBlock & block : plan.blocks)
  {
    const VoxelBox around = HaloBox(shape, weights, nearest, block, progress);
    regions.push_back(RegionOf(shape, BoxOf(around, block, shape.Box())));
  }
  return regions;
}

bool
IsRegionOf(const BlockRegion & region, const VoxelShape & shape)
{
  return RegionOf(shape, region.box) == region;
}

} // namespace voxelcore
