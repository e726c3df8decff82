#include "voxelcore/Certified.h"

#include "CertifiedWork.h"
#include "CheckedLattice.h"
#include "Frames.h"
#include "RequestStages.h"
#include "voxelcore/ShapeTopology.h"
#include "voxelcore/SpacingWeights.h"
#include "voxelcore/StagePlan.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

namespace
{

/** The skeleton is that of a body that goes on where the scan's border cuts it; all else that is asked for is of the
 *  body within. */
CertifiedResult
RunUpToBorder(VoxelShape               shape,
              const ImageGeometry &    geometry,
              const CertifiedRequest & request,
              const ProgressCallback & progress)
{
  ExtendedShape extended = UpToBorder(shape, geometry, *request.scan, *request.skeleton);
  if (extended.shape.Box().size == shape.Box().size)
  {
    CertifiedResult result = RunCertified(std::move(shape), geometry, request, progress);
    if (!extended.sections.empty())
    {
      result.skeleton->border = { std::move(extended.sections), 0 };
    }
    return result;
  }
  const BeyondBorder goesOn{ *request.scan,
                             shape.Box(),
                             ComputeShapeTopology(shape),
                             request.skeleton->border,
                             std::move(extended.sections) };
  CertifiedRequest   curves = request;
  curves.refineCores = false;
  curves.thickness.reset();
  curves.spendsCores = true;
  if (request.spendsCores && !request.thickness)
  {
    return RunCertified(std::move(extended.shape), geometry, curves, progress, &goesOn);
  }
  CertifiedRequest within = request;
  within.skeleton.reset();
  StagePlan       plan(progress, { 0.5, 0.5 });
  CertifiedResult result = RunCertified(std::move(shape), geometry, within, plan.Next());
  CertifiedResult beyond = RunCertified(std::move(extended.shape), geometry, curves, plan.Next(), &goesOn);
  result.skeleton = std::move(beyond.skeleton);
  result.seconds.shape += beyond.seconds.shape;
  result.seconds.delaunay += beyond.seconds.delaunay;
  result.seconds.core += beyond.seconds.core;
  result.seconds.prune += beyond.seconds.prune;
  result.seconds.skeleton += beyond.seconds.skeleton;
  return result;
}

} // namespace

void
CompletePruning(std::vector<Lambda> & lambdas, std::vector<Tolerance> & tolerances)
{
  if (lambdas.empty() && tolerances.empty())
  {
    tolerances.push_back(ParseTolerance(kUsualTolerance));
  }
  if (lambdas.empty())
  {
    lambdas.emplace_back();
  }
}

bool
RefinesUsually(const std::vector<Tolerance> & tolerances)
{
  return !tolerances.empty() &&
         std::all_of(tolerances.begin(), tolerances.end(), [](const Tolerance & height) { return height.value > 0; });
}

void
RequireLengthsIn(SpatialUnit unit, const CertifiedRequest & request)
{
  for (const Lambda & lambda : request.lambdas)
  {
    RequireLengthIn(unit, lambda);
  }
  for (const Tolerance & height : request.tolerances)
  {
    RequireLengthIn(unit, height);
  }
  if (request.skeleton)
  {
    RequireLengthsIn(unit, *request.skeleton);
  }
}

CertifiedResult
ComputeCertified(VoxelShape               shape,
                 const ImageGeometry &    geometry,
                 const CertifiedRequest & request,
                 const ProgressCallback & progress)
{
  CertifiedRequest complete = CompleteRequest(request, geometry.spacing);
  if (!IsMapAlone(complete))
  {
    RequireDistinctPositions(geometry);
  }
  const ProgressCallback forward = ForwardOnly(progress);
  shape = CropToVoxels(std::move(shape));
  const BodyFrame frame(geometry, shape.Box());
  shape = MovedTo({ 0, 0, 0 }, shape);
  const RootChoice     root = complete.skeleton ? complete.skeleton->branches.root : RootChoice();
  const SpacingWeights weights = ComputeLatticeWeights(geometry);
  RequireTrueLattice(weights, geometry, frame.Leave(shape.Box()), request.name);
  RequireTrueLattice(weights, frame.Geometry(), shape.Box(), request.name);
  const CertifiedRequest there = InFrame(std::move(complete), frame, weights);
  const bool             mayBeCut = there.scan && there.skeleton && there.skeleton->border != BorderEnds::Closed;
  CertifiedResult        result = mayBeCut ? RunUpToBorder(std::move(shape), frame.Geometry(), there, forward)
                                           : RunCertified(std::move(shape), frame.Geometry(), there, forward);
  result.shape.box = frame.Leave(result.shape.box);
  result.shape.geometry = geometry;
  for (CertifiedCore & core : result.cores)
  {
    LeaveFrame(frame, core.core);
  }
  if (result.skeleton)
  {
    LeaveFrame(frame, root, *result.skeleton);
  }
  if (result.thickness)
  {
    LeaveFrame(frame, *result.thickness);
  }
  ReportProgress(forward, "done", 1);
  return result;
}

CoreOrigin
OriginOf(const CertifiedResult & result, std::int64_t label, std::string name, std::uint64_t voxels)
{
  return {
    label, std::move(name), voxels, result.shape.box, result.boundaryVertices, result.shape.topology, result.whole, true
  };
}

CorePruning
PruningOf(const CoreNumbers & numbers)
{
  CorePruning pruning{ numbers.lambda, numbers.lambdaMm, numbers.complex };
  if (numbers.tolerance)
  {
    pruning.tolerance = numbers.tolerance->height;
    pruning.toleranceMm = numbers.tolerance->heightMm;
  }
  if (numbers.refined)
  {
    pruning.refined = "labels";
    pruning.meanMove = numbers.refined->meanDisplacement;
    pruning.farthestMove = numbers.refined->maxDisplacement;
  }
  return pruning;
}

} // namespace voxelcore
