#pragma once
// Runs of bits in rows of 64-bit words.

#include <bit>
#include <cstdint>
#include <span>

namespace voxelcore
{

/** Sets bits first to end - 1; returns by how many there are more. */
inline std::uint64_t
SetBits(std::span<std::uint64_t> row, std::int32_t first, std::int32_t end)
{
  std::uint64_t added = 0;
  for (std::int32_t at = first; at < end;)
  {
    const std::int32_t  wordEnd = (at | 63) + 1;
    const std::int32_t  stop = end < wordEnd ? end : wordEnd;
    const std::uint64_t bits = (~std::uint64_t{ 0 } >> (64 - (stop - at))) << (at & 63);
    std::uint64_t &     word = row[static_cast<std::size_t>(at) >> 6U];
    added += static_cast<std::uint64_t>(std::popcount(bits & ~word));
    word |= bits;
    at = stop;
  }
  return added;
}

} // namespace voxelcore
