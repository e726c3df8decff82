#include "voxelcore/BoundaryCounts.h"

#include <array>
#include <bit>
#include <vector>

namespace voxelcore
{

namespace
{

using Bits = std::uint64_t;
using Row = std::span<const Bits>;

/** Rows of the shape, empty ones beyond its box. */
class PaddedRows
{
public:
  explicit PaddedRows(const VoxelShape & shape)
    : m_Shape(shape)
    , m_Empty(shape.WordsPerRow(), 0)
  {}

  Row
  At(std::int32_t y, std::int32_t z) const
  {
    const auto & size = m_Shape.Box().size;
    return y < 0 || z < 0 || y >= size[1] || z >= size[2] ? Row(m_Empty) : m_Shape.Row(y, z);
  }

private:
  const VoxelShape & m_Shape;
  std::vector<Bits>  m_Empty;
};

std::uint64_t
Count(Bits bits)
{
  return static_cast<std::uint64_t>(std::popcount(bits));
}

/** The corners of lattice row (y, z): four rows of voxels around it, each left and right of a corner. */
void
CountCorners(const std::array<Row, 4> & rows, std::size_t words, BoundaryCounts & counts)
{
  std::array<Bits, 4> carry{};
  // One word more: the corner behind the last voxel of a box whose width is a multiple of 64.
  for (std::size_t word = 0; word <= words; ++word)
  {
    std::array<Bits, 4> any{};
    std::array<Bits, 4> all{};
    Bits                leftAny = 0;
    Bits                leftAll = ~Bits{ 0 };
    Bits                rightAny = 0;
    Bits                rightAll = ~Bits{ 0 };
    for (std::size_t i = 0; i < 4; ++i)
    {
      const Bits right = word < words ? rows[i][word] : 0;
      const Bits left = (right << 1) | carry[i];
      carry[i] = right >> 63;
      any[i] = left | right;
      all[i] = left & right;
      leftAny |= left;
      leftAll &= left;
      rightAny |= right;
      rightAll &= right;
    }
    const auto flat = [](Bits allHere, Bits anyThere) { return allHere & ~anyThere; };
    // Rows 0, 1 lie at z - 1, rows 2, 3 at z; rows 0, 2 at y - 1, rows 1, 3 at y.
    counts.vertices += Count((leftAny | rightAny) & ~(leftAll & rightAll));
    counts.flatVertices += Count(flat(leftAll, rightAny) | flat(rightAll, leftAny) |
                                 flat(all[0] & all[1], any[2] | any[3]) | flat(all[2] & all[3], any[0] | any[1]) |
                                 flat(all[0] & all[2], any[1] | any[3]) | flat(all[1] & all[3], any[0] | any[2]));
  }
}

/** Voxels of row (y, z), and those of them that have all 26 neighbours, from the nine rows around it. */
void
CountVoxels(const std::array<Row, 9> & rows, std::size_t words, BoundaryCounts & counts)
{
  const auto column = [&](std::size_t word) {
    Bits bits = ~Bits{ 0 };
    for (const Row & row : rows)
    {
      bits &= row[word];
    }
    return bits;
  };
  Bits before = 0;
  Bits here = column(0);
  for (std::size_t word = 0; word < words; ++word)
  {
    const Bits after = word + 1 < words ? column(word + 1) : 0;
    const Bits inner = here & ((here << 1) | (before >> 63)) & ((here >> 1) | (after << 63));
    const Bits voxels = rows[4][word];
    counts.voxels += Count(voxels);
    counts.borderVoxels += Count(voxels & ~inner);
    before = here;
    here = after;
  }
}

} // namespace

BoundaryCounts
CountBoundary(const VoxelShape & shape)
{
  BoundaryCounts    counts;
  const auto &      size = shape.Box().size;
  const std::size_t words = shape.WordsPerRow();
  if (words == 0 || size[1] == 0 || size[2] == 0)
  {
    return counts;
  }
  const PaddedRows rows(shape);
  for (std::int32_t z = 0; z <= size[2]; ++z)
  {
    for (std::int32_t y = 0; y <= size[1]; ++y)
    {
      CountCorners({ rows.At(y - 1, z - 1), rows.At(y, z - 1), rows.At(y - 1, z), rows.At(y, z) }, words, counts);
      if (y < size[1] && z < size[2])
      {
        std::array<Row, 9> around;
        for (std::int32_t i = 0; i < 9; ++i)
        {
          around[static_cast<std::size_t>(i)] = rows.At(y + i % 3 - 1, z + i / 3 - 1);
        }
        CountVoxels(around, words, counts);
      }
    }
  }
  return counts;
}

} // namespace voxelcore
