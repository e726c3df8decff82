#include "voxelcore/Models/MedialModel.h"

#include <vtkVersion.h>

namespace voxelcore
{

std::string
ModelLibrary()
{
  return std::string("VTK ") + vtkVersion::GetVTKVersion();
}

} // namespace voxelcore
