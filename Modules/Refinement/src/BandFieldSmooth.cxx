// How a band field is smoothed.

#include "BandField.h"

#include "GaussWeights.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

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

// G at the voxels of one brick, of every voxel or every other one.
void
BandField::Convolve(const Kernels &            kernels,
                    std::int32_t               step,
                    const std::vector<float> & from,
                    std::size_t                brick,
                    float *                    to) const
{
  constexpr std::size_t                           most = kSide + 2 * kMostRadius;
  const std::int32_t                              rx = step * kernels[0].radius;
  const std::int32_t                              ry = step * kernels[1].radius;
  const std::int32_t                              rz = step * kernels[2].radius;
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
    const auto   skip = static_cast<std::size_t>(step) * stride;
    const auto & gauss = kernels[axis].weights;
    for (std::size_t i = 0; i < size; ++i)
    {
      sum[i] = gauss[0] * in[i + radius * skip];
    }
    for (std::size_t k = 1; k <= radius; ++k)
    {
      const float * lower = in + (radius - k) * skip;
      const float * upper = in + (radius + k) * skip;
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
#pragma omp parallel for schedule(dynamic, 16) if (count > kManyBricks)
  for (std::ptrdiff_t brick = 0; brick < count; ++brick)
  {
    Convolve(kernels,
             1,
             m_Values,
             static_cast<std::size_t>(brick),
             once.data() + static_cast<std::size_t>(brick) * kVoxels);
  }
#pragma omp parallel for schedule(dynamic, 16) if (count > kManyBricks)
  for (std::ptrdiff_t brick = 0; brick < count; ++brick)
  {
    const std::size_t first = static_cast<std::size_t>(brick) * kVoxels;
    Convolve(m_Gauss, 1, once, static_cast<std::size_t>(brick), m_Values.data() + first);
    for (std::size_t i = first; i < first + kVoxels; ++i)
    {
      m_Values[i] = (1 + weight) * once[i] - weight * m_Values[i];
    }
  }
}

void
BandField::SmoothPart(float weight, bool wide, const Parts & parts)
{
  const auto                count = static_cast<std::ptrdiff_t>(m_Bricks.size());
  const Kernels &           kernels = wide ? m_GaussWide : m_Gauss;
  const std::int32_t        step = wide ? 2 : 1;
  std::vector<std::uint8_t> changes(m_Bricks.size());
  for (std::size_t brick = 0; brick < m_Bricks.size(); ++brick)
  {
    const auto first = parts.begin() + static_cast<std::ptrdiff_t>(brick * kVoxels);
    changes[brick] = std::any_of(first, first + kVoxels, [](std::uint8_t part) { return part != 0; }) ? 1 : 0;
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
      Convolve(kernels, step, m_Values, brick, once.data() + brick * kVoxels);
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
    Convolve(kernels, step, once, brick, twice);
    for (std::size_t voxel = 0; voxel < kVoxels; ++voxel)
    {
      const std::size_t at = brick * kVoxels + voxel;
      const float       smoothed = (1 + weight) * once[at] - weight * twice[voxel];
      m_Values[at] += static_cast<float>(parts[at]) / 255 * (smoothed - m_Values[at]);
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
