#pragma once
// What a thickness map comes to: mean, spread, quantiles and histogram over the voxels, which all have one volume.

#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** Lengths in the unit of the values. Quantiles are those of the sorted values: the least value that at least this part
 *  of them does not exceed. */
struct ThicknessNumbers
{
  std::uint64_t voxels = 0;
  double        mean = 0;
  double        deviation = 0; ///< standard deviation, of all the values there are
  double        least = 0;
  double        quantile5 = 0;
  double        quantile25 = 0;
  double        median = 0;
  double        quantile75 = 0;
  double        quantile95 = 0;
  double        greatest = 0;

  double                     binWidth = 0;
  std::vector<std::uint64_t> bins; ///< voxels from i to below (i + 1) times the width; the last holds the greatest
};

/** `bin` is the least width of the bins, above 0; it is doubled until there are at most 200 bins. All zero for no
 *  values; the values are sorted. */
ThicknessNumbers
SummarizeThickness(std::vector<float> values, double bin);

} // namespace voxelcore
