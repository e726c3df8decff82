#include "voxelcore/Labels/GreyScan.h"

#include "GreyTest.h"

#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{
namespace
{

constexpr std::size_t kBins = 16;

/** The value behind which the brighter class begins: Otsu's threshold, exactly, of ascending values. */
double
OtsuThreshold(const std::vector<double> & ascending)
{
  // Differences from the first value: sums stay short.
  const double base = ascending.front();
  double       total = 0;
  for (const double value : ascending)
  {
    total += value - base;
  }
  const auto  count = static_cast<double>(ascending.size());
  double      below = 0;
  double      best = -1;
  std::size_t split = 0; // the last of the darker class
  for (std::size_t i = 0; i + 1 < ascending.size(); ++i)
  {
    below += ascending[i] - base;
    if (ascending[i] == ascending[i + 1])
    {
      continue;
    }
    const double left = static_cast<double>(i + 1);
    const double difference = below / left - (total - below) / (count - left);
    const double between = left * (count - left) * difference * difference;
    if (between > best)
    {
      best = between;
      split = i;
    }
  }
  const double last = ascending[split];
  const double next = ascending[std::min(split + 1, ascending.size() - 1)];
  if (last == std::floor(last) && next == std::floor(next))
  {
    return last + 1;
  }
  return last + (next - last) / 2;
}

/** With so few digits as a person would give. */
double
Rounded(double value)
{
  if (value == 0 || value == std::floor(value))
  {
    return value;
  }
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 3);
  return ParseReal(Number(std::round(value / unit) * unit)).value_or(value);
}

} // namespace

GreyScan
GreyTest::Describe() const
{
  GreyScan            grey;
  const Neighbours    found = CountNeighbours();
  std::vector<double> shares;
  for (const auto & [value, of] : found.values)
  {
    if (of.pairs > 0)
    {
      shares.push_back(static_cast<double>(of.equal) / static_cast<double>(of.pairs));
    }
  }
  grey.distinct = found.values.size();
  if (!shares.empty())
  {
    std::nth_element(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2), shares.end());
    grey.equal = shares[shares.size() / 2];
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < ValueCount(); ++i)
  {
    if (const double value = Value(i); std::isfinite(value))
    {
      values.push_back(value);
    }
  }
  if (values.empty())
  {
    return grey;
  }
  std::sort(values.begin(), values.end());
  grey.lowest = values.front();
  grey.highest = values.back();
  grey.otsu = Rounded(OtsuThreshold(values));
  grey.proposed = Rounded(ProposedThreshold(values));
  // Bins between the 0.1st and 99.9th percentile, the outer ones open: a speck of metal must not flatten the rest.
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  const double low = at(0.001);
  const double high = at(0.999);
  for (std::size_t b = 0; b <= kBins; ++b)
  {
    grey.edges.push_back(low + (high - low) * static_cast<double>(b) / static_cast<double>(kBins));
  }
  grey.edges.front() = grey.lowest;
  grey.edges.back() = grey.highest;
  auto from = values.begin();
  for (std::size_t b = 0; b < kBins; ++b)
  {
    const auto to = b + 1 == kBins ? values.end() : std::lower_bound(from, values.end(), grey.edges[b + 1]);
    grey.counts.push_back(static_cast<std::uint64_t>(to - from));
    from = to;
  }
  return grey;
}

std::string
ProposedRange(const GreyScan & grey)
{
  return Number(grey.proposed) + ":inf";
}

std::string
GreyScanText(const GreyScan & grey)
{
  return Text("looks like a grey scan (",
              grey.distinct >= GreyTest::kMostDistinct ? "more than " : "",
              grey.distinct >= GreyTest::kMostDistinct ? GreyTest::kMostDistinct : grey.distinct,
              " values from ",
              Number(grey.lowest),
              " to ",
              Number(grey.highest),
              ", neighbouring voxels are rarely equal)");
}

} // namespace voxelcore
