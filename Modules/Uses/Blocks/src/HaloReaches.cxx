#include "HaloReaches.h"

#include "BoundaryBits.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace voxelcore
{

std::int64_t
FloorOfRoot(Int128 value)
{
  if (value < (Int128{ 1 } << 52)) // then the rounded root of a number below a square is below its root
  {
    return static_cast<std::int64_t>(std::sqrt(static_cast<double>(static_cast<std::int64_t>(value))));
  }
  auto root = static_cast<std::int64_t>(std::sqrt(static_cast<double>(value)));
  while (Int128{ root } * root > value)
  {
    --root;
  }
  while (Int128{ root + 1 } * (root + 1) <= value)
  {
    ++root;
  }
  return root;
}

HaloReaches::HaloReaches(const VoxelShape &     shape,
                         const SpacingWeights & weights,
                         const NearestVertex &  nearest,
                         const HaloRange &      block,
                         const HaloRange &      limits)
  : m_Shape(shape)
  , m_Weights(weights)
  , m_Nearest(nearest)
  , m_Block(block)
  , m_Limits(limits)
  , m_Around(block)
{}

void
HaloReaches::Measure(const ProgressCallback & progress)
{
  Divide(m_Block, {}, progress);
  for (const Reach & reach : m_Reaches)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto [low, high] = Halo(reach, axis);
      m_Around.lower[axis] = std::min(m_Around.lower[axis], low);
      m_Around.upper[axis] = std::max(m_Around.upper[axis], high);
    }
  }
}

// Bounds the box as a whole, then halves it where a closer bound may cut less out of the surroundings.
void
HaloReaches::Divide(const HaloRange & box, const NearestVertex::Answer & near, const ProgressCallback & progress)
{
  if (!HoldsVoxels(box))
  {
    return;
  }
  if ((++m_Divided & 0xFFFU) == 0)
  {
    ReportProgress(progress, "halo", 0.0);
  }
  std::array<std::int32_t, 3> middle{}; // doubled
  std::array<std::int32_t, 3> vertex = near.vertex;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    middle[axis] = box.lower[axis] + box.upper[axis];
  }
  const NearestVertex::Answer nearest =
    m_Nearest.Find(middle, { vertex, near.squared < 0 ? Int128{ -1 } : m_Nearest.Squared(middle, vertex) });
  // The corner of the box farthest from that vertex is at least as far as any place in the box is from its nearest.
  Reach       reach{ box, 0 };
  std::size_t longest = 0;
  Int128      side = 0; // squared
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int64_t square = m_Weights.weight[axis] * m_Weights.weight[axis];
    const std::int64_t length = box.upper[axis] - box.lower[axis];
    const std::int64_t d = std::abs(std::int64_t{ nearest.vertex[axis] } - middle[axis]) + length;
    reach.fourSquared += Int128{ d * d } * square;
    if (length > 1 && Int128{ length * length } * square > side)
    {
      side = Int128{ length * length } * square;
      longest = axis;
    }
  }
  if (StaysInBlock(reach))
  {
    return;
  }
  // Boxes of a quarter of the radius at most: smaller ones gain little and cost more.
  if (64 * side <= reach.fourSquared)
  {
    m_Reaches.push_back(reach);
    return;
  }
  const std::int32_t half = box.lower[longest] + (box.upper[longest] - box.lower[longest]) / 2;
  HaloRange          first = box;
  HaloRange          second = box;
  first.upper[longest] = half;
  second.lower[longest] = half;
  Divide(first, nearest, progress);
  Divide(second, nearest, progress);
}

bool
HaloReaches::HoldsVoxels(const HaloRange & box) const
{
  for (std::int32_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    for (std::int32_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      const auto row = m_Shape.Row(y, z);
      for (std::int32_t word = box.lower[0] >> 6; word << 6 < box.upper[0]; ++word)
      {
        if ((row[static_cast<std::size_t>(word)] & BoundaryBits::Between(box.lower[0], box.upper[0], word)) != 0)
        {
          return true;
        }
      }
    }
  }
  return false;
}

std::pair<std::int32_t, std::int32_t>
HaloReaches::Halo(const Reach & reach, std::size_t axis) const
{
  const std::int64_t steps = FloorOfRoot(reach.fourSquared / 4) / m_Weights.weight[axis];
  return { static_cast<std::int32_t>(std::max<std::int64_t>(reach.box.lower[axis] - steps - 1, m_Limits.lower[axis])),
           static_cast<std::int32_t>(std::min<std::int64_t>(reach.box.upper[axis] + steps + 1, m_Limits.upper[axis])) };
}

bool
HaloReaches::StaysInBlock(const Reach & reach) const
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto [low, high] = Halo(reach, axis);
    if (low < m_Block.lower[axis] || high > m_Block.upper[axis])
    {
      return false;
    }
  }
  return true;
}

} // namespace voxelcore
