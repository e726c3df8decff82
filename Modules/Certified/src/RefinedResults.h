#pragma once
// A shape's core refined at each of its thresholds, and the curves that it burns to.

#include "SkeletonSteps.h"
#include "voxelcore/Certified.h"
#include "voxelcore/Refinement.h"

#include <vector>

namespace voxelcore
{

/** What is kept of the making of a whole core. */
struct RefinementParts
{
  std::vector<LatticePoint> points;
  EdgePoints                edgePoints;
  MedialComplex             core; ///< in lattice coordinates
};

/** What is refined. */
struct RefinementTask
{
  std::vector<CoreNumbers> asked;            ///< cores, as they are pruned: by lambda, or all by tolerance
  BurnedCurves *           curves = nullptr; ///< of the whole core; points and radii are moved
};

/** A result for each core of the task. \throws CertificateError when the topology is no longer the shape's, or a vertex
 *  has left it; Cancelled */
std::vector<CertifiedCore>
RefineAndCertify(const VoxelShape &       voxels,
                 const CertifiedShape &   shape,
                 RefinementParts          parts,
                 const SurfaceSource &    source,
                 RefinementTask           task,
                 const ProgressCallback & progress);

/** Whether every vertex lies strictly inside the open shape; positions in lattice coordinates. */
bool
IsEnclosed(const MedialComplex & core, const VoxelShape & voxels);

} // namespace voxelcore
