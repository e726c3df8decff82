#include "RequestStages.h"

#include "PruneStages.h"
#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <limits>

namespace voxelcore
{

namespace
{

// In the time of the core; measured on phantoms of 128 to 256 voxels.
constexpr double kShapeTime = 0.03;
constexpr double kDelaunayTime = 0.47;
constexpr double kCoreTime = 0.4;
constexpr double kPruneTime = 0.1;
constexpr double kToleranceTime = 0.35;
constexpr double kCoverageTime = 0.1;
constexpr double kRefineTime = 1.5;
constexpr double kSkeletonTime = 1.1;
constexpr double kBracketTime = 1.0;
constexpr double kThicknessTime = 0.4;

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

void
RequireSense(const CertifiedRequest & request)
{
  if (!request.tolerances.empty() && request.lambdas.size() > 1)
  {
    throw UsageError(request.name + ": give one lambda with tolerances, which is pruned first");
  }
  if (request.skeleton && request.skeleton->refined && !*request.surface)
  {
    throw UsageError(request.name + ": a refined skeleton needs an estimate of the surface");
  }
}

} // namespace

CertifiedRequest
CompleteRequest(CertifiedRequest request, const Vector3 & spacing)
{
  CompletePruning(request.lambdas, request.tolerances);
  if (!request.surface)
  {
    request.surface = UsualSurface(request, spacing);
  }
  RequireSense(request);
  return request;
}

bool
RefinesCores(const CertifiedRequest & request)
{
  return *request.surface && request.refineCores;
}

bool
RefinesCurves(const CertifiedRequest & request)
{
  return request.skeleton && request.skeleton->refined;
}

bool
Refines(const CertifiedRequest & request)
{
  return RefinesCores(request) || RefinesCurves(request);
}

bool
BurnsWhole(const SkeletonRequest & request)
{
  return request.lambda.value == 0 && !request.tolerance;
}

bool
BurnsWhole(const CertifiedRequest & request)
{
  return request.skeleton && BurnsWhole(*request.skeleton);
}

bool
BurnsBeforePruning(const CertifiedRequest & request)
{
  return BurnsWhole(request) || (request.skeleton && (request.skeleton->tolerance || Refines(request)));
}

bool
NeedsBracket(const CertifiedRequest & request)
{
  return request.thickness && !RefinesCores(request);
}

bool
IsMapAlone(const CertifiedRequest & request)
{
  return request.thickness && request.thickness->alone && !RefinesCurves(request) && !request.skeleton &&
         !request.cells && !request.crossCheck;
}

std::vector<double>
StageTimes(const CertifiedRequest & request)
{
  std::vector<double> times{ kShapeTime, kDelaunayTime };
  if (NeedsBracket(request))
  {
    times.push_back(kBracketTime);
  }
  times.push_back(kCoreTime);
  if (!request.tolerances.empty())
  {
    times.push_back(kToleranceTime);
  }
  times.push_back(kPruneTime);
  if (BurnsBeforePruning(request))
  {
    times.push_back(kSkeletonTime);
  }
  if (Refines(request))
  {
    times.push_back(kRefineTime);
  }
  if (!request.tolerances.empty())
  {
    times.push_back(kCoverageTime);
  }
  else if (!RefinesCores(request))
  {
    times.push_back(kPruneTime);
  }
  if (request.skeleton && !BurnsBeforePruning(request))
  {
    times.push_back(kSkeletonTime);
  }
  if (request.thickness)
  {
    times.push_back(kThicknessTime);
  }
  return times;
}

} // namespace voxelcore
