// How a band field is smoothed: along z, y and x, brick by brick in the memory of the values themselves.

#include "BandField.h"

#include "GaussWeights.h"

#include "voxelcore/EightLanes.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr std::size_t kSide = BrickGrid::kSide;
constexpr std::size_t kVoxels = BrickGrid::kCells;
using Eight = float __attribute__((vector_size(32), aligned(4), may_alias));

// Along y or z: eight voxels at once that lie beside each other along x. `along` is how far apart voxels are that are
// summed, `across` how far apart the eight lines of eight voxels are.
template <std::size_t Radius>
[[gnu::always_inline]] inline void
SumLayersOf(const std::array<const float *, 3> & from,
            float *                              to,
            std::size_t                          along,
            std::size_t                          across,
            const float *                        weights)
{
  for (std::size_t line = 0; line < kSide; ++line)
  {
    Eight column[kSide + 2 * Radius];
    for (std::size_t i = 0; i < kSide + 2 * Radius; ++i)
    {
      const std::size_t layer = i + kSide - Radius;
      column[i] = *reinterpret_cast<const Eight *>(from[layer / kSide] + (layer % kSide) * along + line * across);
    }
    for (std::size_t i = 0; i < kSide; ++i)
    {
      Eight sum = weights[0] * column[i + Radius];
      for (std::size_t k = 1; k <= Radius; ++k)
      {
        sum += weights[k] * (column[i + Radius - k] + column[i + Radius + k]);
      }
      *reinterpret_cast<Eight *>(to + i * along + line * across) = sum;
    }
  }
}

template <std::size_t Radius>
[[gnu::always_inline]] inline void
SumRowsOf(const std::array<const float *, 3> & from, float * to, const float * weights)
{
  for (std::size_t row = 0; row < kSide * kSide; ++row)
  {
    float line[3 * kSide];
    for (std::size_t part = 0; part < 3; ++part)
    {
      std::copy_n(from[part] + row * kSide, kSide, line + part * kSide);
    }
    const float * const middle = line + kSide;
    Eight               sum = weights[0] * *reinterpret_cast<const Eight *>(middle);
    for (std::size_t k = 1; k <= Radius; ++k)
    {
      sum += weights[k] * (*reinterpret_cast<const Eight *>(middle - k) + *reinterpret_cast<const Eight *>(middle + k));
    }
    *reinterpret_cast<Eight *>(to + row * kSide) = sum;
  }
}

// sum(std::integral_constant<std::size_t, radius>): loops of known length, for each radius that kernels have.
template <typename TSum>
[[gnu::always_inline]] inline void
WithRadius(std::size_t radius, TSum sum)
{
  const auto any = [&]<std::size_t... Less>(std::index_sequence<Less...>) __attribute__((always_inline))
  {
    (void)((radius == Less + 1 && (sum(std::integral_constant<std::size_t, Less + 1>{}), true)) || ...);
  };
  any(std::make_index_sequence<kSide>{});
}

VOXELCORE_EIGHT_LANES void
SumLayers(const std::array<const float *, 3> & from,
          float *                              to,
          std::size_t                          along,
          std::size_t                          across,
          const float *                        weights,
          std::size_t                          radius)
{
  WithRadius(
    radius,
    [&](auto known)
      __attribute__((always_inline)) { SumLayersOf<decltype(known)::value>(from, to, along, across, weights); });
}

VOXELCORE_EIGHT_LANES void
SumRows(const std::array<const float *, 3> & from, float * to, const float * weights, std::size_t radius)
{
  WithRadius(
    radius,
    [&](auto known) __attribute__((always_inline)) { SumRowsOf<decltype(known)::value>(from, to, weights); });
}

// Where `parts` are given former values are kept in part; where flags are, no value contradicts them.
VOXELCORE_EIGHT_LANES void
Combine(float *              values,
        const float *        once,
        const float *        twice,
        float                weight,
        const std::uint8_t * in,
        const std::uint8_t * out,
        const float *        parts)
{
  for (std::size_t i = 0; i < kVoxels; ++i)
  {
    const float smoothed = (1 + weight) * once[i] - weight * twice[i];
    values[i] = parts == nullptr ? smoothed : values[i] + parts[i] * (smoothed - values[i]);
  }
  if (in != nullptr)
  {
    for (std::size_t i = 0; i < kVoxels; ++i)
    {
      values[i] = (in[i / kSide] >> (i % kSide) & 1) != 0 ? std::max(values[i], 0.0F) : values[i];
      values[i] = (out[i / kSide] >> (i % kSide) & 1) != 0 ? std::min(values[i], 0.0F) : values[i];
    }
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
    m_Binomial[axis] = Binomial(variance, kMostRadius);
    m_GaussToSpline[axis] = Gauss(std::max(variance - 1.0 / 3, 0.02));
  }
}

// Four sigma far, normalised.
BandField::Kernel
BandField::Gauss(double variance)
{
  Kernel kernel;
  kernel.radius =
    std::min(static_cast<std::int32_t>(kMostRadius), static_cast<std::int32_t>(std::ceil(4 * std::sqrt(variance))));
  const std::vector<double> weights = GaussWeights(variance, static_cast<std::size_t>(kernel.radius));
  std::transform(weights.begin(), weights.end(), kernel.weights.begin(), [](double w) {
    return static_cast<float>(w);
  });
  return kernel;
}

// Steps of a voxel or none, as many as give the variance while no step is taken more often than not. A binomial ends at
// half the distance where a sampled Gaussian of the same variance is small.
BandField::Kernel
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
  kernel.radius = static_cast<std::int32_t>(steps);
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

// The sums of a kernel along one axis, in place unless they come from elsewhere. Rows of bricks are gone along, what a
// brick held before is kept for the next one.
void
BandField::Sweep(std::size_t                       axis,
                 const Kernel &                    kernel,
                 const std::vector<float> *        from,
                 std::vector<float> &              values,
                 const std::vector<std::uint8_t> & needed) const
{
  constexpr std::array<std::size_t, 3> neighbour{ 1, 3, 9 };
  const auto                           radius = static_cast<std::size_t>(kernel.radius);
  const std::vector<std::uint32_t> &   starts = m_RowStarts[axis];
  const auto                           count = static_cast<std::ptrdiff_t>(starts.size());
#pragma omp parallel for schedule(dynamic, 16) if (m_Grid.Count() > static_cast <std::size_t>(BrickGrid::kMany))
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    std::array<std::array<float, kVoxels>, 2> former;
    std::size_t                               turn = 0;
    auto                                      brick = static_cast<std::int32_t>(starts[static_cast<std::size_t>(i)]);
    const float *                             before =
      Block(values, m_Grid.Neighbours(static_cast<std::size_t>(brick))[BrickGrid::kSelf - neighbour[axis]]);
    while (brick >= 0)
    {
      const std::int32_t next = m_Grid.Neighbours(static_cast<std::size_t>(brick))[BrickGrid::kSelf + neighbour[axis]];
      float * const      here = values.data() + static_cast<std::size_t>(brick) * kVoxels;
      const std::vector<float> & source = from != nullptr ? *from : values;
      const float *              middle = Block(source, brick);
      const bool                 changes = needed[static_cast<std::size_t>(brick)] != 0;
      if (from == nullptr && changes)
      {
        std::copy_n(here, kVoxels, former[turn].data());
        middle = former[turn].data();
        turn = 1 - turn;
      }
      if (changes)
      {
        const std::array<const float *, 3> blocks{ before, middle, Block(source, next) };
        if (axis == 0)
        {
          SumRows(blocks, here, kernel.weights.data(), radius);
        }
        else
        {
          const std::array<std::size_t, 2> strides{ kSide, kSide * kSide };
          SumLayers(blocks, here, strides[axis - 1], strides[2 - axis], kernel.weights.data(), radius);
        }
      }
      before = middle;
      brick = next;
    }
  }
}

// Bricks that change, and those around them that sums are taken from.
std::array<std::vector<std::uint8_t>, 3>
BandField::Rings(std::vector<std::uint8_t> changed) const
{
  std::array<std::vector<std::uint8_t>, 3> needed;
  needed[0] = std::move(changed);
  needed[1] = m_Grid.AndAround(needed[0]);
  needed[2] = m_Grid.AndAround(needed[1]);
  return needed;
}

// m_Once and m_Twice of values where they are needed; where they are not, m_Twice stays what it is.
void
BandField::SumTwice(const Kernels &                                  first,
                    const Kernels &                                  second,
                    const std::array<std::vector<std::uint8_t>, 3> & needed)
{
  m_Once.resize(m_Values.size());
  m_Twice.resize(m_Values.size());
  Sweep(2, first[2], &m_Values, m_Once, needed[2]);
  Sweep(1, first[1], nullptr, m_Once, needed[2]);
  Sweep(0, first[0], nullptr, m_Once, needed[2]);
  Sweep(2, second[2], &m_Once, m_Twice, needed[1]);
  Sweep(1, second[1], nullptr, m_Twice, needed[1]);
  Sweep(0, second[0], nullptr, m_Twice, needed[1]);
}

void
BandField::Smooth(float weight, const SmoothingZones * zones)
{
  const auto                count = static_cast<std::ptrdiff_t>(m_Grid.Count());
  std::vector<std::uint8_t> changed(m_Grid.Count(), 1);
  for (std::size_t brick = 0; zones != nullptr && brick < changed.size(); ++brick)
  {
    changed[brick] = zones->AnyIn(m_Level, m_Grid.At(brick)) ? 1 : 0;
  }
  const auto needed = Rings(std::move(changed));
  SumTwice(m_Binomial, m_Binomial, needed);
#pragma omp parallel for schedule(dynamic, 16) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto brick = static_cast<std::size_t>(i);
    if (needed[0][brick] == 0)
    {
      continue;
    }
    std::array<float, kVoxels> parts;
    if (zones != nullptr)
    {
      zones->Fill(m_Level, m_Grid.At(brick), parts);
    }
    const std::size_t at = brick * kVoxels;
    Combine(m_Values.data() + at,
            m_Once.data() + at,
            m_Twice.data() + at,
            weight,
            m_In[brick].data(),
            m_Out[brick].data(),
            zones != nullptr ? parts.data() : nullptr);
  }
}

void
BandField::FindCoefficients(float weight, std::vector<std::uint8_t> changed)
{
  const auto                count = static_cast<std::ptrdiff_t>(m_Grid.Count());
  const auto                needed = Rings(std::move(changed));
  std::vector<std::uint8_t> kept(m_Grid.Count(), 0); // sums are taken in the memory of the coefficients
  std::vector<float>        former;
  for (std::size_t brick = 0; brick < kept.size(); ++brick)
  {
    kept[brick] = needed[1][brick] != 0 && needed[0][brick] == 0 && !m_Coefficients.empty();
    if (kept[brick] != 0)
    {
      const float * const from = m_Coefficients.data() + brick * kVoxels;
      former.insert(former.end(), from, from + kVoxels);
    }
  }
  m_Twice.swap(m_Coefficients);
  SumTwice(m_GaussToSpline, m_Gauss, needed);
  m_Twice.swap(m_Coefficients);
#pragma omp parallel for schedule(dynamic, 16) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    if (needed[0][static_cast<std::size_t>(i)] != 0)
    {
      const std::size_t   at = static_cast<std::size_t>(i) * kVoxels;
      const float * const twice = m_Coefficients.data() + at;
      Combine(m_Coefficients.data() + at, m_Once.data() + at, twice, weight, nullptr, nullptr, nullptr);
    }
  }
  for (std::size_t brick = 0, from = 0; brick < kept.size(); ++brick)
  {
    if (kept[brick] != 0)
    {
      std::copy_n(former.data() + from, kVoxels, m_Coefficients.data() + brick * kVoxels);
      from += kVoxels;
    }
  }
}

void
BandField::FindCoefficients(float weight)
{
  std::vector<float>().swap(m_Twice);
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
  std::int32_t reach = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    reach = std::max(reach, m_GaussToSpline[axis].radius + m_Gauss[axis].radius);
  }
  changed = Rings(std::move(changed))[reach > BrickGrid::kSide ? 2 : 1];
  FindCoefficients(weight, changed);
  return Rings(std::move(changed))[1];
}

} // namespace voxelcore
