#pragma once
// Values of a band field between its voxels: to be compiled into what is made for eight lanes.

#include "BandField.h"

#include "voxelcore/Base/EightLanes.h"

#include <array>
#include <cstdint>
#include <cstring>

namespace voxelcore
{

namespace spline
{

// A place among the 8 x 4 x 4 coefficients around it.
struct SplinePlace
{
  std::array<std::uint32_t, 2> first;      ///< of four rows along y and z, in the first of the bricks
  std::int32_t                 firstX = 0; ///< of four among eight along x
  float                        x = 0;      ///< where the place is among the eight
  std::array<float, 2>         rest;       ///< how far it is beyond the second of four along y and z
};

using Four = float __attribute__((vector_size(16)));
using Eight = EightFloats;

inline Four
FourAt(const float * from)
{
  Four four;
  std::memcpy(&four, from, sizeof(four));
  return four;
}

[[gnu::always_inline]] inline void
Join(const float * low, const float * high, Eight & joined)
{
  joined = __builtin_shufflevector(FourAt(low), FourAt(high), 0, 1, 2, 3, 4, 5, 6, 7);
}

// What rows along y and z count, and their slopes: by which of four, then y and z.
struct SplineWeights
{
  std::array<Four, 4> values;
  std::array<Four, 4> slopes;
};

[[gnu::always_inline]] inline SplineWeights
WeightsOf(const std::array<float, 2> & rest)
{
  constexpr float sixth = 1.0F / 6;
  const Four      t{ rest[0], rest[1], 0, 0 };
  const Four      s = 1.0F - t;
  return { { s * s * s * sixth,
             (4.0F - 3.0F * t * t * (1.0F + s)) * sixth,
             (4.0F - 3.0F * s * s * (1.0F + t)) * sixth,
             t * t * t * sixth },
           { -0.5F * s * s, (1.5F * t - 2.0F) * t, (2.0F - 1.5F * s) * s, 0.5F * t * t } };
}

// Cubic B-splines. What is along y and z is summed first, for four voxels along x and two planes at once.
[[gnu::always_inline]] inline void
SumRows(const BandField::Spot & spot, const SplinePlace & place, std::array<float, 4> & valueAndSlopes)
{
  using Lanes = std::int32_t __attribute__((vector_size(32)));
  constexpr float     sixth = 1.0F / 6;
  const SplineWeights weights = WeightsOf(place.rest);
  // Where the four rows along y are in the bricks before and behind along z.
  struct Halves
  {
    const float * low;
    const float * high;
  };
  Halves rows[2][4];
#pragma GCC unroll 2
  for (std::uint32_t z = 0; z < 2; ++z)
  {
#pragma GCC unroll 4
    for (std::uint32_t y = 0; y < 4; ++y)
    {
      const std::uint32_t atY = place.first[0] + y;
      const std::uint32_t block = 2 * z + (atY >> 3);
      const std::uint32_t from = 8 * (atY & 7);
      rows[z][y] = { spot.low[block] + from, spot.high[block] + from };
    }
  }
  std::array<Eight, 2> ofPlanes{};
  std::array<Eight, 2> slopesOfPlanes{};
  const auto           sumPlanes = [&](const auto & rowOf) __attribute__((always_inline))
  {
#pragma GCC unroll 2
    for (std::uint32_t two = 0; two < 2; ++two)
    {
      const std::uint32_t  lower = place.first[1] + 2 * two;
      const std::uint32_t  upper = lower + 1;
      const Halves * const inLower = rows[lower >> 3];
      const Halves * const inUpper = rows[upper >> 3];
#pragma GCC unroll 4
      for (std::uint32_t y = 0; y < 4; ++y)
      {
        Eight row;
        rowOf(inLower[y], 64 * (lower & 7), inUpper[y], 64 * (upper & 7), row);
        ofPlanes[two] += weights.values[y][0] * row;
        slopesOfPlanes[two] += weights.slopes[y][0] * row;
      }
    }
  };
  // The four begin with this one of the eight. Where these lie in one brick, so do the four beside each other; else,
  // of each two that are four apart the one that is among them.
  const std::int32_t first = place.firstX;
  Four               lanes{ 0, 1, 2, 3 };
  if (first == 0 || spot.corner < BandField::Spot::kApart)
  {
    lanes += static_cast<float>(first);
    sumPlanes([&](const Halves & lower,
                  std::uint32_t  fromLower,
                  const Halves & upper,
                  std::uint32_t  fromUpper,
                  Eight &        row) __attribute__((always_inline)) {
      Join(lower.low + fromLower + first, upper.low + fromUpper + first, row);
    });
  }
  else
  {
    const Lanes isHigh = Lanes{ 0, 1, 2, 3, 0, 1, 2, 3 } < first;
    lanes = __builtin_shufflevector(isHigh, isHigh, 0, 1, 2, 3) ? lanes + 4 : lanes;
    sumPlanes([&](const Halves & lower,
                  std::uint32_t  fromLower,
                  const Halves & upper,
                  std::uint32_t  fromUpper,
                  Eight &        row) __attribute__((always_inline)) {
      Eight high;
      Join(lower.low + fromLower, upper.low + fromUpper, row);
      Join(lower.high + fromLower, upper.high + fromUpper, high);
      row = isHigh ? high : row;
    });
  }
  Four sum{};
  Four alongY{};
  Four alongZ{};
#pragma GCC unroll 4
  for (std::size_t z = 0; z < 4; ++z)
  {
    const auto plane = [z](const Eight & planes) __attribute__((always_inline))
    {
      return z % 2 == 0 ? __builtin_shufflevector(planes, planes, 0, 1, 2, 3)
                        : __builtin_shufflevector(planes, planes, 4, 5, 6, 7);
    };
    const Four ofPlane = plane(ofPlanes[z / 2]);
    sum += weights.values[z][1] * ofPlane;
    alongY += weights.values[z][1] * plane(slopesOfPlanes[z / 2]);
    alongZ += weights.slopes[z][1] * ofPlane;
  }
  // (2 - |u|)+^3 / 6 - 4 (1 - |u|)+^3 / 6, and its slope.
  const Four u = lanes - place.x;
  const Four zero{};
  const Four away = u < 0 ? -u : u;
  const Four outer = away < 2 ? 2 - away : zero;
  const Four inner = away < 1 ? 1 - away : zero;
  const Four half = u < 0 ? zero - 0.5F : zero + 0.5F;
  const Four weightX = (outer * outer * outer - 4 * inner * inner * inner) * sixth;
  const Four slopeX = (outer * outer - 4 * inner * inner) * half;
  const Four a = sum * weightX;
  const Four b = sum * slopeX;
  const Four c = alongY * weightX;
  const Four d = alongZ * weightX;
  // Four sums of four at once: of those two apart first, so that it is the same which of them are first.
  const Four ab = __builtin_shufflevector(a, b, 0, 4, 1, 5) + __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Four cd = __builtin_shufflevector(c, d, 0, 4, 1, 5) + __builtin_shufflevector(c, d, 2, 6, 3, 7);
  const Four all = __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
  std::memcpy(valueAndSlopes.data(), &all, sizeof(all));
}

} // namespace spline

[[gnu::always_inline]] inline bool
BandField::Evaluate(const Vector3 & place, Spot & spot, double & value, Vector3 & gradient) const
{
  BrickGrid::Brick      first{}; // of four voxels along an axis
  std::array<double, 3> rest{};
  BrickGrid::Brick      home{};
  std::uint32_t         corner = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double at = place[axis] - 0.5; // in voxel indices, where centres are whole
    const auto   cut = static_cast<std::int32_t>(at);
    const auto   base = cut - (at < cut ? 1 : 0);
    first[axis] = base - 1;
    rest[axis] = at - base;
    home[axis] = base >> 3;
    corner |= static_cast<std::uint32_t>((first[axis] >> 3) - home[axis] + 1) << axis;
  }
  corner |= static_cast<std::uint32_t>(first[0] << 1 & 8);
  // One by one: a comparison of the arrays is a call for each place.
  const bool found =
    spot.brick >= 0 && ((spot.home[0] ^ home[0]) | (spot.home[1] ^ home[1]) | (spot.home[2] ^ home[2])) == 0;
  if (!found || spot.corner != corner)
  {
    spot.home = home;
    spot.brick = found ? spot.brick : m_Grid.Find(home);
    spot.corner = corner;
    if (spot.brick < 0)
    {
      return false;
    }
    FindBlocks(spot);
  }
  spline::SplinePlace at;
  at.first = { static_cast<std::uint32_t>(first[1] & 7), static_cast<std::uint32_t>(first[2] & 7) };
  at.firstX = first[0] & 3;
  at.x = static_cast<float>(at.firstX + 1 + rest[0]);
  at.rest = { static_cast<float>(rest[1]), static_cast<float>(rest[2]) };
  std::array<float, 4> sums;
  spline::SumRows(spot, at, sums);
  value = sums[0];
  gradient = { sums[1], sums[2], sums[3] };
  return true;
}

} // namespace voxelcore
