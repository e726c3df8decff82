#include "voxelcore/Lattice/SpacingWeights.h"

#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <cmath>
#include <sstream>

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

template <typename Values>
std::string
JoinedText(const Values & values, const char * separator)
{
  std::ostringstream text;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    text << (axis == 0 ? "" : separator) << values[axis];
  }
  return text.str();
}
} // namespace

SpacingWeights
ComputeSpacingWeights(const std::array<double, 3> & spacing)
{
  for (const double s : spacing)
  {
    // Beyond these bounds, which no microscope and no telescope reaches, areas and volumes could leave double range.
    if (!(s >= 1e-12 && s <= 1e12))
    {
      throw InputError("the voxel spacing " + JoinedText(spacing, " x ") +
                       " mm is not between 1e-12 and 1e12 mm on every axis; give the right spacing");
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
  if (!(best.deviation <= kLargestDeviation))
  {
    std::ostringstream deviation;
    deviation.precision(best.deviation < 0.1 ? 2 : 0);
    deviation << (best.deviation < 0.1 ? std::defaultfloat : std::fixed) << 100 * best.deviation;
    throw InputError("the voxel spacing " + JoinedText(spacing, " x ") +
                     " mm has no ratio in whole numbers up to 4096 (the nearest, " + JoinedText(best.weight, ":") +
                     ", is off by " + deviation.str() +
                     " %, and 0.1 % is allowed); resample to voxels closer to cubes, or give the right spacing");
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

SpacingWeights
ComputeLatticeWeights(const ImageGeometry & geometry)
{
  const SpacingWeights weights = ComputeSpacingWeights(geometry.spacing);
  RequireDistinctPositions(geometry);
  return weights;
}

} // namespace voxelcore
