#include "WallSwelling.h"

#include "GaussWeights.h"
#include "SampledProfile.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

// Where the profile of a wall of half thickness `half` is 0 after smoothing; as `half` where it is nowhere. After each
// pass but the last, values that contradict labels are 0, which holds the wall back.
double
SmoothedHalf(double half, double clip, double sigma, const std::vector<float> & weights)
{
  const auto          middle = static_cast<std::ptrdiff_t>(std::ceil((half + 2 * clip + 8 * sigma) / kProfileStep));
  std::vector<double> values;
  for (std::ptrdiff_t i = -middle; i <= middle; ++i)
  {
    values.push_back(std::clamp(half - std::abs(static_cast<double>(i)) * kProfileStep, -clip, clip));
  }
  const double              width = sigma / kProfileStep;
  const std::vector<double> gauss = GaussWeights(width * width, static_cast<std::size_t>(std::ceil(5 * width)));
  const auto                isIn = [&](std::size_t i) {
    return std::abs(static_cast<double>(static_cast<std::ptrdiff_t>(i) - middle)) * kProfileStep < half;
  };
  for (std::size_t pass = 0; pass < weights.size(); ++pass)
  {
    const double              weight = weights[pass];
    const std::vector<double> once = ConvolveProfile(values, gauss);
    const std::vector<double> twice = ConvolveProfile(once, gauss);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      const double sum = (1 + weight) * once[i] - weight * twice[i];
      const bool   fits = pass + 1 == weights.size() || (sum > 0) == isIn(i);
      values[i] = fits ? sum : 0;
    }
  }
  for (auto i = static_cast<std::size_t>(middle); i + 1 < values.size(); ++i)
  {
    if (values[i] > 0 && values[i + 1] <= 0)
    {
      const double steps = static_cast<double>(i) - static_cast<double>(middle);
      return kProfileStep * (steps + values[i] / (values[i] - values[i + 1]));
    }
  }
  return half;
}

} // namespace

WallSwelling::WallSwelling(double clip, double sigma, const std::vector<float> & weights)
{
  // Thinner walls have too few voxels across for a profile without them: they are held by their labels, and less the
  // more they are thick.
  constexpr double thinnest = 1.0; // in sigmas
  constexpr double thin = 2.25;
  m_Walls.emplace_back(thinnest * sigma, 0.0);
  // Sides lie midway between two values: as many voxels' centres are just in as just out.
  const double first = (std::floor(thin * sigma / kProfileStep) + 0.5) * kProfileStep;
  const auto   halfAt = [&](int i) { return first + i * kProfileStep; };
  for (int i = 0; halfAt(i) < clip + 4 * sigma; ++i)
  {
    const double half = halfAt(i);
    const double found = SmoothedHalf(half, clip, sigma, weights);
    if (found > m_Walls.back().first)
    {
      m_Walls.emplace_back(found, found - half);
    }
  }
}

double
WallSwelling::At(double half) const
{
  const auto upper = std::lower_bound(m_Walls.begin(), m_Walls.end(), half, [](const auto & wall, double value) {
    return wall.first < value;
  });
  if (upper == m_Walls.begin() || upper == m_Walls.end())
  {
    return 0;
  }
  const auto & lower = *(upper - 1);
  const double part = (half - lower.first) / (upper->first - lower.first);
  return lower.second + part * (upper->second - lower.second);
}

} // namespace voxelcore
