#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Jobs/JobTools.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

CertifiedRequest
RequestOf(const CoreOptions & options, SurfaceSource surface)
{
  CertifiedRequest request;
  request.lambdas = options.lambdas;
  request.tolerances = options.tolerances;
  request.surface = std::move(surface); // empty: nothing is refined
  request.refineCores = !options.output.empty() || !options.skeleton;
  request.skeleton = options.skeleton;
  if (request.skeleton && request.skeleton->network)
  {
    // Only when its points have labels: NetworkLabels::Take().
    request.skeleton->branches.cutLoops = false;
    request.skeleton->branches.splitAtJunctions = false;
  }
  const std::vector<std::string> & also = options.skeletonTargets.also;
  request.spendsCores = options.output.empty() && options.skeleton && ranges::find(also, "ma") == also.end();
  request.engine = options.engine;
  request.crossCheck = options.crossCheck;
  return request;
}

LabelRecord
DescribeLabel(const EditedLabel & edited, const ImageGeometry & geometry)
{
  LabelRecord        record;
  const LabelShape & label = edited.label;
  record.label = label.value;
  record.component = edited.component;
  record.edits = edited.edits;
  record.hollow = edited.hollow;
  record.diagnosis = edited.diagnosis;
  record.name = label.name;
  record.voxels = label.voxels;
  record.volumeMm3 =
    static_cast<double>(label.voxels) * (geometry.spacing[0] * geometry.spacing[1] * geometry.spacing[2]);
  record.box = label.shape.Box();
  return record;
}

LabelOutcome
ProcessLabel(EditedLabel              edited,
             const ImageGeometry &    geometry,
             CertifiedRequest         request,
             const ProgressCallback & progress)
{
  Stopwatch     watch;
  LabelOutcome  outcome;
  LabelRecord & record = outcome.record;
  LabelShape &  label = edited.label;
  record = DescribeLabel(edited, geometry);
  request.name = LabelText(label.value, label.name);
  CertifiedResult result = ComputeCertified(std::move(label.shape), geometry, request, progress);
  record.boundaryVertices = result.boundaryVertices;
  record.shape = result.shape.topology;
  record.core = result.whole;
  // No result without a certificate.
  record.topologyEqual = true;
  record.enclosed = true;
  record.covered = result.covered;
  for (CertifiedCore & one : result.cores)
  {
    record.pruned.push_back({ std::move(one.numbers) });
    outcome.parts.push_back(std::move(one.core));
    outcome.parts.back().label = record.label;
    outcome.parts.back().component = record.component;
  }
  if (result.skeleton)
  {
    outcome.skeleton = TakeSkeleton(std::move(*result.skeleton), record);
  }
  outcome.thickness = std::move(result.thickness);
  outcome.seconds.shape = result.seconds.shape;
  outcome.seconds.delaunay = result.seconds.delaunay;
  outcome.seconds.core = result.seconds.core;
  outcome.seconds.prune = result.seconds.prune;
  outcome.seconds.skeleton = result.seconds.skeleton;
  record.seconds = watch.Lap();
  return outcome;
}

} // namespace voxelcore
