#include "XmlUnpacking.h"

#include "VtpPacking.h"
#include "VtkMessages.h"
#include "UnfitFile.h"

#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkSmartPointer.h>

namespace voxelcore
{
namespace
{

struct Compressor
{
  vtkSmartPointer<vtkDataCompressor> decoder;
  std::uint64_t                      mostGain; ///< what one byte can become at most
};

Compressor
MakeCompressor(const std::string & name)
{
  if (name == kCompressor)
  {
    return { nullptr, kMostInflated }; // ours
  }
  if (name == "vtkLZ4DataCompressor")
  {
    return { vtkSmartPointer<vtkLZ4DataCompressor>::New(), 255 };
  }
  if (name == "vtkLZMADataCompressor")
  {
    return { vtkSmartPointer<vtkLZMADataCompressor>::New(), 8192 };
  }
  throw UnfitFile{ "it is compressed in a way that VTK does not know" };
}

} // namespace

std::uint64_t
MostGain(const std::string & compressor)
{
  return MakeCompressor(compressor).mostGain;
}

bool
UnpackBlock(const std::string & compressor, std::string_view packed, char * to, std::uint64_t size)
{
  if (compressor == kCompressor)
  {
    return Inflate(packed, to, size);
  }
  const VtkMessages messages; // what is wrong is said by us
  const auto *      from = reinterpret_cast<const unsigned char *>(packed.data());
  return MakeCompressor(compressor)
           .decoder->Uncompress(from, packed.size(), reinterpret_cast<unsigned char *>(to), size) == size;
}

} // namespace voxelcore
