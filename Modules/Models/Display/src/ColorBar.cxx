#include "ColorBar.h"

#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Base/Text.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

std::string
QuantityOf(PictureColoring coloring)
{
  switch (coloring)
  {
    case PictureColoring::Lambda:
      return "Lambda";
    case PictureColoring::ErosionThickness:
      return "Erosion thickness";
    case PictureColoring::Thickness:
      return "Thickness";
    case PictureColoring::Confidence:
      return "Confidence";
    default:
      return "Radius";
  }
}

/** Three significant digits, written out. */
std::string
ThreeDigits(double value)
{
  const int first = value != 0 ? static_cast<int>(std::floor(std::log10(std::abs(value)))) : 2;
  return FixedText(value, std::max(0, 2 - first));
}

std::string
Percent(double share)
{
  return ShortText(100 * share, 3);
}

} // namespace

double
RoundDown(double value)
{
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : { 5.0, 2.0 })
  {
    if (step * power <= value * (1 + 1e-9))
    {
      return step * power;
    }
  }
  return power;
}

std::vector<double>
RoundTicks(double low, double high, int parts)
{
  // From 2^53 steps on, the next number of steps is the same to a double: nothing lies between.
  constexpr double most = 9007199254740992;
  const double     step = high > low ? RoundDown((high - low) / parts * 1.5) : 0;
  if (!(std::max(std::abs(low), std::abs(high)) < most * step))
  {
    return { low };
  }
  std::vector<double> ticks;
  // NOLINTNEXTLINE(cert-flp30-c): whole numbers below 2^53
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
  {
    ticks.push_back(k * step);
  }
  return ticks;
}

ColorBar
DescribeColorBar(const PictureOptions & options, const ColorRange & range, bool eachLabel, SpatialUnit lengths)
{
  ColorBar          bar;
  const std::string quantity = QuantityOf(options.coloring);
  const std::string shares = Percent(options.shares.low) + " to " + Percent(options.shares.high) + " %";
  if (eachLabel)
  {
    bar.title = quantity;
    bar.caption = "of each label";
    bar.below = options.shares.low > 0;
    bar.above = options.shares.high < 1;
    bar.ticks = { { 0, Percent(options.shares.low) + " %" }, { 1, Percent(options.shares.high) + " %" } };
    return bar;
  }
  const bool       isLength = options.coloring != PictureColoring::Confidence;
  const LengthUnit unit = isLength ? LengthUnit::For(std::max(std::abs(range.low), std::abs(range.high)), lengths)
                                   : LengthUnit::For(1, SpatialUnit::Voxels); // numbers as they are
  bar.title = quantity + (isLength ? " (" + unit.Symbol() + ")" : "");
  bar.below = range.least < range.low;
  bar.above = range.greatest > range.high;
  if (!options.range && (bar.below || bar.above))
  {
    bar.caption = shares + " of area";
  }
  const auto number = [&](double mm) { return options.range ? ShortText(unit.Of(mm), 6) : ThreeDigits(unit.Of(mm)); };
  const std::string low = (bar.below ? "≤ " : "") + number(range.low);
  if (!(range.low < range.high))
  {
    bar.ticks = { { 0.5, low } };
    return bar;
  }
  constexpr double kApart = 0.09; // lest the words lie on those of an end
  bar.ticks.emplace_back(0, low);
  for (const double tick : RoundTicks(unit.Of(range.low), unit.Of(range.high), 5))
  {
    const double place = (tick - unit.Of(range.low)) / (unit.Of(range.high) - unit.Of(range.low));
    if (place > kApart && place < 1 - kApart)
    {
      bar.ticks.emplace_back(place, ShortText(std::abs(tick) < 1e-12 ? 0 : tick, 6));
    }
  }
  bar.ticks.emplace_back(1, (bar.above ? "≥ " : "") + number(range.high));
  return bar;
}

} // namespace voxelcore
