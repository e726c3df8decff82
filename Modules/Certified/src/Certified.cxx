#include "voxelcore/Certified.h"

#include "CertifiedWork.h"
#include "Frames.h"
#include "RequestStages.h"
#include "voxelcore/StagePlan.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

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
  const RootChoice root = complete.skeleton ? complete.skeleton->branches.root : RootChoice();
  CertifiedResult  result = RunCertified(std::move(shape),
                                        frame.Geometry(),
                                        InFrame(std::move(complete), frame, ComputeLatticeWeights(geometry)),
                                        forward);
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
