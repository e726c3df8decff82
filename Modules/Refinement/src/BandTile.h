#pragma once
// A brick of a band field and what lies up to 16 voxels beside it, as rows of bits.

#include "BandField.h"

#include <algorithm>
#include <bit>

namespace voxelcore::tile
{

inline constexpr std::int32_t kMargin = 16; ///< voxels, two bricks
inline constexpr std::int32_t kSide = BandField::kSide + 2 * kMargin;
inline constexpr double       kNone = 1e6;
using Rows = std::array<std::uint64_t, static_cast<std::size_t>(kSide) * kSide>;

/** Squared distances of the brick's voxels to the nearest one whose bit is set, kNone or more where there is none within
 *  the margin; `squares` of a voxel's sides. */
inline std::array<double, BandField::kVoxels>
SquaredDistances(const Rows & rows, const Vector3 & squares)
{
  constexpr std::int32_t    brick = BandField::kSide;
  constexpr std::size_t     width = brick;
  std::array<double, width> none;
  none.fill(kNone);
  // By x alone, by x and y, by all.
  std::array<std::array<double, width>, static_cast<std::size_t>(kSide) * kSide> byX;
  for (std::size_t row = 0; row < rows.size(); ++row)
  {
    for (std::int32_t x = 0; x < brick; ++x)
    {
      const std::int32_t up = std::countr_zero(rows[row] >> (x + kMargin));
      const std::int32_t down = std::countl_zero(rows[row] << (63 - x - kMargin));
      const std::int32_t d = std::min(up, down);
      byX[row][static_cast<std::size_t>(x)] = d > kMargin ? kNone : d * d * squares[0];
    }
  }
  std::array<std::array<double, width>, static_cast<std::size_t>(kSide) * brick> byY;
  for (std::int32_t z = 0; z < kSide; ++z)
  {
    for (std::int32_t y = 0; y < brick; ++y)
    {
      auto & to = byY[static_cast<std::size_t>(z * brick + y)];
      to = none;
      for (std::int32_t d = -kMargin; d <= kMargin; ++d)
      {
        const auto & from = byX[static_cast<std::size_t>(z * kSide + y + kMargin + d)];
        for (std::size_t x = 0; x < width; ++x)
        {
          to[x] = std::min(to[x], from[x] + d * d * squares[1]);
        }
      }
    }
  }
  std::array<double, BandField::kVoxels> least;
  least.fill(kNone);
  for (std::int32_t z = 0; z < brick; ++z)
  {
    for (std::int32_t y = 0; y < brick; ++y)
    {
      double * const to = least.data() + static_cast<std::size_t>((z * brick + y) * brick);
      for (std::int32_t d = -kMargin; d <= kMargin; ++d)
      {
        const auto & from = byY[static_cast<std::size_t>((z + kMargin + d) * brick + y)];
        for (std::size_t x = 0; x < width; ++x)
        {
          to[x] = std::min(to[x], from[x] + d * d * squares[2]);
        }
      }
    }
  }
  return least;
}

} // namespace voxelcore::tile
