#pragma once
// A label's core refined at each of its thresholds.

#include "JobTools.h"
#include "voxelcore/Refinement.h"
#include "voxelcore/RefineStage.h"

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

/** Results in the order of `lambdas`. \throws CertificateError when the topology is no longer the shape's, or a vertex has
 *  left it; Cancelled */
std::vector<PrunedCore>
RefineAndCertify(const VoxelShape &          shape,
                 RefinementParts             parts,
                 const SurfaceSource &       source,
                 const ImageGeometry &       geometry,
                 const std::vector<Lambda> & lambdas,
                 const std::vector<double> & thresholdsMm,
                 const LabelRecord &         record,
                 const std::string &         labelText,
                 const ProgressCallback &    progress);

} // namespace voxelcore
