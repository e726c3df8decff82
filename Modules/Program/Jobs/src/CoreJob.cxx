#include "voxelcore/Jobs/CoreJob.h"

#include "SkeletonNotes.h"
#include "voxelcore/Jobs/CoreJobSteps.h"
#include "voxelcore/Jobs/DisplayFiles.h"
#include "FacelessLabels.h"
#include "FolderLabels.h"
#include "voxelcore/Jobs/JobTools.h"
#include "SkeletonBodies.h"
#include "voxelcore/Jobs/LabelLoop.h"
#include "voxelcore/Jobs/LabelVolumes.h"
#include "ResultFiles.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/SystemCalls.h"
#include "voxelcore/Jobs/CostModel.h"
#include "voxelcore/Jobs/NetworkLabels.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Jobs/SkeletonFiles.h"
#include "voxelcore/Report/ReportTable.h"
#include "voxelcore/Report/Sha256.h"

#include <algorithm>
#include <cstdio>
#include <future>
#include <map>
#include <numeric>
#include <omp.h>
#include <tuple>
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
DescribeInput(const CoreOptions & options, const LabelMap & volume)
{
  return { options.scan.string(), {}, volume.format, volume.geometry, volume.notes };
}

} // namespace

ParameterRecord
DescribeParameters(const CoreOptions &    options,
                   const LabelMap &       volume,
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
  parameters.reading = options.reading;
  parameters.reading.crop = volume.crop;
  parameters.resolution = options.resolution;
  parameters.edits = options.edits;
  if (options.edits.connectivity == Connectivity::Joined && !edited.touched)
  {
    parameters.edits.connectivity = Connectivity::Six; // where no pieces touch, both are one
  }
  parameters.further = options.further;
  for (const Lambda & lambda : options.lambdas)
  {
    parameters.lambda.push_back(lambda.text);
  }
  for (const Tolerance & height : options.tolerances)
  {
    parameters.tolerances.push_back(height.text);
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

void
CheckCoreTargets(const CoreOptions & options, OutputTransaction & transaction)
{
  if (options.lambdas.empty())
  {
    throw UsageError("no --lambda given; give one, such as --lambda 1.5vox");
  }
  if (!options.tolerances.empty() && options.lambdas.size() > 1)
  {
    throw UsageError("with --tolerance give one --lambda, the floor");
  }
  if (options.report)
  {
    transaction.CheckTarget(*options.report);
  }
  if (options.table)
  {
    transaction.CheckTarget(*options.table);
    transaction.CheckTarget(ColumnsBeside(*options.table));
  }
  if (options.crossCheck && !HasEngine(Engine::TetGen))
  {
    throw UsageError("--cross-check needs TetGen, which this build lacks; configure it with -DVOXELCORE_TETGEN=ON");
  }
  ProtectInputs(transaction, options);
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
    for (const std::string & suffix : ResultSuffixes(options.lambdas, options.tolerances))
    {
      transaction.CheckTarget(FileOutputPath(options.output, suffix));
    }
  }
}

namespace
{

/** Before hours of work. */
void
RequireLengths(const CoreOptions & options, SpatialUnit unit)
{
  CertifiedRequest request;
  request.lambdas = options.lambdas;
  request.tolerances = options.tolerances;
  request.skeleton = options.skeleton;
  RequireLengthsOf(options.scan, unit, request);
}

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

} // namespace

CoreResult
StageCoreJob(const CoreOptions & options,
             OutputTransaction & transaction,
             const JobContext &  context,
             bool                labelByLabel,
             const ShapesSeen &  seen,
             ScanAtHand *        scan)
{
  // Shares of the whole job's time: reading, editing, the labels, writing, pages and scenes.
  StagePlan                    plan(context.progress,
                 { 0.05,
                   options.edits.mend || options.edits.smooth ? 0.07 : 0.01,
                                      0.85,
                                      0.05,
                   options.display.html || options.display.scene ? 0.3 : 0.0 });
  Stopwatch                    total;
  Stopwatch                    watch;
  CoreResult                   result;
  CoreReport &                 report = result.report;
  const bool                   toFolder = IsFolderOutput(options.output);
  std::optional<SkeletonFiles> skeletons;
  if (options.skeleton)
  {
    skeletons.emplace(options.skeletonOutput, options.scan, options.skeletonTargets, transaction);
  }

  std::optional<SkeletonBodies> bodies;
  if (options.skeleton && !options.skeletonTargets.NeedsBodies().empty())
  {
    bodies.emplace(options.skeletonOutput, options.skeletonTargets, transaction);
  }
  DisplayFiles shown(options.display, options.scan, transaction);

  // The digest runs beside reading and computing, until the first result is written; a scan that cannot be read is
  // reported by the reader.
  auto digest = std::async(Beside(), [&options] { return ScanSha256(options.scan, options.reading); });
  const ProgressCallback look = plan.Next("reading");
  InputScan              volume =
    scan != nullptr ? std::move(scan->volume) : ReadScanOrMesh(options.scan, options.reading, options.resolution, look);
  const SpacingWeights weights = ScanWeights(volume.geometry, options.scan);
  RequireLengths(options, volume.geometry.unit);
  if (skeletons)
  {
    skeletons->RequireUnit(volume.geometry.unit);
  }
  std::optional<NetworkLabels> network;
  if (options.skeleton && options.skeleton->network)
  {
    network.emplace(volume.labels, options.scan.string(), result.notes);
  }
  const ProgressCallback editing = plan.Next();
  EditedLabels           edited = scan != nullptr ? std::move(scan->edited)
                                                  : EditLabels(std::move(volume.labels),
                                                     volume.geometry,
                                                     options.edits,
                                                     options.reading.labels != "all",
                                                     options.scan.string(),
                                                     editing);
  if (seen)
  {
    seen(edited.labels, volume.geometry);
  }
  const std::vector<std::string> found = DiagnoseLabels(edited.labels, weights.weight);
  if (options.memory)
  {
    RequireMemory(options, edited.labels);
  }
  if (context.admit)
  {
    context.admit(1e-6 * static_cast<double>(
                           PredictJob(CountBoundaries(edited.labels), options, omp_get_max_threads()).memoryBytes));
  }
  const SurfaceSource           estimates = MakeSurfaceSource(options.refine, options.scan, options.reading, volume);
  const std::optional<VoxelBox> border = BorderOf(volume);
  volume.mesh.reset();
  if (bodies)
  {
    bodies->Keep(edited.labels, options, volume.geometry, border, estimates);
  }
  if (network)
  {
    network->Fit(edited.labels.front(), volume.geometry, border, *options.skeleton);
    shown.AddNetwork(network->Labels(), volume.geometry);
  }
  else
  {
    shown.AddScan(edited.labels, volume.geometry);
  }
  report.command = options.command;
  report.input = DescribeInput(options, volume);
  report.parameters = DescribeParameters(options, volume, edited, weights);
  result.warnings = volume.warnings;
  result.warnings.insert(result.warnings.end(), found.begin(), found.end());
  result.notes.insert(result.notes.end(), edited.notes.begin(), edited.notes.end());
  report.seconds.read = watch.Lap();

  report.skeleton = options.skeleton;

  ResultFiles                 files(options, toFolder, transaction, result);
  std::optional<FolderLabels> folder;
  std::vector<std::string>    failures;
  // What was seen in labels that an earlier run finished; its files do not say.
  std::map<std::pair<std::int64_t, std::int64_t>, std::pair<std::optional<HollowBody>, std::optional<MaskDiagnosis>>>
    looks;
  if (labelByLabel)
  {
    for (const EditedLabel & one : edited.labels)
    {
      looks[{ one.label.value, one.component }] = { one.hollow, one.diagnosis };
    }
    report.input.sha256 = digest.get();
    folder.emplace(options, edited.labels, files, skeletons ? &*skeletons : nullptr, transaction, report);
    if (const std::size_t finished = folder->CountFinished(); finished > 0)
    {
      result.notes.push_back(std::to_string(finished) + (finished == 1 ? " label was" : " labels were") +
                             " finished by an earlier run and kept");
    }
  }
  const auto takeFinished = [&] {
    folder->TakeFinished([&](FinishedLabels::Label label) {
      std::tie(label.record.hollow, label.record.diagnosis) = looks.at({ label.record.label, label.record.component });
      files.AddFinished(std::move(label.record));
      if (skeletons)
      {
        skeletons->AddFinished(report, report.labels.size() - 1);
      }
      result.notes.insert(result.notes.end(), label.notes.begin(), label.notes.end());
    });
  };
  ProcessLabels(
    edited.labels,
    options,
    volume.geometry,
    estimates,
    border,
    plan.Next(),
    [&](LabelOutcome outcome) {
      if (digest.valid())
      {
        report.input.sha256 = digest.get();
      }
      if (folder)
      {
        takeFinished();
        folder->Pass();
        if (!outcome.failure.empty())
        {
          failures.push_back(outcome.failure);
          return;
        }
      }
      if (scan != nullptr && scan->done)
      {
        scan->done(outcome);
      }
      const std::size_t notesBefore = result.notes.size();
      if (network)
      {
        network->Take(outcome, *options.skeleton, report, result.notes);
      }
      if (bodies)
      {
        bodies->Add(*outcome.skeleton, *outcome.record.skeleton);
      }
      // A core that is only a step on the way to a skeleton is not shown.
      const ModelPart nothing;
      shown.AddLabel(outcome.record,
                     options.output.empty() ? nothing : outcome.parts.front(),
                     outcome.skeleton ? &*outcome.skeleton : nullptr);
      const ModelPart surface = skeletons && skeletons->NeedsSurface() ? outcome.parts.front() : ModelPart();
      files.Add(std::move(outcome.record), std::move(outcome.parts));
      if (skeletons)
      {
        skeletons->Add(report, report.labels.size() - 1, std::move(*outcome.skeleton), surface, result.notes);
      }
      if (folder)
      {
        const auto firstNote = result.notes.begin() + static_cast<std::ptrdiff_t>(notesBefore);
        folder->Finished().Finish({ report.labels.back(), { firstNote, result.notes.end() } },
                                  report.input.geometry.unit,
                                  transaction);
      }
    },
    report.seconds,
    labelByLabel);
  if (folder)
  {
    takeFinished();
  }
  if (!failures.empty())
  {
    std::string       first = failures.front();
    const std::string nothing = "nothing was written";
    if (const std::size_t at = first.find(nothing); at != std::string::npos)
    {
      first.replace(at, nothing.size(), "it was not written");
    }
    throw CertificateError(
      first + (failures.size() > 1 ? "; " + std::to_string(failures.size() - 1) + " more labels failed" : "") +
      "; the labels that passed are in the folder, tables and report are not written");
  }
  ReportProgress(plan.Next("writing"), "", 0);
  files.Finish();
  if (skeletons)
  {
    Stopwatch writing;
    if (folder)
    {
      folder->Finished().RemoveTables();
    }
    skeletons->Finish(report, result.notes);
    if (bodies)
    {
      bodies->Finish();
    }
    if (folder)
    {
      folder->Finished().NoteTables(transaction);
    }
    report.seconds.write += writing.Lap();
  }
  {
    Stopwatch writing;
    shown.Finish(report, result.notes, plan.Next());
    report.seconds.write += writing.Lap();
  }
  std::vector<std::uint64_t> faces;
  for (const LabelRecord & label : report.labels)
  {
    faces.push_back(label.core.faces);
  }
  TellFacelessLabels(report, faces, result.notes, result.warnings);
  TellBorderCuts(report, result.notes);
  TellShortLoops(report, result.notes);
  report.seconds.total = total.Lap();
  report.peakMemoryMb = PeakMemoryMb();
  if (options.report)
  {
    WriteTextFile(transaction.Stage(*options.report), ReportJson(report));
  }
  if (options.table)
  {
    WriteTextFile(transaction.Stage(*options.table), LabelTableCsv(report, context.Heads(report.input.geometry.unit)));
    WriteTextFile(transaction.Stage(ColumnsBeside(*options.table)), LabelTableColumnsJson(report));
  }
  return result;
}

CoreResult
RunCoreJob(const CoreOptions & options, const JobContext & given)
{
  const JobContext  context = ForwardOnly(given);
  OutputTransaction transaction(options.force, context.temporaries);
  CheckCoreTargets(options, transaction);
  const bool isFolder = IsFolderOutput(options.output.empty() ? options.skeletonOutput : options.output);
  const bool isShown = options.display.scene || options.display.html;
  CoreResult result = StageCoreJob(options, transaction, context, isFolder && !isShown);
  Finish(transaction, context);
  return result;
}

} // namespace voxelcore
