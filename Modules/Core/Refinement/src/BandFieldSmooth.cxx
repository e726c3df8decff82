// How a band field is smoothed.

#include "BandField.h"

#include "BrickSums.h"
#include "GaussWeights.h"

#include "voxelcore/Base/EightLanes.h"

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
  using Eight = EightFloats;
  using Flags = std::int32_t __attribute__((vector_size(32)));
  constexpr Flags single{ 1, 2, 4, 8, 16, 32, 64, 128 };
  constexpr Eight zero{};
  for (std::size_t row = 0, i = 0; i < kVoxels; ++row, i += kSide)
  {
    const Eight smoothed = (1 + weight) * EightAt(once + i)->lanes - weight * EightAt(twice + i)->lanes;
    const Eight former = EightAt(values + i)->lanes;
    Eight       sum = parts == nullptr ? smoothed : former + EightAt(parts + i)->lanes * (smoothed - former);
    if (in != nullptr)
    {
      const Flags isIn = (single & in[row]) != 0;
      const Flags isOut = (single & out[row]) != 0;
      sum = (isIn & (sum < zero)) ? zero : sum;
      sum = (isOut & (sum > zero)) ? zero : sum;
    }
    EightAt(values + i)->lanes = sum;
  }
}

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
  const bool                      all = std::find(changed.begin(), changed.end(), 0) == changed.end();
  const std::vector<std::uint8_t> needed = all ? changed : m_Grid.AndAround(changed);
  const std::size_t               planes = m_Planes.size() - 1;
  std::size_t                     most = 0;
  for (std::size_t plane = 0; plane < planes; ++plane)
  {
    most = std::max<std::size_t>(most, m_Planes[plane + 1].brick - m_Planes[plane].brick);
  }
  m_Once.resize(slots * most * kVoxels);
  float * const once = m_Once.data();
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
    PlaneValues       sums{ once, {} };
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
          row.Of(brick, once + (static_cast<std::ptrdiff_t>(brick) + shift) * static_cast<std::ptrdiff_t>(kVoxels));
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
                   once + (static_cast<std::ptrdiff_t>(brick) + sums.shift[1]) * static_cast<std::ptrdiff_t>(kVoxels),
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

// Where a slab ends what lies beside it is needed, too: feet go 6 voxels far, and so into the next brick, and what is
// evaluated there reaches into the next but one.
std::vector<BandField::Slab>
BandField::Slabs() const
{
  constexpr std::size_t few = 24;
  constexpr std::size_t least = 8;
  constexpr std::size_t parts = 6;
  const std::size_t     planes = m_Planes.size() - 1;
  const std::size_t     length = planes < few ? planes : std::max(least, planes / parts);
  std::vector<Slab>     slabs;
  for (std::size_t first = 0; first < planes; first += length)
  {
    slabs.push_back({ first, std::min(planes, first + length) });
  }
  return slabs;
}

void
BandField::FindCoefficients(float weight, const Slab & slab, const std::vector<std::uint8_t> & changed)
{
  constexpr std::int32_t beside = 2;
  if (HasAllCoefficients())
  {
    return;
  }
  const std::size_t         planes = m_Planes.size() - 1;
  const bool                all = slab.first == 0 && slab.end == planes;
  std::vector<std::uint8_t> bricks(m_Grid.Count(), 1);
  std::size_t               first = 0;
  std::size_t               end = m_Grid.Count();
  if (!all)
  {
    bricks = changed.empty() ? bricks : m_Grid.AndAround(m_Grid.AndAround(changed));
    const auto isNear = [&](std::size_t brick) {
      const std::int32_t plane = m_Grid.At(brick)[2];
      return plane >= PlaneAt(slab.first) - beside && plane <= PlaneAt(slab.end - 1) + beside;
    };
    while (!isNear(first))
    {
      bricks[first++] = 0;
    }
    while (!isNear(end - 1))
    {
      bricks[--end] = 0;
    }
  }
  // What the slab before has found for this one stays.
  const std::size_t found = slab.first == 0 ? first : m_FirstCoefficient + m_Coefficients.size() / kVoxels;
  if (found > first)
  {
    const auto from = m_Coefficients.begin() + static_cast<std::ptrdiff_t>((first - m_FirstCoefficient) * kVoxels);
    std::copy(from, m_Coefficients.end(), m_Coefficients.begin());
    std::fill(bricks.begin() + static_cast<std::ptrdiff_t>(first),
              bricks.begin() + static_cast<std::ptrdiff_t>(found),
              std::uint8_t{ 0 });
  }
  m_FirstCoefficient = first;
  m_Coefficients.resize((end - first) * kVoxels);
  FindCoefficientsOf(weight, bricks);
}

void
BandField::FindCoefficientsOf(float weight, const std::vector<std::uint8_t> & bricks)
{
  SumTwice(m_GaussToSpline, m_Gauss, bricks, [&](std::size_t brick, const float * once, const float * twice) {
    Combine(m_Coefficients.data() + (brick - m_FirstCoefficient) * kVoxels,
            once,
            twice,
            weight,
            nullptr,
            nullptr,
            nullptr);
  });
}

void
BandField::FindCoefficients(float weight)
{
  if (!HasAllCoefficients())
  {
    Values<float>().swap(m_Coefficients);
    m_FirstCoefficient = 0;
    const std::vector<std::uint8_t> all(m_Grid.Count(), 1);
    SumTwice(m_GaussToSpline, m_Gauss, all, [&](std::size_t brick, const float * once, const float * twice) {
      Combine(m_Values.data() + brick * kVoxels, once, twice, weight, nullptr, nullptr, nullptr);
    });
    m_Coefficients.swap(m_Values);
  }
  DropValues();
}

void
BandField::DropValues()
{
  Values<float>().swap(m_Values);
  Values<float>().swap(m_Once);
  std::vector<BrickGrid::Flags>().swap(m_In);
  std::vector<BrickGrid::Flags>().swap(m_Out);
}

} // namespace voxelcore
