#pragma once
// VOXELCORE_EIGHT_LANES before a function makes it twice: for processors with eight lanes of 32 bits, and for others.
// Which one is chosen when the program starts; sanitizers are not ready that early, so that with them it is the other
// one. Both do the same additions and products in the same order, so results are the same bits.

#include <cstdint>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#  define VOXELCORE_SANITIZED
#elif defined(__has_feature)
#  if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#    define VOXELCORE_SANITIZED
#  endif
#endif
namespace voxelcore
{

using EightFloats = float __attribute__((vector_size(32)));
using EightIntegers = std::int32_t __attribute__((vector_size(32)));

/** Eight floats that may lie wherever a float may. A structure, as both compilers drop aligned() of an alias: clang
 *  after the =, GCC where a type is deduced, such as what a lambda returns. */
struct [[gnu::packed, gnu::may_alias]] EightAnywhere
{
  EightFloats lanes;
};
static_assert(alignof(EightAnywhere) == 1 && sizeof(EightAnywhere) == 8 * sizeof(float));

/** The eight that begin there. */
inline const EightAnywhere *
EightAt(const float * from)
{
  return reinterpret_cast<const EightAnywhere *>(from);
}
inline EightAnywhere *
EightAt(float * from)
{
  return reinterpret_cast<EightAnywhere *>(from);
}

/** Four doubles, likewise. */
using FourDoubles = double __attribute__((vector_size(32)));
struct [[gnu::packed, gnu::may_alias]] FourAnywhere
{
  FourDoubles lanes;
};

inline const FourAnywhere *
FourAt(const double * from)
{
  return reinterpret_cast<const FourAnywhere *>(from);
}

/** Bit i for each lane i that is true, which is -1. */
inline std::uint32_t
LanesOf(const EightIntegers & isTrue)
{
  constexpr EightIntegers bits{ 1, 2, 4, 8, 16, 32, 64, 128 };
  EightIntegers           sum = isTrue & bits;
  sum |= __builtin_shufflevector(sum, sum, 4, 5, 6, 7, 0, 1, 2, 3);
  sum |= __builtin_shufflevector(sum, sum, 2, 3, 0, 1, 6, 7, 4, 5);
  sum |= __builtin_shufflevector(sum, sum, 1, 0, 3, 2, 5, 4, 7, 6);
  return static_cast<std::uint32_t>(sum[0]);
}

} // namespace voxelcore

#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(VOXELCORE_SANITIZED)
#  define VOXELCORE_EIGHT_LANES __attribute__((target_clones("avx2", "default")))
#else
#  define VOXELCORE_EIGHT_LANES
#endif
