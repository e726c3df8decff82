#pragma once
// One layer of voxels or of lattice corners as packed bits, with an empty row around it on either side.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

using Bits = std::uint64_t;

/** Rows -1 to `rows` of `words` words each. */
class BitPlane
{
public:
  BitPlane(std::size_t rows, std::size_t words)
    : m_Rows(rows)
    , m_WordsPerRow(words)
    , m_Words((rows + 2) * words, 0)
  {}

  std::size_t
  Rows() const
  {
    return m_Rows;
  }

  std::span<const Bits>
  Row(std::ptrdiff_t row) const
  {
    return { m_Words.data() + static_cast<std::size_t>(row + 1) * m_WordsPerRow, m_WordsPerRow };
  }
  std::span<Bits>
  Row(std::ptrdiff_t row)
  {
    return { m_Words.data() + static_cast<std::size_t>(row + 1) * m_WordsPerRow, m_WordsPerRow };
  }

  /** All rows, those around included, one after the other. */
  std::vector<Bits> &
  Words()
  {
    return m_Words;
  }
  const std::vector<Bits> &
  Words() const
  {
    return m_Words;
  }

private:
  std::size_t       m_Rows;
  std::size_t       m_WordsPerRow;
  std::vector<Bits> m_Words;
};

/** A row's bits moved down: bit i of the result is bit i + by (0 < by < 64). */
inline Bits
MovedDown(std::span<const Bits> row, std::size_t word, unsigned by)
{
  return (row[word] >> by) | (word + 1 < row.size() ? row[word + 1] << (64 - by) : 0);
}

/** Moved up: bit i of the result is bit i - by. */
inline Bits
MovedUp(std::span<const Bits> row, std::size_t word, unsigned by)
{
  return (row[word] << by) | (word > 0 ? row[word - 1] >> (64 - by) : 0);
}

} // namespace voxelcore
