#pragma once
// Values along a line across a boundary.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace voxelcore
{

constexpr double kProfileStep = 0.25; ///< from value to value

/** Weights by distance from the centre; beyond its ends a profile goes on as there. */
inline std::vector<double>
ConvolveProfile(const std::vector<double> & from, const std::vector<double> & weights)
{
  const auto          size = static_cast<std::ptrdiff_t>(from.size());
  std::vector<double> to(from.size());
  for (std::ptrdiff_t i = 0; i < size; ++i)
  {
    double sum = weights[0] * from[static_cast<std::size_t>(i)];
    for (std::size_t k = 1; k < weights.size(); ++k)
    {
      const auto lower = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, i - static_cast<std::ptrdiff_t>(k)));
      const auto upper = static_cast<std::size_t>(std::min(size - 1, i + static_cast<std::ptrdiff_t>(k)));
      sum += weights[k] * (from[lower] + from[upper]);
    }
    to[static_cast<std::size_t>(i)] = sum;
  }
  return to;
}

} // namespace voxelcore
