#pragma once
// A shape's core refined at each of its thresholds, and the curves that it burns to.

#include "SkeletonSteps.h"
#include "voxelcore/Certified/Certified.h"
#include "voxelcore/Refinement/Refinement.h"

#include <vector>

namespace voxelcore
{

/** What is kept of the making of a whole core; after KeepAsked() only what refinement needs of it. */
struct RefinementParts
{
  std::vector<LatticePoint> boundary;   ///< all boundary vertices
  std::vector<LatticePoint> points;     ///< those that edgePoints names, where they are fewer
  EdgePoints                edgePoints; ///< of each edge of the core
  MedialComplex             core;       ///< in lattice coordinates
  std::vector<LiveElements> left;       ///< LeftToRefine() at each threshold
  std::vector<LiveElements> curves;
};

/** What is refined. */
struct RefinementTask
{
  std::vector<CoreNumbers> asked;            ///< cores, as they are pruned: by lambda, or all by tolerance
  BurnedCurves *           curves = nullptr; ///< of the whole core; points and radii are moved
};

/** Keeps of a whole core in lattice coordinates, whose parts these are, what the task needs. */
void
KeepAsked(const Vector3 &          spacing,
          const MedialComplex &    whole,
          const RefinementTask &   task,
          RefinementParts &        parts,
          const ProgressCallback & progress);

/** A result for each core of the task, for which KeepAsked() has kept the parts.
 *  \throws CertificateError when the topology is no longer the shape's, or a vertex has left it; Cancelled */
std::vector<CertifiedCore>
RefineAndCertify(const VoxelShape &       voxels,
                 const CertifiedShape &   shape,
                 RefinementParts          parts,
                 const SurfaceSource &    source,
                 RefinementTask           task,
                 const ProgressCallback & progress);


} // namespace voxelcore
