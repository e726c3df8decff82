#include "HaloMarks.h"

#include "BoundaryBits.h"

#include <algorithm>
#include <bit>

namespace voxelcore
{

namespace
{

constexpr std::int32_t greatestGrain = 64;

void
Mark(const ShapeRow & row, std::int32_t begin, std::int32_t end)
{
  for (std::int32_t word = begin >> 6; word << 6 < end; ++word)
  {
    row[static_cast<std::size_t>(word)] |= BoundaryBits::Between(begin, end, word);
  }
}

// The edge of the cubes of voxels by which a halo is marked: at most an eighth of its radius, a power of two.
std::int32_t
GrainOf(const HaloReaches::Reach & reach, const SpacingWeights & weights)
{
  const std::int64_t greatest = *std::max_element(weights.weight.begin(), weights.weight.end());
  const std::int64_t steps = FloorOfRoot(reach.fourSquared / 4) / greatest;
  std::int32_t       grain = 1;
  while (grain < greatestGrain && 16 * std::int64_t{ grain } <= steps)
  {
    grain *= 2;
  }
  return grain;
}

// Marks the cubes of voxels around the lattice points within reach.
void
MarkHalo(const HaloReaches &        reaches,
         const HaloReaches::Reach & reach,
         const SpacingWeights &     weights,
         std::int32_t               grain,
         const HaloRange &          box,
         VoxelShape &               cubes)
{
  const auto &                                         w = weights.weight;
  std::array<std::pair<std::int32_t, std::int32_t>, 3> range; // of cubes
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto [low, high] = reaches.Halo(reach, axis);
    range[axis] = { (low - box.lower[axis]) / grain, (high - box.lower[axis] + grain - 1) / grain };
  }
  const int shift = std::countr_zero(static_cast<std::uint32_t>(grain));
  // Steps between the reach's box and the lattice points on a cube along an axis.
  const auto stepsTo = [&](std::int32_t cube, std::size_t axis) -> std::int64_t {
    const std::int32_t low = box.lower[axis] + cube * grain;
    return std::max({ reach.box.lower[axis] - (low + grain), low - reach.box.upper[axis], 0 });
  };
  for (std::int32_t z = range[2].first; z < range[2].second; ++z)
  {
    const std::int64_t dz = w[2] * stepsTo(z, 2);
    for (std::int32_t y = range[1].first; y < range[1].second; ++y)
    {
      const std::int64_t dy = w[1] * stepsTo(y, 1);
      const Int128       rest = reach.fourSquared / 4 - Int128{ dy } * dy - Int128{ dz } * dz;
      if (rest < 0)
      {
        continue;
      }
      const std::int64_t root = FloorOfRoot(rest);
      const std::int64_t steps = w[0] == 1 ? root : root / w[0];
      const auto         low = std::max<std::int64_t>(reach.box.lower[0] - steps - 1, box.lower[0]) - box.lower[0];
      const auto         high = std::min<std::int64_t>(reach.box.upper[0] + steps + 1, box.upper[0]) - box.lower[0];
      Mark(cubes.Row(y, z),
           static_cast<std::int32_t>(low >> shift),
           static_cast<std::int32_t>((high + grain - 1) >> shift));
    }
  }
}

// Marks the halos of one grain: first in cubes of voxels, then in voxels.
void
MarkHalos(const HaloReaches &    reaches,
          const SpacingWeights & weights,
          std::int32_t           grain,
          const HaloRange &      box,
          VoxelShape &           part)
{
  VoxelShape cubes;
  for (const HaloReaches::Reach & reach : reaches.All())
  {
    if (GrainOf(reach, weights) == grain)
    {
      if (cubes.Box().size[0] == 0)
      {
        const auto count = [&](std::size_t axis) { return (box.upper[axis] - box.lower[axis] + grain - 1) / grain; };
        cubes = VoxelShape({ { 0, 0, 0 }, { count(0), count(1), count(2) } });
      }
      MarkHalo(reaches, reach, weights, grain, box, cubes);
    }
  }
  for (std::int32_t z = 0; z < cubes.Box().size[2] * grain && z < part.Box().size[2]; ++z)
  {
    for (std::int32_t y = 0; y < cubes.Box().size[1] * grain && y < part.Box().size[1]; ++y)
    {
      const auto row = part.Row(y, z);
      const auto marked = std::as_const(cubes).Row(y / grain, z / grain);
      for (std::size_t word = 0; word < marked.size(); ++word)
      {
        for (std::uint64_t bits = marked[word]; bits != 0;)
        {
          const int          first = std::countr_zero(bits);
          const int          length = std::countr_one(bits >> first);
          const std::int32_t begin = (static_cast<std::int32_t>(64 * word) + first) * grain;
          Mark(row, begin, std::min(begin + length * grain, part.Box().size[0]));
          bits = first + length == 64 ? 0 : bits >> (first + length) << (first + length);
        }
      }
    }
  }
}

} // namespace

VoxelShape
RestrictToHalos(const VoxelShape & shape, const SpacingWeights & weights, const HaloReaches & reaches)
{
  const HaloRange & block = reaches.Block();
  HaloRange         box = reaches.Around();
  box.lower[0] &= ~63; // so that rows are copied word by word
  VoxelBox voxels;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    voxels.lower[axis] = shape.Box().lower[axis] + box.lower[axis];
    voxels.size[axis] = box.upper[axis] - box.lower[axis];
  }
  VoxelShape part(voxels);
  for (std::int32_t z = block.lower[2]; z < block.upper[2]; ++z)
  {
    for (std::int32_t y = block.lower[1]; y < block.upper[1]; ++y)
    {
      Mark(part.Row(y - box.lower[1], z - box.lower[2]), block.lower[0] - box.lower[0], block.upper[0] - box.lower[0]);
    }
  }
  for (std::int32_t grain = 1; grain <= greatestGrain; grain *= 2)
  {
    MarkHalos(reaches, weights, grain, box, part);
  }
  for (std::int32_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    for (std::int32_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      const auto from = shape.Row(y, z);
      const auto to = part.Row(y - box.lower[1], z - box.lower[2]);
      for (std::size_t word = 0; word < to.size(); ++word)
      {
        to[word] &= from[word + static_cast<std::size_t>(box.lower[0]) / 64];
      }
    }
  }
  return part;
}

} // namespace voxelcore
