#pragma once
// Distances of the points of a cube to the nearest one whose bit is set in it or around it.

#include "voxelcore/ImageGeometry.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace voxelcore::tile
{

inline constexpr float kNone = 1e6F;

/** Rows of bits along x: `Count` points along each axis, and `Margin` beside them. */
template <std::int32_t Count, std::int32_t Margin>
struct Rows
{
  static constexpr std::int32_t kSide = Count + 2 * Margin;
  static_assert(kSide <= 64);
  std::array<std::uint64_t, static_cast<std::size_t>(kSide) * kSide> bits{};
};

/** Of each point, by x, then y, then z. */
template <std::int32_t Count>
using Squared = std::array<float, static_cast<std::size_t>(Count) * Count * Count>;

inline std::array<float, 3>
AsFloats(const Vector3 & v)
{
  return { static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]) };
}

/** With the `squares` of the sides: kNone or more where no bit is set within the margin. */
template <std::int32_t Count, std::int32_t Margin>
[[gnu::always_inline]] inline void
FindSquaredDistances(const Rows<Count, Margin> & rows, const std::array<float, 3> & squares, Squared<Count> & least)
{
  constexpr std::int32_t side = Rows<Count, Margin>::kSide;
  // By x alone, by x and y, by all.
  float byX[side * side][Count];
  float byY[side * Count][Count];
  for (std::int32_t row = 0; row < side * side; ++row)
  {
    const std::uint64_t bits = rows.bits[static_cast<std::size_t>(row)];
    if (bits == 0)
    {
      std::fill_n(byX[row], Count, kNone);
      continue;
    }
    // A point is as far away as the first dilation that holds it: eight points at once.
    using Eight = std::int32_t __attribute__((vector_size(32)));
    constexpr Eight              single{ 1, 2, 4, 8, 16, 32, 64, 128 };
    constexpr std::uint64_t      all = (std::uint64_t{ 1 } << Count) - 1;
    std::array<Eight, Count / 8> away{};
    std::uint64_t                reached = bits;
    for (std::int32_t d = 0; d <= Margin && (reached >> Margin & all) != all; ++d)
    {
      for (std::int32_t part = 0; part < Count / 8; ++part)
      {
        const auto some = static_cast<std::int32_t>(reached >> (Margin + 8 * part) & 0xFF);
        away[static_cast<std::size_t>(part)] -= (single & some) == 0;
      }
      reached |= reached << 1 | reached >> 1;
    }
    for (std::int32_t x = 0; x < Count; ++x)
    {
      const std::int32_t d = away[static_cast<std::size_t>(x / 8)][x % 8];
      byX[row][x] = d > Margin ? kNone : static_cast<float>(d * d) * squares[0];
    }
  }
  // From near to far, as long as what is farther may still be less.
  const auto lowerAll = [](float * to, const auto & from, float square) {
    std::copy_n(from(0), Count, to);
    for (std::int32_t d = 1; d <= Margin; ++d)
    {
      const float  more = static_cast<float>(d * d) * square;
      std::int32_t open = 0;
      for (std::int32_t x = 0; x < Count; ++x)
      {
        open |= to[x] > more ? 1 : 0;
      }
      if (open == 0)
      {
        break;
      }
      const float * const before = from(-d);
      const float * const after = from(d);
      for (std::int32_t x = 0; x < Count; ++x)
      {
        to[x] = std::min(to[x], std::min(before[x], after[x]) + more);
      }
    }
  };
  for (std::int32_t row = 0; row < side * Count; ++row)
  {
    const auto * const middle = byX + (row / Count * side + row % Count + Margin);
    lowerAll(
      byY[row],
      [&](std::int32_t d) { return middle[d]; },
      squares[1]);
  }
  for (std::int32_t row = 0; row < Count * Count; ++row)
  {
    const auto * const middle = byY + (row + Margin * Count);
    lowerAll(
      least.data() + row * Count,
      [&](std::int32_t d) { return middle[d * Count]; },
      squares[2]);
  }
}

} // namespace voxelcore::tile
