#include "BrickGrid.h"

#include "voxelcore/Base/CountBits.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace voxelcore
{

BrickGrid::BrickGrid(const VoxelShape & shape, std::span<const LatticePoint> points, int level, std::int32_t reach)
{
  const int shift = m_Shift = 3 + level;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    m_Lower[axis] = (shape.Box().lower[axis] - 1 - reach) >> shift;
    m_Size[axis] = static_cast<std::uint32_t>(((shape.Box().lower[axis] + shape.Box().size[axis] + reach) >> shift) -
                                              m_Lower[axis] + 1);
  }
  m_BitCount = std::size_t{ m_Size[0] } * m_Size[1] * m_Size[2];
  m_Bits.assign(m_BitCount / 64 + 1, 0);
  // Of many points the bricks around are the same. Each range counts once: along an axis its first brick, and a bit
  // where it is one longer.
  const std::int32_t         length = ((2 * reach + 1) >> shift) + 1;
  std::vector<std::uint64_t> ranges;
  for (const LatticePoint & p : points)
  {
    // A boundary vertex lies between the voxels p - 1 and p.
    std::uint64_t range = 0;
    for (const auto & [at, axis] : { std::pair{ p.z, 2 }, std::pair{ p.y, 1 }, std::pair{ p.x, 0 } })
    {
      const std::int32_t first = (at - 1 - reach) >> shift;
      const std::int32_t longer = ((at + reach) >> shift) - first + 1 - length;
      range =
        (range << 21) | static_cast<std::uint64_t>(2 * (first - m_Lower[static_cast<std::size_t>(axis)]) + longer);
    }
    if (ranges.empty() || ranges.back() != range)
    {
      ranges.push_back(range);
    }
  }
  std::sort(ranges.begin(), ranges.end());
  ranges.erase(std::unique(ranges.begin(), ranges.end()), ranges.end());
  for (const std::uint64_t range : ranges)
  {
    std::array<std::size_t, 3> first{};
    std::array<std::size_t, 3> end{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::size_t part = range >> (21 * axis) & 0x1FFFFF;
      first[axis] = part >> 1;
      end[axis] = first[axis] + static_cast<std::size_t>(length) + (part & 1);
    }
    for (std::size_t z = first[2]; z < end[2]; ++z)
    {
      for (std::size_t y = first[1]; y < end[1]; ++y)
      {
        const std::size_t row = (z * m_Size[1] + y) * m_Size[0];
        for (std::size_t bit = row + first[0]; bit < row + end[0]; ++bit)
        {
          m_Bits[bit >> 6] |= std::uint64_t{ 1 } << (bit & 63);
        }
      }
    }
  }
  ListBricks(shape);
}

BrickGrid::BrickGrid(const VoxelShape & shape, const BrickGrid & other, const std::vector<std::uint8_t> & wanted)
  : m_Shift(other.m_Shift)
  , m_Lower(other.m_Lower)
  , m_Size(other.m_Size)
  , m_BitCount(other.m_BitCount)
  , m_Bits(other.m_Bits.size(), 0)
{
  for (std::size_t brick = 0; brick < wanted.size(); ++brick)
  {
    if (wanted[brick] != 0)
    {
      const std::size_t bit = BitOf(other.At(brick));
      m_Bits[bit >> 6] |= std::uint64_t{ 1 } << (bit & 63);
    }
  }
  ListBricks(shape);
}

// What has a bit, and its neighbours.
void
BrickGrid::ListBricks(const VoxelShape & shape)
{
  std::uint32_t count = 0;
  for (std::size_t word = 0; word < m_Bits.size(); ++word)
  {
    m_Ranks.push_back(count);
    count += CountBits(m_Bits[word]);
  }
  m_Bricks.reserve(count);
  for (std::size_t word = 0; word < m_Bits.size(); ++word)
  {
    for (std::uint64_t bits = m_Bits[word]; bits != 0; bits &= bits - 1)
    {
      const std::size_t bit = word * 64 + static_cast<std::size_t>(std::countr_zero(bits));
      const auto        row = bit / m_Size[0];
      m_Bricks.push_back({ m_Lower[0] + static_cast<std::int32_t>(bit % m_Size[0]),
                           m_Lower[1] + static_cast<std::int32_t>(row % m_Size[1]),
                           m_Lower[2] + static_cast<std::int32_t>(row / m_Size[1]) });
    }
  }
  m_Neighbours.resize(m_Bricks.size());
  const auto bricks = static_cast<std::ptrdiff_t>(m_Bricks.size());
#pragma omp parallel for schedule(static) if (bricks > kMany)
  for (std::ptrdiff_t i = 0; i < bricks; ++i)
  {
    const Brick & at = m_Bricks[static_cast<std::size_t>(i)];
    auto &        neighbours = m_Neighbours[static_cast<std::size_t>(i)];
    for (std::size_t n = 0; n < 27; ++n)
    {
      const Brick  other{ at[0] + static_cast<std::int32_t>(n % 3) - 1,
                         at[1] + static_cast<std::int32_t>(n / 3 % 3) - 1,
                         at[2] + static_cast<std::int32_t>(n / 9) - 1 };
      std::int32_t found = Find(other);
      if (found < 0) // no boundary near it, so any voxel speaks for all of it
      {
        const std::int32_t side = 1 << m_Shift;
        found = shape.Contains(other[0] * side, other[1] * side, other[2] * side) ? kInside : kOutside;
      }
      neighbours[n] = found;
    }
  }
}

std::vector<std::uint8_t>
BrickGrid::AndAround(const std::vector<std::uint8_t> & flags) const
{
  std::vector<std::uint8_t> more(flags.size());
  for (std::size_t brick = 0; brick < flags.size(); ++brick)
  {
    more[brick] = std::any_of(m_Neighbours[brick].begin(), m_Neighbours[brick].end(), [&](std::int32_t other) {
      return other >= 0 && flags[static_cast<std::size_t>(other)] != 0;
    });
  }
  return more;
}

} // namespace voxelcore
