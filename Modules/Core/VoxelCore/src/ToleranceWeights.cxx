#include "voxelcore/VoxelCore/ToleranceWeights.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace voxelcore
{

namespace
{

std::int64_t
WidthOfRuns(std::int64_t weight, std::int64_t largest)
{
  std::int64_t width = 1;
  while (width < kWidestRun &&
         (2 * width + 1) * (2 * width + 1) * weight * weight < 6 * largest * largest - 2 * weight * weight)
  {
    ++width;
  }
  return width;
}

/** Of the 2 w voxels along an axis about a corner, how often the sums over both voxels there count each: 1, 3 to
 *  2 w - 1, and down again. Their difference counts those behind -1 and those before 1. */
std::int64_t
TimesCounted(std::int64_t voxel, std::int64_t width)
{
  return 2 * std::min(voxel, 2 * width - 1 - voxel) + 1;
}

/** Sums along x of up to 64 voxels, by their bits. */
class RunSums
{
public:
  explicit RunSums(std::int64_t width)
    : m_Upper(~std::uint64_t{ 0 } << width)
  {
    for (std::size_t byte = 0; byte < m_Counted.size(); ++byte)
    {
      for (std::uint64_t bits = 0; bits < m_Counted[byte].size(); ++bits)
      {
        for (std::int64_t bit = 0; bit < 8; ++bit)
        {
          const std::int64_t voxel = 8 * static_cast<std::int64_t>(byte) + bit;
          m_Counted[byte][bits] += (bits >> bit & 1U) != 0 && voxel < 2 * width ? TimesCounted(voxel, width) : 0;
        }
      }
    }
  }

  std::int64_t
  Sum(std::uint64_t bits) const
  {
    std::int64_t sum = 0;
    for (std::size_t byte = 0; bits != 0; ++byte, bits >>= 8U)
    {
      sum += m_Counted[byte][bits & 0xFFU];
    }
    return sum;
  }
  std::int64_t
  Difference(std::uint64_t bits) const
  {
    return 2 * std::popcount(bits & m_Upper) - std::popcount(bits);
  }

private:
  std::array<std::array<std::int64_t, 256>, 8> m_Counted{};
  std::uint64_t                                m_Upper;
};

/** `count` bits of a row from `first` on, which may lie outside it; up to 64. */
std::uint64_t
BitsOf(const ConstShapeRow & row, std::int64_t first, std::int64_t count)
{
  const auto wordAt = [&](std::int64_t word) {
    return word < 0 || word >= static_cast<std::int64_t>(row.size()) ? 0 : row[static_cast<std::size_t>(word)];
  };
  const std::int64_t word = first >> 6;
  const auto         shift = static_cast<unsigned>(first & 63);
  std::uint64_t      bits = wordAt(word) >> shift;
  if (shift + count > 64)
  {
    bits |= wordAt(word + 1) << (64 - shift);
  }
  return bits & ~std::uint64_t{ 0 } >> (64 - count);
}

/** Gradients at corners, asked for in scan order. */
class Gradients
{
public:
  Gradients(const VoxelShape & shape, const std::array<std::int64_t, 3> & widths, const RunSums & sums)
    : m_Shape(shape)
    , m_Widths(widths)
    , m_Sums(sums)
  {}

  std::array<std::int64_t, 3>
  At(const LatticePoint & p)
  {
    MoveTo(p.y, p.z);
    const auto [wx, wy, wz] = m_Widths;
    const std::int64_t          first = std::int64_t{ p.x } - m_Shape.Box().lower[0] - wx;
    std::array<std::int64_t, 3> gradient{};
    auto                        row = m_Rows.begin();
    for (std::int64_t z = 0; z < 2 * wz; ++z)
    {
      for (std::int64_t y = 0; y < 2 * wy; ++y, ++row)
      {
        const std::uint64_t bits = BitsOf(*row, first, 2 * wx);
        if (bits == 0)
        {
          continue;
        }
        const std::int64_t sum = m_Sums.Sum(bits);
        gradient[0] += m_Sums.Difference(bits) * TimesCounted(y, wy) * TimesCounted(z, wz);
        gradient[1] += (y < wy ? -sum : sum) * TimesCounted(z, wz);
        gradient[2] += (z < wz ? -sum : sum) * TimesCounted(y, wy);
      }
    }
    return gradient;
  }

private:
  void
  MoveTo(std::int32_t y, std::int32_t z)
  {
    if (!m_Rows.empty() && m_Y == y && m_Z == z)
    {
      return;
    }
    m_Y = y;
    m_Z = z;
    m_Rows.clear();
    const auto &       lower = m_Shape.Box().lower;
    const std::int32_t wy = static_cast<std::int32_t>(m_Widths[1]);
    const std::int32_t wz = static_cast<std::int32_t>(m_Widths[2]);
    for (std::int32_t k = z - lower[2] - wz; k < z - lower[2] + wz; ++k)
    {
      for (std::int32_t j = y - lower[1] - wy; j < y - lower[1] + wy; ++j)
      {
        m_Rows.push_back(m_Shape.RowAnywhere(j, k));
      }
    }
  }

  const VoxelShape &                  m_Shape;
  const std::array<std::int64_t, 3> & m_Widths;
  const RunSums &                     m_Sums;
  std::vector<ConstShapeRow>          m_Rows; ///< about the row of corners below
  std::int32_t                        m_Y = 0;
  std::int32_t                        m_Z = 0;
};

std::array<double, 3>
SidesOf(const SpacingWeights & weights)
{
  return { static_cast<double>(weights.weight[0]),
           static_cast<double>(weights.weight[1]),
           static_cast<double>(weights.weight[2]) };
}

double
WeightOf(const std::array<std::int64_t, 3> & gradient, const std::array<double, 3> & sides, double most)
{
  double sum = 0;
  double squared = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto   along = static_cast<double>(gradient[axis]);
    const double normal = along / sides[axis];
    sum += std::abs(along);
    squared += normal * normal;
  }
  // The gradient's components along the axes are its differences over the sides, so these times the sides again.
  return squared == 0 ? 1.0 : std::clamp(Length(sides) * std::sqrt(squared) / sum, 1.0, most);
}

} // namespace

std::vector<double>
ToleranceWeights(const VoxelShape & shape, const SpacingWeights & weights, const std::vector<LatticePoint> & points)
{
  const auto [least, largest] = ranges::minmax(weights.weight);
  if (least == largest)
  {
    return {};
  }
  std::array<std::int64_t, 3> widths{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    widths[axis] = WidthOfRuns(weights.weight[axis], largest);
  }
  const RunSums       sums(widths[0]);
  const auto          sides = SidesOf(weights);
  const double        most = Length(sides) / (std::sqrt(3.0) * static_cast<double>(least));
  std::vector<double> result(points.size());
  RunInParts(points.size() > 1000, points.size(), [&](std::size_t first, std::size_t last) {
    Gradients gradients(shape, widths, sums);
    for (std::size_t i = first; i < last; ++i)
    {
      result[i] = WeightOf(gradients.At(points[i]), sides, most);
    }
  });
  return result;
}

} // namespace voxelcore
