#include "voxelcore/Shape/BitBricks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <random>
#include <thread>
#include <vector>

namespace voxelcore
{
namespace
{

constexpr std::uint64_t kAll = ~std::uint64_t{ 0 };

/** The same as plain words. */
class PlainBits
{
public:
  PlainBits(std::size_t words, std::size_t rowsY, std::size_t rowsZ)
    : m_Words(words)
    , m_RowsY(rowsY)
    , m_Bits(words * rowsY * rowsZ, 0)
  {}
  std::uint64_t &
  At(std::size_t word, std::size_t y, std::size_t z)
  {
    return m_Bits[(z * m_RowsY + y) * m_Words + word];
  }

private:
  std::size_t                m_Words;
  std::size_t                m_RowsY;
  std::vector<std::uint64_t> m_Bits;
};

void
ExpectEqual(const BitBricks & bricks, PlainBits & plain, const std::array<std::size_t, 3> & size)
{
  for (std::size_t z = 0; z < size[2]; ++z)
  {
    for (std::size_t y = 0; y < size[1]; ++y)
    {
      const ConstShapeRow row = bricks.Row(y, z);
      ASSERT_EQ(row.size(), size[0]);
      for (std::size_t word = 0; word < size[0]; ++word)
      {
        ASSERT_EQ(row[word], plain.At(word, y, z)) << word << " " << y << " " << z;
        ASSERT_EQ(bricks.Get(word, y, z), plain.At(word, y, z));
      }
    }
  }
}

TEST(BitBricks, ReadWhatWasWrittenAlsoWhenCompactedAndCopied)
{
  const unsigned seed = std::random_device{}();
  RecordProperty("seed", static_cast<int>(seed));
  std::mt19937 random(seed);
  for (int round = 0; round < 60; ++round)
  {
    const std::size_t                bits = 1 + random() % 200;
    const std::array<std::size_t, 3> size{ (bits + 63) / 64, 1 + random() % 20, 1 + random() % 20 };
    const std::uint64_t              last = kAll >> ((64 - bits % 64) % 64);
    BitBricks                        bricks(bits, size[1], size[2]);
    PlainBits                        plain(size[0], size[1], size[2]);
    for (int write = 0; write < 400; ++write)
    {
      // Mostly whole runs of equal words, so that bricks become alike and apart again.
      const std::uint64_t value = random() % 3 == 0 ? 0 : random() % 2 == 0 ? kAll : std::uint64_t{ random() } << 13U;
      const std::size_t   y = random() % size[1];
      const std::size_t   z = random() % size[2];
      const std::size_t   endY = std::min(size[1], y + 1 + random() % 9);
      const std::size_t   endZ = std::min(size[2], z + 1 + random() % 9);
      for (std::size_t atZ = z; atZ < endZ; ++atZ)
      {
        for (std::size_t atY = y; atY < endY; ++atY)
        {
          for (std::size_t word = 0; word < size[0]; ++word)
          {
            const std::uint64_t own = word + 1 == size[0] ? value & last : value;
            bricks.Row(atY, atZ)[word] = own;
            plain.At(word, atY, atZ) = own;
          }
        }
      }
      if (write % 50 == 49)
      {
        bricks.Compact(z, endZ);
        bricks.Compact();
      }
    }
    ASSERT_NO_FATAL_FAILURE(ExpectEqual(bricks, plain, size)) << "seed " << seed;
    BitBricks copy(bricks);
    ASSERT_NO_FATAL_FAILURE(ExpectEqual(copy, plain, size)) << "seed " << seed;
    copy.Row(0, 0)[0] ^= 1;
    ASSERT_NO_FATAL_FAILURE(ExpectEqual(bricks, plain, size)) << "seed " << seed;
    const BitBricks moved(std::move(bricks));
    ASSERT_NO_FATAL_FAILURE(ExpectEqual(moved, plain, size)) << "seed " << seed;
  }
}

TEST(BitBricks, AllInAndAllOutTakeAPointerABrick)
{
  BitBricks         bricks(1000, 100, 100); // ends within a word, and within bricks along y and z
  const std::size_t empty = bricks.Bytes();
  EXPECT_LE(empty, 16 * 13 * 14 * sizeof(void *));
  for (std::size_t z = 0; z < 100; ++z)
  {
    for (std::size_t y = 0; y < 100; ++y)
    {
      for (std::size_t word = 0; word < 16; ++word)
      {
        bricks.Row(y, z)[word] = word < 15 ? kAll : kAll >> 24U;
      }
    }
  }
  EXPECT_GE(bricks.Bytes(), empty + std::size_t{ 512 } * 16 * 13 * 13);
  bricks.Compact();
  EXPECT_EQ(bricks.Bytes(), empty);
  EXPECT_EQ(bricks.Row(99, 99)[15], kAll >> 24U);
  bricks.Row(50, 50)[3] = 7;
  EXPECT_EQ(bricks.Bytes(), empty + 512);
  EXPECT_EQ(bricks.Row(51, 50)[3], kAll);
  EXPECT_EQ(bricks.Row(50, 50)[3], 7U);
}

TEST(BitBricks, WritingWhatIsThereTakesNoMemory)
{
  BitBricks         bricks(640, 64, 64);
  const std::size_t empty = bricks.Bytes();
  for (std::size_t word = 0; word < 10; ++word)
  {
    bricks.Row(5, 6)[word] = 0;
    bricks.Row(5, 6)[word] &= 12;
  }
  EXPECT_EQ(bricks.Bytes(), empty);
}

TEST(BitBricks, LayersThatShareABrickAreLeftOut)
{
  BitBricks bricks(64, 8, 24);
  for (std::size_t z = 0; z < 24; ++z)
  {
    for (std::size_t y = 0; y < 8; ++y)
    {
      bricks.Row(y, z)[0] = kAll;
    }
  }
  bricks.Compact(1, 23); // only 8 to 15 are wholly in that
  EXPECT_NE(std::as_const(bricks).Row(0, 0).Brick(0), BitBricks::In());
  EXPECT_EQ(std::as_const(bricks).Row(0, 8).Brick(0), BitBricks::In());
  EXPECT_NE(std::as_const(bricks).Row(0, 16).Brick(0), BitBricks::In());
  bricks.Compact(16, 24);
  EXPECT_EQ(std::as_const(bricks).Row(0, 16).Brick(0), BitBricks::In());
}

TEST(BitBricks, RowsWorkWithAlgorithms)
{
  BitBricks                        bricks(192, 3, 3);
  const std::vector<std::uint64_t> words{ 5, 0, 9 };
  std::ranges::copy(words, bricks.Row(1, 2).begin());
  const ConstShapeRow row = std::as_const(bricks).Row(1, 2);
  EXPECT_TRUE(std::ranges::equal(row, words));
  EXPECT_EQ(row.front(), 5U);
  EXPECT_EQ(row.back(), 9U);
  EXPECT_EQ(std::ranges::find(row, 0U) - row.begin(), 1);
  EXPECT_TRUE(std::ranges::all_of(bricks.Background(), [](std::uint64_t word) { return word == 0; }));
}

TEST(BitBricks, ThreadsWriteWordsOfOneBrick)
{
  for (int round = 0; round < 20; ++round)
  {
    BitBricks                bricks(64 * 40, 8, 8);
    std::atomic<int>         waiting{ 8 };
    std::vector<std::thread> threads;
    for (std::size_t y = 0; y < 8; ++y)
    {
      threads.emplace_back([&, y] {
        for (--waiting; waiting > 0;)
        {}
        for (std::size_t word = 0; word < 40; ++word)
        {
          for (std::size_t z = 0; z < 8; ++z)
          {
            bricks.Row(y, z)[word] = 1000 * word + 10 * y + z + 1;
          }
        }
      });
    }
    for (std::thread & thread : threads)
    {
      thread.join();
    }
    for (std::size_t word = 0; word < 40; ++word)
    {
      for (std::size_t at = 0; at < 64; ++at)
      {
        ASSERT_EQ(bricks.Get(word, at / 8, at % 8), 1000 * word + 10 * (at / 8) + at % 8 + 1);
      }
    }
  }
}

} // namespace
} // namespace voxelcore
