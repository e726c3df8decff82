#include "voxelcore/SpacingWeights.h"

#include "voxelcore/Error.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{
constexpr std::int64_t largestWeight = 4096;
constexpr double       tolerance = 1e-6;

// Largest relative error of a ratio of two weights against the ratio of their spacings.
double
Deviation(const std::array<std::int64_t, 3> & weight, const std::array<double, 3> & spacing)
{
  double worst = 0.0;
  for (std::size_t a = 0; a < 3; ++a)
  {
    for (std::size_t b = a + 1; b < 3; ++b)
    {
      const double ratio =
        (static_cast<double>(weight[a]) * spacing[b]) / (static_cast<double>(weight[b]) * spacing[a]);
      worst = std::max(worst, std::max(ratio, 1.0 / ratio) - 1.0);
    }
  }
  return worst;
}
} // namespace

SpacingWeights
ComputeSpacingWeights(const std::array<double, 3> & spacing)
{
  for (const double s : spacing)
  {
    if (!std::isfinite(s) || s <= 0.0)
    {
      throw InputError("the voxel spacing is not finite and positive on every axis; give it with --spacing");
    }
  }
  const double   longest = *std::max_element(spacing.begin(), spacing.end());
  SpacingWeights best;
  best.deviation = HUGE_VAL;
  for (std::int64_t greatest = 1; greatest <= largestWeight; ++greatest)
  {
    std::array<std::int64_t, 3> weight{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      weight[axis] = std::max<std::int64_t>(1, std::llround(spacing[axis] / longest * static_cast<double>(greatest)));
    }
    const double deviation = Deviation(weight, spacing);
    if (deviation < best.deviation)
    {
      best.weight = weight;
      best.deviation = deviation;
      if (deviation <= tolerance)
      {
        break;
      }
    }
  }
  double product = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    product *= spacing[axis] / static_cast<double>(best.weight[axis]);
  }
  // Equal ratios, the common case, give the unit without the rounding of a cube root.
  const double first = spacing[0] / static_cast<double>(best.weight[0]);
  const bool   same = first == spacing[1] / static_cast<double>(best.weight[1]) &&
                    first == spacing[2] / static_cast<double>(best.weight[2]);
  best.unit = same ? first : std::cbrt(product);
  return best;
}

} // namespace voxelcore
