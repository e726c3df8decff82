#include "CheckedLattice.h"

#include "CertificateText.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Verification/Verification.h"

#include <cmath>

namespace voxelcore
{

void
RequireTrueLattice(const SpacingWeights & weights,
                   const ImageGeometry &  geometry,
                   const VoxelBox &       box,
                   const std::string &    name)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double side = static_cast<double>(weights.weight[axis]) * weights.unit;
    if (!(std::abs(side - geometry.spacing[axis]) <= kLargestDeviation * geometry.spacing[axis]))
    {
      RefuseResult(name, "its distances are not those of its voxels");
    }
  }
  for (unsigned corner = 0; corner < 8; ++corner)
  {
    Vector3 place{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      place[axis] = box.lower[axis] + ((corner >> axis & 1U) != 0 ? 1.0 * box.size[axis] : 0.0);
    }
    const Vector3 back = PhysicalToLattice(geometry, LatticeToPhysical(geometry, place));
    if (!(Distance(back, place) <= 2 * PositionTolerance(geometry)))
    {
      RefuseResult(name, "a place in the scan is not found again");
    }
  }
}

} // namespace voxelcore
