#pragma once
// How many bits of a word are set.

#include <bit>
#include <cstdint>

namespace voxelcore
{

/** As std::popcount, which is a call of a function where it is compiled for all processors: those from 2008 on do it in
 *  one step, and older ones lack it. */
inline std::uint32_t
CountBits(std::uint64_t word)
{
#if defined(__x86_64__) && !defined(__POPCNT__)
  word -= word >> 1U & 0x5555555555555555U;
  word = (word & 0x3333333333333333U) + (word >> 2U & 0x3333333333333333U);
  word = (word + (word >> 4U)) & 0x0F0F0F0F0F0F0F0FU;
  return static_cast<std::uint32_t>(word * 0x0101010101010101U >> 56U);
#else
  return static_cast<std::uint32_t>(std::popcount(word));
#endif
}

} // namespace voxelcore
