#include "ScanFile.h"
#include "SlabReader.h"
#include "voxelcore/GreyVolume.h"

#include <cmath>
#include <cstring>

namespace voxelcore
{

namespace
{

template <typename T>
double
Stored(const std::byte * at)
{
  T value;
  std::memcpy(&value, at, sizeof(T));
  return static_cast<double>(value);
}

double
Stored(const std::byte * at, PixelType type)
{
  switch (type)
  {
    case PixelType::UInt8:
      return Stored<std::uint8_t>(at);
    case PixelType::Int8:
      return Stored<std::int8_t>(at);
    case PixelType::UInt16:
      return Stored<std::uint16_t>(at);
    case PixelType::Int16:
      return Stored<std::int16_t>(at);
    case PixelType::UInt32:
      return Stored<std::uint32_t>(at);
    case PixelType::Int32:
      return Stored<std::int32_t>(at);
    case PixelType::UInt64:
      return Stored<std::uint64_t>(at);
    case PixelType::Int64:
      return Stored<std::int64_t>(at);
    case PixelType::Float32:
      return Stored<float>(at);
    default:
      return Stored<double>(at);
  }
}

} // namespace

GreyVolume
ReadGreyVolume(const std::filesystem::path & path,
               const VoxelBox &              box,
               const ReadOptions &           options,
               const ProgressCallback &      progress)
{
  ScanFile scan = OpenScan(path, options);
  if (scan.interleaved > 1 && scan.component < 0)
  {
    Refuse(path, "it is a segmentation in layers, without grey values", "give the scan it was made of");
  }
  CropRange part;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    part.first[axis] = box.lower[axis];
    part.end[axis] = box.lower[axis] + box.size[axis];
    if (part.first[axis] < 0 || part.end[axis] > scan.geometry.size[axis] || box.size[axis] < 1)
    {
      Refuse(path, "it is smaller than the segmentation", "give the scan the segmentation was made of");
    }
  }
  GreyVolume grey{ scan.geometry, box, {} };
  grey.values.reserve(static_cast<std::size_t>(box.size[0]) * static_cast<std::size_t>(box.size[1]) *
                      static_cast<std::size_t>(box.size[2]));
  const std::size_t bytes = PixelBytes(scan.type);
  const std::size_t stride = bytes * scan.interleaved;
  const std::size_t first = bytes * static_cast<std::size_t>(scan.interleaved > 1 ? scan.component : 0);
  SlabReader        reader(scan, part);
  while (const Slab * slab = reader.Next())
  {
    std::size_t at = 0;
    for (const RowSpan & span : slab->spans)
    {
      for (std::size_t row = 0; row < span.rowCount; ++row, at += reader.RowBytes())
      {
        for (std::int32_t x = part.first[0]; x < part.end[0]; ++x)
        {
          const std::byte * place = slab->bytes.data() + at + stride * static_cast<std::size_t>(x) + first;
          const double      value = scan.slope * Stored(place, scan.type) + scan.intercept;
          if (!std::isfinite(value))
          {
            Refuse(path, "a voxel near the shape is no finite number", "grey values must be numbers there");
          }
          grey.values.push_back(static_cast<float>(value));
        }
      }
    }
    ReportProgress(progress, "read", reader.Fraction());
  }
  reader.Finish(progress);
  return grey;
}

} // namespace voxelcore
