#pragma once
// A shape's core refined at each of its thresholds.

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

/** A result for each of `asked`, which says how it was pruned, by lambda or by tolerance. \throws CertificateError when
 *  the topology is no longer the shape's, or a vertex has left it; Cancelled */
std::vector<CertifiedCore>
RefineAndCertify(const VoxelShape &       voxels,
                 const CertifiedShape &   shape,
                 RefinementParts          parts,
                 const SurfaceSource &    source,
                 std::vector<CoreNumbers> asked,
                 const ProgressCallback & progress);

/** Whether every vertex lies strictly inside the open shape; positions in lattice coordinates. */
bool
IsEnclosed(const MedialComplex & core, const VoxelShape & voxels);

} // namespace voxelcore
