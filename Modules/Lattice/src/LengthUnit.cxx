#include "voxelcore/LengthUnit.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace voxelcore
{

namespace
{

constexpr const char * kNames[] = { "mm", "um", "nm" };
constexpr const char * kSymbols[] = { "mm", "µm", "nm" };
constexpr double       kLeast = 0.1; ///< of a unit, for which the next smaller one is not yet taken

} // namespace

LengthUnit
LengthUnit::For(double typicalMm)
{
  const double length = std::abs(typicalMm);
  if (!(length > 0) || length >= kLeast)
  {
    return LengthUnit(0);
  }
  return LengthUnit(length >= kLeast / 1000 ? 1 : 2);
}

double
LengthUnit::Of(double mm, int power) const
{
  double value = mm;
  for (int i = 0; i < m_Thousandths * power; ++i)
  {
    value *= 1000;
  }
  return value;
}

std::string
LengthUnit::Name(int power) const
{
  return kNames[m_Thousandths] + (power > 1 ? std::to_string(power) : std::string());
}

std::string
LengthUnit::Symbol(int power) const
{
  return kSymbols[m_Thousandths] + std::string(power == 2 ? "²" : power == 3 ? "³" : "");
}

std::string
LengthUnit::Text(double mm, int power, int decimals) const
{
  return FixedText(Of(mm, power), decimals);
}

std::string
DecimalText(double value, int decimals)
{
  char text[400];
  std::snprintf(text, sizeof(text), "%.*f", decimals, value);
  return text;
}

std::string
FixedText(double value, int decimals)
{
  constexpr int kMostDecimals = 30;
  if (value != 0 && std::isfinite(value))
  {
    const int first = -static_cast<int>(std::floor(std::log10(std::abs(value)))); // the decimal that is not 0
    decimals = std::max(decimals, first > 0 ? first + 1 : 0);
  }
  if (decimals > kMostDecimals)
  {
    return ShortText(value, 2);
  }
  return DecimalText(value, decimals);
}

std::string
ShortText(double value, int digits)
{
  char text[40];
  std::snprintf(text, sizeof(text), "%.*g", digits, value);
  return text;
}

} // namespace voxelcore
