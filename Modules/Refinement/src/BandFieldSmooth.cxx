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

// Sums of sums, where something changes: use(brick, once, twice). Plane by plane, two behind the first sums, so that
// these are needed of four planes alone, and values of what has been used may change.
template <typename TUse>
void
BandField::SumTwice(const Kernels & first, const Kernels & second, const std::vector<std::uint8_t> & changed, TUse use)
{
  constexpr std::size_t           slots = 4;
  const std::vector<std::uint8_t> needed = m_Grid.AndAround(changed);
  const std::size_t               planes = m_Planes.size() - 1;
  std::size_t                     most = 0;
  for (std::size_t plane = 0; plane < planes; ++plane)
  {
    most = std::max<std::size_t>(most, m_Planes[plane + 1].brick - m_Planes[plane].brick);
  }
  Values<float> once(slots * most * kVoxels);
  const auto    shiftOf = [&](std::size_t plane) {
    return static_cast<std::ptrdiff_t>(plane % slots * most) - static_cast<std::ptrdiff_t>(m_Planes[plane].brick);
  };
  const auto sumRow = [&](std::size_t                       row,
                          const Kernels &                   kernels,
                          const PlaneValues &               values,
                          const std::vector<std::uint8_t> & wanted,
                          auto                              get) {
    BrickSums sums(m_Grid, kernels, values, m_FarBlocks);
    for (auto brick = static_cast<std::int32_t>(m_RowStarts[row]); brick >= 0;
         brick = m_Grid.Neighbours(static_cast<std::size_t>(brick))[BrickGrid::kSelf + 1])
    {
      if (wanted[static_cast<std::size_t>(brick)] != 0)
      {
        get(static_cast<std::size_t>(brick), sums);
      }
    }
  };
  const PlaneValues values{ m_Values.data(), {} };
#pragma omp parallel if (m_Grid.Count() > static_cast <std::size_t>(BrickGrid::kMany))
  for (std::size_t plane = 0; plane < planes + 2; ++plane)
  {
    const auto range = [&](std::size_t which) {
      return which < planes ? std::array{ m_Planes[which].row, m_Planes[which + 1].row }
                            : std::array<std::uint32_t, 2>{ 0, 0 };
    };
    const auto        ahead = range(plane);
    const auto        behind = range(plane - 2);
    const std::size_t own = plane - 2;
    PlaneValues       sums{ once.data(), {} };
    for (std::size_t i = 0; i < 3 && behind[0] < behind[1]; ++i)
    {
      sums.shift[i] = own + i >= 1 && own + i <= planes ? shiftOf(own + i - 1) : 0;
    }
    const std::ptrdiff_t shift = ahead[0] < ahead[1] ? shiftOf(plane) : 0;
    const auto           firsts = static_cast<std::ptrdiff_t>(ahead[1] - ahead[0]);
    const auto           count = firsts + static_cast<std::ptrdiff_t>(behind[1] - behind[0]);
#pragma omp for schedule(dynamic, 2)
    for (std::ptrdiff_t i = 0; i < count; ++i)
    {
      if (i < firsts)
      {
        sumRow(ahead[0] + static_cast<std::size_t>(i), first, values, needed, [&](std::size_t brick, BrickSums & row) {
          row.Of(brick,
                 once.data() + (static_cast<std::ptrdiff_t>(brick) + shift) * static_cast<std::ptrdiff_t>(kVoxels));
        });
        continue;
      }
      sumRow(behind[0] + static_cast<std::size_t>(i - firsts),
             second,
             sums,
             changed,
             [&](std::size_t brick, BrickSums & row) {
               BrickValues twice;
               row.Of(brick, twice.data());
               use(brick,
                   once.data() +
                     (static_cast<std::ptrdiff_t>(brick) + sums.shift[1]) * static_cast<std::ptrdiff_t>(kVoxels),
                   twice.data());
             });
    }
  }
}

void
BandField::Smooth(float weight, const SmoothingZones * zones)
{
  std::vector<std::uint8_t> changed(m_Grid.Count(), 1);
  for (std::size_t brick = 0; zones != nullptr && brick < changed.size(); ++brick)
  {
    changed[brick] = zones->AnyIn(m_Level, m_Grid.At(brick)) ? 1 : 0;
  }
  SumTwice(m_Binomial, m_Binomial, changed, [&](std::size_t brick, const float * once, const float * twice) {
    BrickValues parts;
    if (zones != nullptr)
    {
      zones->Fill(m_Level, m_Grid.At(brick), parts);
    }
    Combine(m_Values.data() + brick * kVoxels,
            once,
            twice,
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
  SumTwice(m_GaussToSpline, m_Gauss, changed, [&](std::size_t brick, const float * once, const float * twice) {
    Combine(m_Coefficients.data() + brick * kVoxels, once, twice, weight, nullptr, nullptr, nullptr);
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
  Values<float>().swap(m_Values);
  std::vector<BrickGrid::Flags>().swap(m_In);
  std::vector<BrickGrid::Flags>().swap(m_Out);
}

BandField::Snapshot
BandField::Save(const SmoothingZones & zones) const
{
  Snapshot saved;
  for (std::size_t brick = 0; brick < m_Grid.Count(); ++brick)
  {
    if (zones.AnyIn(m_Level, m_Grid.At(brick)))
    {
      saved.bricks.push_back(static_cast<std::uint32_t>(brick));
    }
  }
  const float unit = kSavedUnits / m_Far;
  const auto  count = static_cast<std::ptrdiff_t>(saved.bricks.size());
  saved.values.resize(saved.bricks.size() * kVoxels);
#pragma omp parallel for schedule(static) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const float * const from = m_Values.data() + saved.bricks[static_cast<std::size_t>(i)] * kVoxels;
    std::transform(
      from,
      from + kVoxels,
      saved.values.begin() + i * static_cast<std::ptrdiff_t>(kVoxels),
      [&](float value) { return static_cast<std::int16_t>(std::clamp(value * unit, -32767.0F, 32767.0F)); });
  }
  return saved;
}

std::vector<std::uint8_t>
BandField::LeftOut(const SmoothingZones & zones, int passes) const
{
  const auto                count = static_cast<std::ptrdiff_t>(m_Grid.Count());
  std::vector<std::uint8_t> bricks(m_Grid.Count(), 0);
#pragma omp parallel for schedule(dynamic, 16) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto brick = static_cast<std::size_t>(i);
    bricks[brick] = zones.AnyLeftOutIn(m_Level, m_Grid.At(brick)) ? 1 : 0;
  }
  std::size_t reach = 0;
  for (const Kernel & kernel : m_Binomial)
  {
    reach = std::max(reach, 2 * kernel.radius * static_cast<std::size_t>(passes));
  }
  for (std::size_t ring = 0; ring < reach; ring += kSide)
  {
    bricks = m_Grid.AndAround(bricks);
  }
  return bricks;
}

std::vector<std::uint8_t>
BandField::BlendWith(const Snapshot & former, const SmoothingZones & zones, float weight)
{
  const float                unit = m_Far / kSavedUnits;
  std::vector<std::uint32_t> places(m_Grid.Count(), 0); // one more than in the snapshot
  for (std::size_t i = 0; i < former.bricks.size(); ++i)
  {
    places[former.bricks[i]] = static_cast<std::uint32_t>(i + 1);
  }
  const auto formerOf = [&](std::size_t brick, BrickValues & values) {
    const auto from =
      former.values.begin() + (static_cast<std::ptrdiff_t>(places[brick]) - 1) * static_cast<std::ptrdiff_t>(kVoxels);
    const bool saved = places[brick] != 0;
    if (saved)
    {
      std::transform(from, from + static_cast<std::ptrdiff_t>(kVoxels), values.begin(), [&](std::int16_t value) {
        return unit * static_cast<float>(value);
      });
    }
    return saved;
  };
  return Blend(formerOf, zones, weight);
}

std::vector<std::uint8_t>
BandField::BlendWith(const BandField & former, const SmoothingZones & zones, float weight)
{
  const auto formerOf = [&](std::size_t brick, BrickValues & values) {
    const auto from = static_cast<std::size_t>(former.m_Grid.Find(m_Grid.At(brick))) * kVoxels;
    std::copy_n(former.m_Values.begin() + static_cast<std::ptrdiff_t>(from), kVoxels, values.begin());
    return true;
  };
  return Blend(formerOf, zones, weight);
}

// formerOf(brick, values): whether it has changed, and what its values were.
template <typename TFormer>
std::vector<std::uint8_t>
BandField::Blend(const TFormer & formerOf, const SmoothingZones & zones, float weight)
{
  const auto                count = static_cast<std::ptrdiff_t>(m_Grid.Count());
  std::vector<std::uint8_t> changed = LeftOut(zones, 0);
#pragma omp parallel for schedule(dynamic, 16) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto  brick = static_cast<std::size_t>(i);
    BrickValues former;
    if (changed[brick] == 0 || !formerOf(brick, former))
    {
      changed[brick] = 0;
      continue;
    }
    BrickValues parts;
    zones.Fill(m_Level, m_Grid.At(brick), parts);
    float * const values = m_Values.data() + brick * kVoxels;
    for (std::size_t voxel = 0; voxel < kVoxels; ++voxel)
    {
      values[voxel] = former[voxel] + parts[voxel] * (values[voxel] - former[voxel]);
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
