#include "SampledProfile.h"

#include "voxelcore/Base/EightLanes.h"

#include <algorithm>
#include <cstddef>

namespace voxelcore
{

namespace
{

// Weight by weight, so that many values are summed up at once. `from` goes on for as many values as there are weights
// on either side.
VOXELCORE_EIGHT_LANES void
AddWeighted(const double * from, std::ptrdiff_t size, const std::vector<double> & weights, double * to)
{
  for (std::ptrdiff_t i = 0; i < size; ++i)
  {
    to[i] = weights[0] * from[i];
  }
  for (std::size_t k = 1; k < weights.size(); ++k)
  {
    const double         weight = weights[k];
    const double * const before = from - k;
    const double * const after = from + k;
    for (std::ptrdiff_t i = 0; i < size; ++i)
    {
      to[i] += weight * (before[i] + after[i]);
    }
  }
}

} // namespace

std::vector<double>
ConvolveProfile(const std::vector<double> & from, const std::vector<double> & weights)
{
  const std::size_t   beyond = weights.size();
  std::vector<double> longer(from.size() + 2 * beyond, from.back());
  std::fill_n(longer.begin(), beyond, from.front());
  std::copy(from.begin(), from.end(), longer.begin() + static_cast<std::ptrdiff_t>(beyond));
  std::vector<double> to(from.size());
  AddWeighted(longer.data() + beyond, static_cast<std::ptrdiff_t>(from.size()), weights, to.data());
  return to;
}

} // namespace voxelcore
