#include "BandField.h"

#include "DistanceTile.h"

#include "voxelcore/EightLanes.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace voxelcore
{

namespace
{

constexpr std::int32_t kMargin = 8; // voxels
using LabelRows = tile::Rows<BrickGrid::kSide, kMargin>;

VOXELCORE_EIGHT_LANES void
FindDistances(const LabelRows & rows, const std::array<float, 3> & squares, tile::Squared<BrickGrid::kSide> & least)
{
  tile::FindSquaredDistances(rows, squares, least);
}

// The 8 x 4 x 4 values around a place, rows by y, then by z: each as two of four beside each other along x.
struct SplineRows
{
  std::array<const float *, 16> low;
  std::array<const float *, 16> high;
  float                         x = 0; ///< where the place is in a row
  std::array<float, 2>          rest;  ///< how far it is beyond the second of four along y and z
};

// Cubic B-splines. What is along y and z is summed first, for eight voxels along x at once, of which four count.
VOXELCORE_EIGHT_LANES void
SumRows(const SplineRows & rows, std::array<float, 4> & valueAndSlopes)
{
  using Eight = float __attribute__((vector_size(32)));
  using Four = float __attribute__((vector_size(16)));
  constexpr float                     sixth = 1.0F / 6;
  std::array<std::array<float, 4>, 2> weight;
  std::array<std::array<float, 4>, 2> slope;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const float t = rows.rest[axis];
    const float s = 1.0F - t;
    weight[axis] = { s * s * s * sixth,
                     (4.0F - 3.0F * t * t * (1.0F + s)) * sixth,
                     (4.0F - 3.0F * s * s * (1.0F + t)) * sixth,
                     t * t * t * sixth };
    slope[axis] = { -0.5F * s * s, (1.5F * t - 2.0F) * t, (2.0F - 1.5F * s) * s, 0.5F * t * t };
  }
  Eight sum{};
  Eight alongY{};
  Eight alongZ{};
  for (std::size_t z = 0; z < 4; ++z)
  {
    Eight ofPlane{};
    Eight slopeOfPlane{};
    for (std::size_t y = 0; y < 4; ++y)
    {
      Four low;
      Four high;
      std::memcpy(&low, rows.low[4 * z + y], sizeof(low));
      std::memcpy(&high, rows.high[4 * z + y], sizeof(high));
      const Eight row = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
      ofPlane += weight[0][y] * row;
      slopeOfPlane += slope[0][y] * row;
    }
    sum += weight[1][z] * ofPlane;
    alongY += weight[1][z] * slopeOfPlane;
    alongZ += slope[1][z] * ofPlane;
  }
  // (2 - |u|)+^3 / 6 - 4 (1 - |u|)+^3 / 6, and its slope.
  const Eight u = Eight{ 0, 1, 2, 3, 4, 5, 6, 7 } - rows.x;
  const Eight zero{};
  const Eight away = u < 0 ? -u : u;
  const Eight outer = away < 2 ? 2 - away : zero;
  const Eight inner = away < 1 ? 1 - away : zero;
  const Eight half = u < 0 ? zero - 0.5F : zero + 0.5F;
  const Eight weightX = (outer * outer * outer - 4 * inner * inner * inner) * sixth;
  const Eight slopeX = (outer * outer - 4 * inner * inner) * half;
  const auto  four = [](const Eight & v) __attribute__((always_inline))
  {
    return __builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7);
  };
  const Four a = four(sum * weightX);
  const Four b = four(sum * slopeX);
  const Four c = four(alongY * weightX);
  const Four d = four(alongZ * weightX);
  // Four sums of four at once.
  const Four ab = __builtin_shufflevector(a, b, 0, 4, 1, 5) + __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Four cd = __builtin_shufflevector(c, d, 0, 4, 1, 5) + __builtin_shufflevector(c, d, 2, 6, 3, 7);
  const Four all = __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
  std::memcpy(valueAndSlopes.data(), &all, sizeof(all));
}

} // namespace

BandField::BandField(const VoxelShape &            shape,
                     std::span<const LatticePoint> points,
                     const Vector3 &               sides,
                     double                        sigma,
                     std::int32_t                  reach)
  : m_Grid(shape, points, 0, reach)
  , m_Sides(sides)
  , m_In(m_Grid.Count())
  , m_Out(m_Grid.Count())
  , m_Values(m_Grid.Count() * kVoxels, 0.0F)
{
  SetWidth(sigma);
  SetFar(0);
  const auto count = static_cast<std::ptrdiff_t>(m_Grid.Count());
#pragma omp parallel for schedule(static) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto & at = m_Grid.At(static_cast<std::size_t>(i));
    for (std::int32_t row = 0; row < kSide * kSide; ++row)
    {
      const std::uint64_t bits = BitsOfRow(shape, at[0] * kSide, at[1] * kSide + (row & 7), at[2] * kSide + (row >> 3));
      m_In[static_cast<std::size_t>(i)][static_cast<std::size_t>(row)] = static_cast<std::uint8_t>(bits);
      m_Out[static_cast<std::size_t>(i)][static_cast<std::size_t>(row)] = static_cast<std::uint8_t>(~bits);
    }
  }
  FindRowStarts();
}

void
BandField::FindRowStarts()
{
  for (std::size_t brick = 0; brick < m_Grid.Count(); ++brick)
  {
    for (std::size_t axis = 0, stride = 1; axis < 3; ++axis, stride *= 3)
    {
      if (m_Grid.Neighbours(brick)[BrickGrid::kSelf - stride] < 0)
      {
        m_RowStarts[axis].push_back(static_cast<std::uint32_t>(brick));
      }
    }
  }
}

void
BandField::SetFar(float far)
{
  m_Far = far;
  m_FarBlocks[0].fill(-far);
  m_FarBlocks[1].fill(far);
}

void
BandField::FillDistances(const VoxelShape & shape, double clip)
{
  SetFar(static_cast<float>(clip));
  const std::array<float, 3> squares = tile::AsFloats(Times(m_Sides, m_Sides));
  const float                half = 0.5F * static_cast<float>(std::min({ m_Sides[0], m_Sides[1], m_Sides[2] }));
  const auto                 count = static_cast<std::ptrdiff_t>(m_Grid.Count());
#pragma omp parallel for schedule(dynamic, 16) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto   brick = static_cast<std::size_t>(i);
    const auto & at = m_Grid.At(brick);
    LabelRows    in;
    LabelRows    out;
    ReadRows(shape, { kSide * at[0] - kMargin, kSide * at[1] - kMargin, kSide * at[2] - kMargin }, in, out);
    tile::Squared<BrickGrid::kSide> toIn;
    tile::Squared<BrickGrid::kSide> toOut;
    FindDistances(in, squares, toIn);
    FindDistances(out, squares, toOut);
    float * const values = m_Values.data() + brick * kVoxels;
    for (std::size_t voxel = 0; voxel < kVoxels; ++voxel)
    {
      const bool  inside = toIn[voxel] == 0;
      const float distance = std::min(std::sqrt(inside ? toOut[voxel] : toIn[voxel]) - half, m_Far);
      values[voxel] = inside ? distance : -distance;
    }
  }
}

bool
BandField::Evaluate(const Vector3 & place, double & value, Vector3 & gradient) const
{
  BrickGrid::Brick      base{}; // in voxel indices, where centres are whole
  std::array<double, 3> rest{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double at = place[axis] - 0.5;
    const double floor = std::floor(at);
    base[axis] = static_cast<std::int32_t>(floor);
    rest[axis] = at - floor;
  }
  const BrickGrid::Brick home{ base[0] >> 3, base[1] >> 3, base[2] >> 3 };
  const std::int32_t     found = m_Grid.Find(home);
  if (found < 0)
  {
    return false;
  }
  const auto & neighbours = m_Grid.Neighbours(static_cast<std::size_t>(found));
  // Eight along x from the half of a brick on that the first of the four lies in.
  const std::int32_t first = base[0] - 1;
  const std::int32_t low = first >> 2;
  const auto         lowHalf = static_cast<std::size_t>(low & 1);
  const auto         lowBrick = static_cast<std::size_t>((low >> 1) - home[0] + 1);
  const auto         highBrick = lowBrick + lowHalf;
  SplineRows         rows;
  rows.x = static_cast<float>((first & 3) + 1 + rest[0]);
  rows.rest = { static_cast<float>(rest[1]), static_cast<float>(rest[2]) };
  for (std::int32_t z = 0, r = 0; z < 4; ++z)
  {
    const std::int32_t atZ = base[2] - 1 + z;
    for (std::int32_t y = 0; y < 4; ++y, ++r)
    {
      const std::int32_t atY = base[1] - 1 + y;
      const auto beside = static_cast<std::size_t>(3 * ((atY >> 3) - home[1] + 1) + 9 * ((atZ >> 3) - home[2] + 1));
      const auto row = static_cast<std::size_t>(kSide * (atY & 7) + kSide * kSide * (atZ & 7));
      rows.low[static_cast<std::size_t>(r)] = Block(m_Coefficients, neighbours[lowBrick + beside]) + row + 4 * lowHalf;
      rows.high[static_cast<std::size_t>(r)] =
        Block(m_Coefficients, neighbours[highBrick + beside]) + row + 4 * (1 - lowHalf);
    }
  }
  std::array<float, 4> sums;
  SumRows(rows, sums);
  value = sums[0];
  gradient = { sums[1], sums[2], sums[3] };
  return true;
}

} // namespace voxelcore
