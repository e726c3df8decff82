// In the place of what reads and writes TIFF, where VoxelCore is built without libtiff (VOXELCORE_TIFF).

#include "TiffFile.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/FormatOpeners.h"
#include "voxelcore/Formats/VolumeWriters.h"

namespace voxelcore
{

TiffPages
InspectTiff(const std::filesystem::path & path, const ReadOptions &)
{
  RefuseInput(path, "this VoxelCore is built without TIFF", "save it as NRRD or NIfTI");
}

std::unique_ptr<ByteStream>
OpenTiffPages(const std::filesystem::path & path, const TiffPages &)
{
  RefuseInput(path, "this VoxelCore is built without TIFF", "save it as NRRD or NIfTI");
}

ScanFile
OpenTiff(const std::filesystem::path & path, const ReadOptions & options)
{
  InspectTiff(path, options);
  return {};
}

void
WriteTiff(const std::filesystem::path & path, const VolumeToWrite &)
{
  throw OutputError(path.string() + ": this VoxelCore is built without TIFF; write .nrrd or .nii");
}

} // namespace voxelcore
