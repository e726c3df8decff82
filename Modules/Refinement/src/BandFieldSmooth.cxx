// How a band field is smoothed.

#include "BandField.h"

#include "GaussWeights.h"

#include "voxelcore/EightLanes.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

// sum[i] of weights by distance in steps of `stride`: in[i] .. in[i + 2 * radius * stride].
VOXELCORE_EIGHT_LANES void
SumAlong(const float * weights,
         std::int32_t  radius,
         const float * in,
         float *       sum,
         std::size_t   stride,
         std::size_t   size)
{
  const float * const middle = in + static_cast<std::size_t>(radius) * stride;
  for (std::size_t i = 0; i < size; ++i)
  {
    sum[i] = weights[0] * middle[i];
  }
  for (std::int32_t k = 1; k <= radius; ++k)
  {
    const std::size_t   away = static_cast<std::size_t>(k) * stride;
    const float * const lower = middle - away;
    const float * const upper = middle + away;
    for (std::size_t i = 0; i < size; ++i)
    {
      sum[i] += weights[k] * (lower[i] + upper[i]);
    }
  }
}

} // namespace

void
BandField::SetWidth(double sigma)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double variance = sigma * sigma / (m_Sides[axis] * m_Sides[axis]);
    m_Gauss[axis] = Gauss(variance, kMostRadius);
    m_GaussWide[axis] = Gauss(variance, kMostRadius / 2);
    m_GaussToSpline[axis] = Gauss(std::max(variance - 1.0 / 3, 0.02), kMostRadius);
  }
}

// Four sigma far, normalised.
BandField::Kernel
BandField::Gauss(double variance, std::int32_t mostRadius)
{
  Kernel kernel;
  kernel.radius = std::min(mostRadius, static_cast<std::int32_t>(std::ceil(4 * std::sqrt(variance))));
  const std::vector<double> weights = GaussWeights(variance, static_cast<std::size_t>(kernel.radius));
  std::transform(weights.begin(), weights.end(), kernel.weights.begin(), [](double w) {
    return static_cast<float>(w);
  });
  return kernel;
}

// G at the voxels of one brick, of every voxel or every other one: along z first, as its rows are the longest.
void
BandField::Convolve(const Kernels &            kernels,
                    std::int32_t               step,
                    const std::vector<float> & from,
                    std::size_t                brick,
                    float *                    to) const
{
  constexpr std::size_t most = kSide + 2 * kMostRadius;
  constexpr std::size_t side = kSide;
  const std::int32_t    rx = step * kernels[0].radius;
  const std::int32_t    ry = step * kernels[1].radius;
  const std::int32_t    rz = step * kernels[2].radius;
  const auto            left = static_cast<std::size_t>(rx);
  const auto            wide = static_cast<std::size_t>(kSide + 2 * rx);
  const auto            deep = static_cast<std::size_t>(kSide + 2 * ry);
  float                 tile[most * most * most + side];
  float                 byZ[most * most * side];
  float                 byY[most * side * side];
  float *               row = tile;
  float                 inside[side];
  float                 outside[side];
  std::fill_n(inside, side, m_Far);
  std::fill_n(outside, side, -m_Far);
  for (std::int32_t z = -rz; z < kSide + rz; ++z)
  {
    for (std::int32_t y = -ry; y < kSide + ry; ++y, row += wide)
    {
      const auto         first = static_cast<std::size_t>(3 * (BrickOf(y) + 1) + 9 * (BrickOf(z) + 1));
      const std::int32_t within = kSide * (y & 7) + kSide * kSide * (z & 7);
      const auto         rowOf = [&](std::size_t part) {
        const std::int32_t source = m_Neighbours[brick][first + part];
        return source >= 0 ? from.data() + static_cast<std::size_t>(source) * kVoxels + within
                                   : (source == kFarInside ? inside : outside);
      };
      // Copies of known length are fast; what is too much of the last one, the next row goes over.
      if (left == side / 2)
      {
        std::copy_n(rowOf(0) + side / 2, side / 2, row);
      }
      else
      {
        std::copy_n(rowOf(0) + side - left, left, row);
      }
      std::copy_n(rowOf(1), side, row + left);
      std::copy_n(rowOf(2), side, row + left + side);
    }
  }
  const auto skip = static_cast<std::size_t>(step);
  SumAlong(kernels[2].weights.data(), kernels[2].radius, tile, byZ, skip * wide * deep, wide * deep * side);
  for (std::size_t z = 0; z < side; ++z)
  {
    SumAlong(kernels[1].weights.data(),
             kernels[1].radius,
             byZ + z * wide * deep,
             byY + z * wide * side,
             skip * wide,
             wide * side);
  }
  for (std::size_t line = 0; line < side * side; ++line)
  {
    SumAlong(kernels[0].weights.data(), kernels[0].radius, byY + line * wide, to + line * side, skip, side);
  }
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
  Smooth(weight, m_Gauss, m_Gauss, 1, nullptr);
}

void
BandField::SmoothToCoefficients(float weight)
{
  Smooth(weight, m_GaussToSpline, m_Gauss, 1, nullptr);
}

void
BandField::SmoothPart(float weight, bool wide, const Parts & parts)
{
  const Kernels & kernels = wide ? m_GaussWide : m_Gauss;
  Smooth(weight, kernels, kernels, wide ? 2 : 1, &parts);
}

void
BandField::Smooth(float weight, const Kernels & first, const Kernels & second, std::int32_t step, const Parts * parts)
{
  const auto                count = static_cast<std::ptrdiff_t>(m_Bricks.size());
  std::vector<std::uint8_t> changes(m_Bricks.size(), 1);
  for (std::size_t brick = 0; parts != nullptr && brick < m_Bricks.size(); ++brick)
  {
    const auto begin = parts->begin() + static_cast<std::ptrdiff_t>(brick * kVoxels);
    changes[brick] = std::any_of(begin, begin + kVoxels, [](std::uint8_t part) { return part != 0; }) ? 1 : 0;
  }
  std::vector<float> once(m_Values.size());
#pragma omp parallel for schedule(dynamic, 16) if (count > kManyBricks)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto   brick = static_cast<std::size_t>(i);
    const auto & around = m_Neighbours[brick];
    if (std::any_of(around.begin(), around.end(), [&](std::int32_t other) {
          return other >= 0 && changes[static_cast<std::size_t>(other)] != 0;
        }))
    {
      Convolve(first, step, m_Values, brick, once.data() + brick * kVoxels);
    }
  }
#pragma omp parallel for schedule(dynamic, 16) if (count > kManyBricks)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto brick = static_cast<std::size_t>(i);
    if (changes[brick] == 0)
    {
      continue;
    }
    float twice[kVoxels];
    Convolve(second, step, once, brick, twice);
    for (std::size_t voxel = 0; voxel < kVoxels; ++voxel)
    {
      const std::size_t at = brick * kVoxels + voxel;
      const float       smoothed = (1 + weight) * once[at] - weight * twice[voxel];
      m_Values[at] =
        parts == nullptr ? smoothed : m_Values[at] + static_cast<float>((*parts)[at]) / 255 * (smoothed - m_Values[at]);
    }
  }
}

void
BandField::ClearContradictions()
{
  const auto count = static_cast<std::ptrdiff_t>(m_Bricks.size());
#pragma omp parallel for schedule(static) if (count > kManyBricks)
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

} // namespace voxelcore
