#pragma once
// A stored value as a number.

#include "ScanFile.h"

#include <cstddef>
#include <cstring>

namespace voxelcore
{

template <typename T>
double
StoredValue(const std::byte * at)
{
  T value;
  std::memcpy(&value, at, sizeof(T));
  return static_cast<double>(value);
}

/** In this machine's byte order; whole numbers beyond 2^53 are rounded. */
inline double
StoredValue(const std::byte * at, PixelType type)
{
  switch (type)
  {
    case PixelType::UInt8:
      return StoredValue<std::uint8_t>(at);
    case PixelType::Int8:
      return StoredValue<std::int8_t>(at);
    case PixelType::UInt16:
      return StoredValue<std::uint16_t>(at);
    case PixelType::Int16:
      return StoredValue<std::int16_t>(at);
    case PixelType::UInt32:
      return StoredValue<std::uint32_t>(at);
    case PixelType::Int32:
      return StoredValue<std::int32_t>(at);
    case PixelType::UInt64:
      return StoredValue<std::uint64_t>(at);
    case PixelType::Int64:
      return StoredValue<std::int64_t>(at);
    case PixelType::Float32:
      return StoredValue<float>(at);
    default:
      return StoredValue<double>(at);
  }
}

} // namespace voxelcore
