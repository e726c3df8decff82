#include "HaloRegion.h"

#include "HaloComponents.h"
#include "HaloMarks.h"
#include "HaloReaches.h"

#include <algorithm>
#include <optional>

namespace voxelcore
{

namespace
{

// The voxels of a block that lie in the shape's box, relative to it; nothing where there are none.
std::optional<HaloRange>
VoxelsOf(const HaloBlock & block, const VoxelBox & box)
{
  const std::array<std::int32_t, 3> low{ block.lower.x, block.lower.y, block.lower.z };
  const std::array<std::int32_t, 3> high{ block.upper.x, block.upper.y, block.upper.z };
  HaloRange                         voxels;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    voxels.lower[axis] = std::max(low[axis] - box.lower[axis], 0);
    voxels.upper[axis] = std::min(high[axis] - box.lower[axis], box.size[axis]);
    if (voxels.lower[axis] >= voxels.upper[axis])
    {
      return std::nullopt;
    }
  }
  return voxels;
}

// In indices of the scan.
VoxelBox
AsBox(const HaloRange & range, const VoxelBox & shapeBox)
{
  VoxelBox box;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] = shapeBox.lower[axis] + range.lower[axis];
    box.size[axis] = range.upper[axis] - range.lower[axis];
  }
  return box;
}

} // namespace

VoxelShape
MakeHaloRegion(const VoxelShape &       shape,
               const SpacingWeights &   weights,
               const HaloBlock &        block,
               const ProgressCallback & progress)
{
  const std::optional<HaloRange> voxels = VoxelsOf(block, shape.Box());
  if (!voxels)
  {
    return {};
  }
  const NearestVertex nearest(shape, weights);
  HaloReaches         reaches(shape, weights, nearest, *voxels, { { 0, 0, 0 }, shape.Box().size });
  reaches.Measure(progress);
  return ComponentsThatMeet(RestrictToHalos(shape, weights, reaches), AsBox(*voxels, shape.Box()));
}

std::optional<VoxelShape>
MakeHaloRegionWithin(const VoxelShape &       shape,
                     const VoxelBox &         scan,
                     const SpacingWeights &   weights,
                     const HaloBlock &        block,
                     VoxelBox &               needed,
                     const ProgressCallback & progress)
{
  const VoxelBox &               window = shape.Box();
  const std::optional<HaloRange> voxels = VoxelsOf(block, window);
  if (!voxels)
  {
    return VoxelShape();
  }
  // Corners at the edge of the window show what it cuts off, unless the scan ends there.
  VoxelBox  trusted;
  HaloRange limits;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    limits.lower[axis] = scan.lower[axis] - window.lower[axis];
    limits.upper[axis] = limits.lower[axis] + scan.size[axis];
    trusted.lower[axis] = limits.lower[axis] == 0 ? 0 : 1;
    trusted.size[axis] = window.size[axis] + (limits.upper[axis] == window.size[axis] ? 1 : 0) - trusted.lower[axis];
  }
  const NearestVertex nearest(shape, weights, trusted);
  HaloReaches         reaches(shape, weights, nearest, *voxels, limits);
  if (!reaches.BlockHoldsVoxels())
  {
    return VoxelShape();
  }
  if (nearest.HasNone())
  {
    needed = {};
    return std::nullopt;
  }
  reaches.Measure(progress);
  needed = AsBox(reaches.Around(), window);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (reaches.Around().lower[axis] < 0 || reaches.Around().upper[axis] > window.size[axis])
    {
      return std::nullopt;
    }
  }
  return ComponentsThatMeet(RestrictToHalos(shape, weights, reaches), AsBox(*voxels, window));
}

VoxelBox
HaloBox(const VoxelShape &       shape,
        const SpacingWeights &   weights,
        const NearestVertex &    nearest,
        const HaloBlock &        block,
        const ProgressCallback & progress)
{
  const std::optional<HaloRange> voxels = VoxelsOf(block, shape.Box());
  if (!voxels)
  {
    return {};
  }
  HaloReaches reaches(shape, weights, nearest, *voxels, { { 0, 0, 0 }, shape.Box().size });
  reaches.Measure(progress);
  return AsBox(reaches.Around(), shape.Box());
}

} // namespace voxelcore
