#include "CapScan.h"

#include "voxelcore/EightLanes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace voxelcore
{

namespace
{
constexpr std::int32_t lanes = 8;
using Floats = float __attribute__((vector_size(4 * lanes)));
using Integers = std::int32_t __attribute__((vector_size(4 * lanes)));
using Places = std::uint16_t __attribute__((vector_size(2 * lanes)));
constexpr float margin = 1e-3F; // columns, far more than single precision is off by within a box of 16
} // namespace

VOXELCORE_EIGHT_LANES void
ScanCap(const Cap & cap, CapVertices & found)
{
  // Where the height is positive is a bound of x from one side, linear in the height at x = 0: from below or from
  // above, or all or nothing. Heights are integers below 2^24, so exact.
  float fromBase = -1.0F;
  float fromSlope = 0.0F;
  float toBase = 17.0F;
  float toSlope = 0.0F;
  if (cap.normal[0] > 0.0F)
  {
    fromBase = 0.0F;
    fromSlope = -1.0F / cap.normal[0];
  }
  else if (cap.normal[0] < 0.0F)
  {
    toBase = 0.0F;
    toSlope = -1.0F / cap.normal[0];
  }
  else
  {
    toBase = -20.0F;
    toSlope = 40.0F;
  }
  const float                                inverse = 1.0F / cap.weight[0];
  const std::int32_t                         rowsRead = (cap.rowCount + lanes - 1) / lanes * lanes;
  alignas(64) std::array<std::uint16_t, 256> bits;
  for (std::int32_t z = 0; z < cap.layerCount; ++z)
  {
    const auto            layer = static_cast<float>(z);
    const float           dz = cap.weight[2] * (layer - cap.centre[2]);
    const float           left = cap.radius2 - dz * dz;
    const float           layerHeight = cap.cornerHeight + cap.normal[2] * layer;
    const std::uint64_t * rows = cap.rows + 64 * z;
    std::uint16_t *       own = bits.data() + 16 * z;
    for (std::int32_t first = 0; first < rowsRead; first += lanes)
    {
      std::array<std::uint32_t, lanes> wide; // as wide as the lanes are, then narrow
      for (std::int32_t lane = 0; lane < lanes; ++lane)
      {
        const auto  y = static_cast<float>(first + lane);
        const float dy = cap.weight[1] * (y - cap.centre[1]);
        const float rest = left - dy * dy;
        const float half = std::sqrt(std::max(rest, 0.0F)) * inverse;
        const float height = layerHeight + cap.normal[1] * y;
        float       from = std::max(cap.centre[0] - half, fromBase + fromSlope * height);
        float       to = std::min(cap.centre[0] + half, toBase + toSlope * height);
        to = rest < 0.0F ? -1.0F : to;
        // Truncation of positive numbers, with less than 1 added before where it has to round up.
        from = std::min(std::max(from, 0.0F), 16.0F) + (1.0F - margin);
        to = std::min(std::max(to, -1.0F), 15.0F) + (1.0F + margin);
        const auto          fromColumn = static_cast<std::int32_t>(from);
        const auto          columns = static_cast<std::int32_t>(to);
        const auto          row = static_cast<std::uint32_t>(rows[first + lane] >> cap.firstColumn);
        const std::uint32_t mask = (0xFFFFU << fromColumn) & ((1U << columns) - 1U);
        wide[lane] = row & mask;
      }
      for (std::int32_t lane = 0; lane < lanes; ++lane)
      {
        own[first + lane] = static_cast<std::uint16_t>(wide[lane]);
      }
    }
  }
  std::size_t count = 0;
  for (std::int32_t z = 0; z < cap.layerCount; ++z)
  {
    for (std::int32_t four = 0; four < rowsRead; four += 4)
    {
      const std::int32_t at = 16 * z + four;
      std::uint64_t      word = 0;
      std::memcpy(&word, bits.data() + at, sizeof(word));
      for (; word != 0; word &= word - 1)
      {
        found.place[count++] = static_cast<std::uint16_t>(16 * at + std::countr_zero(word));
      }
    }
  }
  found.count = count;

  // A sum of squares of numbers below 16 W is right to a few units of its last place, W the weight.
  constexpr float    roundings = 8e-6F;
  constexpr float    infinity = std::numeric_limits<float>::infinity();
  Floats             leasts = infinity - Floats{};
  constexpr Integers numbers{ 0, 1, 2, 3, 4, 5, 6, 7 };
  for (std::size_t first = 0; first < count; first += lanes)
  {
    Places read;
    std::memcpy(&read, found.place.data() + first, sizeof(read));
    const Integers places = __builtin_convertvector(read, Integers);
    const Floats   x = __builtin_convertvector(places & 15, Floats);
    const Floats   y = __builtin_convertvector((places >> 4) & 15, Floats);
    const Floats   z = __builtin_convertvector(places >> 8, Floats);
    const Floats   dx = cap.weight[0] * (x - cap.middle[0]);
    const Floats   dy = cap.weight[1] * (y - cap.middle[1]);
    const Floats   dz = cap.weight[2] * (z - cap.middle[2]);
    const Floats   height = cap.cornerHeight + cap.normal[0] * x + cap.normal[1] * y + cap.normal[2] * z;
    const Floats   square = dx * dx + dy * dy + dz * dz;
    const Floats   off = roundings * (square + cap.circle2);
    const Floats   value = square - cap.circle2;
    const Floats   inverseHeight = 1.0F / height;
    const Integers isBeyond = height > 0.0F;
    const Floats   low = isBeyond ? (value - off) * inverseHeight : infinity - Floats{};
    const Floats   high = (value + off) * inverseHeight;
    const Integers bounds = isBeyond & (numbers < static_cast<std::int32_t>(count - first)) & (high < leasts);
    leasts = bounds ? high : leasts;
    std::memcpy(found.low.data() + first, &low, sizeof(low));
  }
  float least = leasts[0];
  for (int lane = 1; lane < lanes; ++lane)
  {
    least = std::min(least, leasts[lane]);
  }
  found.least = least;
}

} // namespace voxelcore
