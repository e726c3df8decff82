#pragma once
// What a request means for the order of the work.

#include "voxelcore/Certified/Certified.h"

#include <vector>

namespace voxelcore
{

/** With what is usual where nothing is said: pruning, and the surface that cores are refined to.
 *  \throws UsageError for a request that contradicts itself. */
CertifiedRequest
CompleteRequest(CertifiedRequest request, const Vector3 & spacing);

/** Whether the cores that come out are refined. */
bool
RefinesCores(const CertifiedRequest & request);

/** Whether the curves that come out are refined. */
bool
RefinesCurves(const CertifiedRequest & request);

/** Whether either is. */
bool
Refines(const CertifiedRequest & request);

/** Whether the skeleton is that of the whole core. */
bool
BurnsWhole(const SkeletonRequest & request);
bool
BurnsWhole(const CertifiedRequest & request);

/** Whether the skeleton is burned while the whole core is there; else a pruned core that comes out is. */
bool
BurnsBeforePruning(const CertifiedRequest & request);

/** Whether the thickness is that of the voxels as they are, which is found while the cells are there. */
bool
NeedsBracket(const CertifiedRequest & request);

/** Whether a map of thickness is all that comes out, and needs no core. */
bool
IsMapAlone(const CertifiedRequest & request);

/** Shares of the time of the stages, in the order in which they follow: shape, Delaunay cells, bracket of thickness,
 *  core, tolerances, whole core's certificate, skeleton, refinement, coverage or pruned cores' certificates, skeleton,
 *  thickness. */
std::vector<double>
StageTimes(const CertifiedRequest & request);

} // namespace voxelcore
