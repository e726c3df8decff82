#include "CrossCheck.h"
#include "JobTools.h"
#include "MakeSkeleton.h"
#include "RefineLabel.h"
#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/ComplexTopology.h"
#include "voxelcore/CoreJob.h"
#include "voxelcore/Error.h"
#include "voxelcore/SideBySide.h"
#include "voxelcore/ShapeTopology.h"
#include "voxelcore/VoxelCore.h"
#include "voxelcore/LengthUnit.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace voxelcore
{

namespace
{

// The time of a label's stages, in that of its core; measured on phantoms of 128 to 256 voxels.
constexpr double kShapeTime = 0.03;
constexpr double kDelaunayTime = 0.47;
constexpr double kCoreTime = 0.4;
constexpr double kPruneTime = 0.1;
constexpr double kBumpTime = 0.35;
constexpr double kCoverageTime = 0.1;
constexpr double kRefineTime = 1.5;
constexpr double kSkeletonTime = 1.1;

/** What ComputeWholeCore() is asked for. */
struct WholeCoreOptions
{
  Engine engine = Engine::Auto;
  bool   crossCheck = false;
  bool   bumps = false; ///< with bump heights, from the least threshold on; else pruned by lambda, unless it is refined
  const std::vector<double> & thresholds; ///< mm

  const CellSource & source;         ///< of the cells, where it is not empty
  RefinementParts *  keep = nullptr; ///< takes what refining needs
};

/** A core in LPS mm, and what is left of it at each threshold, ascending. */
struct WholeCore
{
  ModelPart                  part;
  std::vector<MedialComplex> pruned;
};

/** The core of a label, described and certified, and pruned by lambda. Frees the points and the cells as soon as it can. */
WholeCore
ComputeWholeCore(const VoxelShape &       shape,
                 const ImageGeometry &    geometry,
                 const SpacingWeights &   weights,
                 const WholeCoreOptions & options,
                 const std::string &      labelText,
                 LabelOutcome &           outcome,
                 StagePlan &              plan)
{
  LabelRecord & record = outcome.record;
  Stopwatch     watch;
  ReportProgress(plan.Next("shape"), "", 0);
  record.shape = ComputeShapeTopology(shape);
  MedialComplex core;
  {
    std::vector<LatticePoint> points = BoundaryVertices(shape);
    record.boundaryVertices = points.size();
    outcome.seconds.shape += watch.Lap();

    const ProgressCallback part = plan.Next("delaunay");
    DelaunayCells          cells = options.source ? options.source(points, part)
                                   : options.crossCheck
                                     ? CrossCheckedCells(shape, points, weights, options.engine, labelText, part)
                                     : ComputeDelaunayCells(shape, points, weights, options.engine, part);
    outcome.seconds.delaunay += watch.Lap();

    const ProgressCallback building = plan.Next("core");
    ReportProgress(building, "", 0);
    TouchingBalls touching = options.bumps ? LargestTouchingBalls(cells, points, weights) : TouchingBalls();
    if (options.keep != nullptr)
    {
      options.keep->edgePoints = NearestToEdges(cells);
    }
    ReportProgress(building, "", 0.1);
    core = BuildVoxelCore(shape, points, std::move(cells), weights);
    if (options.keep != nullptr)
    {
      options.keep->points = std::move(points);
    }
    if (options.bumps)
    {
      outcome.seconds.core += watch.Lap();
      core.bumps =
        ComputeBumps(core, weights, points, std::move(touching), options.thresholds.front(), plan.Next("prune"));
      EndBumps(core.bumps, geometry);
      outcome.seconds.prune += watch.Lap();
    }
  }
  record.enclosed = IsEnclosed(core, shape);
  if (!record.enclosed)
  {
    throw CertificateError(labelText +
                           ": certificate failed: a vertex of the core lies outside the shape; nothing was "
                           "written; this is a fault of VoxelCore, please report it with the scan");
  }
  if (options.keep != nullptr)
  {
    options.keep->core = core;
  }
  WholeCore whole;
  whole.part = ToPhysical(std::move(core), geometry, record.label);
  outcome.seconds.core += watch.Lap();
  const ProgressCallback prune = plan.Next(options.keep == nullptr ? "prune" : "core");
  ReportProgress(prune, "", 0);
  // Neither changes the core, and each is work for one processor.
  RunBoth(
    whole.part.core.cells.FaceCount() > 10000,
    [&] {
      if (!options.bumps && options.keep == nullptr)
      {
        whole.pruned = PruneAscending(whole.part.core, 0, options.thresholds, prune);
      }
    },
    [&] {
      const TopologyNumbers topology = ComputeComplexTopology(whole.part.core.cells);
      RequireEqualTopology(record.shape, topology, "its core", labelText);
      record.topologyEqual = true;
      // Described in LPS mm, as it stands in the file, so that a file pruned later gets the same figures to the last bit.
      record.core = DescribeComplex(whole.part.core, topology);
    });
  outcome.seconds.prune += watch.Lap();
  return whole;
}

/** Measures how far the boundary lies from what is left, by other means than those that pruned it. What a floor took
 *  was promised nothing. */
void
CertifyCoverage(PrunedCore &           pruned,
                const VoxelShape &     shape,
                const ImageGeometry &  geometry,
                const SpacingWeights & weights,
                LabelRecord &          record,
                const std::string &    labelText)
{
  BumpRecord & bumps = *pruned.record.bumps;
  bumps.boundaryGapMm = MeasureBoundaryGap(pruned.part, shape, geometry, weights);
  if (pruned.record.lambdaMm > 0)
  {
    return;
  }
  if (*bumps.boundaryGapMm > bumps.heightMm + BoundaryGapTolerance(geometry))
  {
    throw CertificateError(labelText + ": certificate failed: a boundary vertex lies " +
                           ShortText(*bumps.boundaryGapMm) + " mm from its core pruned at bump height " + bumps.height +
                           "; nothing was written; this is a fault of VoxelCore, please report it with the scan");
  }
  record.covered = true;
}

} // namespace

bool
IsEnclosed(const MedialComplex & core, const VoxelShape & shape)
{
  std::atomic<bool> enclosed = true;
  RunInParts(core.positions.size() > 10000, core.positions.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t vertex = first; vertex < last && enclosed; ++vertex)
    {
      if (!ContainsInside(shape, core.positions[vertex]))
      {
        enclosed = false;
      }
    }
  });
  return enclosed;
}

LabelOutcome
ProcessLabel(LabelShape                      label,
             const ImageGeometry &           geometry,
             const SpacingWeights &          weights,
             const std::vector<Lambda> &     lambdas,
             Engine                          engine,
             const ProgressCallback &        watcher,
             bool                            crossCheck,
             const SkeletonStage *           skeleton,
             const std::vector<BumpHeight> & bumps,
             const CellSource &              source,
             const SurfaceSource &           surface)
{
  LabelOutcome      outcome;
  LabelRecord &     record = outcome.record;
  const std::string labelText = LabelText(label.value, label.name);
  Stopwatch         watch;
  record.label = label.value;
  record.name = label.name;
  record.voxels = label.voxels;
  record.volumeMm3 =
    static_cast<double>(label.voxels) * (geometry.spacing[0] * geometry.spacing[1] * geometry.spacing[2]);
  record.box = label.shape.Box();

  const bool             ofWhole = skeleton != nullptr && skeleton->lambda.value == 0 && !skeleton->bumps;
  const ProgressCallback progress = ForwardOnly(watcher);
  // In the order below.
  std::vector<double> times{ kShapeTime, kDelaunayTime, kCoreTime };
  if (!bumps.empty())
  {
    times.push_back(kBumpTime);
  }
  times.push_back(kPruneTime);
  if (ofWhole)
  {
    times.push_back(kSkeletonTime);
  }
  times.push_back(surface ? kRefineTime : bumps.empty() ? kPruneTime : kCoverageTime);
  if (skeleton != nullptr && !ofWhole)
  {
    times.push_back(kSkeletonTime);
  }
  StagePlan  plan(progress, times);
  const auto makeSkeleton = [&](const ModelPart & ofCore) {
    Stopwatch skeletonWatch;
    outcome.skeleton = MakeSkeleton(ofCore, *skeleton, weights, geometry, record, plan.Next());
    outcome.seconds.skeleton += skeletonWatch.Lap();
  };

  std::vector<double> thresholds;
  for (const Lambda & lambda : lambdas)
  {
    thresholds.push_back(LambdaInMillimetres(lambda, weights, geometry.spacing, record.box));
  }
  RefinementParts        kept;
  const WholeCoreOptions options{ engine, crossCheck, !bumps.empty(), thresholds, source, surface ? &kept : nullptr };
  WholeCore              whole = ComputeWholeCore(label.shape, geometry, weights, options, labelText, outcome, plan);
  ModelPart &            part = whole.part;

  if (ofWhole)
  {
    makeSkeleton(part);
  }

  Stopwatch               pruneWatch;
  std::vector<PrunedCore> pruned;
  if (surface)
  {
    part = ModelPart();
    pruned = RefineAndCertify(label.shape,
                              std::move(kept),
                              surface,
                              geometry,
                              lambdas,
                              thresholds,
                              record,
                              labelText,
                              plan.Next());
  }
  else if (bumps.empty())
  {
    label.shape = VoxelShape();
    pruned = CertifyPruned(std::move(part),
                           std::move(whole.pruned),
                           record.core,
                           0,
                           lambdas,
                           thresholds,
                           record.shape,
                           labelText,
                           plan.Next("certificate"));
  }
  else
  {
    const PrunedRecord floor{ lambdas.front().text, thresholds.front(), {}, {}, {} };
    pruned = PruneByBumpsAndCertify(part, floor, bumps, geometry, record.shape, labelText);
    part = ModelPart();
    const ProgressCallback coverage = plan.Next("certificate");
    for (std::size_t i = 0; i < pruned.size(); ++i)
    {
      ReportProgress(coverage, "", static_cast<double>(i) / static_cast<double>(pruned.size()));
      CertifyCoverage(pruned[i], label.shape, geometry, weights, record, labelText);
    }
  }
  for (PrunedCore & one : pruned)
  {
    record.pruned.push_back(std::move(one.record));
    outcome.parts.push_back(std::move(one.part));
  }
  outcome.seconds.prune += pruneWatch.Lap();
  if (skeleton != nullptr && skeleton->bumps)
  {
    makeSkeleton(outcome.parts.front());
  }
  else if (skeleton != nullptr && !ofWhole)
  {
    const auto same = std::find_if(lambdas.begin(), lambdas.end(), [&](const Lambda & lambda) {
      return lambda.text == skeleton->lambda.text;
    });
    makeSkeleton(outcome.parts.at(static_cast<std::size_t>(same - lambdas.begin())));
  }
  record.seconds = watch.Lap();
  ReportProgress(progress, "done", 1);
  return outcome;
}

} // namespace voxelcore
