#include "CapScan.h"

#include "voxelcore/Base/EightLanes.h"

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
using Words = std::uint64_t __attribute__((vector_size(8 * lanes)));
using Places = std::uint16_t __attribute__((vector_size(2 * lanes)));
constexpr float margin = 1e-3F; // columns or rows, far more than single precision is off by within a box of 16

constexpr Integers numbers{ 0, 1, 2, 3, 4, 5, 6, 7 };

// By reference: what returns eight lanes would be called in two ways.
inline void
BoundBelow(Floats & value, float bound)
{
  const Floats bounds = bound + Floats{};
  value = value > bounds ? value : bounds;
}

inline void
BoundAbove(Floats & value, float bound)
{
  const Floats bounds = bound + Floats{};
  value = value < bounds ? value : bounds;
}

inline void
TakeRoots(Floats & value)
{
  for (std::int32_t lane = 0; lane < lanes; ++lane)
  {
    value[lane] = std::sqrt(value[lane]);
  }
}

// Of each layer of a cap's box, the rows that its ball meets.
struct LayerRows
{
  std::array<std::int32_t, 16> begin;
  std::array<std::int32_t, 16> end;
};

inline LayerRows
RowsOfLayers(const Cap & cap)
{
  LayerRows   layers;
  const float inverse = 1.0F / cap.weight[1];
  for (std::int32_t z = 0; z < 16; ++z)
  {
    const float dz = cap.weight[2] * (static_cast<float>(z) - cap.centre[2]);
    const float left = cap.radius2 - dz * dz;
    const float half = std::sqrt(std::max(left, 0.0F)) * inverse;
    const float to = left < 0.0F ? -1.0F : cap.centre[1] + half;
    // Truncation of positive numbers, as of columns in ScanCap().
    layers.begin[z] =
      static_cast<std::int32_t>(std::min(std::max(cap.centre[1] - half, 0.0F), 16.0F) + (1.0F - margin));
    layers.end[z] =
      std::min(static_cast<std::int32_t>(std::min(std::max(to, -1.0F), 15.0F) + (1.0F + margin)), cap.rowCount);
  }
  return layers;
}

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
  const float                   inverse = 1.0F / cap.weight[0];
  const LayerRows               layers = RowsOfLayers(cap);
  const std::uint64_t           columnsRead = std::uint64_t{ 0xFFFF } << cap.firstColumn;
  std::array<std::uint64_t, 65> bits; // of four rows each that have any
  std::array<std::uint16_t, 65> at;   // the place of the first
  std::size_t                   words = 0;
  for (std::int32_t z = 0; z < cap.layerCount; ++z)
  {
    const auto            layer = static_cast<float>(z);
    const float           dz = cap.weight[2] * (layer - cap.centre[2]);
    const float           left = cap.radius2 - dz * dz;
    const float           layerHeight = cap.cornerHeight + cap.normal[2] * layer;
    const std::uint64_t * rows = cap.rows + 64 * z;
    for (std::int32_t first = layers.begin[z]; first < layers.end[z]; first += lanes)
    {
      Words eight;
      std::memcpy(&eight, rows + first, sizeof(eight));
      std::uint64_t any = 0;
      for (std::int32_t lane = 0; lane < lanes; ++lane)
      {
        any |= eight[lane];
      }
      if ((any & columnsRead) == 0)
      {
        continue;
      }
      const Floats y = static_cast<float>(first) + __builtin_convertvector(numbers, Floats);
      const Floats dy = cap.weight[1] * (y - cap.centre[1]);
      const Floats rest = left - dy * dy;
      Floats       half = rest;
      BoundBelow(half, 0.0F);
      TakeRoots(half);
      half *= inverse;
      const Floats height = layerHeight + cap.normal[1] * y;
      const Floats fromPlane = fromBase + fromSlope * height;
      const Floats toPlane = toBase + toSlope * height;
      Floats       from = cap.centre[0] - half;
      Floats       to = cap.centre[0] + half;
      from = from > fromPlane ? from : fromPlane;
      to = to < toPlane ? to : toPlane;
      to = rest < 0.0F ? Floats{} - 1.0F : to;
      BoundBelow(from, 0.0F);
      BoundAbove(from, 16.0F);
      BoundBelow(to, -1.0F); // and it is no more than the ball's, below 31: bits beyond 16 are cut off in the end
      // Truncation of positive numbers, with less than 1 added before where it has to round up.
      const Integers               fromColumn = __builtin_convertvector(from + (1.0F - margin), Integers);
      const Integers               columns = __builtin_convertvector(to + (1.0F + margin), Integers);
      const Integers               row = __builtin_convertvector(eight >> cap.firstColumn, Integers);
      const Integers               own = row & (0xFFFF << fromColumn) & ((1 << columns) - 1);
      const Places                 narrow = __builtin_convertvector(own, Places);
      std::array<std::uint64_t, 2> four;
      std::memcpy(four.data(), &narrow, sizeof(four));
      for (std::size_t i = 0; i < 2; ++i)
      {
        bits[words] = four[i];
        at[words] = static_cast<std::uint16_t>(256 * z + 16 * first + 64 * static_cast<std::int32_t>(i));
        words += four[i] != 0 ? 1 : 0;
      }
    }
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < words; ++i)
  {
    for (std::uint64_t word = bits[i]; word != 0; word &= word - 1)
    {
      found.place[count++] = static_cast<std::uint16_t>(at[i] + std::countr_zero(word));
    }
  }

  // A sum of squares of numbers below 16 W is right to a few units of its last place, W the weight.
  constexpr float                  roundings = 8e-6F;
  constexpr float                  infinity = std::numeric_limits<float>::infinity();
  Floats                           leasts = infinity - Floats{};
  std::array<Floats, 4096 / lanes> lows; // what each vertex's value / height is at least
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
    const Integers isBeyond = (height > 0.0F) & (numbers < static_cast<std::int32_t>(count - first));
    const Floats   low = isBeyond ? (value - off) * inverseHeight : infinity - Floats{};
    const Floats   high = (value + off) * inverseHeight;
    leasts = (isBeyond & (high < leasts)) ? high : leasts;
    lows[first / lanes] = low;
  }
  float least = leasts[0];
  for (int lane = 1; lane < lanes; ++lane)
  {
    least = std::min(least, leasts[lane]);
  }
  std::size_t kept = 0;
  for (std::size_t first = 0; first < count; first += lanes)
  {
    // Where none is beyond the plane, nothing is less.
    std::uint32_t stay = least < infinity ? LanesOf(lows[first / lanes] <= least) : 0;
    for (; stay != 0; stay &= stay - 1)
    {
      found.place[kept++] = found.place[first + static_cast<std::size_t>(std::countr_zero(stay))];
    }
  }
  found.count = kept;
}

} // namespace voxelcore
