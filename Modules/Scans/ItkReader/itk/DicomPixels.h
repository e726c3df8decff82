#pragma once
// Grey pixels of a DICOM file.

#include "voxelcore/Labels/StoredVoxels.h"

#include <gdcmFile.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace voxelcore::itkreader
{

/** What a data set says of its pixels. */
struct DicomPixels
{
  std::int64_t rows = 0;
  std::int64_t columns = 0;
  std::int64_t frames = 1;
  int          bitsAllocated = 0;
  int          bitsStored = 0;
  bool         isSigned = false;
  double       slope = 1;
  double       intercept = 0;

  bool
  operator==(const DicomPixels &) const = default;

  std::size_t
  FrameValues() const
  {
    return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  }
  std::size_t
  FrameBytes() const
  {
    return FrameValues() * static_cast<std::size_t>(bitsAllocated) / 8;
  }
  PixelType
  Type() const;
};

/** Rescale slope and intercept, where a data set or functional groups state them. */
void
TakeRescale(const gdcm::DataSet & set, DicomPixels & pixels);

/** \throws InputError for colours, look-up tables and pixels that are no whole numbers of 1, 8, 16 or 32 bits */
DicomPixels
DescribePixels(const std::filesystem::path & path, const gdcm::DataSet & set);

/** All frames of a file as they are stored, unpacked by GDCM where they are compressed; of pixels of one bit the bytes
 *  they are packed in. \throws InputError when there are fewer than described */
std::vector<char>
ReadPixels(const std::filesystem::path & path, const DicomPixels & pixels);

/** GDCM and its version, for notes. */
std::string
GdcmName();

} // namespace voxelcore::itkreader
