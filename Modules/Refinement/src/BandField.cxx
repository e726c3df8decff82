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

// Of the four voxels on either side of a place along each axis.
struct SplineWeights
{
  std::array<std::array<float, 4>, 3> value;
  std::array<std::array<float, 4>, 3> slope;
};

// Rows by y, then by z. What is along y and z is summed first, for the four of two rows side by side.
VOXELCORE_EIGHT_LANES void
SumRows(const std::array<const float *, 16> & rows, const SplineWeights & weights, double & value, Vector3 & gradient)
{
  using Eight = float __attribute__((vector_size(32)));
  const auto &               y = weights.value[1];
  const auto &               dy = weights.slope[1];
  const std::array<Eight, 2> valueY{ Eight{ y[0], y[0], y[0], y[0], y[1], y[1], y[1], y[1] },
                                     Eight{ y[2], y[2], y[2], y[2], y[3], y[3], y[3], y[3] } };
  const std::array<Eight, 2> slopeY{ Eight{ dy[0], dy[0], dy[0], dy[0], dy[1], dy[1], dy[1], dy[1] },
                                     Eight{ dy[2], dy[2], dy[2], dy[2], dy[3], dy[3], dy[3], dy[3] } };
  Eight                      sum{};
  Eight                      alongY{};
  Eight                      alongZ{};
  for (std::size_t z = 0; z < 4; ++z)
  {
    std::array<Eight, 2> pairs;
    for (std::size_t i = 0; i < 2; ++i)
    {
      std::memcpy(&pairs[i], rows[4 * z + 2 * i], 4 * sizeof(float));
      std::memcpy(reinterpret_cast<char *>(&pairs[i]) + 4 * sizeof(float), rows[4 * z + 2 * i + 1], 4 * sizeof(float));
    }
    const Eight ofPlane = valueY[0] * pairs[0] + valueY[1] * pairs[1];
    const Eight slopeOfPlane = slopeY[0] * pairs[0] + slopeY[1] * pairs[1];
    sum += weights.value[2][z] * ofPlane;
    alongY += weights.value[2][z] * slopeOfPlane;
    alongZ += weights.slope[2][z] * ofPlane;
  }
  std::array<float, 4> along{};
  for (std::size_t x = 0; x < 4; ++x)
  {
    along[0] += weights.value[0][x] * (sum[x] + sum[x + 4]);
    along[1] += weights.slope[0][x] * (sum[x] + sum[x + 4]);
    along[2] += weights.value[0][x] * (alongY[x] + alongY[x + 4]);
    along[3] += weights.value[0][x] * (alongZ[x] + alongZ[x + 4]);
  }
  value = along[0];
  gradient = { along[1], along[2], along[3] };
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
  std::array<float, 3> squares{};
  std::transform(m_Sides.begin(), m_Sides.end(), squares.begin(), [](double side) {
    return static_cast<float>(side * side);
  });
  const float half = 0.5F * static_cast<float>(std::min({ m_Sides[0], m_Sides[1], m_Sides[2] }));
  const auto  count = static_cast<std::ptrdiff_t>(m_Grid.Count());
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
  BrickGrid::Brick base{};
  SplineWeights    weights;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double    at = place[axis] - 0.5; // in voxel indices, where centres are whole
    const double    floor = std::floor(at);
    const auto      t = static_cast<float>(at - floor);
    const float     s = 1.0F - t;
    constexpr float sixth = 1.0F / 6;
    base[axis] = static_cast<std::int32_t>(floor);
    weights.value[axis] = { s * s * s * sixth,
                            (4.0F - 3.0F * t * t * (1.0F + s)) * sixth,
                            (4.0F - 3.0F * s * s * (1.0F + t)) * sixth,
                            t * t * t * sixth };
    weights.slope[axis] = { -0.5F * s * s, (1.5F * t - 2.0F) * t, (2.0F - 1.5F * s) * s, 0.5F * t * t };
  }
  const BrickGrid::Brick home{ base[0] >> 3, base[1] >> 3, base[2] >> 3 };
  const std::int32_t     found = m_Grid.Find(home);
  if (found < 0)
  {
    return false;
  }
  const auto & neighbours = m_Grid.Neighbours(static_cast<std::size_t>(found));
  // Of the four rows along y and z where they are in a brick, and which of two bricks beside each other they are in.
  std::array<std::array<std::size_t, 4>, 2> within{};
  std::array<std::array<std::size_t, 4>, 2> beside{};
  for (std::size_t axis = 1; axis < 3; ++axis)
  {
    const std::size_t stride = axis == 1 ? kSide : kSide * kSide;
    const std::size_t apart = axis == 1 ? 3 : 9;
    for (std::size_t i = 0; i < 4; ++i)
    {
      const std::int32_t at = base[axis] - 1 + static_cast<std::int32_t>(i);
      within[axis - 1][i] = stride * static_cast<std::size_t>(at & 7);
      beside[axis - 1][i] = apart * static_cast<std::size_t>((at >> 3) - home[axis] + 1);
    }
  }
  // The rows of four as they lie, or put together from two bricks.
  std::array<const float *, 16> rows;
  std::array<float, 128>        mixed;
  const auto                    first = static_cast<std::size_t>((base[0] - 1) & 7);
  const std::size_t             left = base[0] - 1 < kSide * home[0] ? 0 : 1;
  for (std::size_t z = 0, r = 0; z < 4; ++z)
  {
    for (std::size_t y = 0; y < 4; ++y, ++r)
    {
      const std::size_t   middle = left + beside[0][y] + beside[1][z];
      const std::size_t   row = within[0][y] + within[1][z];
      const float * const from = Block(m_Values, neighbours[middle]) + row;
      rows[r] = from + first;
      if (first > kSide - 4)
      {
        const float * const next = Block(m_Values, neighbours[middle + 1]) + row;
        std::memcpy(mixed.data() + 8 * r, from + 4, 4 * sizeof(float));
        std::memcpy(mixed.data() + 8 * r + 4, next, 4 * sizeof(float));
        rows[r] = mixed.data() + 8 * r + (first - 4);
      }
    }
  }
  SumRows(rows, weights, value, gradient);
  return true;
}

} // namespace voxelcore
