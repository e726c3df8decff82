#include "OpenScan.h"
#include "SlabReader.h"
#include "voxelcore/GreyVolume.h"
#include "voxelcore/TextFields.h"

#include <cmath>

namespace voxelcore
{

GreyVolume
ReadGreyVolume(const std::filesystem::path & path,
               const VoxelBox &              box,
               const ReadOptions &           options,
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
          const double      value = scan.slope * StoredValue(place, scan.type) + scan.intercept;
          if (!std::isfinite(value))
          {
            RefuseInput(path, "a voxel near the shape is no finite number", "grey values must be numbers there");
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
