#include "voxelcore/Certified.h"

#include "CertifiedWork.h"
#include "RequestStages.h"
#include "voxelcore/StagePlan.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

namespace
{

/** From the labels alone. */
SurfaceSource
UsualSurface(const CertifiedRequest & request, const Vector3 & spacing)
{
  if (!RefinesUsually(request.tolerances))
  {
    return {};
  }
  return SurfacesFromLabels(spacing);
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
  CertifiedRequest complete = request;
  CompletePruning(complete.lambdas, complete.tolerances);
  if (!complete.surface)
  {
    complete.surface = UsualSurface(complete, geometry.spacing);
  }
  RequireSense(complete);
  const ProgressCallback forward = ForwardOnly(progress);
  CertifiedResult        result = RunCertified(std::move(shape), geometry, complete, forward);
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
