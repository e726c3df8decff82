#include "XmlUnpacking.h"

#include "VtpPacking.h"
#include "VtkMessages.h"
#include "VtpFile.h"

#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

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
    return { vtkSmartPointer<vtkZLibDataCompressor>::New(), kMostInflated };
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
Unpack(const std::string &   compressor,
       const unsigned char * from,
       std::uint64_t         packed,
       unsigned char *       to,
       std::uint64_t         size)
{
  const VtkMessages messages; // what is wrong is said by us
  return MakeCompressor(compressor).decoder->Uncompress(from, packed, to, size) == size;
}

} // namespace voxelcore
