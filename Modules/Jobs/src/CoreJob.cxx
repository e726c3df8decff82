#include "voxelcore/CoreJob.h"

#include "CoreJobSteps.h"
#include "DisplayFiles.h"
#include "FacelessLabels.h"
#include "FinishedLabels.h"
#include "JobTools.h"
#include "LabelLoop.h"
#include "voxelcore/SkeletonFiles.h"
#include "voxelcore/CostModel.h"
#include "voxelcore/Error.h"
#include "voxelcore/OutputNames.h"
#include "voxelcore/ReadInput.h"
#include "voxelcore/ReportTable.h"
#include "voxelcore/Sha256.h"

#include <algorithm>
#include <cstdio>
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
DescribeInput(const CoreOptions & options, const LabelMap & volume)
{
  return { options.scan.string(), {}, volume.format, volume.geometry, volume.notes };
}

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
  parameters.edits = options.edits;
  parameters.crop = volume.crop;
  parameters.binary = options.reading.binary;
  parameters.threshold = options.reading.threshold;
  parameters.volume = options.reading.volume;
  parameters.component = options.reading.component;
  parameters.raw = options.reading.raw;
  parameters.spacing = options.reading.spacing;
  parameters.resolution = options.resolution;
  parameters.orthonormalize = options.reading.orthonormalize;
  parameters.niftiForm = options.reading.niftiForm;
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

} // namespace

void
CheckCoreTargets(const CoreOptions & options, OutputTransaction & transaction)
{
  if (options.lambdas.empty())
  {
    throw UsageError("no --lambda given");
  }
  if (!options.tolerances.empty() && options.lambdas.size() > 1)
  {
    throw UsageError("with --tolerance give one --lambda, the floor");
  }
  if (!options.refine.surface.empty() && (!options.tolerances.empty() || options.skeleton || options.model.keepEdges))
  {
    throw UsageError("--refine does not go with --tolerance, --with-skeleton or --keep-edges");
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
    for (const std::string & suffix : ResultSuffixes(options.lambdas, options.tolerances))
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
    , m_Suffixes(ResultSuffixes(options.lambdas, options.tolerances))
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

  /** Takes what is in its folder already. */
  void
  AddFinished(LabelRecord record)
  {
    for (std::size_t i = 0; i < m_Models.size() && !m_Options.output.empty(); ++i)
    {
      record.pruned[i].output = Target(record, i).string();
    }
    m_Result.report.labels.push_back(std::move(record));
  }

  /** The files a label of a folder gets. */
  std::vector<fs::path>
  Targets(const LabelRecord & record) const
  {
    std::vector<fs::path> targets;
    for (std::size_t i = 0; i < m_Models.size() && !m_Options.output.empty(); ++i)
    {
      targets.push_back(Target(record, i));
    }
    return targets;
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
  std::vector<MedialModel> m_Models; ///< one per lambda or tolerance
};

/** Where a folder says which of its labels are finished. */
fs::path
FinishedLabelsPath(const CoreOptions & options)
{
  const bool isCore = !options.output.empty();
  return (isCore ? options.output : options.skeletonOutput) /
         (ScanName(options.scan) + (isCore ? "_medial" : "_skeleton") + "_finished.jsonl");
}

/** The labels of a folder, of which some are finished. */
class FolderLabels
{
public:
  /** Takes out of `labels` those that are finished. Refuses before hours of work what could not be written in the end. */
  FolderLabels(const CoreOptions &        options,
               std::vector<EditedLabel> & labels,
               const ResultFiles &        files,
               const SkeletonFiles *      skeletons,
               const OutputTransaction &  transaction,
               const CoreReport &         report)
    : m_Finished(FinishedLabelsPath(options), LabelKey(report, KeyText(skeletons)))
  {
    std::vector<EditedLabel> left;
    for (EditedLabel & one : labels)
    {
      auto known = m_Finished.Find(one.label.value, one.component, one.label.name);
      if (!known)
      {
        LabelRecord record;
        record.label = one.label.value;
        record.component = one.component;
        for (const fs::path & target : files.Targets(record))
        {
          transaction.CheckTarget(target);
        }
        if (skeletons != nullptr)
        {
          transaction.CheckTarget(skeletons->FolderTarget(record.label, record.component));
        }
        left.push_back(std::move(one));
      }
      m_Known.push_back(std::move(known));
    }
    labels = std::move(left);
    for (const fs::path & table : skeletons != nullptr ? skeletons->FolderTables() : std::vector<fs::path>())
    {
      if (!m_Finished.IsTable(table))
      {
        transaction.CheckTarget(table);
      }
    }
  }

  std::size_t
  CountFinished() const
  {
    return static_cast<std::size_t>(
      std::count_if(m_Known.begin(), m_Known.end(), [](const auto & known) { return known.has_value(); }));
  }

  /** Hands over, in their order, the finished labels before the next that is not. */
  template <typename Take>
  void
  TakeFinished(Take && take)
  {
    for (; m_Next < m_Known.size() && m_Known[m_Next]; ++m_Next)
    {
      take(std::move(*m_Known[m_Next]));
    }
  }

  /** The next that was not finished has come. */
  void
  Pass()
  {
    ++m_Next;
  }

  FinishedLabels &
  Finished()
  {
    return m_Finished;
  }

private:
  static std::string
  KeyText(const SkeletonFiles * skeletons)
  {
    std::string text;
    for (const std::string & ending : skeletons != nullptr ? skeletons->Endings() : std::vector<std::string>())
    {
      text += ending == "csv" ? "" : ending + " "; // tables are of all labels
    }
    return text;
  }

  FinishedLabels                                    m_Finished;
  std::vector<std::optional<FinishedLabels::Label>> m_Known;
  std::size_t                                       m_Next = 0;
};

} // namespace

CoreResult
StageCoreJob(const CoreOptions & options,
             OutputTransaction & transaction,
             const JobContext &  context,
             bool                labelByLabel)
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

  DisplayFiles shown(options.display, options.scan, transaction);

  // The digest runs beside reading and computing, until the first result is written; a scan that cannot be read is
  // reported by the reader.
  auto                 digest = std::async(std::launch::async, [&options] { return ScanSha256(options.scan); });
  LabelMap             volume = ReadScanOrMesh(options.scan, options.reading, options.resolution, plan.Next("reading"));
  const SpacingWeights weights = ScanWeights(volume.geometry, options.scan);
  EditedLabels         edited = EditLabels(std::move(volume.labels),
                                   options.edits,
                                   options.reading.labels != "all",
                                   options.scan.string(),
                                   plan.Next());
  if (options.memory)
  {
    RequireMemory(options, edited.labels);
  }
  if (context.admit)
  {
    context.admit(1e-6 * static_cast<double>(
                           PredictJob(CountBoundaries(edited.labels), options, omp_get_max_threads()).memoryBytes));
  }
  const SurfaceSource estimates = MakeSurfaceSource(options.refine, options.scan, options.reading, volume);
  shown.AddScan(edited.labels, volume.geometry);
  report.command = options.command;
  report.input = DescribeInput(options, volume);
  report.parameters = DescribeParameters(options, volume, edited, weights);
  result.warnings = volume.warnings;
  result.notes = edited.notes;
  report.seconds.read = watch.Lap();

  report.skeleton = options.skeleton;

  ResultFiles                 files(options, toFolder, transaction, result);
  std::optional<FolderLabels> folder;
  std::vector<std::string>    failures;
  if (labelByLabel)
  {
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
      const std::size_t notesBefore = result.notes.size();
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
      if (folder)
      {
        const auto firstNote = result.notes.begin() + static_cast<std::ptrdiff_t>(notesBefore);
        folder->Finished().Finish({ report.labels.back(), { firstNote, result.notes.end() } }, transaction);
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
