#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Blocks/HaloBlocks.h"
#include "voxelcore/Shape/BoundaryCounts.h"

#include "BlockParts.h"
#include "BoundaryBits.h"
#include "Checksum.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Lattice/Predicates.h"
#include "voxelcore/Shape/BoundaryVertices.h"

#include <algorithm>
#include <cstdlib>

namespace voxelcore
{

namespace
{

constexpr std::size_t greatestCount = std::size_t{ 1 } << 20;

// Boxes of lattice corners here are relative to the shape's box.
using Place = std::array<std::int32_t, 3>;

class Cutter
{
public:
  explicit Cutter(const VoxelShape & shape)
    : m_Shape(shape)
    , m_Bits(shape)
  {}

  /** Appends `count` parts of the box to `blocks`. */
  void
  Cut(const Place & lower, const Place & upper, std::size_t count, std::vector<HaloBlock> & blocks) const
  {
    if (count == 1)
    {
      const auto & o = m_Shape.Box().lower;
      blocks.push_back({ { o[0] + lower[0], o[1] + lower[1], o[2] + lower[2] },
                         { o[0] + upper[0], o[1] + upper[1], o[2] + upper[2] } });
      return;
    }
    const std::size_t first = count / 2;
    const auto [axis, plane] = ChooseCut(lower, upper, first, count);
    Place upperOfFirst = upper;
    Place lowerOfSecond = lower;
    upperOfFirst[axis] = plane;
    lowerOfSecond[axis] = plane;
    Cut(lower, upperOfFirst, first, blocks);
    Cut(lowerOfSecond, upper, count - first, blocks);
  }

private:
  struct Plane
  {
    std::size_t  axis = 0;
    std::int32_t at = 0;
  };

  // The plane that parts the boundary vertices first : count - first most evenly, on the axis where it meets fewest
  // inner faces: there the halo is small and the subshape's cut surface, too. A vertex too many on a side counts as
  // two faces.
  Plane
  ChooseCut(const Place & lower, const Place & upper, std::size_t first, std::size_t count) const
  {
    std::array<std::vector<std::uint64_t>, 3> vertices;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      vertices[axis].assign(static_cast<std::size_t>(std::max(upper[axis] - lower[axis], 0)), 0);
    }
    std::uint64_t total = 0;
    m_Bits.Visit({ lower[0], lower[1], lower[2] },
                 { upper[0], upper[1], upper[2] },
                 [&](std::int32_t x, std::int32_t y, std::int32_t z) {
                   ++vertices[0][static_cast<std::size_t>(x - lower[0])];
                   ++vertices[1][static_cast<std::size_t>(y - lower[1])];
                   ++vertices[2][static_cast<std::size_t>(z - lower[2])];
                   ++total;
                 });

    Plane        best{ 0, lower[0] }; // the first part is empty unless an axis can be cut
    Int128       least = -1;
    std::int32_t length = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      std::int32_t  plane = 0;
      Int128        error = -1; // times count
      std::uint64_t sum = 0;
      for (std::int32_t at = lower[axis] + 1; at < upper[axis]; ++at)
      {
        sum += vertices[axis][static_cast<std::size_t>(at - 1 - lower[axis])];
        const Int128 off = Int128{ sum } * count - Int128{ total } * first;
        if (error < 0 || (off < 0 ? -off : off) < error)
        {
          error = off < 0 ? -off : off;
          plane = at;
        }
      }
      if (error < 0)
      {
        continue;
      }
      const Int128 cost = Int128{ CountInnerFaces(lower, upper, axis, plane) } * count + 2 * error;
      if (least < 0 || cost < least || (cost == least && upper[axis] - lower[axis] > length))
      {
        least = cost;
        length = upper[axis] - lower[axis];
        best = { axis, plane };
      }
    }
    return best;
  }

  // Faces in the plane, within the box, whose both voxels are in.
  std::uint64_t
  CountInnerFaces(const Place & lower, const Place & upper, std::size_t axis, std::int32_t plane) const
  {
    Place end = upper; // of voxels
    for (std::size_t i = 0; i < 3; ++i)
    {
      end[i] = std::min(end[i], m_Shape.Box().size[i]);
    }
    if (plane < 1 || plane >= m_Shape.Box().size[axis])
    {
      return 0;
    }
    std::uint64_t faces = 0;
    const auto    row = [&](std::int32_t y, std::int32_t z, std::int32_t word) {
      return m_Shape.Row(y, z)[static_cast<std::size_t>(word)];
    };
    for (std::int32_t z = axis == 2 ? plane : lower[2]; z < (axis == 2 ? plane + 1 : end[2]); ++z)
    {
      for (std::int32_t y = axis == 1 ? plane : lower[1]; y < (axis == 1 ? plane + 1 : end[1]); ++y)
      {
        if (axis == 0)
        {
          const auto in = [&](std::int32_t x) { return row(y, z, x >> 6) >> (x & 63) & 1U; };
          faces += in(plane - 1) & in(plane);
          continue;
        }
        for (std::int32_t word = lower[0] >> 6; word << 6 < end[0]; ++word)
        {
          const std::uint64_t both = row(y, z, word) & row(axis == 1 ? y - 1 : y, axis == 2 ? z - 1 : z, word);
          faces += CountBits(both & BoundaryBits::Between(lower[0], end[0], word));
        }
      }
    }
    return faces;
  }

  const VoxelShape & m_Shape;
  BoundaryBits       m_Bits;
};

std::array<std::uint64_t, 2>
DigestOf(const VoxelShape & shape, const BlockPlan & plan)
{
  std::array<Checksum, 2> sums{ Checksum(1), Checksum(2) };
  const auto              add = [&sums](std::uint64_t word) {
    sums[0].Add(word);
    sums[1].Add(word);
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    add(static_cast<std::uint64_t>(shape.Box().lower[axis]));
    add(static_cast<std::uint64_t>(shape.Box().size[axis]));
    add(static_cast<std::uint64_t>(plan.weight[axis]));
  }
  add(plan.boundaryVertices);
  add(plan.boundarySquares);
  add(plan.blocks.size());
  for (const HaloBlock & block : plan.blocks)
  {
    for (const LatticePoint & p : { block.lower, block.upper })
    {
      add(static_cast<std::uint64_t>(p.x));
      add(static_cast<std::uint64_t>(p.y));
      add(static_cast<std::uint64_t>(p.z));
    }
  }
  for (std::int32_t z = 0; z < shape.Box().size[2]; ++z)
  {
    for (std::int32_t y = 0; y < shape.Box().size[1]; ++y)
    {
      for (const std::uint64_t word : shape.Row(y, z))
      {
        add(word);
      }
    }
  }
  return { sums[0].Value(), sums[1].Value() };
}

// What a plan says of the shape.
BlockPlan
StartPlan(const VoxelShape & shape, const SpacingWeights & weights)
{
  RequireExactRange(shape.Box().size, weights);
  BlockPlan plan;
  plan.weight = weights.weight;
  plan.boundaryVertices = CountBoundaryVertices(shape);
  plan.boundarySquares = CountBoundarySquares(shape);
  return plan;
}

Place
LowerOf(const HaloBlock & block)
{
  return { block.lower.x, block.lower.y, block.lower.z };
}

Place
UpperOf(const HaloBlock & block)
{
  return { block.upper.x, block.upper.y, block.upper.z };
}

// Lattice corners that two blocks have in common.
Int128
CountCommon(const HaloBlock & a, const HaloBlock & b)
{
  Int128 count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int64_t low = std::max(LowerOf(a)[axis], LowerOf(b)[axis]);
    const std::int64_t high = std::min(UpperOf(a)[axis], UpperOf(b)[axis]);
    count *= std::max<std::int64_t>(high - low, 0);
  }
  return count;
}

} // namespace

void
RequireExactRange(const std::array<std::int32_t, 3> & size, const SpacingWeights & weights)
{
  const std::int32_t longest = *std::max_element(size.begin(), size.end());
  if (longest > (1 << 20) || !ExactRangeAllows(longest, weights))
  {
    throw InputError(
      "the shape is too large for exact arithmetic at this spacing; crop it, or give a simpler --spacing");
  }
}

BlockPlan
PlanBlocks(const VoxelShape & shape, const SpacingWeights & weights, std::size_t count)
{
  if (count == 0 || count > greatestCount)
  {
    throw UsageError("a shape is cut into 1 to " + std::to_string(greatestCount) + " blocks");
  }
  BlockPlan    plan = StartPlan(shape, weights);
  const auto & size = shape.Box().size;
  plan.blocks.reserve(count);
  Cutter(shape).Cut({ 0, 0, 0 }, { size[0] + 1, size[1] + 1, size[2] + 1 }, count, plan.blocks);
  plan.digest = DigestOf(shape, plan);
  return plan;
}

BlockPlan
PlanBlocks(const VoxelShape & shape, const SpacingWeights & weights, std::vector<HaloBlock> blocks)
{
  const auto & [lower, size] = shape.Box();
  const HaloBlock whole{ { lower[0], lower[1], lower[2] },
                         { lower[0] + size[0] + 1, lower[1] + size[1] + 1, lower[2] + size[2] + 1 } };
  Int128          covered = 0;
  bool            apart = !blocks.empty() && blocks.size() <= greatestCount;
  for (std::size_t i = 0; i < blocks.size() && apart; ++i)
  {
    apart = CountCommon(blocks[i], whole) == CountCommon(blocks[i], blocks[i]); // none lies outside
    covered += CountCommon(blocks[i], whole);
    for (std::size_t j = 0; j < i && apart; ++j)
    {
      apart = CountCommon(blocks[i], blocks[j]) == 0;
    }
  }
  if (!apart || covered != CountCommon(whole, whole))
  {
    throw UsageError("the blocks do not part the lattice corners of the shape's box; make the plan anew");
  }
  BlockPlan plan = StartPlan(shape, weights);
  plan.blocks = std::move(blocks);
  plan.digest = DigestOf(shape, plan);
  return plan;
}

bool
IsPlanOf(const BlockPlan & plan, const VoxelShape & shape, const SpacingWeights & weights)
{
  return plan.weight == weights.weight && DigestOf(shape, plan) == plan.digest;
}

} // namespace voxelcore
