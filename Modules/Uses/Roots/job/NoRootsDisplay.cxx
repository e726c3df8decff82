// In place of RootsDisplay.cxx where module Display is not built.

#include "RootsDisplay.h"

#include <stdexcept>

namespace voxelcore
{

bool
DrawsRoots()
{
  return false;
}

void
DrawRoots(const RootModel &,
          const VoxelShape &,
          const ImageGeometry &,
          const RootsOptions &,
          OutputTransaction &,
          const ProgressCallback &)
{
  throw std::logic_error("this build does not draw roots");
}

} // namespace voxelcore
