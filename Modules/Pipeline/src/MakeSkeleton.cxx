#include "MakeSkeleton.h"

#include "JobTools.h"
#include "voxelcore/ComplexTopology.h"
#include "voxelcore/CurveSkeleton.h"
#include "voxelcore/Error.h"

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
MeasuringOf(const BranchOptions & options, const Vector3 & spacing)
{
  MeasureOptions measuring;
  measuring.root = options.root;
  measuring.radiusShift = 0.25 * Diagonal(spacing);
  return measuring;
}

void
CutAndMeasure(SkeletonPart & part, const BranchOptions & options, const Vector3 & spacing, SkeletonRecord & record)
{
  if (options.cutLoops)
  {
    record.cuts = CutLoops(part.graph);
  }
  if (options.splitAtJunctions)
  {
    SplitAtJunctions(part.graph);
  }
  part.table = MeasureBranches(part.graph, MeasuringOf(options, spacing));
  record.numbers = part.table.numbers;
}

SkeletonPart
MakeSkeleton(const ModelPart &        surface,
             const SkeletonStage &    stage,
             const SpacingWeights &   weights,
             const ImageGeometry &    geometry,
             LabelRecord &            record,
             const ProgressCallback & progress)
{
  const Vector3 &   spacing = geometry.spacing;
  const auto        length = [&](const Lambda & l) { return LambdaInMillimetres(l, weights, spacing, record.box); };
  const double      voxel = *std::min_element(spacing.begin(), spacing.end());
  const std::string text = LabelText(record.label, record.name);
  CurveOptions      curves;
  curves.branchThreshold = length(stage.standOut);
  if (stage.plates)
  {
    curves.plateThreshold = length(*stage.plates);
  }
  curves.sampling = 1.5 * voxel;
  curves.geometry = geometry;
  curves.voxel = VoxelSide(spacing);
  StagePlan             plan(progress, { 0.98, 0.02 });
  const CurveSkeleton   skeleton = ComputeCurveSkeleton(surface.core, curves, plan.Next());
  const TopologyNumbers topology = ComputeComplexTopology(skeleton.complex.cells);
  RequireEqualTopology(record.shape, topology, "its skeleton", text);

  ReportProgress(plan.Next("branches"), "", 0);
  SkeletonPart part;
  part.label = record.label;
  part.component = record.component;
  part.name = record.name;
  part.graph = BuildSkeletonGraph(skeleton);
  // The zigzag that is to go is that of voxels, which is as long as they are across slices.
  const bool       inVoxels = stage.smooth.unit == Lambda::Unit::Voxel;
  const double     window = inVoxels ? stage.smooth.value * VoxelSide(spacing) : length(stage.smooth);
  const VoxelReach reach = HalfAVoxel(geometry);
  FitBranches(part.graph, window, reach);
  const BranchOptions & branches = stage.branches;
  const double          limit = branches.pruneLength ? length(*branches.pruneLength) : 0;
  if (PruneBranches(part.graph, { limit, branches.pruneRadii }) > 0)
  {
    FitBranches(part.graph, window, reach);
  }
  const SkeletonNumbers numbers = MeasureBranches(part.graph).numbers;
  if (part.graph.FaceCount() == 0 && (numbers.components != topology.betti[0] || numbers.cycles != topology.betti[1]))
  {
    throw CertificateError(text +
                           ": certificate failed: the branches do not have the shape's topology; nothing was "
                           "written; this is a fault of VoxelCore, please report it with the scan");
  }
  record.skeleton.emplace();
  record.skeleton->topology = topology;
  CutAndMeasure(part, branches, spacing, *record.skeleton);
  ReportProgress(progress, "branches", 1);
  return part;
}

} // namespace voxelcore
