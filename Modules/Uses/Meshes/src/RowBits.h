#pragma once
// Runs of bits in rows of 64-bit words.

#include "voxelcore/Base/CountBits.h"

#include <cstddef>
#include <cstdint>

namespace voxelcore
{

/** Sets bits first to end - 1 of a row of words; returns by how many there are more. */
template <typename TRow>
std::uint64_t
SetBits(const TRow & row, std::int32_t first, std::int32_t end)
{
  std::uint64_t added = 0;
  for (std::int32_t at = first; at < end;)
  {
    const std::int32_t  wordEnd = (at | 63) + 1;
    const std::int32_t  stop = end < wordEnd ? end : wordEnd;
    const std::uint64_t bits = (~std::uint64_t{ 0 } >> (64 - (stop - at))) << (at & 63);
    const auto          word = static_cast<std::size_t>(at) >> 6U;
    added += CountBits(bits & ~row[word]);
    row[word] |= bits;
    at = stop;
  }
  return added;
}

} // namespace voxelcore
