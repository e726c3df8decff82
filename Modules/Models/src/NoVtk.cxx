// What VTK does, where VoxelCore is built without it.

#include "ModelFormats.h"
#include "PlainArrays.h"
#include "VtpFile.h"
#include "XmlUnpacking.h"

#include <zlib.h>

namespace voxelcore
{

void
WriteVtp(const std::filesystem::path & path, const MedialModel & model, bool keepEdges)
{
  WritePlainVtp(path, model, keepEdges);
}

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
  if (compressor != "vtkZLibDataCompressor")
  {
    throw UnfitFile{ "it is compressed by " + compressor + ", which this build without VTK cannot read" };
  }
  return 1032;
}

bool
Unpack(const std::string &   compressor,
       const unsigned char * from,
       std::uint64_t         packed,
       unsigned char *       to,
       std::uint64_t         size)
{
  MostGain(compressor);
  uLongf room = size;
  return uncompress(to, &room, from, packed) == Z_OK && room == size;
}

} // namespace voxelcore
