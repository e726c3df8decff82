// Which stored values are labels: the rules of LabelCollector.

#include "LabelCollector.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Labels/ScaledValue.h"

#include <bit>
#include <cmath>

namespace voxelcore
{
namespace
{

// More labels than any volume has.
constexpr std::size_t kMostLabels = 1U << 20;

} // namespace

double
LabelCollector::Value(std::uint64_t bits) const
{
  switch (m_Scan.type)
  {
    case PixelType::UInt8:
    case PixelType::UInt16:
    case PixelType::UInt32:
    case PixelType::UInt64:
      return static_cast<double>(bits);
    case PixelType::Int8:
      return static_cast<double>(static_cast<std::int8_t>(bits));
    case PixelType::Int16:
      return static_cast<double>(static_cast<std::int16_t>(bits));
    case PixelType::Int32:
      return static_cast<double>(static_cast<std::int32_t>(bits));
    case PixelType::Int64:
      return static_cast<double>(static_cast<std::int64_t>(bits));
    case PixelType::Float32:
      return static_cast<double>(bit_cast<float>(static_cast<std::uint32_t>(bits)));
    case PixelType::Float64:
      break;
  }
  return bit_cast<double>(bits);
}

void
LabelCollector::RefuseValue(double value, const char * what, std::int32_t x, std::int32_t y, std::int32_t z) const
{
  RefuseInput(m_Scan.path,
              Text("value ", Number(value), " at voxel (", x, ",", y, ",", z, ") ", what),
              Text("labels are whole numbers from 0 up; ",
                   value < 0 || std::isnan(value) ? "name those to take, such as --labels 1; " : "",
                   value > 0 && value < 1 ? "for a mask of 0 and 1 give --threshold 0.5:inf, " : "",
                   "for a grey scan give --threshold LO:HI"));
}

std::int64_t
LabelCollector::WholeNumber(std::uint64_t bits, std::int32_t x, std::int32_t y, std::int32_t z) const
{
  const double stored = Value(bits);
  if (!m_Scan.IsScaled() && !IsFloat(m_Scan.type))
  {
    if (stored < 0)
    {
      RefuseValue(stored, "is negative", x, y, z);
    }
    if (bits > static_cast<std::uint64_t>(INT64_MAX))
    {
      RefuseValue(stored, "is too large for a label", x, y, z);
    }
    return static_cast<std::int64_t>(bits); // exact, where a double may not be
  }
  const double value = ScaledValue(m_Scan, stored);
  if (!std::isfinite(value))
  {
    RefuseValue(value, "is no number", x, y, z);
  }
  if (value != std::floor(value))
  {
    RefuseValue(value, m_Scan.IsScaled() ? "(after scaling) is a fraction" : "is a fraction", x, y, z);
  }
  if (value < 0)
  {
    RefuseValue(value, "is negative", x, y, z);
  }
  if (value > 9007199254740992.0) // 2^53: from here on doubles skip whole numbers
  {
    RefuseValue(value, "is too large for a label", x, y, z);
  }
  return static_cast<std::int64_t>(value);
}

// Below 0, or as no number, files keep what is to be passed over (-1: ignore; NaN: outside). Where labels are named
// nothing needs to be guessed.
bool
LabelCollector::IsPassedOver(std::uint64_t bits)
{
  if (m_Naming.WantsAll() || (!m_Scan.IsScaled() && !IsFloat(m_Scan.type) && Value(bits) >= 0))
  {
    return false;
  }
  const double value = ScaledValue(m_Scan, Value(bits));
  if (std::isnan(value))
  {
    m_PassesNan = true;
    return true;
  }
  if (!(value < 0) || value != std::floor(value) || !std::isfinite(value))
  {
    return false;
  }
  m_PassedOver.insert(value);
  return true;
}

std::int32_t
LabelCollector::Classify(std::uint64_t bits, std::size_t layer, std::int32_t x, std::int32_t y, std::int32_t z)
{
  if (m_Threshold)
  {
    const double value = m_Scan.slope * Value(bits) + m_Scan.intercept;
    return value >= m_Threshold->first && value <= m_Threshold->second ? 0 : kBackground;
  }
  if (IsPassedOver(bits))
  {
    return kBackground;
  }
  const std::int64_t value = WholeNumber(bits, x, y, z);
  if (value == 0)
  {
    return kBackground;
  }
  if (m_Found.size() == kMostLabels)
  {
    RefuseInput(m_Scan.path,
                Text("more than ", kMostLabels, " different values"),
                "this is no label volume; for a grey scan give --threshold LO:HI");
  }
  Found found;
  found.label = m_Naming.Identify(layer, value);
  if (m_Naming.IsWanted(found.label))
  {
    found.target = m_Binary ? 0 : NewTarget(found.label);
  }
  m_Found.push_back(std::move(found));
  return static_cast<std::int32_t>(m_Found.size() - 1);
}

} // namespace voxelcore
