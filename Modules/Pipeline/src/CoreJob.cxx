#include "voxelcore/CoreJob.h"

#include "CrossCheck.h"
#include "JobTools.h"
#include "LabelLoop.h"
#include "MakeSkeleton.h"
#include "SkeletonFiles.h"
#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/ComplexTopology.h"
#include "voxelcore/Error.h"
#include "voxelcore/OutputNames.h"
#include "voxelcore/Sha256.h"
#include "voxelcore/ShapeTopology.h"
#include "voxelcore/VoxelCore.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <numeric>
#include <utility>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

/** Where in a label's work each stage ends, as the shares of time usually are. */
constexpr double kShapeEnds = 0.03;
constexpr double kDelaunayEnds = 0.80;
constexpr double kCoreEnds = 0.92;
constexpr double kCoreBesideSkeleton = 0.5;

std::string
EngineName(Engine engine)
{
  return engine == Engine::TetGen ? "tetgen" : "lattice";
}

bool
ContainsAround(const VoxelShape & shape, const std::array<double, 3> & point)
{
  // Every voxel whose closed cube holds the point must be in: only then the point is inside the *open* shape.
  std::array<std::int32_t, 3> first;
  std::array<std::int32_t, 3> last;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double floor = std::floor(point[k]);
    last[k] = static_cast<std::int32_t>(floor);
    first[k] = last[k] - (floor == point[k] ? 1 : 0);
  }
  for (std::int32_t z = first[2]; z <= last[2]; ++z)
  {
    for (std::int32_t y = first[1]; y <= last[1]; ++y)
    {
      for (std::int32_t x = first[0]; x <= last[0]; ++x)
      {
        if (!shape.Contains(x, y, z))
        {
          return false;
        }
      }
    }
  }
  return true;
}

/** The core of a label, described and certified, in LPS mm. Frees what it does not need any longer as it goes: the
 *  points and the cells, and the shape at its end. */
ModelPart
ComputeWholeCore(VoxelShape               shape,
                 const ImageGeometry &    geometry,
                 const SpacingWeights &   weights,
                 Engine                   engine,
                 bool                     crossCheck,
                 const std::string &      labelText,
                 LabelOutcome &           outcome,
                 const ProgressCallback & progress)
{
  LabelRecord & record = outcome.record;
  Stopwatch     watch;
  ReportProgress(progress, "shape", 0);
  record.shape = ComputeShapeTopology(shape);
  MedialComplex core;
  {
    const std::vector<LatticePoint> points = BoundaryVertices(shape);
    record.boundaryVertices = points.size();
    outcome.seconds.shape += watch.Lap();

    const ProgressCallback part = PartOfProgress(progress, "delaunay", kShapeEnds, kDelaunayEnds);
    DelaunayCells          cells = crossCheck ? CrossCheckedCells(shape, points, weights, engine, labelText, part)
                                              : ComputeDelaunayCells(shape, points, weights, engine, part);
    outcome.seconds.delaunay += watch.Lap();

    ReportProgress(progress, "core", kDelaunayEnds);
    core = BuildVoxelCore(shape, points, std::move(cells), weights);
  }
  const TopologyNumbers topology = ComputeComplexTopology(core.cells);
  RequireEqualTopology(record.shape, topology, "its core", labelText);
  record.topologyEqual = true;
  record.enclosed = IsEnclosed(core, shape);
  if (!record.enclosed)
  {
    throw CertificateError(labelText +
                           ": certificate failed: a vertex of the core lies outside the shape; nothing was "
                           "written; this is a fault of VoxelCore, please report it with the scan");
  }
  shape = VoxelShape();
  ModelPart part = ToPhysical(std::move(core), geometry, record.label);
  // Described in LPS mm, as it stands in the file, so that a file pruned later gets the same figures to the last bit.
  record.core = DescribeComplex(part.core, topology);
  outcome.seconds.core += watch.Lap();
  ReportProgress(progress, "prune", kCoreEnds);
  return part;
}

InputRecord
DescribeInput(const CoreOptions & options, const LabelVolume & volume)
{
  return { options.scan.string(), {}, volume.format, volume.geometry, volume.notes };
}

ParameterRecord
DescribeParameters(const CoreOptions &    options,
                   const LabelVolume &    volume,
                   const EditedLabels &   edited,
                   const SpacingWeights & weights)
{
  ParameterRecord parameters;
  for (const EditedLabel & one : edited.labels)
  {
    if (one.component <= 1)
    {
      parameters.labels.push_back(one.label.value);
    }
  }
  parameters.edits = options.edits;
  parameters.crop = volume.crop;
  parameters.binary = options.reading.binary;
  parameters.threshold = options.reading.threshold;
  parameters.volume = options.reading.volume;
  parameters.component = options.reading.component;
  parameters.spacing = options.reading.spacing;
  parameters.orthonormalize = options.reading.orthonormalize;
  parameters.niftiForm = options.reading.niftiForm;
  for (const Lambda & lambda : options.lambdas)
  {
    parameters.lambda.push_back(lambda.text);
  }
  parameters.model = options.model;
  parameters.engine = EngineName(options.engine);
  parameters.crossCheck = options.crossCheck;
  parameters.threads = options.threads;
  parameters.weights = weights;
  return parameters;
}

/** Everything a user could have given wrong that can be seen before reading. */
void
CheckTargets(const CoreOptions & options, bool toFolder, OutputTransaction & transaction)
{
  if (options.lambdas.empty())
  {
    throw UsageError("no --lambda given");
  }
  if (options.report)
  {
    transaction.CheckTarget(*options.report);
  }
  if (options.crossCheck && !HasEngine(Engine::TetGen))
  {
    throw UsageError("--cross-check needs TetGen, which this build lacks; configure it with -DVOXELCORE_TETGEN=ON");
  }
  transaction.Protect(options.scan);
  if (options.output.empty())
  {
    return;
  }
  if (toFolder)
  {
    transaction.MakeDirectory(options.output);
  }
  else
  {
    if (!IsModelPath(options.output))
    {
      throw UsageError(options.output.string() +
                       ": unknown extension; use .vtp .vtk .ply .obj .stl or .ma, or a folder ending in /");
    }
    for (std::size_t i = 0; i < options.lambdas.size(); ++i)
    {
      transaction.CheckTarget(FileOutputPath(options.output, options.lambdas, i));
    }
  }
}

/** The result files of a run, in memory until their turn to be written. */
class ResultFiles
{
public:
  ResultFiles(const CoreOptions & options, bool toFolder, OutputTransaction & transaction, CoreResult & result)
    : m_Options(options)
    , m_ToFolder(toFolder)
    , m_Transaction(transaction)
    , m_Result(result)
    , m_Models(options.lambdas.size())
  {}

  /** Takes a label's cores; in a folder they go to disk at once. */
  void
  Add(LabelRecord record, std::vector<ModelPart> parts)
  {
    if (m_Options.output.empty())
    {
      m_Result.report.labels.push_back(std::move(record));
      return;
    }
    for (std::size_t i = 0; i < m_Options.lambdas.size(); ++i)
    {
      record.pruned[i].output = Target(record, i).string();
      m_Models[i].parts.push_back(std::move(parts[i]));
    }
    m_Result.report.labels.push_back(std::move(record));
    if (m_ToFolder)
    {
      Write({ m_Result.report.labels.size() - 1 });
    }
  }

  /** Writes what Add() kept. */
  void
  Finish()
  {
    if (!m_ToFolder && !m_Options.output.empty())
    {
      std::vector<std::size_t> all(m_Result.report.labels.size());
      std::iota(all.begin(), all.end(), std::size_t{ 0 });
      Write(all);
    }
  }

private:
  fs::path
  Target(const LabelRecord & record, std::size_t lambda) const
  {
    return m_ToFolder ? FolderOutputPath(m_Options.output,
                                         m_Options.scan,
                                         record.label,
                                         m_Options.lambdas,
                                         lambda,
                                         record.component)
                      : FileOutputPath(m_Options.output, m_Options.lambdas, lambda);
  }

  void
  Write(const std::vector<std::size_t> & labels)
  {
    Stopwatch watch;
    for (std::size_t i = 0; i < m_Models.size(); ++i)
    {
      MedialModel & model = m_Models[i];
      model.provenance = ProvenanceJson(m_Result.report, labels, i);
      model.hasEdges = m_Options.model.keepEdges;
      const LabelRecord & first = m_Result.report.labels[labels.front()];
      WriteStagedModel(m_Transaction, Target(first, i), model, m_Options.model, m_Result.notes);
      model = MedialModel();
    }
    m_Result.report.seconds.write += watch.Lap();
  }

  const CoreOptions &      m_Options;
  bool                     m_ToFolder;
  OutputTransaction &      m_Transaction;
  CoreResult &             m_Result;
  std::vector<MedialModel> m_Models; ///< one per lambda
};

} // namespace

bool
IsEnclosed(const MedialComplex & core, const VoxelShape & shape)
{
  for (const auto & position : core.positions)
  {
    if (!ContainsAround(shape, position))
    {
      return false;
    }
  }
  return true;
}

LabelOutcome
ProcessLabel(LabelShape                  label,
             const ImageGeometry &       geometry,
             const SpacingWeights &      weights,
             const std::vector<Lambda> & lambdas,
             Engine                      engine,
             const ProgressCallback &    progress,
             bool                        crossCheck,
             const SkeletonStage *       skeleton)
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

  // Where there is a skeleton it takes its share of the time after the core.
  const double           coreEnds = skeleton != nullptr ? kCoreBesideSkeleton : 1;
  const ProgressCallback coreProgress = PartOfProgress(progress, 0, coreEnds);
  const auto             makeSkeleton = [&](const ModelPart & surface) {
    Stopwatch skeletonWatch;
    outcome.skeleton =
      MakeSkeleton(surface, *skeleton, weights, geometry.spacing, record, PartOfProgress(progress, coreEnds, 1));
    outcome.seconds.skeleton += skeletonWatch.Lap();
  };

  ModelPart part =
    ComputeWholeCore(std::move(label.shape), geometry, weights, engine, crossCheck, labelText, outcome, coreProgress);
  const bool ofWhole = skeleton != nullptr && skeleton->lambda.value == 0;
  if (ofWhole)
  {
    makeSkeleton(part);
  }

  Stopwatch           pruneWatch;
  std::vector<double> thresholds;
  for (const Lambda & lambda : lambdas)
  {
    thresholds.push_back(LambdaInMillimetres(lambda, weights, geometry.spacing, record.box));
  }
  auto pruned = PruneAndCertify(std::move(part),
                                record.core,
                                0,
                                lambdas,
                                thresholds,
                                record.shape,
                                labelText,
                                PartOfProgress(coreProgress, "prune", kCoreEnds, 1));
  for (PrunedCore & one : pruned)
  {
    record.pruned.push_back(std::move(one.record));
    outcome.parts.push_back(std::move(one.part));
  }
  outcome.seconds.prune += pruneWatch.Lap();
  if (skeleton != nullptr && !ofWhole)
  {
    const auto same = std::find_if(lambdas.begin(), lambdas.end(), [&](const Lambda & lambda) {
      return lambda.text == skeleton->lambda.text;
    });
    makeSkeleton(outcome.parts.at(static_cast<std::size_t>(same - lambdas.begin())));
  }
  record.seconds = watch.Lap();
  return outcome;
}

CoreResult
RunCoreJob(const CoreOptions & options, const JobContext & context)
{
  // Shares of the whole job's time: reading, the labels, writing.
  constexpr double  kReadEnds = 0.05;
  constexpr double  kLabelsEnd = 0.95;
  Stopwatch         total;
  Stopwatch         watch;
  CoreResult        result;
  CoreReport &      report = result.report;
  OutputTransaction transaction(options.force, context.temporaries);
  const bool        toFolder = IsFolderOutput(options.output);
  CheckTargets(options, toFolder, transaction);
  std::optional<SkeletonFiles> skeletons;
  if (options.skeleton)
  {
    skeletons.emplace(options.skeletonOutput, options.scan, options.skeleton->branches, transaction);
  }

  // The digest runs beside reading and computing, until the first result is written; a scan that cannot be read is
  // reported by the reader.
  auto        digest = std::async(std::launch::async, [&options] { return ScanSha256(options.scan); });
  LabelVolume volume =
    ReadLabelVolume(options.scan, options.reading, PartOfProgress(context.progress, "reading", 0, kReadEnds));
  EditedLabels         edited = EditLabels(volume,
                                   options.edits,
                                   options.reading.labels != "all",
                                   options.scan.string(),
                                   PartOfProgress(context.progress, "editing", kReadEnds, kReadEnds));
  const SpacingWeights weights = ComputeSpacingWeights(volume.geometry.spacing);
  report.command = options.command;
  report.input = DescribeInput(options, volume);
  report.parameters = DescribeParameters(options, volume, edited, weights);
  result.warnings = volume.warnings;
  result.notes = edited.notes;
  report.seconds.read = watch.Lap();

  report.skeleton = options.skeleton;

  ResultFiles files(options, toFolder, transaction, result);
  ProcessLabels(
    edited.labels,
    options,
    volume.geometry,
    weights,
    PartOfProgress(context.progress, kReadEnds, kLabelsEnd),
    [&](LabelOutcome outcome) {
      if (digest.valid())
      {
        report.input.sha256 = digest.get();
      }
      const ModelPart surface = skeletons && skeletons->NeedsSurface() ? outcome.parts.front() : ModelPart();
      files.Add(std::move(outcome.record), std::move(outcome.parts));
      if (skeletons)
      {
        skeletons->Add(report, report.labels.size() - 1, std::move(*outcome.skeleton), surface, result.notes);
      }
    },
    report.seconds);
  ReportProgress(context.progress, "writing", kLabelsEnd);
  files.Finish();
  if (skeletons)
  {
    Stopwatch writing;
    skeletons->Finish(report, result.notes);
    report.seconds.write += writing.Lap();
  }
  report.seconds.total = total.Lap();
  report.peakMemoryMb = PeakMemoryMb();
  if (options.report)
  {
    WriteTextFile(transaction.Stage(*options.report), ReportJson(report));
  }
  ReportProgress(context.progress, "done", 1); // the last moment at which an interruption is heeded
  transaction.Commit();
  return result;
}

} // namespace voxelcore
