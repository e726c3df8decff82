#include "BoundaryCoverage.h"

#include "CertificateText.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Verification/BallCoverage.h"
#include "voxelcore/Verification/Verification.h"

#include <algorithm>
#include <string>
#include <vector>

namespace voxelcore
{

namespace
{

/** Largest distance of a boundary vertex to the balls of a core, in mm. */
double
BoundaryGapOf(const PlacedCore & core, const VoxelShape & voxels, const ImageGeometry & geometry)
{
  std::vector<std::array<double, 3>> positions = core.core.positions;
  for (auto & position : positions)
  {
    position = PhysicalToLattice(geometry, position);
  }
  return LargestBoundaryGap(voxels, ComputeSpacingWeights(geometry.spacing), positions, core.core.radius).largest;
}

/** By how much a boundary gap measured in LPS mm may exceed a height by rounding, mm. */
double
BoundaryGapTolerance(const ImageGeometry & geometry)
{
  return 4 * PositionTolerance(geometry) * *std::max_element(geometry.spacing.begin(), geometry.spacing.end());
}

} // namespace

bool
CertifyCoverage(CertifiedCore & core, const VoxelShape & voxels, const CertifiedShape & shape)
{
  const ImageGeometry & geometry = shape.geometry;
  ToleranceNumbers &    tolerance = *core.numbers.tolerance;
  tolerance.boundaryGapMm = BoundaryGapOf(core.core, voxels, geometry);
  if (core.numbers.lambdaMm > 0)
  {
    return false;
  }
  const double promised =
    core.numbers.refined ? RefinedGapBound(tolerance.heightMm, geometry.spacing) : tolerance.heightMm;
  if (*tolerance.boundaryGapMm > promised + BoundaryGapTolerance(geometry))
  {
    RefuseResult(shape.name,
                 "a boundary vertex lies " + std::to_string(*tolerance.boundaryGapMm) + InUnit(" mm", geometry.unit) +
                   " from its core pruned at tolerance " + tolerance.height);
  }
  return true;
}

} // namespace voxelcore
