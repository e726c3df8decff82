#include "TimeLeft.h"

#include <algorithm>

namespace voxelcore
{

std::optional<double>
SecondsLeft(std::vector<double>         finishedSeconds,
            const std::vector<double> & runningSeconds,
            std::size_t                 waiting,
            std::size_t                 atATime)
{
  if (finishedSeconds.empty())
  {
    return std::nullopt;
  }
  const auto middle = finishedSeconds.begin() + static_cast<std::ptrdiff_t>(finishedSeconds.size() / 2);
  std::nth_element(finishedSeconds.begin(), middle, finishedSeconds.end());
  const double median = *middle;
  double       work = median * static_cast<double>(waiting);
  double       longest = waiting > 0 ? median : 0;
  for (const double seconds : runningSeconds)
  {
    const double lacks = std::max(0.0, median - seconds);
    work += lacks;
    longest = std::max(longest, lacks);
  }
  return std::max(longest, work / static_cast<double>(std::max<std::size_t>(1, atATime)));
}

} // namespace voxelcore
