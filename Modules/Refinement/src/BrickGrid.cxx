#include "BrickGrid.h"

#include <algorithm>
#include <bit>

namespace voxelcore
{

BrickGrid::BrickGrid(const VoxelShape & shape, std::span<const LatticePoint> points, int level, std::int32_t reach)
{
  const int shift = 3 + level;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    m_Lower[axis] = (shape.Box().lower[axis] - 1 - reach) >> shift;
    m_Size[axis] = static_cast<std::uint32_t>(((shape.Box().lower[axis] + shape.Box().size[axis] + reach) >> shift) -
                                              m_Lower[axis] + 1);
  }
  m_BitCount = std::size_t{ m_Size[0] } * m_Size[1] * m_Size[2];
  m_Bits.assign(m_BitCount / 64 + 1, 0);
  std::array<Brick, 2> last{ { { 1, 1, 1 }, { 0, 0, 0 } } };
  for (const LatticePoint & p : points)
  {
    // A boundary vertex lies between the voxels p - 1 and p.
    const std::array<Brick, 2> range{
      { { (p.x - 1 - reach) >> shift, (p.y - 1 - reach) >> shift, (p.z - 1 - reach) >> shift },
        { (p.x + reach) >> shift, (p.y + reach) >> shift, (p.z + reach) >> shift } }
    };
    if (range == last)
    {
      continue;
    }
    last = range;
    for (std::int32_t z = range[0][2]; z <= range[1][2]; ++z)
    {
      for (std::int32_t y = range[0][1]; y <= range[1][1]; ++y)
      {
        const std::size_t first = BitOf({ range[0][0], y, z });
        for (std::size_t bit = first; bit <= first + static_cast<std::size_t>(range[1][0] - range[0][0]); ++bit)
        {
          m_Bits[bit >> 6] |= std::uint64_t{ 1 } << (bit & 63);
        }
      }
    }
  }
  std::uint32_t count = 0;
  for (std::size_t word = 0; word < m_Bits.size(); ++word)
  {
    m_Ranks.push_back(count);
    count += static_cast<std::uint32_t>(std::popcount(m_Bits[word]));
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
        const std::int32_t side = 1 << shift;
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
