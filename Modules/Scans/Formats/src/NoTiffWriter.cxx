// In the place of what writes TIFF, where VoxelCore is built without libtiff (VOXELCORE_TIFF), or for systems without
// the file descriptors that TiffWriter.cxx hands to libtiff (VOXELCORE_PORTABLE).

#include "voxelcore/Base/Error.h"
#include "voxelcore/Formats/VolumeWriters.h"

namespace voxelcore
{

void
WriteTiff(const std::filesystem::path & path, const VolumeToWrite &)
{
  throw OutputError(path.string() + ": this VoxelCore writes no TIFF; write .nrrd or .nii");
}

} // namespace voxelcore
