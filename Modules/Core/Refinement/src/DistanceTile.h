#pragma once
// Distances of the points of a cube to the nearest one whose bit is set in it or around it.

#include "BrickGrid.h"

#include "voxelcore/Base/EightLanes.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Lattice/ImageGeometry.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

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

/** Along a row alone, squared. */
template <std::int32_t Count, std::int32_t Margin>
[[gnu::always_inline]] inline void
FindAlongRow(std::uint64_t bits, float square, float * squared)
{
  if (bits == 0)
  {
    std::fill_n(squared, Count, kNone);
    return;
  }
  // A point is as far away as the first dilation that holds it: all points at once, a byte each.
  static_assert(Count <= 32);
  using Bytes = std::uint8_t __attribute__((vector_size(32)));
  using Words = std::uint64_t __attribute__((vector_size(32)));
  constexpr std::uint64_t eight = 0x8040201008040201;
  constexpr std::uint64_t all = (std::uint64_t{ 1 } << Count) - 1;
  Bytes                   away{};
  for (std::int32_t d = 0; d <= Margin; ++d)
  {
    const std::uint64_t some = bits >> Margin & all;
    if (some == all)
    {
      break;
    }
    const auto four = reinterpret_cast<Bytes>(Words{ some, some, some, some });
    // clang-format off
    const Bytes spread = __builtin_shufflevector(four, four, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1,
                                                 18, 18, 18, 18, 18, 18, 18, 18, 19, 19, 19, 19, 19, 19, 19, 19);
    // clang-format on
    away -= reinterpret_cast<Bytes>((spread & reinterpret_cast<Bytes>(Words{ eight, eight, eight, eight })) == 0);
    bits |= bits << 1 | bits >> 1;
  }
  using Eight = float __attribute__((vector_size(32)));
  using Integers = std::int32_t __attribute__((vector_size(32)));
  using EightBytes = std::uint8_t __attribute__((vector_size(8)));
  for (std::size_t x = 0; x < Count; x += 8)
  {
    EightBytes some;
    std::memcpy(&some, reinterpret_cast<const std::uint8_t *>(&away) + x, sizeof(some));
    const Integers d = __builtin_convertvector(some, Integers);
    const Eight    found = __builtin_convertvector(d * d, Eight) * square;
    const Eight    kept = d > Margin ? Eight{} + kNone : found;
    std::memcpy(squared + x, &kept, sizeof(kept));
  }
}

/** With the `squares` of the sides: kNone or more where no bit is set within the margin. */
template <std::int32_t Count, std::int32_t Margin>
[[gnu::always_inline]] inline void
FindSquaredDistances(const Rows<Count, Margin> & rows, const std::array<float, 3> & squares, Squared<Count> & least)
{
  constexpr std::int32_t side = Rows<Count, Margin>::kSide;
  // From near to far, as long as what is farther may still be less; has(d): whether anything is so far away.
  using Eight = EightFloats;
  using Words = std::uint64_t __attribute__((vector_size(32)));
  const auto lowerAll = [](float * to, const auto & from, float square, const auto & has) __attribute__((always_inline))
  {
    constexpr std::size_t parts = Count / 8;
    Eight                 nearest[parts];
    for (std::size_t i = 0; i < parts; ++i)
    {
      nearest[i] = EightAt(from(0) + 8 * i)->lanes;
    }
    for (std::int32_t d = 1; d <= Margin; ++d)
    {
      if (!has(d))
      {
        continue;
      }
      const float more = static_cast<float>(d * d) * square;
      Words       open{};
      for (std::size_t i = 0; i < parts; ++i)
      {
        open |= reinterpret_cast<Words>(nearest[i] > more);
      }
      if ((open[0] | open[1] | open[2] | open[3]) == 0)
      {
        break;
      }
      const float * const before = from(-d);
      const float * const after = from(d);
      for (std::size_t i = 0; i < parts; ++i)
      {
        const Eight one = EightAt(before + 8 * i)->lanes;
        const Eight other = EightAt(after + 8 * i)->lanes;
        const Eight nearer = (one < other ? one : other) + more;
        nearest[i] = nearer < nearest[i] ? nearer : nearest[i];
      }
    }
    for (std::size_t i = 0; i < parts; ++i)
    {
      EightAt(to + 8 * i)->lanes = nearest[i];
    }
  };
  // By x alone, of a layer; by x and y.
  float         byX[side][Count];
  float         byY[side * Count][Count];
  std::uint64_t layers[side]; // all of their bits
  for (std::int32_t z = 0; z < side; ++z)
  {
    const std::uint64_t * const bits = rows.bits.data() + z * side;
    layers[z] = 0;
    for (std::int32_t y = 0; y < side; ++y)
    {
      layers[z] |= bits[y];
    }
    if (layers[z] == 0)
    {
      std::fill_n(byY[z * Count], Count * Count, kNone);
      continue;
    }
    for (std::int32_t y = 0; y < side; ++y)
    {
      FindAlongRow<Count, Margin>(bits[y], squares[0], byX[y]);
    }
    for (std::int32_t y = 0; y < Count; ++y)
    {
      const std::int32_t middle = y + Margin;
      lowerAll(
        byY[z * Count + y],
        [&](std::int32_t d) { return byX[middle + d]; },
        squares[1],
        [&](std::int32_t d) { return (bits[middle - d] | bits[middle + d]) != 0; });
    }
  }
  for (std::int32_t row = 0; row < Count * Count; ++row)
  {
    const auto * const          middle = byY + (row + Margin * Count);
    const std::uint64_t * const layer = layers + row / Count + Margin;
    lowerAll(
      least.data() + row * Count,
      [&](std::int32_t d) { return middle[d * Count]; },
      squares[2],
      [&](std::int32_t d) { return (layer[-d] | layer[d]) != 0; });
  }
}

/** Where a row of a brick begins in a tile of so many voxels a side; `part` is 0 or 1 along each axis. */
template <std::int32_t Count>
std::size_t
Place(const BrickGrid::Brick & part, std::size_t row)
{
  constexpr std::size_t half = Count / 2;
  const auto            at = [&](std::size_t axis) { return half * static_cast<std::size_t>(part[axis]); };
  return at(0) + Count * (at(1) + (row >> 3 & 7) + Count * (at(2) + (row >> 6)));
}

/** What a thread needs for one cube after the other. */
template <std::int32_t Count, std::int32_t Margin>
struct Cube
{
  Rows<Count, Margin> in; ///< the shape
  Rows<Count, Margin> out;
  Squared<Count>      toIn;
  Squared<Count>      toOut;
};

/** Cubes of 2^3 bricks that hold one that is needed: use(tile, cube, forBricks), in units of such cubes, in any order,
 *  with a TCube of the thread's own; forBricks(useBrick) calls useBrick(brick, part) of each one that is needed, with 0
 *  or 1 along each axis. */
template <typename TCube, typename TUse>
void
ForTiles(const BrickGrid & grid, const std::vector<std::uint8_t> & needed, TUse use)
{
  std::vector<BrickGrid::Brick> tiles;
  for (std::size_t brick = 0; brick < grid.Count(); ++brick)
  {
    if (const auto & at = grid.At(brick); needed[brick] != 0)
    {
      tiles.push_back({ at[2] >> 1, at[1] >> 1, at[0] >> 1 });
    }
  }
  std::sort(tiles.begin(), tiles.end());
  tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
  const auto   count = static_cast<std::ptrdiff_t>(tiles.size());
  FirstFailure failure;
#pragma omp parallel if (count > BrickGrid::kMany / 8)
  {
    std::unique_ptr<TCube> cube;
    failure.Guard(0, [&] { cube = std::make_unique<TCube>(); });
#pragma omp for schedule(dynamic, 2)
    for (std::ptrdiff_t i = 0; i < count; ++i)
    {
      if (failure.HasFailed()) // there may be no cube
      {
        continue;
      }
      const auto & tile = tiles[static_cast<std::size_t>(i)];
      const auto   x = tile[2];
      const auto   y = tile[1];
      const auto   z = tile[0];
      use(BrickGrid::Brick{ x, y, z }, *cube, [&](auto useBrick) {
        for (std::int32_t n = 0; n < 8; ++n)
        {
          const BrickGrid::Brick part{ n & 1, n >> 1 & 1, n >> 2 };
          const std::int32_t     brick = grid.Find({ 2 * x + part[0], 2 * y + part[1], 2 * z + part[2] });
          if (brick >= 0 && needed[static_cast<std::size_t>(brick)] != 0)
          {
            useBrick(static_cast<std::size_t>(brick), part);
          }
        }
      });
    }
  }
  failure.Rethrow();
}

} // namespace voxelcore::tile
