#pragma once
// Distances of the points of a cube to the nearest one whose bit is set in it or around it.

#include <algorithm>
#include <array>
#include <bit>
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

/** With the `squares` of the sides: kNone or more where no bit is set within the margin. */
template <std::int32_t Count, std::int32_t Margin>
[[gnu::always_inline]] inline void
FindSquaredDistances(const Rows<Count, Margin> & rows, const std::array<float, 3> & squares, Squared<Count> & least)
{
  constexpr std::int32_t side = Rows<Count, Margin>::kSide;
  // By x alone, by x and y, by all.
  float      byX[side * side][Count];
  float      byY[side * Count][Count];
  const auto lower = [](float * to, const float * from, float more) {
    for (std::int32_t x = 0; x < Count; ++x)
    {
      to[x] = std::min(to[x], from[x] + more);
    }
  };
  for (std::int32_t row = 0; row < side * side; ++row)
  {
    const std::uint64_t bits = rows.bits[static_cast<std::size_t>(row)];
    for (std::int32_t x = 0; x < Count; ++x)
    {
      const std::int32_t at = x + Margin;
      const std::int32_t away = std::min(std::countr_zero(bits >> at), std::countl_zero(bits << (63 - at)));
      byX[row][x] = away > Margin ? kNone : static_cast<float>(away * away) * squares[0];
    }
  }
  for (std::int32_t row = 0; row < side * Count; ++row)
  {
    std::fill_n(byY[row], Count, kNone);
    for (std::int32_t d = -Margin; d <= Margin; ++d)
    {
      lower(byY[row], byX[row / Count * side + row % Count + Margin + d], static_cast<float>(d * d) * squares[1]);
    }
  }
  std::fill(least.begin(), least.end(), kNone);
  for (std::int32_t row = 0; row < Count * Count; ++row)
  {
    for (std::int32_t d = -Margin; d <= Margin; ++d)
    {
      lower(least.data() + row * Count, byY[row + (Margin + d) * Count], static_cast<float>(d * d) * squares[2]);
    }
  }
}

} // namespace voxelcore::tile
