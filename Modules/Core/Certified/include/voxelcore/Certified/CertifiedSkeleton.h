#pragma once
// A certified, measured curve skeleton of a certified medial surface.

#include "voxelcore/Certified/CertifiedCore.h"
#include "voxelcore/Shape/BorderExtension.h"
#include "voxelcore/Skeleton/MeasuredSkeleton.h"

#include <optional>
#include <vector>

namespace voxelcore
{

/** What is done to branches. Lengths with their unit, as lambda. */
struct BranchRequest
{
  std::optional<Lambda> pruneLength;    ///< terminal branches shorter than this go
  double                pruneRadii = 0; ///< and those shorter than so many radii at their other end
  bool                  cutLoops = false;
  bool                  splitAtJunctions = false;
  RootChoice            root;

  std::vector<std::array<double, 3>> realLoops{}; ///< places, mm, on loops that are not cut (CutLoops)
};

/** From a core to a curve skeleton. */
struct SkeletonRequest
{
  Lambda                   lambda;                      ///< of the core to burn
  std::optional<Tolerance> tolerance;                   ///< of the core to burn, above 0
  Lambda                   standOut;                    ///< CurveOptions::branchThreshold, by InMeanVoxels()
  std::optional<Lambda>    plates;                      ///< CurveOptions::plateThreshold
  Lambda                   smooth;                      ///< window of FitBranches, by InMeanVoxels()
  bool                     refined = false;             ///< points and radii are those of CertifiedRequest::surface
  BorderEnds               border = BorderEnds::Closed; ///< of CertifiedRequest::scan
  bool                     network = false;             ///< of all labels taken as one body, each point with its label
  BranchRequest            branches;
};

/** A length in mm, of which a vox is the side of the cube with a voxel's diagonal: in thick slices, steps and zigzag
 *  are as long as voxels are across these. */
double
InMeanVoxels(const Lambda & length, const SpacingWeights & weights, const Vector3 & spacing, const VoxelBox & shapeBox);

/** \throws InputError where lengths are in voxels and the request has one in mm. */
void
RequireLengthsIn(SpatialUnit unit, const BranchRequest & request);
void
RequireLengthsIn(SpatialUnit unit, const SkeletonRequest & request);

/** What a scan's border does to a body. */
struct BorderNumbers
{
  std::vector<BorderSection> sections; ///< where it lies at the border
  std::size_t                ends = 0; ///< of branches, in the border
};

struct CertifiedSkeleton
{
  MeasuredSkeleton     skeleton;
  TopologyNumbers      topology; ///< counted in the skeleton before loops were cut
  std::vector<LoopCut> cuts;

  std::optional<BorderNumbers> border{}; ///< of a body at the border of its scan, where that is not closed

  std::optional<bool> standOut{}; ///< true: every part of the body that stands out has a branch; none: nothing is
                                  ///< promised, as the core was pruned before it burned, or the body is not at hand
};

/** A body as it is taken to go on beyond the border of its scan, so far that its curves run up to it. */
ExtendedShape
UpToBorder(const VoxelShape &      shape,
           const ImageGeometry &   geometry,
           const VoxelBox &        scan,
           const SkeletonRequest & request);

/** Burns the core to curves; lambda, tolerance and refinement of the request only say what `core` is. The body that is
 *  measured around them is `body`; without it the union of the core's balls: of a whole core of cubic voxels the
 *  shape, of flat voxels more, as balls bulge through large faces, of a pruned core less.
 *  \throws CertificateError when the skeleton does not have the shape's topology; Cancelled */
CertifiedSkeleton
SkeletonOf(const PlacedCore &       core,
           const CertifiedShape &   shape,
           const SkeletonRequest &  request,
           const ProgressCallback & progress = {},
           const VoxelShape *       body = nullptr);

/** Cuts and splits branches as asked for, and measures them anew. What hangs loose after a cut stays where it stands
 *  out by `standOut` mm. */
void
CutAndMeasure(CertifiedSkeleton & skeleton, const BranchRequest & request, double standOut);

} // namespace voxelcore
