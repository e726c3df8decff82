#include "voxelcore/Base/SystemCalls.h"

namespace voxelcore
{

std::FILE *
OpenToWrite(const std::filesystem::path & path, bool isNew)
{
  return std::fopen(path.c_str(), isNew ? "wbx" : "wb");
}

} // namespace voxelcore
