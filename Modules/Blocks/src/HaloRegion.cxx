#include "HaloRegion.h"

#include "HaloComponents.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace voxelcore
{

namespace
{

using Place = std::array<std::int32_t, 3>;

// Voxels, or corners of them, lower <= x < upper; relative to the shape's box.
struct Range
{
  Place lower{};
  Place upper{};
};

// A small box of voxels with an upper bound of the distance from places in it to the nearest boundary vertex.
struct Reach
{
  Range  box;
  Int128 fourSquared = 0;
};

// The greatest whole number whose square is not above `value`, for 0 <= value < 2^100.
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

constexpr std::int32_t greatestGrain = 64;

class RegionMaker
{
public:
  RegionMaker(const VoxelShape &     shape,
              const SpacingWeights & weights,
              const NearestVertex &  nearest,
              const Range &          block)
    : RegionMaker(shape, weights, nearest, block, { { 0, 0, 0 }, shape.Box().size })
  {}

  // `limits` are the voxels there are, known or not.
  RegionMaker(const VoxelShape &     shape,
              const SpacingWeights & weights,
              const NearestVertex &  nearest,
              const Range &          block,
              const Range &          limits)
    : m_Shape(shape)
    , m_Weights(weights)
    , m_Nearest(nearest)
    , m_Block(block)
    , m_Limits(limits)
  {}

  bool
  BlockHoldsVoxels() const
  {
    return HoldsVoxels(m_Block);
  }

  // Finds how far balls can reach out of the block.
  void
  Measure(const ProgressCallback & progress)
  {
    m_Around = m_Block;
    m_Progress = &progress;
    Divide(m_Block, {});
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

  // Voxels of the block and of all halos.
  const Range &
  Around() const
  {
    return m_Around;
  }

  // The shape in the block and in what its balls can reach.
  VoxelShape
  Restrict() const
  {
    Range box = m_Around;
    box.lower[0] &= ~63; // so that rows are copied word by word
    VoxelBox voxels;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      voxels.lower[axis] = m_Shape.Box().lower[axis] + box.lower[axis];
      voxels.size[axis] = box.upper[axis] - box.lower[axis];
    }
    VoxelShape part(voxels);
    for (std::int32_t z = m_Block.lower[2]; z < m_Block.upper[2]; ++z)
    {
      for (std::int32_t y = m_Block.lower[1]; y < m_Block.upper[1]; ++y)
      {
        Mark(part.Row(y - box.lower[1], z - box.lower[2]),
             m_Block.lower[0] - box.lower[0],
             m_Block.upper[0] - box.lower[0]);
      }
    }
    for (std::int32_t grain = 1; grain <= greatestGrain; grain *= 2)
    {
      MarkHalos(grain, box, part);
    }
    for (std::int32_t z = box.lower[2]; z < box.upper[2]; ++z)
    {
      for (std::int32_t y = box.lower[1]; y < box.upper[1]; ++y)
      {
        const auto from = m_Shape.Row(y, z);
        const auto to = part.Row(y - box.lower[1], z - box.lower[2]);
        for (std::size_t word = 0; word < to.size(); ++word)
        {
          to[word] &= from[word + static_cast<std::size_t>(box.lower[0]) / 64];
        }
      }
    }
    return part;
  }

private:
  // Bounds the box as a whole, then halves it where a closer bound may cut less out of the surroundings.
  void
  Divide(const Range & box, const NearestVertex::Answer & near)
  {
    if (!HoldsVoxels(box))
    {
      return;
    }
    if ((++m_Divided & 0xFFFU) == 0)
    {
      ReportProgress(*m_Progress, "halo", 0.0);
    }
    Place middle{}; // doubled
    Place vertex = near.vertex;
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
    Range              first = box;
    Range              second = box;
    first.upper[longest] = half;
    second.lower[longest] = half;
    Divide(first, nearest);
    Divide(second, nearest);
  }

  bool
  HoldsVoxels(const Range & box) const
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

  // The voxels, along an axis, around lattice points that balls centred in the box can reach.
  std::pair<std::int32_t, std::int32_t>
  Halo(const Reach & reach, std::size_t axis) const
  {
    const std::int64_t steps = FloorOfRoot(reach.fourSquared / 4) / m_Weights.weight[axis];
    return { static_cast<std::int32_t>(std::max<std::int64_t>(reach.box.lower[axis] - steps - 1, m_Limits.lower[axis])),
             static_cast<std::int32_t>(
               std::min<std::int64_t>(reach.box.upper[axis] + steps + 1, m_Limits.upper[axis])) };
  }

  bool
  StaysInBlock(const Reach & reach) const
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

  // The edge of the cubes of voxels by which a halo is marked: at most an eighth of its radius, a power of two.
  std::int32_t
  GrainOf(const Reach & reach) const
  {
    const std::int64_t greatest = *std::max_element(m_Weights.weight.begin(), m_Weights.weight.end());
    const std::int64_t steps = FloorOfRoot(reach.fourSquared / 4) / greatest;
    std::int32_t       grain = 1;
    while (grain < greatestGrain && 16 * std::int64_t{ grain } <= steps)
    {
      grain *= 2;
    }
    return grain;
  }

  // Marks the halos of one grain: first in cubes of voxels, then in voxels.
  void
  MarkHalos(std::int32_t grain, const Range & box, VoxelShape & part) const
  {
    VoxelShape cubes;
    for (const Reach & reach : m_Reaches)
    {
      if (GrainOf(reach) == grain)
      {
        if (cubes.Box().size[0] == 0)
        {
          const auto count = [&](std::size_t axis) { return (box.upper[axis] - box.lower[axis] + grain - 1) / grain; };
          cubes = VoxelShape({ { 0, 0, 0 }, { count(0), count(1), count(2) } });
        }
        MarkHalo(reach, grain, box, cubes);
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

  // Marks the cubes of voxels around the lattice points within reach.
  void
  MarkHalo(const Reach & reach, std::int32_t grain, const Range & box, VoxelShape & cubes) const
  {
    const auto &                                         w = m_Weights.weight;
    std::array<std::pair<std::int32_t, std::int32_t>, 3> range; // of cubes
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto [low, high] = Halo(reach, axis);
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

  static void
  Mark(const ShapeRow & row, std::int32_t begin, std::int32_t end)
  {
    for (std::int32_t word = begin >> 6; word << 6 < end; ++word)
    {
      row[static_cast<std::size_t>(word)] |= BoundaryBits::Between(begin, end, word);
    }
  }

  const VoxelShape &       m_Shape;
  const SpacingWeights &   m_Weights;
  const NearestVertex &    m_Nearest;
  Range                    m_Block;  // voxels
  Range                    m_Limits; // of voxels
  Range                    m_Around; // voxels of the block and of all halos
  std::vector<Reach>       m_Reaches;
  std::size_t              m_Divided = 0;
  const ProgressCallback * m_Progress = nullptr;
};

// The voxels of a block that lie in the shape's box, relative to it; nothing where there are none.
std::optional<Range>
VoxelsOf(const HaloBlock & block, const VoxelBox & box)
{
  const Place low{ block.lower.x, block.lower.y, block.lower.z };
  const Place high{ block.upper.x, block.upper.y, block.upper.z };
  Range       voxels;
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
AsBox(const Range & range, const VoxelBox & shapeBox)
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
  const std::optional<Range> voxels = VoxelsOf(block, shape.Box());
  if (!voxels)
  {
    return {};
  }
  const NearestVertex nearest(shape, weights);
  RegionMaker         maker(shape, weights, nearest, *voxels);
  maker.Measure(progress);
  return ComponentsThatMeet(maker.Restrict(), AsBox(*voxels, shape.Box()));
}

std::optional<VoxelShape>
MakeHaloRegionWithin(const VoxelShape &       shape,
                     const VoxelBox &         scan,
                     const SpacingWeights &   weights,
                     const HaloBlock &        block,
                     VoxelBox &               needed,
                     const ProgressCallback & progress)
{
  const VoxelBox &           window = shape.Box();
  const std::optional<Range> voxels = VoxelsOf(block, window);
  if (!voxels)
  {
    return VoxelShape();
  }
  // Corners at the edge of the window show what it cuts off, unless the scan ends there.
  VoxelBox trusted;
  Range    limits;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    limits.lower[axis] = scan.lower[axis] - window.lower[axis];
    limits.upper[axis] = limits.lower[axis] + scan.size[axis];
    trusted.lower[axis] = limits.lower[axis] == 0 ? 0 : 1;
    trusted.size[axis] = window.size[axis] + (limits.upper[axis] == window.size[axis] ? 1 : 0) - trusted.lower[axis];
  }
  const NearestVertex nearest(shape, weights, trusted);
  RegionMaker         maker(shape, weights, nearest, *voxels, limits);
  if (!maker.BlockHoldsVoxels())
  {
    return VoxelShape();
  }
  if (nearest.HasNone())
  {
    needed = {};
    return std::nullopt;
  }
  maker.Measure(progress);
  needed = AsBox(maker.Around(), window);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (maker.Around().lower[axis] < 0 || maker.Around().upper[axis] > window.size[axis])
    {
      return std::nullopt;
    }
  }
  return ComponentsThatMeet(maker.Restrict(), AsBox(*voxels, window));
}

VoxelBox
HaloBox(const VoxelShape &       shape,
        const SpacingWeights &   weights,
        const NearestVertex &    nearest,
        const HaloBlock &        block,
        const ProgressCallback & progress)
{
  const std::optional<Range> voxels = VoxelsOf(block, shape.Box());
  if (!voxels)
  {
    return {};
  }
  RegionMaker maker(shape, weights, nearest, *voxels);
  maker.Measure(progress);
  return AsBox(maker.Around(), shape.Box());
}

} // namespace voxelcore
