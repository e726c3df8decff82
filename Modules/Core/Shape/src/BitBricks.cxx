#include "voxelcore/Shape/BitBricks.h"

#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{
namespace
{

constexpr std::size_t greatestChunk = 2048; // bricks: 1 MB

constexpr std::array<std::uint64_t, 2 * BitBricks::words>
OutAndIn()
{
  std::array<std::uint64_t, 2 * BitBricks::words> both{};
  std::fill(both.begin() + BitBricks::words, both.end(), ~std::uint64_t{ 0 });
  return both;
}

} // namespace

alignas(64) const std::array<std::uint64_t, 2 * BitBricks::words> BitBricks::kAlike = OutAndIn();

BitBricks::BitBricks(std::size_t bits, std::size_t rowsY, std::size_t rowsZ)
  : m_WordsPerRow((bits + 63) / 64)
  , m_RowsY(rowsY)
  , m_RowsZ(rowsZ)
  , m_BricksY((rowsY + 7) / 8)
  , m_LastWord(~std::uint64_t{ 0 } >> ((64 - bits % 64) % 64))
  , m_Bricks(m_WordsPerRow * (m_BricksY * ((rowsZ + 7) / 8) + 1), Out())
{
  if (m_LastWord != ~std::uint64_t{ 0 })
  {
    m_Edge = std::make_unique<Word[]>(words);
    std::fill_n(m_Edge.get(), words, m_LastWord);
  }
}

BitBricks::BitBricks(const BitBricks & other)
  : m_WordsPerRow(other.m_WordsPerRow)
  , m_RowsY(other.m_RowsY)
  , m_RowsZ(other.m_RowsZ)
  , m_BricksY(other.m_BricksY)
  , m_LastWord(other.m_LastWord)
  , m_Bricks(other.m_Bricks)
{
  if (other.m_Edge)
  {
    m_Edge = std::make_unique<Word[]>(words);
    std::fill_n(m_Edge.get(), words, m_LastWord);
  }
  for (const Word *& brick : m_Bricks)
  {
    if (brick == other.m_Edge.get())
    {
      brick = m_Edge.get();
    }
    else if (!IsShared(brick))
    {
      const Word * from = brick;
      Word * const to = NewBrick();
      std::copy_n(from, words, to);
      brick = to;
    }
  }
}

BitBricks::BitBricks(BitBricks && other) noexcept
{
  swap(*this, other);
}

BitBricks &
BitBricks::operator=(BitBricks other) noexcept
{
  swap(*this, other);
  return *this;
}

void
swap(BitBricks & a, BitBricks & b) noexcept
{
  std::swap(a.m_WordsPerRow, b.m_WordsPerRow);
  std::swap(a.m_RowsY, b.m_RowsY);
  std::swap(a.m_RowsZ, b.m_RowsZ);
  std::swap(a.m_BricksY, b.m_BricksY);
  std::swap(a.m_LastWord, b.m_LastWord);
  a.m_Bricks.swap(b.m_Bricks);
  a.m_Edge.swap(b.m_Edge);
  a.m_Chunks.swap(b.m_Chunks);
  std::swap(a.m_ChunkSize, b.m_ChunkSize);
  std::swap(a.m_ChunkUsed, b.m_ChunkUsed);
  a.m_Free.swap(b.m_Free);
}

std::uint64_t *
BitBricks::NewBrick()
{
  if (!m_Free.empty())
  {
    Word * const brick = m_Free.back();
    m_Free.pop_back();
    return brick;
  }
  if (m_ChunkUsed == m_ChunkSize)
  {
    // As much again as there is, so that small shapes stay small. Where there is no memory, all stays as it was: other
    // threads may ask for more before they hear of it.
    const std::size_t size = std::clamp<std::size_t>(2 * m_ChunkSize, 1, greatestChunk);
    m_Chunks.push_back(make_unique_for_overwrite<Brick[]>(size));
    m_ChunkSize = size;
    m_ChunkUsed = 0;
  }
  return m_Chunks.back()[m_ChunkUsed++].bits.data();
}

const std::uint64_t *
BitBricks::MakeOwn(const Word *& brick)
{
  const std::lock_guard lock(m_Mutex);
  const Word * const    before = brick;
  if (!IsShared(before)) // another thread was here first
  {
    return before;
  }
  Word * const own = NewBrick();
  std::copy_n(before, words, own);
  atomic_ref<const Word *>(brick).store(own, std::memory_order_release);
  return own;
}

void
BitBricks::Compact(std::size_t begin, std::size_t end)
{
  std::vector<Word *> released;
  const std::size_t   lastLayer = end >= m_RowsZ ? (m_RowsZ + 7) / 8 : end / 8;
  for (std::size_t layer = (begin + 7) / 8; layer < lastLayer; ++layer)
  {
    const std::size_t rowsZ = std::min<std::size_t>(8, m_RowsZ - 8 * layer);
    for (std::size_t beam = 0; beam < m_BricksY; ++beam)
    {
      const std::size_t rowsY = std::min<std::size_t>(8, m_RowsY - 8 * beam);
      for (std::size_t word = 0; word < m_WordsPerRow; ++word)
      {
        const Word *& brick = m_Bricks[(layer * m_BricksY + beam) * m_WordsPerRow + word];
        if (IsShared(brick))
        {
          continue;
        }
        Word any = 0;
        Word all = ~Word{ 0 };
        for (std::size_t z = 0; z < rowsZ; ++z)
        {
          for (std::size_t y = 0; y < rowsY; ++y)
          {
            any |= brick[8 * z + y];
            all &= brick[8 * z + y];
          }
        }
        const bool   isEdge = word + 1 == m_WordsPerRow && m_Edge;
        const Word * alike = any == 0                                             ? Out()
                             : all == (isEdge ? m_LastWord : ~std::uint64_t{ 0 }) ? (isEdge ? m_Edge.get() : In())
                                                                                  : nullptr;
        if (alike != nullptr)
        {
          released.push_back(const_cast<Word *>(brick));
          brick = alike;
        }
      }
    }
  }
  const std::lock_guard lock(m_Mutex);
  m_Free.insert(m_Free.end(), released.begin(), released.end());
}

std::size_t
BitBricks::Bytes() const
{
  std::size_t bricks = m_ChunkUsed;
  std::size_t size = 1;
  for (std::size_t chunk = 0; chunk + 1 < m_Chunks.size(); ++chunk, size = std::min(2 * size, greatestChunk))
  {
    bricks += size;
  }
  return m_Bricks.size() * sizeof(Word *) + (bricks - m_Free.size()) * sizeof(Brick);
}

} // namespace voxelcore
