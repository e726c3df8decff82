// In the place of what starts voxelcore-itk-reader, where no processes can be started (VOXELCORE_PORTABLE).

#include "voxelcore/Base/TextFields.h"
#include "voxelcore/ItkReader/ItkProcess.h"

namespace voxelcore
{

bool
HasItkReader()
{
  return false;
}

ItkFormat
FormatByItk(const std::filesystem::path &)
{
  return ItkFormat::None;
}

ScanFile
OpenByItk(const std::filesystem::path & path, ItkFormat, const ReadOptions &)
{
  RefuseInput(path, "this VoxelCore is built without reading through ITK", "save it as NRRD or NIfTI");
}

std::vector<std::filesystem::path>
ItkScanFiles(const std::filesystem::path & path, ItkFormat)
{
  RefuseInput(path, "this VoxelCore is built without reading through ITK", "save it as NRRD or NIfTI");
}

} // namespace voxelcore
