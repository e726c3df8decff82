#include "voxelcore/Thickness/ThicknessNumbers.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

ThicknessNumbers
SummarizeThickness(std::vector<float> values, double bin)
{
  constexpr double most = 200;
  ThicknessNumbers numbers;
  numbers.voxels = values.size();
  numbers.binWidth = bin;
  if (values.empty())
  {
    return numbers;
  }
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (const float value : values)
  {
    sum += value;
  }
  const auto count = static_cast<double>(values.size());
  numbers.mean = sum / count;
  double squares = 0;
  for (const float value : values)
  {
    squares += (value - numbers.mean) * (value - numbers.mean);
  }
  numbers.deviation = std::sqrt(squares / count);
  const auto quantile = [&](double part) {
    const auto rank = static_cast<std::size_t>(std::ceil(part * count));
    return static_cast<double>(values[std::clamp<std::size_t>(rank, 1, values.size()) - 1]);
  };
  numbers.least = values.front();
  numbers.quantile5 = quantile(0.05);
  numbers.quantile25 = quantile(0.25);
  numbers.median = quantile(0.5);
  numbers.quantile75 = quantile(0.75);
  numbers.quantile95 = quantile(0.95);
  numbers.greatest = values.back();
  while (numbers.greatest / numbers.binWidth >= most)
  {
    numbers.binWidth *= 2;
  }
  numbers.bins.assign(static_cast<std::size_t>(numbers.greatest / numbers.binWidth) + 1, 0);
  for (const float value : values)
  {
    ++numbers.bins[static_cast<std::size_t>(value / numbers.binWidth)];
  }
  return numbers;
}

} // namespace voxelcore
