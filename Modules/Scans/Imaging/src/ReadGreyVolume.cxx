#include "OpenScan.h"
#include "SlabReader.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Imaging/GreyVolume.h"

#include <cmath>

namespace voxelcore
{

ImageGeometry
VisitGreyRows(const std::filesystem::path & path,
              const VoxelBox &              box,
              const ReadOptions &           options,
              const GreyRow &               take,
              const ProgressCallback &      progress)
{
  CropRange part;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    part.first[axis] = box.lower[axis];
    part.end[axis] = box.lower[axis] + box.size[axis];
  }
  ReadOptions ofPart = options;
  ofPart.crop = part;
  ScanFile scan = OpenScan(path, ofPart);
  if (scan.interleaved > 1 && scan.component < 0)
  {
    RefuseInput(path, "it is a segmentation in layers, without grey values", "give the scan it was made of");
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (part.first[axis] < 0 || part.end[axis] > scan.geometry.size[axis] || box.size[axis] < 1)
    {
      RefuseInput(path, "it is smaller than the segmentation", "give the scan the segmentation was made of");
    }
  }
  std::vector<float> values(static_cast<std::size_t>(box.size[0]));
  const std::size_t  bytes = PixelBytes(scan.type);
  const std::size_t  stride = bytes * scan.interleaved;
  const std::size_t  first = bytes * static_cast<std::size_t>(scan.interleaved > 1 ? scan.component : 0);
  SlabReader         reader(scan, part);
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
          const double      value = scan.slope * StoredValue(place, scan.type) + scan.intercept;
          if (!std::isfinite(value))
          {
            RefuseInput(path, "a voxel near the shape is no finite number", "grey values must be numbers there");
          }
          values[static_cast<std::size_t>(x - part.first[0])] = static_cast<float>(value);
        }
        const auto number = static_cast<std::int64_t>(span.firstRow + row);
        take(static_cast<std::int32_t>(number % scan.geometry.size[1]),
             static_cast<std::int32_t>(number / scan.geometry.size[1]),
             values);
      }
    }
    ReportProgress(progress, "read", reader.Fraction());
  }
  reader.Finish(progress);
  return scan.geometry;
}

GreyVolume
ReadGreyVolume(const std::filesystem::path & path,
               const VoxelBox &              box,
               const ReadOptions &           options,
               const ProgressCallback &      progress)
{
  GreyVolume grey{ {}, box, {} };
  grey.values.reserve(static_cast<std::size_t>(box.size[0]) * static_cast<std::size_t>(box.size[1]) *
                      static_cast<std::size_t>(box.size[2]));
  grey.geometry = VisitGreyRows(
    path,
    box,
    options,
    [&grey](std::int32_t, std::int32_t, std::span<const float> row) {
      grey.values.insert(grey.values.end(), row.begin(), row.end());
    },
    progress);
  return grey;
}

} // namespace voxelcore
