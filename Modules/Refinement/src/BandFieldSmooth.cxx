// How a band field is smoothed.

#include "BandField.h"

#include "BrickSums.h"
#include "GaussWeights.h"

#include "voxelcore/EightLanes.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

constexpr std::size_t kSide = BrickGrid::kSide;
constexpr std::size_t kVoxels = BrickGrid::kCells;

// Eight voxels beside each other at once. Where `parts` are given former values are kept in part; where flags are, no
// value contradicts them.
VOXELCORE_EIGHT_LANES void
Combine(float *              values,
        const float *        once,
        const float *        twice,
        float                weight,
        const std::uint8_t * in,
        const std::uint8_t * out,
        const float *        parts)
{
  using Eight = float __attribute__((vector_size(32), aligned(4), may_alias));
  using Flags = std::int32_t __attribute__((vector_size(32)));
  constexpr Flags single{ 1, 2, 4, 8, 16, 32, 64, 128 };
  const auto      at = [](auto * from, std::size_t i) __attribute__((always_inline))
  {
    return reinterpret_cast<const Eight *>(from + i);
  };
  constexpr Eight zero{};
  for (std::size_t row = 0, i = 0; i < kVoxels; ++row, i += kSide)
  {
    const Eight smoothed = (1 + weight) * *at(once, i) - weight * *at(twice, i);
    Eight       sum = parts == nullptr ? smoothed : *at(values, i) + *at(parts, i) * (smoothed - *at(values, i));
    if (in != nullptr)
    {
      const Flags isIn = (single & in[row]) != 0;
      const Flags isOut = (single & out[row]) != 0;
      sum = isIn & (sum < zero) ? zero : sum;
      sum = isOut & (sum > zero) ? zero : sum;
    }
    *reinterpret_cast<Eight *>(values + i) = sum;
  }
}

constexpr float kSavedUnits = 24000; // to Far(), so that values may be somewhat greater

} // namespace

void
BandField::SetWidth(double sigma)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double variance = sigma * sigma / (m_Sides[axis] * m_Sides[axis]);
    m_Gauss[axis] = Gauss(variance);
    m_Binomial[axis] = Binomial(variance, Kernel::kMostRadius);
    m_GaussToSpline[axis] = Gauss(std::max(variance - 1.0 / 3, 0.02));
  }
}

// Four sigma far, normalised.
Kernel
BandField::Gauss(double variance)
{
  Kernel kernel;
  kernel.radius = std::min(Kernel::kMostRadius, static_cast<std::size_t>(std::ceil(4 * std::sqrt(variance))));
  const std::vector<double> weights = GaussWeights(variance, kernel.radius);
  std::transform(weights.begin(), weights.end(), kernel.weights.begin(), [](double w) {
    return static_cast<float>(w);
  });
  return kernel;
}

// Steps of a voxel or none, as many as give the variance while no step is taken more often than not. A binomial ends at
// half the distance where a sampled Gaussian of the same variance is small.
Kernel
BandField::Binomial(double variance, std::size_t mostRadius)
{
  const auto   steps = std::clamp(static_cast<std::size_t>(std::ceil(2 * variance)), std::size_t{ 1 }, mostRadius);
  const double part = variance / (2 * static_cast<double>(steps));
  std::vector<double> weights(2 * steps + 3, 0.0); // from -steps - 1 on
  weights[steps + 1] = 1;
  for (std::size_t step = 0; step < steps; ++step)
  {
    std::vector<double> next(weights.size(), 0.0);
    for (std::size_t i = 1; i + 1 < weights.size(); ++i)
    {
      next[i] = (1 - 2 * part) * weights[i] + part * (weights[i - 1] + weights[i + 1]);
    }
    weights = std::move(next);
  }
  Kernel kernel;
  kernel.radius = steps;
  std::transform(weights.begin() + static_cast<std::ptrdiff_t>(steps) + 1,
                 weights.end() - 1,
                 kernel.weights.begin(),
                 [](double w) { return static_cast<float>(w); });
  return kernel;
}

float
BandField::StepWeight(double sigma)
{
  const double once = std::sqrt(sigma * sigma + 1.0 / 12);
  const double twice = std::sqrt(2 * sigma * sigma + 1.0 / 12);
  return static_cast<float>(once / (twice - once));
}

// Goes through the bricks that are needed, row by row: use(brick, sums).
template <typename TUse>
void
BandField::Sum(const Kernels &                   kernels,
               const std::vector<float> &        values,
               const std::vector<std::uint8_t> & needed,
               TUse                              use) const
{
  const auto count = static_cast<std::ptrdiff_t>(m_RowStarts.size());
#pragma omp parallel for schedule(dynamic, 16) if (m_Grid.Count() > static_cast <std::size_t>(BrickGrid::kMany))
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    BrickSums   row(m_Grid, kernels, values, m_FarBlocks);
    BrickValues sums;
    for (auto brick = static_cast<std::int32_t>(m_RowStarts[static_cast<std::size_t>(i)]); brick >= 0;
         brick = m_Grid.Neighbours(static_cast<std::size_t>(brick))[BrickGrid::kSelf + 1])
    {
      if (needed[static_cast<std::size_t>(brick)] != 0)
      {
        row.Of(static_cast<std::size_t>(brick), sums.data());
        use(static_cast<std::size_t>(brick), sums);
      }
    }
  }
}

// m_Once of values, in bricks where something changes and around them.
void
BandField::SumOnce(const Kernels & kernels, const std::vector<std::uint8_t> & changed)
{
  m_Once.resize(m_Values.size());
  Sum(kernels, m_Values, m_Grid.AndAround(changed), [&](std::size_t brick, const BrickValues & sums) {
    std::copy(sums.begin(), sums.end(), m_Once.begin() + static_cast<std::ptrdiff_t>(brick * kVoxels));
  });
}

void
BandField::Smooth(float weight, const SmoothingZones * zones)
{
  std::vector<std::uint8_t> changed(m_Grid.Count(), 1);
  for (std::size_t brick = 0; zones != nullptr && brick < changed.size(); ++brick)
  {
    changed[brick] = zones->AnyIn(m_Level, m_Grid.At(brick)) ? 1 : 0;
  }
  SumOnce(m_Binomial, changed);
  Sum(m_Binomial, m_Once, changed, [&](std::size_t brick, const BrickValues & twice) {
    BrickValues parts;
    if (zones != nullptr)
    {
      zones->Fill(m_Level, m_Grid.At(brick), parts);
    }
    const std::size_t at = brick * kVoxels;
    Combine(m_Values.data() + at,
            m_Once.data() + at,
            twice.data(),
            weight,
            m_In[brick].data(),
            m_Out[brick].data(),
            zones != nullptr ? parts.data() : nullptr);
  });
}

void
BandField::FindCoefficients(float weight, const std::vector<std::uint8_t> & changed)
{
  m_Coefficients.resize(m_Values.size());
  SumOnce(m_GaussToSpline, changed);
  Sum(m_Gauss, m_Once, changed, [&](std::size_t brick, const BrickValues & twice) {
    const std::size_t at = brick * kVoxels;
    Combine(m_Coefficients.data() + at, m_Once.data() + at, twice.data(), weight, nullptr, nullptr, nullptr);
  });
}

void
BandField::FindCoefficients(float weight)
{
  FindCoefficients(weight, std::vector<std::uint8_t>(m_Grid.Count(), 1));
}

void
BandField::DropValues()
{
  std::vector<float>().swap(m_Values);
  std::vector<float>().swap(m_Once);
  std::vector<BrickGrid::Flags>().swap(m_In);
  std::vector<BrickGrid::Flags>().swap(m_Out);
}

BandField::Snapshot
BandField::Save() const
{
  const float unit = kSavedUnits / m_Far;
  Snapshot    saved(m_Values.size());
  std::transform(m_Values.begin(), m_Values.end(), saved.begin(), [&](float value) {
    return static_cast<std::int16_t>(std::clamp(value * unit, -32767.0F, 32767.0F));
  });
  return saved;
}

std::vector<std::uint8_t>
BandField::BlendWith(const Snapshot & former, const SmoothingZones & zones, float weight)
{
  const float               unit = m_Far / kSavedUnits;
  const auto                count = static_cast<std::ptrdiff_t>(m_Grid.Count());
  std::vector<std::uint8_t> changed(m_Grid.Count(), 0);
#pragma omp parallel for schedule(dynamic, 16) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto                 brick = static_cast<std::size_t>(i);
    std::array<float, kVoxels> parts;
    zones.Fill(m_Level, m_Grid.At(brick), parts);
    for (std::size_t voxel = 0; voxel < kVoxels; ++voxel)
    {
      if (parts[voxel] < 1)
      {
        float &     value = m_Values[brick * kVoxels + voxel];
        const float before = unit * static_cast<float>(former[brick * kVoxels + voxel]);
        value = before + parts[voxel] * (value - before);
        changed[brick] = 1;
      }
    }
  }
  // Sums reach one or two bricks far, and what is evaluated one more.
  std::size_t reach = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    reach = std::max(reach, m_GaussToSpline[axis].radius + m_Gauss[axis].radius);
  }
  changed = m_Grid.AndAround(changed);
  if (reach > kSide)
  {
    changed = m_Grid.AndAround(changed);
  }
  FindCoefficients(weight, changed);
  return m_Grid.AndAround(changed);
}

} // namespace voxelcore
