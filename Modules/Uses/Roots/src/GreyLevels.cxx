#include "voxelcore/Roots/GreyLevels.h"

#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr std::size_t kHistogramBins = 64;

/** Values from a background to something bright, counted. */
class Histogram
{
public:
  Histogram(std::span<const float> values, double low, double high)
    : m_Low(low)
    , m_Step((high - low) / kHistogramBins)
  {
    for (const float value : values)
    {
      const double bin = std::floor((value - low) / m_Step);
      m_Counts[static_cast<std::size_t>(std::clamp(bin, 0.0, kHistogramBins - 1.0))] += 1;
    }
  }

  double
  Otsu() const
  {
    double total = 0;
    double sum = 0;
    for (std::size_t bin = 0; bin < kHistogramBins; ++bin)
    {
      total += m_Counts[bin];
      sum += m_Counts[bin] * static_cast<double>(bin);
    }
    double      below = 0;
    double      belowSum = 0;
    double      best = -1;
    std::size_t at = 0;
    for (std::size_t bin = 0; bin + 1 < kHistogramBins; ++bin)
    {
      below += m_Counts[bin];
      belowSum += m_Counts[bin] * static_cast<double>(bin);
      const double above = total - below;
      if (below > 0 && above > 0)
      {
        const double apart = belowSum / below - (sum - belowSum) / above;
        if (below * above * apart * apart > best)
        {
          best = below * above * apart * apart;
          at = bin;
        }
      }
    }
    return m_Low + static_cast<double>(at + 1) * m_Step;
  }

  /** The middle of the least count, smoothed over five bins, between the fullest bins of the lower and upper half. */
  double
  Valley() const
  {
    std::array<double, kHistogramBins> smooth{};
    for (std::size_t bin = 0; bin < kHistogramBins; ++bin)
    {
      for (std::size_t k = bin >= 2 ? bin - 2 : 0; k < std::min(kHistogramBins, bin + 3); ++k)
      {
        smooth[bin] += m_Counts[k];
      }
    }
    const auto middle = smooth.begin() + kHistogramBins / 2;
    const auto from = std::max_element(smooth.begin(), middle);
    const auto to = std::max_element(middle, smooth.end());
    const auto least = std::min_element(from, to + 1);
    return m_Low + (static_cast<double>(least - smooth.begin()) + 0.5) * m_Step;
  }

private:
  double                             m_Low;
  double                             m_Step;
  std::array<double, kHistogramBins> m_Counts{};
};

double
Median(std::vector<float> & values)
{
  if (values.empty())
  {
    return 0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** Calls visit(x, y, z, value) for the voxels of the band, in scan order. */
template <typename TVisit>
void
VisitBand(const BandValues & values, const TVisit & visit)
{
  const VoxelShape & band = values.Band();
  const auto &       lower = band.Box().lower;
  std::size_t        at = 0;
  for (std::int32_t z = 0; z < band.Box().size[2]; ++z)
  {
    for (std::int32_t y = 0; y < band.Box().size[1]; ++y)
    {
      const auto row = band.Row(y, z);
      for (std::size_t word = 0; word < row.size(); ++word)
      {
        for (std::uint64_t bits = row[word]; bits != 0; bits &= bits - 1, ++at)
        {
          visit(static_cast<std::int32_t>(64 * word) + std::countr_zero(bits) + lower[0],
                y + lower[1],
                z + lower[2],
                values.All()[at]);
        }
      }
    }
  }
}

} // namespace

BandValues::BandValues(VoxelShape band)
  : m_Band(std::move(band))
{
  std::uint64_t count = 0;
  const auto    rowsY = m_Band.Box().size[1];
  const auto    rowsZ = m_Band.Box().size[2];
  m_Before.reserve(static_cast<std::size_t>(rowsY) * static_cast<std::size_t>(rowsZ));
  m_InRow.reserve(m_Before.capacity() * m_Band.WordsPerRow());
  for (std::int32_t z = 0; z < rowsZ; ++z)
  {
    for (std::int32_t y = 0; y < rowsY; ++y)
    {
      m_Before.push_back(count);
      std::uint32_t inRow = 0;
      for (const std::uint64_t word : std::as_const(m_Band).Row(y, z))
      {
        m_InRow.push_back(inRow);
        inRow += CountBits(word);
      }
      count += inRow;
    }
  }
  m_Values.resize(count);
}

std::size_t
BandValues::Number(std::int32_t x, std::int32_t y, std::int32_t z) const
{
  const VoxelBox &  box = m_Band.Box();
  const std::size_t row = static_cast<std::size_t>(z - box.lower[2]) * static_cast<std::size_t>(box.size[1]) +
                          static_cast<std::size_t>(y - box.lower[1]);
  const auto          at = static_cast<std::uint32_t>(x - box.lower[0]);
  const std::uint64_t word = m_Band.Row(y - box.lower[1], z - box.lower[2])[at / 64];
  const std::uint64_t below = word & ((std::uint64_t{ 1 } << (at % 64)) - 1);
  return m_Before[row] + m_InRow[row * m_Band.WordsPerRow() + at / 64] + CountBits(below);
}

void
BandValues::SetRow(std::int32_t y, std::int32_t z, std::span<const float> row)
{
  const VoxelBox & box = m_Band.Box();
  const auto       words = std::as_const(m_Band).Row(y - box.lower[1], z - box.lower[2]);
  std::size_t      at = m_Before[static_cast<std::size_t>(z - box.lower[2]) * static_cast<std::size_t>(box.size[1]) +
                            static_cast<std::size_t>(y - box.lower[1])];
  for (std::size_t word = 0; word < words.size(); ++word)
  {
    for (std::uint64_t bits = words[word]; bits != 0; bits &= bits - 1, ++at)
    {
      m_Values[at] = row[64 * word + static_cast<std::size_t>(std::countr_zero(bits))];
    }
  }
}

VoxelShape
AtLeast(const VoxelShape & shape, const BandValues & values, double shapeLevel, double level)
{
  VoxelShape result(values.Band().Box());
  VisitBand(values, [&](std::int32_t x, std::int32_t y, std::int32_t z, float value) {
    const bool isIn = shape.Contains(x, y, z);
    const bool isForced = isIn != (value >= shapeLevel); // filled, or taken out
    if (isForced ? isIn : value >= level)
    {
      result.Insert(x, y, z);
    }
  });
  return result;
}

GreyLevels
ProposeLevels(const VoxelShape & shape, const BandValues & values, double level)
{
  std::vector<float> inside;
  std::vector<float> outside;
  VisitBand(values, [&](std::int32_t x, std::int32_t y, std::int32_t z, float value) {
    (shape.Contains(x, y, z) ? inside : outside).push_back(value);
  });
  GreyLevels levels;
  levels.background = Median(outside);
  levels.bright = Median(inside);
  levels.shape = levels.otsu = levels.valley = levels.neighbourhood = levels.kernel = level;
  if (!(levels.background < level && level < levels.bright))
  {
    return levels;
  }
  const Histogram histogram(values.All(), levels.background, levels.bright);
  levels.otsu = histogram.Otsu();
  levels.valley = histogram.Valley();
  for (const double part : { 0.6, 0.4, 0.2 })
  {
    levels.tried.push_back({ level - part * (level - levels.background), {} });
  }
  levels.tried.push_back({ level, {} });
  for (const double part : { 0.2, 0.4, 0.6 })
  {
    levels.tried.push_back({ level + part * (levels.bright - level), {} });
  }
  RunEach(levels.tried.size(), [&](std::size_t i) {
    levels.tried[i].numbers = ComputeShapeTopology(AtLeast(shape, values, level, levels.tried[i].level));
  });
  const auto sum = [](const LevelNumbers & one) {
    const auto & betti = one.numbers.betti;
    return betti[0] + betti[1] + betti[2];
  };
  const LevelNumbers * kernel = nullptr;
  const LevelNumbers * around = nullptr;
  for (const LevelNumbers & one : levels.tried)
  {
    if (one.level > level && (kernel == nullptr || one.numbers.betti[1] < kernel->numbers.betti[1]))
    {
      kernel = &one;
    }
    if (one.level < level && (around == nullptr || sum(one) <= sum(*around)))
    {
      around = &one;
    }
  }
  levels.kernel = kernel->level;
  levels.neighbourhood = around->level;
  return levels;
}

} // namespace voxelcore
