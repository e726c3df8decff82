#include "LabelWork.h"

#include "JobTools.h"
#include "MakeSkeleton.h"
#include "SkeletonFiles.h"
#include "voxelcore/CoreJob.h"
#include "voxelcore/Error.h"
#include "voxelcore/GreyScan.h"
#include "voxelcore/OutputNames.h"
#include "voxelcore/OutputTransaction.h"
#include "voxelcore/Parameters.h"

#include <optional>
#include <utility>

namespace voxelcore
{
namespace
{

/** Where the command line has files. */
void
NameFiles(ParameterValues & values)
{
  values["scan"] = "the array";
  values["output"] = "result.vtp";
}

/** The one label that is there. */
LabelShape
OnlyLabel(std::vector<LabelShape> labels)
{
  if (labels.size() == 1)
  {
    return std::move(labels.front());
  }
  std::string text;
  for (std::size_t i = 0; i < labels.size() && i < 10; ++i)
  {
    text += (i > 0 ? ", " : "") + std::to_string(labels[i].value);
  }
  throw InputError("the array: it holds " + std::to_string(labels.size()) + " labels (" + text +
                   (labels.size() > 10 ? ", ..." : "") +
                   "); choose one with label=, or take all but 0 as one shape with label='any'");
}

/** A core for each part, with a report that names it alone, as a file's provenance does. */
std::vector<std::shared_ptr<CoreOfLabel>>
ResultsOf(const CoreReport & report, const std::vector<PrunedRecord> & pruned, std::vector<ModelPart> parts)
{
  std::vector<std::shared_ptr<CoreOfLabel>> results;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    auto result = std::make_shared<CoreOfLabel>();
    result->report = report;
    result->report.parameters.lambda = { pruned[i].lambda };
    if (pruned[i].bumps)
    {
      result->report.parameters.bumps = { pruned[i].bumps->height };
    }
    result->report.labels.front().pruned = { pruned[i] };
    result->part = std::move(parts[i]);
    results.push_back(std::move(result));
  }
  return results;
}

void
RequireUnrefinedCore(const CoreOfLabel & core)
{
  if (!core.refined.empty())
  {
    throw UsageError("this core was made with --refine " + core.refined +
                     ", and only cores as they come out of the voxels are worked on; make one without");
  }
}

std::vector<PrunedCore>
PruneByLambdas(const CoreOfLabel & core, const std::vector<Lambda> & lambdas, const ProgressCallback & progress)
{
  const CoreReport &   report = core.report;
  const LabelRecord &  record = report.labels.front();
  const PrunedRecord & done = record.pruned.front();
  if (done.bumps && done.bumps->heightMm > 0)
  {
    throw UsageError("this core is pruned by bump height " + done.bumps->height +
                     " already; prune it further with bumps=, or make one with bumps=0 or without");
  }
  if (!core.hasEdges)
  {
    throw UsageError("the file this core was read from lacks the measures of its edges; write it with keep_edges=True");
  }
  std::vector<double> limits;
  for (const Lambda & wanted : lambdas)
  {
    limits.push_back(LambdaInMillimetres(wanted, report.parameters.weights, report.input.geometry.spacing, record.box));
    if (limits.back() < done.lambdaMm)
    {
      throw UsageError("this core is pruned at " + done.lambda + " already, further than " + wanted.text +
                       "; make one with lambda_=0");
    }
  }
  ModelPart whole = core.part;
  whole.core.bumps = {};
  return PruneAndCertify(std::move(whole),
                         done.complex,
                         done.lambdaMm,
                         lambdas,
                         limits,
                         record.shape,
                         LabelText(record.label, record.name),
                         progress);
}

std::vector<PrunedCore>
PruneByHeights(const CoreOfLabel & core, const std::vector<BumpHeight> & heights)
{
  const ImageGeometry & geometry = core.report.input.geometry;
  const LabelRecord &   record = core.report.labels.front();
  const PrunedRecord &  done = record.pruned.front();
  if (!done.bumps)
  {
    throw UsageError("this core does not hold bump heights; make it with bumps=0");
  }
  for (const BumpHeight & height : heights)
  {
    if (BumpHeightInMillimetres(height, geometry.spacing) < done.bumps->heightMm)
    {
      throw UsageError("this core is pruned at bump height " + done.bumps->height + " already, further than " +
                       height.text + "; make one with bumps=0");
    }
  }
  PrunedRecord floor = done;
  floor.bumps.reset();
  return PruneByBumpsAndCertify(core.part,
                                floor,
                                heights,
                                geometry,
                                record.shape,
                                LabelText(record.label, record.name));
}

} // namespace

std::vector<std::shared_ptr<CoreOfLabel>>
MakeCores(const ArrayView &        array,
          const ImageGeometry &    geometry,
          ParameterValues          values,
          const ProgressCallback & progress)
{
  NameFiles(values);
  const CoreOptions options = CoreOptionsFrom(values);
  CoreReport        report;
  report.input.path = "the array";
  report.input.format = "array";
  report.input.geometry = LabelAssembler::CheckGeometry("the array", geometry, options.reading.orthonormalize);

  constexpr double readEnds = 0.05;
  LabelShape       label;
  try
  {
    label = OnlyLabel(
      LabelsOf(array, report.input.geometry, options.reading, PartOfProgress(progress, "reading", 0, readEnds)));
  }
  catch (const GreyScanError & error)
  {
    const std::string range = OtsuRange(error.grey);
    throw InputError("the array: " + GreyScanText(error.grey) + "; choose a range, for example threshold=(" +
                     range.substr(0, range.find(':')) + ", numpy.inf) by Otsu, or give label= if its values are labels");
  }
  const SpacingWeights weights = ComputeLatticeWeights(report.input.geometry);
  ParameterRecord &    parameters = report.parameters;
  parameters.labels = { label.value };
  parameters.binary = options.reading.binary;
  parameters.threshold = options.reading.threshold;
  parameters.orthonormalize = options.reading.orthonormalize;
  parameters.lambda = { options.lambdas.front().text };
  parameters.engine = options.engine == Engine::TetGen ? "tetgen" : "lattice";
  parameters.weights = weights;
  LabelOutcome                    outcome = ProcessLabel(std::move(label),
                                      report.input.geometry,
                                      weights,
                                      options.lambdas,
                                      options.engine,
                                      PartOfProgress(progress, readEnds, 1),
                                      false,
                                      nullptr,
                                      options.bumps);
  const std::vector<PrunedRecord> pruned = std::move(outcome.record.pruned);
  report.labels = { std::move(outcome.record) };
  return ResultsOf(report, pruned, std::move(outcome.parts));
}

std::vector<std::shared_ptr<CoreOfLabel>>
Prune(const CoreOfLabel & core, ParameterValues values, const ProgressCallback & progress)
{
  RequireUnrefinedCore(core);
  values["core"] = "the core";
  values["output"] = "result.vtp";
  const PruneOptions      options = PruneOptionsFrom(values);
  std::vector<PrunedCore> pruned =
    options.bumps.empty() ? PruneByLambdas(core, options.lambdas, progress) : PruneByHeights(core, options.bumps);
  CoreReport report = core.report;
  report.parameters.bumps.clear();
  report.labels.front().covered.reset(); // there is no boundary here to measure it on
  std::vector<PrunedRecord> records;
  std::vector<ModelPart>    parts;
  for (PrunedCore & one : pruned)
  {
    records.push_back(std::move(one.record));
    parts.push_back(std::move(one.part));
  }
  auto results = ResultsOf(report, records, std::move(parts));
  for (const auto & result : results)
  {
    result->hasEdges = core.hasEdges;
  }
  return results;
}

std::shared_ptr<SkeletonOfLabel>
MakeSkeletonOf(std::shared_ptr<const CoreOfLabel> core, ParameterValues values, const ProgressCallback & progress)
{
  RequireUnrefinedCore(*core);
  NameFiles(values);
  auto result = std::make_shared<SkeletonOfLabel>();
  result->report = core->report;
  SkeletonStage stage = SkeletonOptionsFrom(values).stage;
  stage.lambda = ParseLambda(core->report.parameters.lambda.front());
  if (!core->report.parameters.bumps.empty())
  {
    const BumpHeight height = ParseBumpHeight(core->report.parameters.bumps.front());
    stage.bumps = height.value > 0 ? std::optional(height) : std::nullopt;
  }
  result->part = MakeSkeleton(core->part,
                              stage,
                              core->report.parameters.weights,
                              core->report.input.geometry,
                              result->report.labels.front(),
                              progress);
  result->report.skeleton = std::move(stage);
  result->surface = std::move(core);
  return result;
}

void
Save(const CoreOfLabel &           core,
     const std::filesystem::path & path,
     const ModelOptions &          options,
     bool                          force,
     const ProgressCallback &      progress)
{
  if (!IsModelPath(path))
  {
    throw UsageError(path.string() + ": unknown extension; use .vtp .vtk .ply .obj .stl or .ma");
  }
  OutputTransaction transaction(force);
  MedialModel       model;
  CoreReport        report = core.report;
  report.parameters.model = options;
  model.parts = { core.part };
  model.hasEdges = core.hasEdges;
  model.refined = core.refined;
  model.provenance = ProvenanceJson(report, { 0 }, 0);
  std::vector<std::string> notes;
  WriteStagedModel(transaction, path, model, options, notes);
  ReportProgress(progress, "writing", 1);
  transaction.Commit();
}

void
Save(const SkeletonOfLabel &       skeleton,
     const std::filesystem::path & path,
     const std::string &           also,
     bool                          force,
     const ProgressCallback &      progress)
{
  OutputTransaction transaction(force);
  CoreReport        report = skeleton.report;
  BranchOptions     options = report.skeleton.value().branches;
  options.also = also.empty() ? std::vector<std::string>() : ParseAlso(also);
  report.skeleton->branches.also = options.also;
  if (IsFolderOutput(path))
  {
    throw UsageError(path.string() + ": give a file, .vtp or .csv");
  }
  SkeletonFiles            files(path, "the array", options, transaction);
  std::vector<std::string> notes;
  files.Add(report, 0, skeleton.part, files.NeedsSurface() ? skeleton.surface->part : ModelPart(), notes);
  files.Finish(report, notes);
  ReportProgress(progress, "writing", 1);
  transaction.Commit();
}

std::shared_ptr<CoreOfLabel>
ReadCore(const std::filesystem::path & path)
{
  MedialModel model = ReadModel(path);
  auto        result = std::make_shared<CoreOfLabel>();
  result->report = ParseProvenance(model.provenance, path.string());
  if (model.parts.size() != 1 || result->report.labels.size() != 1)
  {
    throw InputError(path.string() + ": holds " + std::to_string(model.parts.size()) +
                     " labels; give a file with one, as 'voxelcore core -o FOLDER/' writes them");
  }
  result->part = std::move(model.parts.front());
  result->hasEdges = model.hasEdges;
  result->refined = model.refined;
  return result;
}

} // namespace voxelcore
