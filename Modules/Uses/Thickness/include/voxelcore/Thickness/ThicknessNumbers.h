#pragma once
// What a thickness map comes to: mean, spread, quantiles and histogram over the voxels, which all have one volume.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace voxelcore
{

/** Lengths in the unit of the values. Quantiles are those of the sorted values: the least value that at least this part
 *  of them does not exceed. Of no voxels they are no numbers. */
struct ThicknessNumbers
{
  std::uint64_t voxels = 0;
  double        mean = std::numeric_limits<double>::quiet_NaN();
  double deviation = std::numeric_limits<double>::quiet_NaN(); ///< standard deviation, of all the values there are
  double least = std::numeric_limits<double>::quiet_NaN();
  double quantile5 = std::numeric_limits<double>::quiet_NaN();
  double quantile25 = std::numeric_limits<double>::quiet_NaN();
  double median = std::numeric_limits<double>::quiet_NaN();
  double quantile75 = std::numeric_limits<double>::quiet_NaN();
  double quantile95 = std::numeric_limits<double>::quiet_NaN();
  double greatest = std::numeric_limits<double>::quiet_NaN();

  double                     binWidth = 0;
  std::vector<std::uint64_t> bins; ///< voxels from i to below (i + 1) times the width; the last holds the greatest
};

/** `bin` is the least width of the bins, above 0; it is doubled until there are at most 200 bins. Without values
 *  none of the lengths is a number. */
ThicknessNumbers
SummarizeThickness(std::vector<float> values, double bin);

} // namespace voxelcore
