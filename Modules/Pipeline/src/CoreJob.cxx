#include "voxelcore/CoreJob.h"

#include "CoreJobSteps.h"
#include "DisplayFiles.h"
#include "JobTools.h"
#include "LabelLoop.h"
#include "SkeletonFiles.h"
#include "voxelcore/CostModel.h"
#include "voxelcore/Error.h"
#include "voxelcore/OutputNames.h"
#include "voxelcore/ReadInput.h"
#include "voxelcore/ReportTable.h"
#include "voxelcore/Sha256.h"

#include <future>
#include <numeric>
#include <omp.h>
#include <utility>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

std::string
EngineName(Engine engine)
{
  return engine == Engine::TetGen ? "tetgen" : "lattice";
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
  parameters.resolution = options.resolution;
  parameters.orthonormalize = options.reading.orthonormalize;
  parameters.niftiForm = options.reading.niftiForm;
  for (const Lambda & lambda : options.lambdas)
  {
    parameters.lambda.push_back(lambda.text);
  }
  for (const BumpHeight & height : options.bumps)
  {
    parameters.bumps.push_back(height.text);
  }
  parameters.refine.surface = options.refine.surface;
  if (!options.refine.grey.empty())
  {
    parameters.refine.greySha256 = ScanSha256(options.refine.grey);
    parameters.refine.greyRange = options.refine.greyRange;
  }
  parameters.model = options.model;
  parameters.engine = EngineName(options.engine);
  parameters.crossCheck = options.crossCheck;
  parameters.threads = options.threads;
  parameters.weights = weights;
  return parameters;
}

} // namespace

void
CheckCoreTargets(const CoreOptions & options, OutputTransaction & transaction)
{
  if (options.lambdas.empty())
  {
    throw UsageError("no --lambda given");
  }
  if (!options.bumps.empty() && options.lambdas.size() > 1)
  {
    throw UsageError("with --bumps give one --lambda, the floor");
  }
  if (!options.refine.surface.empty() && (!options.bumps.empty() || options.skeleton || options.model.keepEdges))
  {
    throw UsageError("--refine does not go with --bumps, --with-skeleton or --keep-edges");
  }
  if (options.report)
  {
    transaction.CheckTarget(*options.report);
  }
  if (options.table)
  {
    transaction.CheckTarget(*options.table);
  }
  if (options.crossCheck && !HasEngine(Engine::TetGen))
  {
    throw UsageError("--cross-check needs TetGen, which this build lacks; configure it with -DVOXELCORE_TETGEN=ON");
  }
  transaction.Protect(options.scan);
  if (!options.refine.grey.empty())
  {
    transaction.Protect(options.refine.grey);
  }
  if (options.output.empty())
  {
    return;
  }
  if (IsFolderOutput(options.output))
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
    for (const std::string & suffix : ResultSuffixes(options.lambdas, options.bumps))
    {
      transaction.CheckTarget(FileOutputPath(options.output, suffix));
    }
  }
}

namespace
{

/** Before anything large is allocated. */
void
RequireMemory(const CoreOptions & options, const std::vector<EditedLabel> & labels)
{
  const CostPrediction prediction = PredictJob(CountBoundaries(labels), options, omp_get_max_threads());
  if (prediction.memoryBytes > *options.memory)
  {
    throw InputError(options.scan.string() + ": needs about " + MemoryText(prediction.memoryBytes) +
                     ", and --memory allows " + MemoryText(*options.memory) +
                     "; take fewer --labels at a time, write into a folder (-o DIR/), or cut with --crop");
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
    , m_Suffixes(ResultSuffixes(options.lambdas, options.bumps))
    , m_Models(m_Suffixes.size())
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
    for (std::size_t i = 0; i < m_Models.size(); ++i)
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
  Target(const LabelRecord & record, std::size_t which) const
  {
    return m_ToFolder
             ? FolderOutputPath(m_Options.output, m_Options.scan, record.label, m_Suffixes[which], record.component)
             : FileOutputPath(m_Options.output, m_Suffixes[which]);
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
      model.refined = m_Options.refine.surface;
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
  std::vector<std::string> m_Suffixes;
  std::vector<MedialModel> m_Models; ///< one per lambda or bump height
};

} // namespace

CoreResult
StageCoreJob(const CoreOptions & options, OutputTransaction & transaction, const JobContext & context)
{
  // Shares of the whole job's time: reading, the labels, writing.
  constexpr double             kReadEnds = 0.05;
  constexpr double             kLabelsEnd = 0.95;
  Stopwatch                    total;
  Stopwatch                    watch;
  CoreResult                   result;
  CoreReport &                 report = result.report;
  const bool                   toFolder = IsFolderOutput(options.output);
  std::optional<SkeletonFiles> skeletons;
  if (options.skeleton)
  {
    skeletons.emplace(options.skeletonOutput, options.scan, options.skeleton->branches, transaction);
  }

  DisplayFiles shown(options.display, options.scan, transaction);

  // The digest runs beside reading and computing, until the first result is written; a scan that cannot be read is
  // reported by the reader.
  auto         digest = std::async(std::launch::async, [&options] { return ScanSha256(options.scan); });
  LabelVolume  volume = ReadScanOrMesh(options.scan,
                                      options.reading,
                                      options.resolution,
                                      PartOfProgress(context.progress, "reading", 0, kReadEnds));
  EditedLabels edited = EditLabels(volume,
                                   options.edits,
                                   options.reading.labels != "all",
                                   options.scan.string(),
                                   PartOfProgress(context.progress, "editing", kReadEnds, kReadEnds));
  if (options.memory)
  {
    RequireMemory(options, edited.labels);
  }
  if (context.admit)
  {
    context.admit(1e-6 * static_cast<double>(
                           PredictJob(CountBoundaries(edited.labels), options, omp_get_max_threads()).memoryBytes));
  }
  const SurfaceSource  estimates = MakeSurfaceSource(options.refine, options.scan, options.reading, volume);
  const SpacingWeights weights = ComputeSpacingWeights(volume.geometry.spacing);
  shown.AddScan(edited.labels, volume.geometry);
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
    estimates,
    PartOfProgress(context.progress, kReadEnds, kLabelsEnd),
    [&](LabelOutcome outcome) {
      if (digest.valid())
      {
        report.input.sha256 = digest.get();
      }
      // A core that is only a step on the way to a skeleton is not shown.
      shown.AddLabel(outcome.record,
                     options.output.empty() ? ModelPart() : outcome.parts.front(),
                     outcome.skeleton ? &*outcome.skeleton : nullptr);
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
  {
    Stopwatch writing;
    shown.Finish(report, result.notes, PartOfProgress(context.progress, kLabelsEnd, 1));
    report.seconds.write += writing.Lap();
  }
  report.seconds.total = total.Lap();
  report.peakMemoryMb = PeakMemoryMb();
  if (options.report)
  {
    WriteTextFile(transaction.Stage(*options.report), ReportJson(report));
  }
  if (options.table)
  {
    WriteTextFile(transaction.Stage(*options.table), LabelTableCsv(report));
  }
  return result;
}

CoreResult
RunCoreJob(const CoreOptions & options, const JobContext & context)
{
  OutputTransaction transaction(options.force, context.temporaries);
  CheckCoreTargets(options, transaction);
  CoreResult result = StageCoreJob(options, transaction, context);
  ReportProgress(context.progress, "done", 1); // the last moment at which an interruption is heeded
  transaction.Commit();
  return result;
}

} // namespace voxelcore
