#include "BoundaryCoverage.h"

#include "CertificateText.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Verification/BallCoverage.h"
#include "voxelcore/Verification/Verification.h"

#include <algorithm>
#include <string>
#include <vector>

namespace voxelcore
{

namespace
{

/** The largest gaps of boundary vertices to the balls of a core. */
BoundaryGaps
BoundaryGapsOf(const PlacedCore & core, const VoxelShape & voxels, const ImageGeometry & geometry)
{
  std::vector<std::array<double, 3>> positions = core.core.positions;
  for (auto & position : positions)
  {
    position = PhysicalToLattice(geometry, position);
  }
  return LargestBoundaryGaps(voxels, ComputeSpacingWeights(geometry.spacing), positions, core.core.radius);
}

/** By how much a weighed boundary gap measured in LPS mm may exceed a height by rounding, mm. */
double
BoundaryGapTolerance(const ImageGeometry & geometry)
{
  const auto [least, largest] = ranges::minmax(geometry.spacing);
  return 4 * PositionTolerance(geometry) * largest * (largest / least); // nothing is weighed more
}

} // namespace

bool
CertifyCoverage(CertifiedCore & core, const VoxelShape & voxels, const CertifiedShape & shape)
{
  const ImageGeometry & geometry = shape.geometry;
  ToleranceNumbers &    tolerance = *core.numbers.tolerance;
  const BoundaryGaps    gaps = BoundaryGapsOf(core.core, voxels, geometry);
  tolerance.boundaryGapMm = gaps.plain.largest;
  if (core.numbers.lambdaMm > 0)
  {
    return false;
  }
  const double promised =
    core.numbers.refined ? RefinedGapBound(tolerance.heightMm, geometry.spacing).weighed : tolerance.heightMm;
  const auto [least, largest] = ranges::minmax(geometry.spacing);
  if (least != largest && promised > 0)
  {
    tolerance.boundaryGapShare = gaps.weighed.largest / promised;
  }
  if (gaps.weighed.largest > promised + BoundaryGapTolerance(geometry))
  {
    RefuseResult(shape.name,
                 "a boundary vertex lies " + std::to_string(gaps.weighed.largest) +
                   InUnit(least == largest ? " mm" : " mm, weighed by direction,", geometry.unit) +
                   " from its core pruned at tolerance " + tolerance.height);
  }
  return true;
}

} // namespace voxelcore
