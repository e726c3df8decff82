#include "DenseBits.h"

#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace voxelcore
{

namespace
{

/** Whether several threads are worth it for a loop over a volume. */
bool
IsLarge(const VoxelBox & box)
{
  return static_cast<double>(box.size[0]) * box.size[1] * box.size[2] > 1 << 19;
}

/** Of a row, all runs of `open` that hold a bit of `seeds` (all of which are in `open`). */
void
FillRuns(const std::uint64_t * open, std::span<std::uint64_t> seeds)
{
  std::uint64_t carry = 0;
  for (std::size_t word = 0; word < seeds.size(); ++word) // upwards: a sum carries through a run
  {
    const std::uint64_t from = seeds[word] | (carry & open[word]);
    seeds[word] = (open[word] & ~(open[word] + from)) | from;
    carry = seeds[word] >> 63U;
  }
  carry = 0;
  for (std::size_t word = seeds.size(); word-- > 0;)
  {
    std::uint64_t filled = seeds[word] | (carry << 63U & open[word]);
    std::uint64_t through = open[word];
    for (unsigned step = 1; step < 64; step *= 2)
    {
      filled |= through & filled >> step;
      through &= through >> step;
    }
    seeds[word] = filled;
    carry = filled & 1U;
  }
}

/** Rows of voxels one after the other: a slice, row by row or transposed. */
struct Slice
{
  const std::uint64_t * shape;
  std::uint64_t *       holes; ///< what is no hole is taken off, as if all background were
  std::size_t           rows;
  std::size_t           stride; ///< words from one row to the next
};

/** A slice whose rows are rows of the volume: `reached` has room for its rows and one more on either side. */
void
FloodRows(const Slice & slice, std::size_t words, std::uint64_t lastWord, std::vector<std::uint64_t> & reached)
{
  reached.assign((slice.rows + 2) * words, ~std::uint64_t{ 0 });
  std::vector<std::uint64_t> open(slice.rows * words);
  const std::uint64_t        lastBit = lastWord & ~(lastWord >> 1U);
  for (std::size_t row = 0; row < slice.rows; ++row)
  {
    for (std::size_t word = 0; word < words; ++word)
    {
      const std::uint64_t own = word + 1 == words ? lastWord : ~std::uint64_t{ 0 };
      const std::uint64_t rim = (word == 0 ? 1U : 0U) | (word + 1 == words ? lastBit : 0);
      open[row * words + word] = ~slice.shape[row * slice.stride + word] & own;
      reached[(row + 1) * words + word] = open[row * words + word] & rim;
    }
  }
  const auto look = [&](std::size_t row) {
    std::uint64_t *       here = reached.data() + (row + 1) * words;
    const std::uint64_t * isOpen = open.data() + row * words;
    const std::uint64_t * before = here - words;
    const std::uint64_t * after = here + words;
    std::uint64_t         below = 0;
    std::uint64_t         news = 0;
    for (std::size_t word = 0; word < words; ++word)
    {
      const std::uint64_t left = isOpen[word] & ~here[word];
      const std::uint64_t beside = before[word] | after[word];
      if (left != 0)
      {
        const std::uint64_t above = word + 1 < words ? (before[word + 1] | after[word + 1]) << 63U : 0;
        const std::uint64_t touched = (beside | beside << 1U | below | beside >> 1U | above) & left;
        news |= touched;
        here[word] |= touched;
      }
      below = beside >> 63U;
    }
    if (news != 0)
    {
      FillRuns(isOpen, { here, words });
    }
    return news != 0;
  };
  for (std::size_t row = 0; row < slice.rows; ++row)
  {
    FillRuns(open.data() + row * words, { reached.data() + (row + 1) * words, words });
  }
  for (bool wentOn = true; wentOn;)
  {
    wentOn = false;
    for (std::size_t row = 0; row < slice.rows; ++row)
    {
      wentOn = look(row) || wentOn;
    }
    for (std::size_t row = slice.rows; wentOn && row-- > 0;)
    {
      look(row);
    }
  }
  for (std::size_t row = 0; row < slice.rows; ++row)
  {
    for (std::size_t word = 0; word < words; ++word)
    {
      slice.holes[row * slice.stride + word] |= open[row * words + word] & ~reached[(row + 1) * words + word];
    }
  }
}

/** 64 slices across x at once: word `word` of all rows. `reached` is room for these and a rim around them. */
void
FloodColumn(const DenseBits & shape, std::size_t word, DenseBits & holes, std::vector<std::uint64_t> & reached)
{
  const auto          sizeY = static_cast<std::size_t>(shape.Box().size[1]);
  const auto          sizeZ = static_cast<std::size_t>(shape.Box().size[2]);
  const std::size_t   stride = sizeY + 2;
  const std::uint64_t own = word + 1 == shape.WordsPerRow() ? shape.LastWord() : ~std::uint64_t{ 0 };
  reached.assign(stride * (sizeZ + 2), ~std::uint64_t{ 0 });
  const auto placeOf = [&](std::size_t y, std::size_t z) { return (z + 1) * stride + y + 1; };
  const auto openAt = [&](std::size_t y, std::size_t z) {
    return ~shape.Row(static_cast<std::int32_t>(y), static_cast<std::int32_t>(z))[word] & own;
  };
  std::vector<std::uint64_t> open(sizeY * sizeZ);
  for (std::size_t z = 0; z < sizeZ; ++z)
  {
    for (std::size_t y = 0; y < sizeY; ++y)
    {
      open[z * sizeY + y] = openAt(y, z);
      reached[placeOf(y, z)] = 0;
    }
  }
  const auto look = [&](std::size_t y, std::size_t z) {
    const std::uint64_t isOpen = open[z * sizeY + y];
    std::uint64_t &     here = reached[placeOf(y, z)];
    if (here == isOpen)
    {
      return false;
    }
    const std::uint64_t * at = &here;
    const std::uint64_t   touched = here | ((at[-1] | at[1] | *(at - stride - 1) | *(at - stride) | *(at - stride + 1) |
                                           *(at + stride - 1) | *(at + stride) | *(at + stride + 1)) &
                                          isOpen);
    const bool            wentOn = touched != here;
    here = touched;
    return wentOn;
  };
  for (bool wentOn = true; wentOn;)
  {
    wentOn = false;
    for (std::size_t z = 0; z < sizeZ; ++z)
    {
      for (std::size_t y = 0; y < sizeY; ++y)
      {
        wentOn = look(y, z) || wentOn;
      }
      for (std::size_t y = sizeY; y-- > 0;)
      {
        wentOn = look(y, z) || wentOn;
      }
    }
    for (std::size_t z = sizeZ; wentOn && z-- > 0;)
    {
      for (std::size_t y = 0; y < sizeY; ++y)
      {
        look(y, z);
      }
      for (std::size_t y = sizeY; y-- > 0;)
      {
        look(y, z);
      }
    }
  }
  for (std::size_t z = 0; z < sizeZ; ++z)
  {
    for (std::size_t y = 0; y < sizeY; ++y)
    {
      holes.Row(static_cast<std::int32_t>(y), static_cast<std::int32_t>(z))[word] |=
        open[z * sizeY + y] & ~reached[placeOf(y, z)];
    }
  }
}

} // namespace

DenseBits::DenseBits(const VoxelBox & box)
  : m_Box(box)
  , m_Words((static_cast<std::size_t>(box.size[0]) + 63) / 64)
  , m_Bits(m_Words * static_cast<std::size_t>(box.size[1]) * static_cast<std::size_t>(box.size[2]))
{}

DenseBits::DenseBits(const VoxelShape & shape, const std::array<std::int32_t, 3> & room)
  : DenseBits(Grown(shape.Box(), room))
{
  const auto     skip = static_cast<std::size_t>(room[0]) / 64;
  const unsigned shift = static_cast<unsigned>(room[0]) & 63U;
  for (std::int32_t z = 0; z < shape.Box().size[2]; ++z)
  {
    for (std::int32_t y = 0; y < shape.Box().size[1]; ++y)
    {
      const auto      from = shape.Row(y, z);
      std::uint64_t * to = Row(y + room[1], z + room[2]) + skip;
      for (std::size_t word = 0; word < from.size(); ++word)
      {
        const std::uint64_t bits = from[word];
        to[word] |= bits << shift;
        if (shift != 0 && bits >> (64 - shift) != 0)
        {
          to[word + 1] |= bits >> (64 - shift);
        }
      }
    }
  }
}

std::uint64_t
DenseBits::Count() const
{
  return std::accumulate(m_Bits.begin(), m_Bits.end(), std::uint64_t{ 0 }, [](std::uint64_t sum, std::uint64_t word) {
    return sum + CountBits(word);
  });
}

VoxelShape
DenseBits::ToShape() const
{
  VoxelShape shape(m_Box);
  for (std::int32_t z = 0; z < m_Box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < m_Box.size[1]; ++y)
    {
      std::copy_n(Row(y, z), m_Words, shape.Row(y, z).begin());
    }
  }
  return shape;
}

DenseBits
DilatedBits(const VoxelShape & shape, const BallRows & ball)
{
  const DenseBits from(shape, ball.reach);
  DenseBits       dilated(from.Box());
  const auto &    size = from.Box().size;
  const auto      words = static_cast<std::ptrdiff_t>(from.WordsPerRow());
  // Slice by slice, as one row: there is room beside each of its rows, so that nothing spreads from one to the next.
  RunInParts(IsLarge(from.Box()), static_cast<std::size_t>(size[2]), [&](std::size_t first, std::size_t last) {
    BitRow slice(static_cast<std::size_t>(size[1] * words));
    BitRow spare(slice.size());
    for (auto z = static_cast<std::int32_t>(first); z < static_cast<std::int32_t>(last); ++z)
    {
      ranges::fill(slice, 0);
      const bool any = AddBallRows(ball, slice, spare, [&](std::int32_t dy, std::int32_t dz) {
        const std::int32_t fromZ = z - dz;
        // Beyond the room lies nothing: rows that would leave the slice are empty.
        if (fromZ < ball.reach[2] || fromZ >= size[2] - ball.reach[2])
        {
          return false;
        }
        const std::ptrdiff_t  begin = ball.reach[1] * words;
        const std::ptrdiff_t  end = (size[1] - ball.reach[1]) * words;
        const std::uint64_t * source = from.Row(0, fromZ);
        std::uint64_t *       to = slice.data() + dy * words;
        for (std::ptrdiff_t word = begin; word < end; ++word)
        {
          to[word] |= source[word];
        }
        return true;
      });
      if (any)
      {
        ranges::copy(slice, dilated.Row(0, z));
      }
    }
  });
  return dilated;
}

DenseBits
HolesOfAllSlices(const DenseBits & shape)
{
  const auto &      size = shape.Box().size;
  const bool        isLarge = IsLarge(shape.Box());
  const std::size_t words = shape.WordsPerRow();
  const auto        sizeY = static_cast<std::size_t>(size[1]);
  const auto        sizeZ = static_cast<std::size_t>(size[2]);
  DenseBits         holes(shape.Box());
  RunInParts(isLarge, words, [&](std::size_t first, std::size_t last) {
    std::vector<std::uint64_t> reached;
    for (std::size_t word = first; word < last; ++word)
    {
      FloodColumn(shape, word, holes, reached);
    }
  });
  RunInParts(isLarge, sizeY, [&](std::size_t first, std::size_t last) {
    std::vector<std::uint64_t> reached;
    for (auto y = static_cast<std::int32_t>(first); y < static_cast<std::int32_t>(last); ++y)
    {
      FloodRows({ shape.Row(y, 0), holes.Row(y, 0), sizeZ, words * sizeY }, words, shape.LastWord(), reached);
    }
  });
  RunInParts(isLarge, sizeZ, [&](std::size_t first, std::size_t last) {
    std::vector<std::uint64_t> reached;
    for (auto z = static_cast<std::int32_t>(first); z < static_cast<std::int32_t>(last); ++z)
    {
      FloodRows({ shape.Row(0, z), holes.Row(0, z), sizeY, words }, words, shape.LastWord(), reached);
    }
  });
  return holes;
}

} // namespace voxelcore
