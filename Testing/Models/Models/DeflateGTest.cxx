// zlib streams.

#include "Deflate.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <iostream>
#include <random>
#include <string>

using namespace voxelcore;

namespace
{

/** Unpacked by zlib and by us. */
void
ExpectRoundTrip(const std::string & bytes)
{
  const std::string packed = Deflate(bytes);
  std::string       back(bytes.size() + 1, '\0');
  uLongf            room = back.size();
  ASSERT_EQ(uncompress(reinterpret_cast<Bytef *>(back.data()),
                       &room,
                       reinterpret_cast<const Bytef *>(packed.data()),
                       packed.size()),
            Z_OK)
    << bytes.size();
  back.resize(room);
  ASSERT_TRUE(back == bytes) << bytes.size();
  ASSERT_TRUE(Inflate(packed, back.data(), bytes.size()));
  EXPECT_TRUE(back == bytes);
}

/** Doubles that ascend in uneven steps, then counts: the same everywhere, as only whole numbers are computed. */
std::string
Numbers()
{
  std::string   bytes;
  std::string   counts;
  std::uint64_t state = 1;
  double        value = 0;
  for (std::int32_t i = 0; i < 20000; ++i)
  {
    state = state * 6364136223846793005U + 1442695040888963407U;
    value += static_cast<double>(state >> 54U) / 1024;
    bytes.append(reinterpret_cast<const char *>(&value), sizeof value);
    const std::int32_t count = 5 * i + static_cast<std::int32_t>(state >> 61U);
    counts.append(reinterpret_cast<const char *>(&count), sizeof count);
  }
  return bytes + counts;
}

} // namespace

TEST(Deflate, WhatZlibUnpacksIsWhatWasPacked)
{
  const auto seed = std::random_device()();
  std::cout << "seed " << seed << "\n";
  std::mt19937 random(seed);
  for (std::size_t length = 0; length < 20; ++length)
  {
    ExpectRoundTrip(std::string(length, 'x'));
  }
  for (int run = 0; run < 600; ++run)
  {
    std::string    bytes(random() % (run % 50 == 0 ? 300000 : 600), '\0');
    const unsigned values = 1 + random() % 256;
    const int      kind = run % 3;
    for (std::size_t i = 0; i < bytes.size(); ++i)
    {
      const bool repeats = kind == 2 && i > 40 && random() % 10 != 0;
      const bool isNought = kind == 1 && random() % 2 == 0;
      bytes[i] = repeats ? bytes[i - 1 - random() % 40] : isNought ? '\0' : static_cast<char>(random() % values);
    }
    ExpectRoundTrip(bytes);
  }
}

TEST(Deflate, DamagedStreamsAreNotUnpacked)
{
  const std::string numbers = Numbers();
  const std::string packed = Deflate(numbers);
  std::string       to(numbers.size() + 1, '\0');
  EXPECT_FALSE(Inflate(packed, to.data(), numbers.size() - 1));
  EXPECT_FALSE(Inflate(packed, to.data(), numbers.size() + 1));
  EXPECT_FALSE(Inflate(packed.substr(0, packed.size() - 1), to.data(), numbers.size()));
  for (std::size_t at = 0; at < packed.size(); at += 997)
  {
    std::string damaged = packed;
    damaged[at] ^= 4;
    EXPECT_FALSE(Inflate(damaged, to.data(), numbers.size())) << at;
  }
}
