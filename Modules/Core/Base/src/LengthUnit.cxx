#include "voxelcore/Base/LengthUnit.h"

#include "voxelcore/Base/Text.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

constexpr const char * kNames[] = { "mm", "um", "nm" };
constexpr const char * kSymbols[] = { "mm", "µm", "nm" };
constexpr double       kLeast = 0.1; ///< of a unit, for which the next smaller one is not yet taken

} // namespace

LengthUnit
LengthUnit::For(double typicalMm, SpatialUnit unit)
{
  if (unit == SpatialUnit::Voxels)
  {
    return LengthUnit(0, unit);
  }
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
  return InUnit(kNames[m_Thousandths], m_Unit) + (power > 1 ? std::to_string(power) : std::string());
}

std::string
LengthUnit::Symbol(int power) const
{
  return InUnit(kSymbols[m_Thousandths], m_Unit) + std::string(power == 2 ? "²" : power == 3 ? "³" : "");
}

std::string
LengthUnit::Text(double mm, int power, int decimals) const
{
  return FixedText(Of(mm, power), decimals);
}

} // namespace voxelcore
