// What VTK does, where VoxelCore is built without it.

#include "ModelFormats.h"
#include "VtpPacking.h"
#include "PlainArrays.h"
#include "VtpFile.h"
#include "XmlUnpacking.h"

namespace voxelcore
{

void
WriteVtk(const std::filesystem::path & path, const MedialModel & model, bool keepEdges)
{
  WritePlainVtk(path, model, keepEdges);
}

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
Unpack(const std::string &   compressor,
       const unsigned char * from,
       std::uint64_t         packed,
       unsigned char *       to,
       std::uint64_t         size)
{
  MostGain(compressor);
  return Inflate({ reinterpret_cast<const char *>(from), static_cast<std::size_t>(packed) },
                 reinterpret_cast<char *>(to),
                 size);
}

} // namespace voxelcore
