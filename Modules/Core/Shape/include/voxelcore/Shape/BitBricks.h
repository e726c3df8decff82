#pragma once
// Bits in bricks of one word along x and 8 x 8 rows. Bricks that are all out or all in are a pointer and nothing else,
// so memory follows where bits change, not the box.

#include "voxelcore/Base/Library.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace voxelcore
{

class BitBricks;

/** A word of a row that may be written. Writing what is there already takes no memory. */
class ShapeWord
{
public:
  ShapeWord(BitBricks & bricks, const std::uint64_t *& brick, std::size_t place)
    : m_Bricks(&bricks)
    , m_Brick(&brick)
    , m_Place(place)
  {}
  ShapeWord(const ShapeWord &) = default;

  operator std::uint64_t() const;

  const ShapeWord &
  operator=(std::uint64_t bits) const;
  const ShapeWord &
  operator=(const ShapeWord & other) const
  {
    return *this = static_cast<std::uint64_t>(other);
  }
  ShapeWord &
  operator=(const ShapeWord & other)
  {
    std::as_const(*this) = static_cast<std::uint64_t>(other);
    return *this;
  }
  const ShapeWord &
  operator|=(std::uint64_t bits) const
  {
    return *this = static_cast<std::uint64_t>(*this) | bits;
  }
  const ShapeWord &
  operator&=(std::uint64_t bits) const
  {
    return *this = static_cast<std::uint64_t>(*this) & bits;
  }
  const ShapeWord &
  operator^=(std::uint64_t bits) const
  {
    return *this = static_cast<std::uint64_t>(*this) ^ bits;
  }

private:
  BitBricks *            m_Bricks;
  const std::uint64_t ** m_Brick;
  std::size_t            m_Place;
};

/** Walks over the words of a row, ConstShapeRow or ShapeRow. */
template <typename TRow, typename TWord>
class RowIterator
{
public:
  using iterator_category = std::random_access_iterator_tag;
  using value_type = std::uint64_t;
  using difference_type = std::ptrdiff_t;
  using pointer = void;
  using reference = TWord;

  RowIterator() = default;
  RowIterator(const TRow & row, std::size_t word)
    : m_Row(row)
    , m_Word(static_cast<std::ptrdiff_t>(word))
  {}

  TWord
  operator*() const
  {
    return m_Row[static_cast<std::size_t>(m_Word)];
  }
  TWord
  operator[](std::ptrdiff_t by) const
  {
    return m_Row[static_cast<std::size_t>(m_Word + by)];
  }
  RowIterator &
  operator+=(std::ptrdiff_t by)
  {
    m_Word += by;
    return *this;
  }
  RowIterator &
  operator-=(std::ptrdiff_t by)
  {
    return *this += -by;
  }
  RowIterator &
  operator++()
  {
    return *this += 1;
  }
  RowIterator &
  operator--()
  {
    return *this += -1;
  }
  RowIterator
  operator++(int)
  {
    RowIterator before = *this;
    *this += 1;
    return before;
  }
  RowIterator
  operator--(int)
  {
    RowIterator before = *this;
    *this += -1;
    return before;
  }
  friend RowIterator
  operator+(RowIterator at, std::ptrdiff_t by)
  {
    return at += by;
  }
  friend RowIterator
  operator+(std::ptrdiff_t by, RowIterator at)
  {
    return at += by;
  }
  friend RowIterator
  operator-(RowIterator at, std::ptrdiff_t by)
  {
    return at -= by;
  }
  friend std::ptrdiff_t
  operator-(const RowIterator & a, const RowIterator & b)
  {
    return a.m_Word - b.m_Word;
  }
  friend bool
  operator==(const RowIterator & a, const RowIterator & b)
  {
    return a.m_Word == b.m_Word;
  }
  friend auto
  operator<=>(const RowIterator & a, const RowIterator & b)
  {
    return a.m_Word <=> b.m_Word;
  }

private:
  TRow           m_Row;
  std::ptrdiff_t m_Word = 0;
};

/** A row of words to read. It is a view: what is written into its bricks changes it. */
class ConstShapeRow
{
public:
  using Iterator = RowIterator<ConstShapeRow, std::uint64_t>;

  ConstShapeRow() = default;
  ConstShapeRow(const std::uint64_t * const * bricks, std::size_t place, std::size_t words)
    : m_Bricks(bricks)
    , m_Place(place)
    , m_Words(words)
  {}

  std::size_t
  size() const
  {
    return m_Words;
  }
  bool
  empty() const
  {
    return m_Words == 0;
  }
  std::uint64_t
  operator[](std::size_t word) const
  {
    return m_Bricks[word][m_Place];
  }
  std::uint64_t
  front() const
  {
    return (*this)[0];
  }
  std::uint64_t
  back() const
  {
    return (*this)[m_Words - 1];
  }
  Iterator
  begin() const
  {
    return { *this, 0 };
  }
  Iterator
  end() const
  {
    return { *this, m_Words };
  }

  /** The brick that holds a word; equal pointers are equal bits. */
  const std::uint64_t *
  Brick(std::size_t word) const
  {
    return m_Bricks[word];
  }

private:
  const std::uint64_t * const * m_Bricks = nullptr;
  std::size_t                   m_Place = 0;
  std::size_t                   m_Words = 0;
};

/** A row of words to write. Threads may write different words at the same time. */
class ShapeRow
{
public:
  using Iterator = RowIterator<ShapeRow, ShapeWord>;

  ShapeRow() = default;
  ShapeRow(BitBricks & owner, const std::uint64_t ** bricks, std::size_t place, std::size_t words)
    : m_Owner(&owner)
    , m_Bricks(bricks)
    , m_Place(place)
    , m_Words(words)
  {}

  operator ConstShapeRow() const
  {
    return { m_Bricks, m_Place, m_Words };
  }

  std::size_t
  size() const
  {
    return m_Words;
  }
  bool
  empty() const
  {
    return m_Words == 0;
  }
  ShapeWord
  operator[](std::size_t word) const
  {
    return { *m_Owner, m_Bricks[word], m_Place };
  }
  ShapeWord
  back() const
  {
    return (*this)[m_Words - 1];
  }
  Iterator
  begin() const
  {
    return { *this, 0 };
  }
  Iterator
  end() const
  {
    return { *this, m_Words };
  }

private:
  BitBricks *            m_Owner = nullptr;
  const std::uint64_t ** m_Bricks = nullptr;
  std::size_t            m_Place = 0;
  std::size_t            m_Words = 0;
};

/** The storage: rows (y, z) of words, all out at first. A brick takes 8 bytes where its bits are alike, 520 where they
 *  are not or Compact() has not looked yet. */
class BitBricks
{
public:
  using Word = std::uint64_t;

  static constexpr std::int32_t side = 8; ///< rows along y and z
  static constexpr std::size_t  words = 64;

  BitBricks() = default;
  /** `bits` along x; those of the last word beyond them stay 0. */
  BitBricks(std::size_t bits, std::size_t rowsY, std::size_t rowsZ);
  BitBricks(const BitBricks & other);
  BitBricks(BitBricks && other) noexcept;
  BitBricks &
  operator=(BitBricks other) noexcept;
  ~BitBricks() = default;

  friend void
  swap(BitBricks & a, BitBricks & b) noexcept;

  std::size_t
  WordsPerRow() const
  {
    return m_WordsPerRow;
  }
  ConstShapeRow
  Row(std::size_t y, std::size_t z) const
  {
    return { m_Bricks.data() + FirstBrick(y, z), Place(y, z), m_WordsPerRow };
  }
  ShapeRow
  Row(std::size_t y, std::size_t z)
  {
    return { *this, m_Bricks.data() + FirstBrick(y, z), Place(y, z), m_WordsPerRow };
  }
  /** A row of which all is out. */
  ConstShapeRow
  Background() const
  {
    return { m_Bricks.data() + m_Bricks.size() - m_WordsPerRow, 0, m_WordsPerRow };
  }
  Word
  Get(std::size_t word, std::size_t y, std::size_t z) const
  {
    return m_Bricks[FirstBrick(y, z) + word][Place(y, z)];
  }

  /** A brick of which each bit is out, or in. */
  static const Word *
  Out()
  {
    return kAlike.data();
  }
  static const Word *
  In()
  {
    return kAlike.data() + words;
  }

  /** The place of a word among those of its brick: writable, and no other brick's. Threads may call it for the same
   *  brick. */
  Word *
  Writable(const Word *& brick)
  {
    const Word * own = atomic_ref<const Word *>(brick).load(std::memory_order_acquire);
    return const_cast<Word *>(IsShared(own) ? MakeOwn(brick) : own);
  }

  /** Looks for bricks in the layers of rows begin to end - 1 along z that have become all out or all in, and gives
   *  their memory to those to come. Layers that share a brick with others are left out, but for the last. Threads may
   *  call it for different layers. */
  void
  Compact(std::size_t begin, std::size_t end);
  void
  Compact()
  {
    Compact(0, m_RowsZ);
  }

  /** Bytes in use. */
  std::size_t
  Bytes() const;

private:
  struct alignas(64) Brick
  {
    std::array<Word, words> bits;
  };

  static std::size_t
  Place(std::size_t y, std::size_t z)
  {
    return (z & 7U) * 8 + (y & 7U);
  }
  std::size_t
  FirstBrick(std::size_t y, std::size_t z) const
  {
    return ((z >> 3U) * m_BricksY + (y >> 3U)) * m_WordsPerRow;
  }
  bool
  IsShared(const Word * brick) const
  {
    return brick == Out() || brick == In() || brick == m_Edge.get();
  }
  const Word *
  MakeOwn(const Word *& brick);
  Word *
  NewBrick();

  static const std::array<Word, 2 * words> kAlike;

  std::size_t               m_WordsPerRow = 0;
  std::size_t               m_RowsY = 0;
  std::size_t               m_RowsZ = 0;
  std::size_t               m_BricksY = 0;
  Word                      m_LastWord = 0; ///< the bits of a row's last word that belong to it
  std::vector<const Word *> m_Bricks;       ///< x fastest; behind them a row that is out
  std::unique_ptr<Word[]>   m_Edge;         ///< all in, at the end of rows that end within a word

  std::vector<std::unique_ptr<Brick[]>> m_Chunks;
  std::size_t                           m_ChunkSize = 0; ///< bricks in the last chunk
  std::size_t                           m_ChunkUsed = 0;
  std::vector<Word *>                   m_Free;
  std::mutex                            m_Mutex; ///< of the three above
};

inline ShapeWord::operator std::uint64_t() const
{
  return atomic_ref<const std::uint64_t *>(*m_Brick).load(std::memory_order_acquire)[m_Place];
}

inline const ShapeWord &
ShapeWord::operator=(std::uint64_t bits) const
{
  if (static_cast<std::uint64_t>(*this) != bits)
  {
    m_Bricks->Writable(*m_Brick)[m_Place] = bits;
  }
  return *this;
}

} // namespace voxelcore
