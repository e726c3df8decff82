#include "BandField.h"

#include "DistanceTile.h"

#include "voxelcore/EightLanes.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <cmath>

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
  std::array<std::array<double, 4>, 3> value;
  std::array<std::array<double, 4>, 3> slope;
};

// Rows by y, then by z. What is along y and z is summed first, for the four of a row side by side.
VOXELCORE_EIGHT_LANES void
SumRows(const std::array<const float *, 16> & rows, const SplineWeights & weights, double & value, Vector3 & gradient)
{
  using Four = double __attribute__((vector_size(32)));
  Four sum{};
  Four alongY{};
  Four alongZ{};
  for (std::size_t z = 0; z < 4; ++z)
  {
    Four ofPlane{};
    Four slopeOfPlane{};
    for (std::size_t y = 0; y < 4; ++y)
    {
      const float * const row = rows[4 * z + y];
      const Four          four{ row[0], row[1], row[2], row[3] };
      ofPlane += weights.value[1][y] * four;
      slopeOfPlane += weights.slope[1][y] * four;
    }
    sum += weights.value[2][z] * ofPlane;
    alongY += weights.value[2][z] * slopeOfPlane;
    alongZ += weights.slope[2][z] * ofPlane;
  }
  value = 0;
  gradient = { 0, 0, 0 };
  for (std::size_t x = 0; x < 4; ++x)
  {
    value += weights.value[0][x] * sum[x];
    gradient[0] += weights.slope[0][x] * sum[x];
    gradient[1] += weights.value[0][x] * alongY[x];
    gradient[2] += weights.value[0][x] * alongZ[x];
  }
}

} // namespace

BandField::BandField(const VoxelShape &            shape,
                     std::span<const LatticePoint> points,
                     const Vector3 &               sides,
                     double                        sigma,
                     std::int32_t                  reach)
  : m_Grid(shape, points, 0, reach)
  , m_Sides(sides)
  , m_Labels(m_Grid.Count())
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
      m_Labels[static_cast<std::size_t>(i)][static_cast<std::size_t>(row)] = static_cast<std::uint8_t>(
        BitsOfRow(shape, at[0] * kSide, at[1] * kSide + (row & 7), at[2] * kSide + (row >> 3)));
    }
  }
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
    const double at = place[axis] - 0.5; // in voxel indices, where centres are whole
    const double floor = std::floor(at);
    const double t = at - floor;
    const double s = 1.0 - t;
    base[axis] = static_cast<std::int32_t>(floor);
    weights.value[axis] = { s * s * s / 6,
                            (4.0 - 3.0 * t * t * (1.0 + s)) / 6,
                            (4.0 - 3.0 * s * s * (1.0 + t)) / 6,
                            t * t * t / 6 };
    weights.slope[axis] = { -0.5 * s * s, (1.5 * t - 2.0) * t, (2.0 - 1.5 * s) * s, 0.5 * t * t };
  }
  const BrickGrid::Brick home{ base[0] >> 3, base[1] >> 3, base[2] >> 3 };
  const std::int32_t     found = m_Grid.Find(home);
  if (found < 0)
  {
    return false;
  }
  const auto & neighbours = m_Grid.Neighbours(static_cast<std::size_t>(found));
  // The rows of four as they lie, or put together from two bricks.
  std::array<const float *, 16> rows;
  std::array<float, 64>         mixed;
  const std::int32_t            first = (base[0] - 1) & 7;
  const bool                    left = base[0] - 1 < 8 * home[0];
  for (std::int32_t row = 0; row < 16; ++row)
  {
    const auto         r = static_cast<std::size_t>(row);
    const std::int32_t y = base[1] - 1 + (row & 3);
    const std::int32_t z = base[2] - 1 + (row >> 2);
    const std::int32_t within = kSide * (y & 7) + kSide * kSide * (z & 7);
    const auto    middle = static_cast<std::size_t>(1 + 3 * ((y >> 3) - home[1] + 1) + 9 * ((z >> 3) - home[2] + 1));
    const float * from = Block(m_Values, neighbours[left ? middle - 1 : middle]) + within;
    rows[r] = from + first;
    if (first > kSide - 4)
    {
      const float * next = Block(m_Values, neighbours[left ? middle : middle + 1]) + within;
      for (std::int32_t i = 0; i < 4; ++i)
      {
        mixed[4 * r + static_cast<std::size_t>(i)] = first + i < kSide ? from[first + i] : next[first + i - kSide];
      }
      rows[r] = mixed.data() + 4 * r;
    }
  }
  SumRows(rows, weights, value, gradient);
  return true;
}

} // namespace voxelcore
