#pragma once
// The two steps from a core to its skeleton, between which the curves may be refined.

#include "voxelcore/Certified/CertifiedSkeleton.h"
#include "voxelcore/Refinement/SurfaceDistance.h"
#include "voxelcore/Skeleton/CurveSkeleton.h"

#include <memory>
#include <optional>

namespace voxelcore
{

/** What a core has burned to, in LPS mm. */
struct BurnedCurves
{
  CurveSkeleton                          curves;
  TopologyNumbers                        topology;
  std::shared_ptr<const SurfaceDistance> toSurface; ///< to which they have been refined; none: they have not
  std::optional<bool>                    standOut;  ///< CertifiedSkeleton::standOut
};

/** Of a shape that was made to go on beyond the border of its scan, what it was. */
struct BeyondBorder
{
  VoxelBox                   scan;
  VoxelBox                   box; ///< of the shape within
  TopologyNumbers            topology;
  BorderEnds                 ends = BorderEnds::Open;
  std::vector<BorderSection> sections;
};

/** What lambda or tolerance of the request leave of the whole core. \throws UsageError for a tolerance where the core
 *  has none */
LiveElements
PartToBurn(const MedialComplex & whole, const CertifiedShape & shape, const SkeletonRequest & request);

/** Of a part of the core, in the fire of all of it, unless that is null.
 *  \throws CertificateError when the curves do not have the shape's topology; Cancelled */
BurnedCurves
BurnToCurves(const MedialComplex &    core,
             const LiveElements *     part,
             const CertifiedShape &   shape,
             const SkeletonRequest &  request,
             const ProgressCallback & progress);

/** Of all of the core, which is in another order meanwhile (ComputeCurveSkeleton()). */
BurnedCurves
BurnToCurves(MedialComplex &          core,
             const CertifiedShape &   shape,
             const SkeletonRequest &  request,
             const ProgressCallback & progress);

/** Branches, and how wide the body in `voxels` is around them; no table of them yet. Where the body `goesOn` beyond a
 *  border, they are cut in it.
 *  \throws CertificateError when they do not have the topology of the curves. */
CertifiedSkeleton
MeasureCurves(const BurnedCurves &    burned,
              const VoxelShape &      voxels,
              const CertifiedShape &  shape,
              const SkeletonRequest & request,
              const BeyondBorder *    goesOn = nullptr);

/** Of curves of the whole core, as fire and the request's standOut leave them; nothing where that is 0.
 *  \throws CertificateError where a ball in the shape stands out of them all (BallStandingOut()). */
void
RequireNothingStandsOut(BurnedCurves &          burned,
                        const VoxelShape &      voxels,
                        const CertifiedShape &  shape,
                        const SkeletonRequest & request);

/** \throws CertificateError unless every point of a skeleton lies in its shape. */
void
RequireEnclosed(const SkeletonGraph & graph, const VoxelShape & voxels, const CertifiedShape & shape);

} // namespace voxelcore
