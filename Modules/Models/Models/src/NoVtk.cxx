// What VTK does, where VoxelCore is built without it.

#include "ModelFormats.h"
#include "VtpPacking.h"
#include "UnfitFile.h"
#include "XmlUnpacking.h"

namespace voxelcore
{

std::string
ModelLibrary()
{
  return "no VTK";
}

bool
RequireVtkReads(const std::filesystem::path &, const MedialModel &)
{
  return false;
}

std::uint64_t
MostGain(const std::string & compressor)
{
  if (compressor != kCompressor)
  {
    throw UnfitFile{ "it is compressed by " + compressor + ", which this build without VTK cannot read" };
  }
  return kMostInflated;
}

bool
UnpackBlock(const std::string &, std::string_view packed, char * to, std::uint64_t size)
{
  return Inflate(packed, to, size);
}

} // namespace voxelcore
