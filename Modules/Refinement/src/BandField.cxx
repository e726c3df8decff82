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
constexpr std::int32_t kTile = 2 * BrickGrid::kSide;
using LabelRows = tile::Rows<kTile, kMargin>;

VOXELCORE_EIGHT_LANES void
FindDistances(const LabelRows & rows, const std::array<float, 3> & squares, tile::Squared<kTile> & least)
{
  tile::FindSquaredDistances(rows, squares, least);
}

// Where the 8 x 4 x 4 values around a place are.
struct SplineBlocks
{
  std::array<const float *, 4> low;   ///< of two bricks along y, then z: half a brick, with the first four along x
  std::array<const float *, 4> high;  ///< the same of the four behind these
  std::array<std::uint32_t, 2> first; ///< of four rows along y and z, in the first of the bricks
  float                        x = 0; ///< where the place is among the eight
  std::array<float, 2>         rest;  ///< how far it is beyond the second of four along y and z
};

// Cubic B-splines. What is along y and z is summed first, for eight voxels along x at once, of which four count.
VOXELCORE_EIGHT_LANES void
SumRows(const SplineBlocks & blocks, std::array<float, 4> & valueAndSlopes)
{
  using Eight = float __attribute__((vector_size(32)));
  using Four = float __attribute__((vector_size(16)));
  constexpr float                     sixth = 1.0F / 6;
  std::array<std::array<float, 4>, 2> weight;
  std::array<std::array<float, 4>, 2> slope;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const float t = blocks.rest[axis];
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
  for (std::uint32_t z = 0; z < 4; ++z)
  {
    const std::uint32_t atZ = blocks.first[1] + z;
    Eight               ofPlane{};
    Eight               slopeOfPlane{};
    for (std::uint32_t y = 0; y < 4; ++y)
    {
      const std::uint32_t atY = blocks.first[0] + y;
      const std::uint32_t block = (atZ & 8) / 4 + (atY & 8) / 8;
      const std::uint32_t from = 64 * (atZ & 7) + 8 * (atY & 7);
      Four                low;
      Four                high;
      std::memcpy(&low, blocks.low[block] + from, sizeof(low));
      std::memcpy(&high, blocks.high[block] + from, sizeof(high));
      const Eight row = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
      ofPlane += weight[0][y] * row;
      slopeOfPlane += slope[0][y] * row;
    }
    sum += weight[1][z] * ofPlane;
    alongY += weight[1][z] * slopeOfPlane;
    alongZ += slope[1][z] * ofPlane;
  }
  // (2 - |u|)+^3 / 6 - 4 (1 - |u|)+^3 / 6, and its slope.
  const Eight u = Eight{ 0, 1, 2, 3, 4, 5, 6, 7 } - blocks.x;
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
  , m_Values(m_Grid.Count() * kVoxels)
{
  SetWidth(sigma);
  SetFar(0);
  FillFlags(shape);
  FindRowStarts();
}

BandField::BandField(const VoxelShape & shape, const BandField & other, const std::vector<std::uint8_t> & wanted)
  : m_Grid(shape, other.m_Grid, wanted)
  , m_Sides(other.m_Sides)
  , m_Gauss(other.m_Gauss)
  , m_Binomial(other.m_Binomial)
  , m_GaussToSpline(other.m_GaussToSpline)
  , m_In(m_Grid.Count())
  , m_Out(m_Grid.Count())
  , m_Values(m_Grid.Count() * kVoxels)
{
  SetFar(other.m_Far);
  FillFlags(shape);
  FindRowStarts();
}

void
BandField::FillFlags(const VoxelShape & shape)
{
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
}

void
BandField::FindRowStarts()
{
  for (std::size_t brick = 0; brick < m_Grid.Count(); ++brick)
  {
    const auto next = static_cast<std::uint32_t>(brick);
    if (brick == 0 || m_Grid.At(brick)[2] != m_Grid.At(brick - 1)[2])
    {
      m_Planes.push_back({ next, static_cast<std::uint32_t>(m_RowStarts.size()) });
    }
    if (m_Grid.Neighbours(brick)[BrickGrid::kSelf - 1] < 0)
    {
      m_RowStarts.push_back(next);
    }
  }
  m_Planes.push_back({ static_cast<std::uint32_t>(m_Grid.Count()), static_cast<std::uint32_t>(m_RowStarts.size()) });
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
  tile::ForTiles(
    m_Grid,
    std::vector<std::uint8_t>(m_Grid.Count(), 1),
    [&](const BrickGrid::Brick & tile, auto forBricks) {
      LabelRows in;
      LabelRows out;
      ReadRows(shape, { kTile * tile[0] - kMargin, kTile * tile[1] - kMargin, kTile * tile[2] - kMargin }, in, out);
      tile::Squared<kTile> toIn;
      tile::Squared<kTile> toOut;
      FindDistances(in, squares, toIn);
      FindDistances(out, squares, toOut);
      forBricks([&](std::size_t brick, const BrickGrid::Brick & part) {
        float * const values = m_Values.data() + brick * kVoxels;
        for (std::size_t row = 0; row < kVoxels; row += kSide)
        {
          const std::size_t from = tile::Place<kTile>(part, row);
          for (std::size_t x = 0; x < kSide; ++x)
          {
            const bool  inside = toIn[from + x] == 0;
            const float distance = std::min(std::sqrt(inside ? toOut[from + x] : toIn[from + x]) - half, m_Far);
            values[row + x] = inside ? distance : -distance;
          }
        }
      });
    });
}

bool
BandField::Evaluate(const Vector3 & place, double & value, Vector3 & gradient) const
{
  BrickGrid::Brick      first{}; // of four voxels along an axis
  std::array<double, 3> rest{};
  BrickGrid::Brick      home{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double at = place[axis] - 0.5; // in voxel indices, where centres are whole
    const auto   cut = static_cast<std::int32_t>(at);
    const auto   base = cut - (at < cut ? 1 : 0);
    first[axis] = base - 1;
    rest[axis] = at - base;
    home[axis] = base >> 3;
  }
  const std::int32_t found = m_Grid.Find(home);
  if (found < 0)
  {
    return false;
  }
  const auto & neighbours = m_Grid.Neighbours(static_cast<std::size_t>(found));
  const auto   brickOf = [&](std::size_t axis, std::int32_t voxel) {
    return static_cast<std::size_t>((voxel >> 3) - home[axis] + 1);
  };
  // Eight along x from the half of a brick on that the first of the four lies in.
  const auto        half = static_cast<std::size_t>(first[0] >> 2 & 1);
  const std::size_t low = brickOf(0, first[0]) + 3 * brickOf(1, first[1]) + 9 * brickOf(2, first[2]);
  SplineBlocks      blocks;
  for (std::size_t i = 0; i < 4; ++i)
  {
    const std::size_t beside = low + 3 * (i & 1) + 9 * (i >> 1);
    blocks.low[i] = Block(m_Coefficients, neighbours[beside]) + 4 * half;
    blocks.high[i] = Block(m_Coefficients, neighbours[beside + half]) + 4 * (1 - half);
  }
  blocks.first = { static_cast<std::uint32_t>(first[1] & 7), static_cast<std::uint32_t>(first[2] & 7) };
  blocks.x = static_cast<float>((first[0] & 3) + 1 + rest[0]);
  blocks.rest = { static_cast<float>(rest[1]), static_cast<float>(rest[2]) };
  std::array<float, 4> sums;
  SumRows(blocks, sums);
  value = sums[0];
  gradient = { sums[1], sums[2], sums[3] };
  return true;
}

} // namespace voxelcore
