#include "voxelcore/Labels/ScaledValue.h"

#include <cmath>

namespace voxelcore
{

std::size_t
PixelBytes(PixelType type)
{
  switch (type)
  {
    case PixelType::UInt8:
    case PixelType::Int8:
      return 1;
    case PixelType::UInt16:
    case PixelType::Int16:
      return 2;
    case PixelType::UInt32:
    case PixelType::Int32:
    case PixelType::Float32:
      return 4;
    case PixelType::UInt64:
    case PixelType::Int64:
    case PixelType::Float64:
      break;
  }
  return 8;
}

const char *
PixelName(PixelType type)
{
  switch (type)
  {
    case PixelType::UInt8:
      return "uint8";
    case PixelType::Int8:
      return "int8";
    case PixelType::UInt16:
      return "uint16";
    case PixelType::Int16:
      return "int16";
    case PixelType::UInt32:
      return "uint32";
    case PixelType::Int32:
      return "int32";
    case PixelType::UInt64:
      return "uint64";
    case PixelType::Int64:
      return "int64";
    case PixelType::Float32:
      return "float32";
    case PixelType::Float64:
      break;
  }
  return "float64";
}

double
ScaledValue(const StoredVoxels & scan, double stored)
{
  const double value = scan.slope * stored + scan.intercept;
  if (!scan.IsScaled() || !std::isfinite(value) || value == std::floor(value) || std::abs(stored) >= (1 << 22))
  {
    return value;
  }
  const double nearest = std::round(value);
  const double rounding =
    (std::abs(scan.slope * stored) + (scan.intercept == std::floor(scan.intercept) ? 0.0 : std::abs(scan.intercept))) *
    std::ldexp(1.0, -24);
  return std::abs(value - nearest) <= rounding && rounding < 0.01 * std::abs(scan.slope) ? nearest : value;
}

} // namespace voxelcore
