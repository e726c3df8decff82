#include "voxelcore/CertifiedSkeleton.h"

#include "CertificateText.h"
#include "voxelcore/ComplexTopology.h"
#include "voxelcore/CurveSkeleton.h"
#include "voxelcore/SpacingWeights.h"
#include "voxelcore/StagePlan.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

double
Diagonal(const Vector3 & spacing)
{
  return std::sqrt(spacing[0] * spacing[0] + spacing[1] * spacing[1] + spacing[2] * spacing[2]);
}

/** Of the cube with the same diagonal. */
double
VoxelSide(const Vector3 & spacing)
{
  return Diagonal(spacing) / std::sqrt(3.0);
}

VoxelReach
HalfAVoxel(const ImageGeometry & geometry)
{
  VoxelReach reach{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      reach[axis][k] = geometry.direction[3 * k + axis] / (0.5 * geometry.spacing[axis]);
    }
  }
  return reach;
}

} // namespace

MeasureOptions
MeasuringOf(const BranchRequest & request, const Vector3 & spacing)
{
  MeasureOptions measuring;
  measuring.root = request.root;
  measuring.radiusShift = 0.25 * Diagonal(spacing);
  return measuring;
}

void
CutAndMeasure(CertifiedSkeleton & skeleton, const BranchRequest & request, const Vector3 & spacing)
{
  SkeletonGraph & graph = skeleton.skeleton.graph;
  if (request.cutLoops)
  {
    skeleton.cuts = CutLoops(graph);
  }
  if (request.splitAtJunctions)
  {
    SplitAtJunctions(graph);
  }
  skeleton.skeleton.table = MeasureBranches(graph, MeasuringOf(request, spacing));
}

void
RequireLengthsIn(SpatialUnit unit, const BranchRequest & request)
{
  if (request.pruneLength)
  {
    RequireLengthIn(unit, *request.pruneLength);
  }
}

void
RequireLengthsIn(SpatialUnit unit, const SkeletonRequest & request)
{
  RequireLengthIn(unit, request.lambda);
  if (request.tolerance)
  {
    RequireLengthIn(unit, *request.tolerance);
  }
  RequireLengthIn(unit, request.standOut);
  if (request.plates)
  {
    RequireLengthIn(unit, *request.plates);
  }
  RequireLengthIn(unit, request.smooth);
  RequireLengthsIn(unit, request.branches);
}

CertifiedSkeleton
SkeletonOf(const PlacedCore &       core,
           const CertifiedShape &   shape,
           const SkeletonRequest &  request,
           const ProgressCallback & progress)
{
  RequireLengthsIn(shape.geometry.unit, request);
  const Vector3 &      spacing = shape.geometry.spacing;
  const SpacingWeights weights = ComputeSpacingWeights(spacing);
  const auto           length = [&](const Lambda & l) { return LambdaInMillimetres(l, weights, spacing, shape.box); };
  CurveOptions         curves;
  curves.branchThreshold = length(request.standOut);
  if (request.plates)
  {
    curves.plateThreshold = length(*request.plates);
  }
  curves.sampling = 1.5 * *std::min_element(spacing.begin(), spacing.end());
  curves.geometry = shape.geometry;
  curves.voxel = VoxelSide(spacing);
  StagePlan           plan(progress, { 0.98, 0.02 });
  const CurveSkeleton curve = ComputeCurveSkeleton(core.core, curves, plan.Next());
  CertifiedSkeleton   result;
  result.topology = ComputeComplexTopology(curve.complex.cells);
  RequireEqualTopology(shape.topology, result.topology, "its skeleton", shape.name);

  ReportProgress(plan.Next("branches"), "", 0);
  result.skeleton.label = core.label;
  result.skeleton.component = core.component;
  SkeletonGraph & graph = result.skeleton.graph;
  graph = BuildSkeletonGraph(curve);
  // The zigzag that is to go is that of voxels, which is as long as they are across slices.
  const bool       inVoxels = request.smooth.unit == Lambda::Unit::Voxel;
  const double     window = inVoxels ? request.smooth.value * VoxelSide(spacing) : length(request.smooth);
  const VoxelReach reach = HalfAVoxel(shape.geometry);
  FitBranches(graph, window, reach);
  const BranchRequest & branches = request.branches;
  const double          limit = branches.pruneLength ? length(*branches.pruneLength) : 0;
  if (PruneBranches(graph, { limit, branches.pruneRadii }) > 0)
  {
    FitBranches(graph, window, reach);
  }
  const SkeletonNumbers numbers = MeasureBranches(graph).numbers;
  if (graph.FaceCount() == 0 &&
      (numbers.components != result.topology.betti[0] || numbers.cycles != result.topology.betti[1]))
  {
    RefuseResult(shape.name, "the branches do not have the shape's topology");
  }
  CutAndMeasure(result, branches, spacing);
  return result;
}

} // namespace voxelcore
