#include "BandField.h"

#include "voxelcore/BoundaryVertices.h"

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

} // namespace

BandField::BandField(const VoxelShape & shape, const Vector3 & sides, double sigma)
  : m_Sides(sides)
{
  SetWidth(sigma);
  FindBricks(shape);
  FillLabels(shape);
  m_Values.assign(m_Bricks.size() * kVoxels, 0.0F);
}

void
BandField::SetWidth(double sigma)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double variance = sigma * sigma / (m_Sides[axis] * m_Sides[axis]);
    m_Gauss[axis] = Gauss(variance);
    m_GaussToSpline[axis] = Gauss(std::max(variance - 1.0 / 3, 0.02));
  }
}

// Four sigma far, normalised. The exponential is made of sums and products, as the last bit of exp() differs between
// libraries.
BandField::Kernel
BandField::Gauss(double variance)
{
  constexpr int halvings = 8;
  const double  exponent = -0.5 / variance / (1 << halvings);
  double        base = 1;
  for (int term = 10; term > 0; --term)
  {
    base = 1 + base * exponent / term;
  }
  for (int i = 0; i < halvings; ++i)
  {
    base *= base;
  }
  Kernel kernel;
  kernel.radius = std::min(kMostRadius, static_cast<std::int32_t>(std::ceil(4 * std::sqrt(variance))));
  std::array<double, kMostRadius + 1> weights{ 1 };
  double                              sum = 1;
  double                              ratio = base; // base^(k^2) by its odd differences
  for (std::size_t k = 1; k <= static_cast<std::size_t>(kernel.radius); ++k)
  {
    weights[k] = weights[k - 1] * ratio;
    ratio *= base * base;
    sum += 2 * weights[k];
  }
  for (std::size_t k = 0; k < weights.size(); ++k)
  {
    kernel.weights[k] = static_cast<float>(weights[k] / sum);
  }
  return kernel;
}

void
BandField::FindBricks(const VoxelShape & shape)
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
      { { BrickOf(p.x - 1 - kReach), BrickOf(p.y - 1 - kReach), BrickOf(p.z - 1 - kReach) },
        { BrickOf(p.x + kReach), BrickOf(p.y + kReach), BrickOf(p.z + kReach) } }
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
#pragma omp parallel for schedule(static) if (count > 16)
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

// G at the voxels of one brick.
void
BandField::Convolve(const Kernels & kernels, const std::vector<float> & from, std::size_t brick, float * to) const
{
  constexpr std::size_t                           most = kSide + 2 * kMostRadius;
  const std::int32_t                              rx = kernels[0].radius;
  const std::int32_t                              ry = kernels[1].radius;
  const std::int32_t                              rz = kernels[2].radius;
  const auto                                      wide = static_cast<std::size_t>(kSide + 2 * rx);
  const auto                                      deep = static_cast<std::size_t>(kSide + 2 * ry);
  const auto                                      high = static_cast<std::size_t>(kSide + 2 * rz);
  float                                           tile[most * most * most];
  float                                           byX[most * most * kSide];
  float                                           byY[most * kSide * kSide];
  float *                                         out = tile;
  const std::array<std::array<std::size_t, 2>, 3> parts{ { { static_cast<std::size_t>(kSide - rx),
                                                             static_cast<std::size_t>(rx) },
                                                           { 0, 8 },
                                                           { 0, static_cast<std::size_t>(rx) } } };
  for (std::int32_t z = -rz; z < kSide + rz; ++z)
  {
    for (std::int32_t y = -ry; y < kSide + ry; ++y)
    {
      const std::int32_t neighbour = 3 * (BrickOf(y) + 1) + 9 * (BrickOf(z) + 1);
      const auto         row = static_cast<std::size_t>(8 * (y & 7) + 64 * (z & 7));
      for (std::size_t part = 0; part < 3; ++part)
      {
        const std::int32_t source = m_Neighbours[brick][static_cast<std::size_t>(neighbour) + part];
        const auto [first, size] = parts[part];
        if (source >= 0)
        {
          const float * values = from.data() + static_cast<std::size_t>(source) * kVoxels + row + first;
          out = std::copy(values, values + size, out);
        }
        else
        {
          out = std::fill_n(out, size, source == kFarInside ? m_Far : -m_Far);
        }
      }
    }
  }
  const auto pass = [&](std::size_t axis, const float * in, float * sum, std::size_t stride, std::size_t size) {
    const auto   radius = static_cast<std::size_t>(kernels[axis].radius);
    const auto & gauss = kernels[axis].weights;
    for (std::size_t i = 0; i < size; ++i)
    {
      sum[i] = gauss[0] * in[i + radius * stride];
    }
    for (std::size_t k = 1; k <= radius; ++k)
    {
      const float * lower = in + (radius - k) * stride;
      const float * upper = in + (radius + k) * stride;
      for (std::size_t i = 0; i < size; ++i)
      {
        sum[i] += gauss[k] * (lower[i] + upper[i]);
      }
    }
  };
  for (std::size_t row = 0; row < deep * high; ++row)
  {
    pass(0, tile + row * wide, byX + row * kSide, 1, kSide);
  }
  for (std::size_t z = 0; z < high; ++z)
  {
    pass(1, byX + z * deep * kSide, byY + z * kSide * kSide, kSide, kSide * kSide);
  }
  pass(2, byY, to, kSide * kSide, kVoxels);
}

float
BandField::StepWeight(double sigma)
{
  const double once = std::sqrt(sigma * sigma + 1.0 / 12);
  const double twice = std::sqrt(2 * sigma * sigma + 1.0 / 12);
  return static_cast<float>(once / (twice - once));
}

void
BandField::Smooth(float weight)
{
  Smooth(weight, m_Gauss);
}

void
BandField::SmoothToCoefficients(float weight)
{
  Smooth(weight, m_GaussToSpline);
}

void
BandField::Smooth(float weight, const Kernels & kernels)
{
  const auto         count = static_cast<std::ptrdiff_t>(m_Bricks.size());
  std::vector<float> once(m_Values.size());
#pragma omp parallel for schedule(dynamic, 16) if (count > 16)
  for (std::ptrdiff_t brick = 0; brick < count; ++brick)
  {
    Convolve(kernels,
             m_Values,
             static_cast<std::size_t>(brick),
             once.data() + static_cast<std::size_t>(brick) * kVoxels);
  }
#pragma omp parallel for schedule(dynamic, 16) if (count > 16)
  for (std::ptrdiff_t brick = 0; brick < count; ++brick)
  {
    const std::size_t first = static_cast<std::size_t>(brick) * kVoxels;
    Convolve(m_Gauss, once, static_cast<std::size_t>(brick), m_Values.data() + first);
    for (std::size_t i = first; i < first + kVoxels; ++i)
    {
      m_Values[i] = (1 + weight) * once[i] - weight * m_Values[i];
    }
  }
}

void
BandField::ClearContradictions()
{
  const auto count = static_cast<std::ptrdiff_t>(m_Bricks.size());
#pragma omp parallel for schedule(static) if (count > 16)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto brick = static_cast<std::size_t>(i);
    for (std::size_t voxel = 0; voxel < kVoxels; ++voxel)
    {
      float &    value = m_Values[brick * kVoxels + voxel];
      const bool in = ((m_Labels[brick][voxel >> 3] >> (voxel & 7)) & 1) != 0;
      value = in ? std::max(value, 0.0F) : std::min(value, 0.0F);
    }
  }
}

bool
BandField::Evaluate(const Vector3 & place, double & value, Vector3 & gradient) const
{
  Brick                                base{};
  std::array<std::array<double, 4>, 3> weight;
  std::array<std::array<double, 4>, 3> slope;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double at = place[axis] - 0.5; // in voxel indices, where centres are whole
    const double floor = std::floor(at);
    const double t = at - floor;
    base[axis] = static_cast<std::int32_t>(floor);
    const double s = 1.0 - t;
    weight[axis] = { s * s * s / 6,
                     (4.0 - 3.0 * t * t * (1.0 + s)) / 6,
                     (4.0 - 3.0 * s * s * (1.0 + t)) / 6,
                     t * t * t / 6 };
    slope[axis] = { -0.5 * s * s, (1.5 * t - 2.0) * t, (2.0 - 1.5 * s) * s, 0.5 * t * t };
  }
  const Brick        home{ BrickOf(base[0]), BrickOf(base[1]), BrickOf(base[2]) };
  const std::int32_t found = Find(home);
  if (found < 0)
  {
    return false;
  }
  value = 0;
  gradient = { 0, 0, 0 };
  const auto & neighbours = m_Neighbours[static_cast<std::size_t>(found)];
  for (std::int32_t k = 0; k < 4; ++k)
  {
    const std::int32_t z = base[2] + k - 1;
    const auto         wz = static_cast<std::size_t>(k);
    double             ofPlane = 0;
    double             alongX = 0;
    double             alongY = 0;
    for (std::int32_t j = 0; j < 4; ++j)
    {
      const std::int32_t y = base[1] + j - 1;
      const auto         wy = static_cast<std::size_t>(j);
      const std::int32_t neighbour = 3 * (BrickOf(y) - home[1] + 1) + 9 * (BrickOf(z) - home[2] + 1) + 1;
      const auto         row = static_cast<std::size_t>(8 * (y & 7) + 64 * (z & 7));
      double             ofRow = 0;
      double             slopeOfRow = 0;
      for (std::int32_t i = 0; i < 4; ++i)
      {
        const std::int32_t x = base[0] + i - 1;
        const auto         wx = static_cast<std::size_t>(i);
        const std::int32_t source = neighbours[static_cast<std::size_t>(neighbour + BrickOf(x) - home[0])];
        const double       one = source >= 0 ? m_Values[static_cast<std::size_t>(source) * kVoxels + row + (x & 7)]
                                             : (source == kFarInside ? m_Far : -m_Far);
        ofRow += weight[0][wx] * one;
        slopeOfRow += slope[0][wx] * one;
      }
      ofPlane += weight[1][wy] * ofRow;
      alongX += weight[1][wy] * slopeOfRow;
      alongY += slope[1][wy] * ofRow;
    }
    value += weight[2][wz] * ofPlane;
    gradient[0] += weight[2][wz] * alongX;
    gradient[1] += weight[2][wz] * alongY;
    gradient[2] += slope[2][wz] * ofPlane;
  }
  return true;
}

} // namespace voxelcore
