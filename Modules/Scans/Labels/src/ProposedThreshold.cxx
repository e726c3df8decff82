// Which threshold makes a shape of a grey scan, by its values alone.
//
// A scan is taken for classes, each a level with noise that is as wide on both sides, and voxels between them where a
// boundary runs through. Of each class only the side that no other class touches is looked at. What is brighter than
// the background beyond its noise is the object. Its threshold lies halfway between the two levels, where boundaries
// are; and where noise of a large background would come along, as far above it as gives the greatest expected Dice
// overlap with what is truly there. Testing/Performance/Thresholds.md has what it was measured on.

#include "voxelcore/Labels/GreyScan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace voxelcore
{
namespace
{

using Values = std::span<const double>; ///< ascending

/** Voxels of a level with noise. */
struct GreyClass
{
  double level = 0;
  double deviation = 0; ///< of normal noise
  double voxels = 0;
};

/** Of a normal distribution, the share above so many deviations. */
double
Tail(double deviations)
{
  return 0.5 * std::erfc(deviations / std::sqrt(2.0));
}

double
Below(Values values, double limit)
{
  return static_cast<double>(std::lower_bound(values.begin(), values.end(), limit) - values.begin());
}

double
Above(Values values, double limit)
{
  return static_cast<double>(values.size()) - Below(values, limit);
}

Values
BrighterThan(Values values, double limit)
{
  return values.subspan(
    static_cast<std::size_t>(std::upper_bound(values.begin(), values.end(), limit) - values.begin()));
}

/** Equal values are spread evenly over the step they were rounded by: counts then grow as those of values not rounded.
 */
std::vector<double>
Spread(Values sorted)
{
  std::vector<double> spread(sorted.begin(), sorted.end());
  if (sorted.front() == sorted.back())
  {
    return spread;
  }
  for (std::size_t begin = 0; begin < sorted.size();)
  {
    std::size_t end = begin + 1;
    while (end < sorted.size() && sorted[end] == sorted[begin])
    {
      ++end;
    }
    const double value = sorted[begin];
    const double before = begin > 0 ? value - sorted[begin - 1] : sorted[end] - value;
    const double after = end < sorted.size() ? sorted[end] - value : before;
    const double step = (before + after) / 2;
    for (std::size_t i = begin; i < end; ++i)
    {
      spread[i] = value - before / 2 + step * (static_cast<double>(i - begin) + 0.5) / static_cast<double>(end - begin);
    }
    begin = end;
  }
  return spread;
}

/** The middle of the shortest stretch that holds a tenth of the values. */
double
DensestLevel(Values values)
{
  const std::size_t tenth = std::max<std::size_t>(1, values.size() / 10);
  std::size_t       best = 0;
  double            shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + tenth < values.size(); ++i)
  {
    if (const double length = values[i + tenth] - values[i]; length < shortest)
    {
      shortest = length;
      best = i;
    }
  }
  return (values[best] + values[std::min(best + tenth, values.size() - 1)]) / 2;
}

// Of normal noise 0.2673 lies between the level and 0.73 deviations on one side, 1.6 times as much within twice that.
constexpr double kWidth = 0.73;
constexpr double kWithin = 0.2673;
constexpr double kTwice = 1.6;

/** The deviation by the values on one side of a level, where few of other classes lie within 1.5 deviations; infinite
 *  where there are too few values. */
double
DeviationOfSide(Values values, double level, bool darker)
{
  const auto        begin = static_cast<std::size_t>(Below(values, level));
  const std::size_t count = darker ? begin : values.size() - begin;
  const auto        distance = [&](std::size_t i) {
    return darker ? level - values[begin - 1 - i] : values[begin + i] - level;
  };
  const auto within = [&](double limit) { // how many of the side lie so near
    std::size_t low = 0;
    for (std::size_t high = count; low < high;)
    {
      const std::size_t middle = (low + high) / 2;
      if (distance(middle) <= limit)
      {
        low = middle + 1;
      }
      else
      {
        high = middle;
      }
    }
    return static_cast<double>(low);
  };
  // From a hundredth of the side on: fewer scatter. In some two thousand steps.
  const std::size_t first = std::max<std::size_t>(4, count / 100);
  const std::size_t step = std::max<std::size_t>(1, count / 2000);
  for (std::size_t i = first; i < count; i += step)
  {
    if (within(2 * distance(i)) <= kTwice * static_cast<double>(i))
    {
      return distance(i) / kWidth;
    }
  }
  return std::numeric_limits<double>::infinity();
}

/** Of a class that is cut off near its level, by the logarithms of counts in three bins from the cut on: a parabola. */
GreyClass
CutClass(Values values, GreyClass found)
{
  const double first = values.front();
  for (int round = 0; round < 6; ++round)
  {
    const double          width = 0.7 * found.deviation;
    std::array<double, 3> logs{};
    for (std::size_t bin = 0; bin < 3; ++bin)
    {
      const double from = first + width * static_cast<double>(bin);
      logs[bin] = std::log(Below(values, from + width) - Below(values, from));
    }
    const double bend = logs[2] - 2 * logs[1] + logs[0];
    if (!std::isfinite(bend) || !(bend < 0))
    {
      break;
    }
    const double variance = width * width / -bend - width * width / 12; // without that of the bins
    if (!(variance > 0))
    {
      break;
    }
    found.deviation = std::sqrt(variance);
    found.level = first + 1.5 * width + variance * (logs[2] - logs[0]) / (2 * width);
  }
  const double lowest = std::max(first, found.level - found.deviation);
  const double share = 1 - Tail(1) - Tail((found.level - lowest) / found.deviation);
  if (share > 0)
  {
    found.voxels = (Below(values, found.level + found.deviation) - Below(values, lowest)) / share;
  }
  return found;
}

/** The class that is densest in the values. */
GreyClass
DensestClass(Values values)
{
  GreyClass  found{ DensestLevel(values), 0, 0 };
  const auto measure = [&] {
    const double darker = DeviationOfSide(values, found.level, true);
    const double brighter = DeviationOfSide(values, found.level, false);
    const double less = std::min(darker, brighter); // another class makes a side wider, never narrower
    found.deviation = std::isfinite(less) ? less : 0;
    return brighter;
  };
  const double brighter = measure();
  const double reach = 1.5 * found.deviation;
  const bool   cutBelow = found.level - values.front() < reach;
  if (cutBelow && std::isfinite(brighter) && found.deviation > 0)
  {
    return CutClass(values, { found.level, brighter, brighter > 0 ? static_cast<double>(values.size()) : 0 });
  }
  if (values.back() - found.level > reach)
  {
    // To where both sides hold as much; a normal density falls by 0.6065 within a deviation.
    for (int round = 0; round < 8 && found.deviation > 0; ++round)
    {
      const double middle = Below(values, found.level);
      const double left = middle - Below(values, found.level - found.deviation);
      const double right = Below(values, found.level + found.deviation) - middle;
      if (left + right == 0)
      {
        break;
      }
      found.level += (right - left) * found.deviation / (left + right) / (1 - 0.6065);
      measure();
    }
  }
  // What decides is how many voxels lie far out: by those on the dark side, where they agree with those near the level.
  constexpr double far = 3; // deviations
  constexpr double most = 0.1;
  constexpr double fewest = 20; // voxels
  const double     near = kWidth * found.deviation;
  const double     counted = (Below(values, found.level + near) - Below(values, found.level - near)) / (2 * kWithin);
  const double     expected = counted * Tail(far);
  if (found.deviation > 0 && expected >= fewest && values.back() - found.level > reach)
  {
    const double deviation = (found.level - values[static_cast<std::size_t>(expected)]) / far;
    found.deviation = std::abs(deviation / found.deviation - 1) < most ? deviation : found.deviation;
  }
  const double width = kWidth * found.deviation;
  found.voxels = (Below(values, found.level + width) - Below(values, found.level - width)) / (2 * kWithin);
  return found;
}

/** Whether there is more beyond the bright noise of a class than chance and a little skew make, of `all` voxels. */
bool
HasBrighter(Values values, const GreyClass & one, double all)
{
  constexpr double far = 3.5;    // deviations
  constexpr double few = 0.0002; // of all voxels
  const double     noise = one.voxels * Tail(far);
  return Above(values, one.level + far * one.deviation) - noise > std::max(few * all, 6 * std::sqrt(noise));
}

/** Halfway between a background and what is brighter, in values that hold nothing darker than that background. */
double
Halfway(Values values, const GreyClass & background)
{
  const double level = background.level;
  const double deviation = background.deviation;
  // Not so low that what is brighter would be small beside the noise, where a few per cent of its width decide.
  double lowest = level;
  if (deviation > 0)
  {
    constexpr double least = 0.3; // of the noise
    int              steps = 20;
    const auto       limit = [&] { return level + 0.05 * steps * deviation; };
    for (; steps < 120; ++steps)
    {
      const double noise = background.voxels * Tail(0.05 * steps);
      if (Above(values, limit()) - noise >= least * noise)
      {
        break;
      }
    }
    lowest = limit();
  }
  std::vector<double> sums(values.size() + 1); // of what is brighter than each
  std::vector<double> squares(values.size() + 1);
  for (std::size_t i = values.size(); i-- > 0;)
  {
    const double above = values[i] - level;
    sums[i] = sums[i + 1] + above;
    squares[i] = squares[i + 1] + above * above;
  }
  double threshold = std::max(lowest, level + 3.5 * deviation);
  for (int round = 0; round < 40; ++round)
  {
    const auto   from = static_cast<std::size_t>(Below(values, std::nextafter(threshold, values.back())));
    const double z = deviation > 0 ? (threshold - level) / deviation : 0;
    // Of the noise above the threshold: its number, sum and sum of squares.
    const double share = deviation > 0 ? Tail(z) : 0;
    const double density = deviation > 0 ? std::exp(-z * z / 2) / std::sqrt(2 * 3.14159265358979323846) : 0;
    const double count = static_cast<double>(values.size() - from) - background.voxels * share;
    if (!(count > 0))
    {
      break;
    }
    const double mean = (sums[from] - background.voxels * deviation * density) / count;
    const double square = (squares[from] - background.voxels * deviation * deviation * (share + z * density)) / count;
    const double spread = std::sqrt(std::max(0.0, square - mean * mean - deviation * deviation));
    // Beyond noise, values spread where bodies are thin and voxels are partial: their level is the upper end, which of
    // values spread evenly is 1.73 deviations above the mean, and of bodies of many voxels less.
    constexpr double upper = 1.35; // on 36 scans of Testing/Performance/grey_thresholds.py, seeds 7301 to 7303
    const double     next = std::max(lowest, level + (mean + upper * spread) / 2);
    const bool       isThere = std::abs(next - threshold) < 1e-4 * (next - level);
    threshold = next;
    if (isThere)
    {
      break;
    }
  }
  return threshold;
}

/** From halfway on up, where the expected Dice overlap is greatest. */
double
BestAbove(Values values, const GreyClass & background, double halfway)
{
  double best = halfway;
  double highest = -1;
  double all = 0; // voxels of the object: those above halfway, as many are lost below as come along above
  for (int step = 0; step <= 120 && background.deviation > 0; ++step)
  {
    const double threshold = halfway + 0.025 * step * background.deviation;
    const double taken = Above(values, threshold);
    const double right =
      std::max(0.0, taken - background.voxels * Tail((threshold - background.level) / background.deviation));
    all = step == 0 ? right : all;
    if (const double dice = 2 * right / std::max(1.0, all + taken); dice > highest)
    {
      highest = dice;
      best = threshold;
    }
  }
  return best;
}

/** Whether a class is a background, too: much of what is there, with something brighter above it. */
bool
IsBackground(Values values, const GreyClass & one, double all)
{
  return one.voxels > 0.3 * static_cast<double>(values.size()) && HasBrighter(values, one, all);
}

} // namespace

double
ProposedThreshold(std::span<const double> sorted)
{
  if (sorted.empty() || sorted.front() == sorted.back())
  {
    return sorted.empty() ? 0 : sorted.back();
  }
  const auto                all = static_cast<double>(sorted.size());
  const std::vector<double> spread = Spread(sorted);
  Values                    part = spread;
  std::optional<GreyClass>  darker;
  // A lowest value that is a fiftieth of the voxels is padding, or all that was clipped.
  const double  lowest = all - static_cast<double>(BrighterThan(sorted, sorted.front()).size());
  const bool    hasFlat = lowest > 0.02 * all;
  constexpr int most = 4; // padding, air, what holds the object, the object
  for (int depth = 0;; ++depth)
  {
    const bool isFlat = depth == 0 && hasFlat;
    GreyClass  found = isFlat ? GreyClass{ sorted.front(), 0, lowest } : DensestClass(part);
    if (!isFlat && !HasBrighter(part, found, all)) // it is the object
    {
      GreyClass background;
      if (darker)
      {
        background = *darker;
      }
      else
      {
        const Values below = part.first(static_cast<std::size_t>(Below(part, found.level - 2.5 * found.deviation)));
        if (static_cast<double>(below.size()) < 0.05 * all) // one class: what stands out of its noise
        {
          return std::min(sorted.back(), found.level + 4 * found.deviation);
        }
        background = DensestClass(below);
      }
      return std::min(sorted.back(), BestAbove(part, background, (background.level + found.level) / 2));
    }
    const Values brighter =
      isFlat ? part.subspan(static_cast<std::size_t>(lowest)) : BrighterThan(part, found.level + 5 * found.deviation);
    if (depth + 1 < most && (isFlat || static_cast<double>(brighter.size()) > 0.1 * all))
    {
      const GreyClass next = DensestClass(brighter);
      if (IsBackground(brighter, next, all) && next.level - found.level > 4 * found.deviation)
      {
        darker = found;
        part = brighter;
        continue;
      }
    }
    return std::min(sorted.back(), BestAbove(part, found, Halfway(part, found)));
  }
}

} // namespace voxelcore
