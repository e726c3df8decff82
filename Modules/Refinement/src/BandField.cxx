#include "BandField.h"

#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/EightLanes.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace voxelcore
{

namespace
{

std::size_t
Hash(const std::array<std::int32_t, 3> & brick)
{
  std::uint64_t h = static_cast<std::uint32_t>(brick[0]);
  h = (h ^ (h >> 15)) * 0x9E3779B97F4A7C15U + static_cast<std::uint32_t>(brick[1]);
  h = (h ^ (h >> 29)) * 0xBF58476D1CE4E5B9U + static_cast<std::uint32_t>(brick[2]);
  h = (h ^ (h >> 32)) * 0x94D049BB133111EBU;
  return static_cast<std::size_t>(h ^ (h >> 29));
}

bool
ComesBefore(const std::array<std::int32_t, 3> & a, const std::array<std::int32_t, 3> & b)
{
  return std::array{ a[2], a[1], a[0] } < std::array{ b[2], b[1], b[0] };
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

BandField::BandField(const VoxelShape & shape, const Vector3 & sides, double sigma, std::int32_t reach)
  : m_Sides(sides)
{
  SetWidth(sigma);
  FindBricks(shape, reach);
  FillLabels(shape);
  m_Values.assign(m_Bricks.size() * kVoxels, 0.0F);
}

void
BandField::FindBricks(const VoxelShape & shape, std::int32_t reach)
{
  const auto sortBricks = [&] {
    std::sort(m_Bricks.begin(), m_Bricks.end(), ComesBefore);
    m_Bricks.erase(std::unique(m_Bricks.begin(), m_Bricks.end()), m_Bricks.end());
  };
  std::size_t          sorted = 0;
  std::array<Brick, 2> last{};
  bool                 first = true;
  for (const LatticePoint & p : BoundaryVertices(shape))
  {
    // A boundary vertex lies between the voxels p - 1 and p.
    const std::array<Brick, 2> range{
      { { BrickOf(p.x - 1 - reach), BrickOf(p.y - 1 - reach), BrickOf(p.z - 1 - reach) },
        { BrickOf(p.x + reach), BrickOf(p.y + reach), BrickOf(p.z + reach) } }
    };
    if (!first && range == last)
    {
      continue;
    }
    first = false;
    last = range;
    for (std::int32_t z = range[0][2]; z <= range[1][2]; ++z)
    {
      for (std::int32_t y = range[0][1]; y <= range[1][1]; ++y)
      {
        for (std::int32_t x = range[0][0]; x <= range[1][0]; ++x)
        {
          m_Bricks.push_back({ x, y, z });
        }
      }
    }
    if (m_Bricks.size() > 2 * sorted + 100000)
    {
      sortBricks();
      sorted = m_Bricks.size();
    }
  }
  sortBricks();
  m_Bricks.shrink_to_fit();
  m_Table.assign(std::bit_ceil(2 * m_Bricks.size() + 1), 0);
  const std::size_t mask = m_Table.size() - 1;
  for (std::size_t brick = 0; brick < m_Bricks.size(); ++brick)
  {
    std::size_t at = Hash(m_Bricks[brick]) & mask;
    while (m_Table[at] != 0)
    {
      at = (at + 1) & mask;
    }
    m_Table[at] = static_cast<std::uint32_t>(brick + 1);
  }
}

std::int32_t
BandField::Find(const Brick & brick) const
{
  const std::size_t mask = m_Table.size() - 1;
  for (std::size_t at = Hash(brick) & mask; m_Table[at] != 0; at = (at + 1) & mask)
  {
    if (m_Bricks[m_Table[at] - 1] == brick)
    {
      return static_cast<std::int32_t>(m_Table[at] - 1);
    }
  }
  return -1;
}

void
BandField::FillLabels(const VoxelShape & shape)
{
  const auto count = static_cast<std::ptrdiff_t>(m_Bricks.size());
  m_Neighbours.resize(m_Bricks.size());
  m_Labels.resize(m_Bricks.size());
#pragma omp parallel for schedule(static) if (count > kManyBricks)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto    brick = static_cast<std::size_t>(i);
    const Brick & at = m_Bricks[brick];
    for (std::size_t row = 0; row < 64; ++row)
    {
      const auto   y = at[1] * kSide + static_cast<std::int32_t>(row & 7);
      const auto   z = at[2] * kSide + static_cast<std::int32_t>(row >> 3);
      std::uint8_t bits = 0;
      for (std::int32_t x = 0; x < kSide; ++x)
      {
        bits |= static_cast<std::uint8_t>((shape.Contains(at[0] * kSide + x, y, z) ? 1U : 0U) << x);
      }
      m_Labels[brick][row] = bits;
    }
    for (std::size_t n = 0; n < 27; ++n)
    {
      const Brick  other{ at[0] + static_cast<std::int32_t>(n % 3) - 1,
                         at[1] + static_cast<std::int32_t>(n / 3 % 3) - 1,
                         at[2] + static_cast<std::int32_t>(n / 9) - 1 };
      std::int32_t found = Find(other);
      if (found < 0) // no boundary near it, so any voxel speaks for all of it
      {
        found = shape.Contains(other[0] * kSide, other[1] * kSide, other[2] * kSide) ? kFarInside : kFarOutside;
      }
      m_Neighbours[brick][n] = found;
    }
  }
}

bool
BandField::Evaluate(const Vector3 & place, double & value, Vector3 & gradient) const
{
  Brick          base{};
  SplineWeights  weights;
  constexpr auto most = static_cast<std::int32_t>(kSide - 4);
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
  const Brick        home{ BrickOf(base[0]), BrickOf(base[1]), BrickOf(base[2]) };
  const std::int32_t found = Find(home);
  if (found < 0)
  {
    return false;
  }
  const auto & neighbours = m_Neighbours[static_cast<std::size_t>(found)];
  const auto   brickAt = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    return neighbours[static_cast<std::size_t>((BrickOf(x) - home[0] + 1) + 3 * (BrickOf(y) - home[1] + 1) +
                                               9 * (BrickOf(z) - home[2] + 1))];
  };
  // The rows of four as they lie, or put together from several bricks.
  std::array<const float *, 16> rows;
  std::array<float, 64>         mixed;
  for (std::int32_t row = 0; row < 16; ++row)
  {
    const auto         r = static_cast<std::size_t>(row);
    const std::int32_t y = base[1] - 1 + (row & 3);
    const std::int32_t z = base[2] - 1 + (row >> 2);
    const std::int32_t within = kSide * (y & 7) + kSide * kSide * (z & 7);
    const std::int32_t first = (base[0] - 1) & 7;
    const std::int32_t source = brickAt(base[0] - 1, y, z);
    if (first <= most && source >= 0)
    {
      rows[r] = m_Values.data() + static_cast<std::size_t>(source) * kVoxels + within + first;
      continue;
    }
    rows[r] = mixed.data() + 4 * r;
    for (std::int32_t i = 0; i < 4; ++i)
    {
      const std::int32_t x = base[0] + i - 1;
      mixed[4 * r + static_cast<std::size_t>(i)] = ValueAt(brickAt(x, y, z), within + (x & 7));
    }
  }
  SumRows(rows, weights, value, gradient);
  return true;
}

} // namespace voxelcore
