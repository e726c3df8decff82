#pragma once
// Voxels as a file or another library stores them, and what their values stand for.

#include "voxelcore/Lattice/ImageGeometry.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

enum class PixelType : std::uint8_t
{
  UInt8,
  Int8,
  UInt16,
  Int16,
  UInt32,
  Int32,
  UInt64,
  Int64,
  Float32,
  Float64
};

std::size_t
PixelBytes(PixelType type);

/** "uint8", "float32", ... */
const char *
PixelName(PixelType type);

inline bool
IsFloat(PixelType type)
{
  return type == PixelType::Float32 || type == PixelType::Float64;
}

using Color = std::array<double, 3>; ///< red, green, blue from 0 to 1

/** A named segment of a segmentation in layers, such as a .seg.nrrd. */
struct Segment
{
  std::string  name;
  std::size_t  layer = 0;
  std::int64_t value = 0;

  std::optional<Color> color;
};

/** What a list of labels says of a value. */
struct ListedLabel
{
  std::string          name; ///< empty where the list has colours only
  std::optional<Color> color{};
};

/** Rows of values along i, then j, then k. */
struct StoredVoxels
{
  std::filesystem::path path; ///< names the scan in errors
  PixelType             type = PixelType::UInt8;
  ImageGeometry         geometry;
  std::size_t           interleaved = 1; ///< values a voxel, the fastest axis
  std::ptrdiff_t        component = -1;  ///< which of them to take; -1: all are layers of a segmentation
  double                slope = 1;       ///< value = slope * stored + intercept
  double                intercept = 0;
  std::vector<Segment>  segments;

  std::map<std::int64_t, ListedLabel> listed; ///< names of values where there are no segments

  bool
  IsScaled() const
  {
    return slope != 1 || intercept != 0;
  }
  bool
  HasLayers() const
  {
    return interleaved > 1 && component < 0;
  }
};

template <typename T>
double
StoredValue(const std::byte * at)
{
  T value;
  std::memcpy(&value, at, sizeof(T));
  return static_cast<double>(value);
}

/** use(T()) with the type T of stored values. */
template <typename TUse>
auto
WithStoredType(PixelType type, const TUse & use)
{
  switch (type)
  {
    case PixelType::UInt8: // NOLINT(bugprone-branch-clone): the types differ
      return use(std::uint8_t());
    case PixelType::Int8:
      return use(std::int8_t());
    case PixelType::UInt16:
      return use(std::uint16_t());
    case PixelType::Int16:
      return use(std::int16_t());
    case PixelType::UInt32:
      return use(std::uint32_t());
    case PixelType::Int32:
      return use(std::int32_t());
    case PixelType::UInt64:
      return use(std::uint64_t());
    case PixelType::Int64:
      return use(std::int64_t());
    case PixelType::Float32:
      return use(float());
    default:
      return use(double());
  }
}

/** In this machine's byte order; whole numbers beyond 2^53 are rounded. */
inline double
StoredValue(const std::byte * at, PixelType type)
{
  return WithStoredType(type, [at]<typename T>(T) { return StoredValue<T>(at); });
}

} // namespace voxelcore
