#include "voxelcore/Base/SystemCalls.h"

namespace voxelcore
{

std::FILE *
OpenToWrite(const std::filesystem::path & path, bool isNew, bool readsToo)
{
  return std::fopen(path.c_str(), readsToo ? isNew ? "w+bx" : "w+b" : isNew ? "wbx" : "wb");
}

} // namespace voxelcore
