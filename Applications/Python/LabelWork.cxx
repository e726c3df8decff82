#include "LabelWork.h"

#include "JobTools.h"
#include "MakeSkeleton.h"
#include "SkeletonFiles.h"
#include "voxelcore/CoreJob.h"
#include "voxelcore/Error.h"
#include "voxelcore/OutputNames.h"
#include "voxelcore/OutputTransaction.h"

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

} // namespace

std::shared_ptr<CoreOfLabel>
MakeCore(const ArrayView &        array,
         const ImageGeometry &    geometry,
         ParameterValues          values,
         const ProgressCallback & progress)
{
  NameFiles(values);
  const CoreOptions options = CoreOptionsFrom(values);
  if (options.lambdas.size() > 1 || options.bumps.size() > 1)
  {
    throw UsageError("give one lambda_ or one height of bumps; prune() gives others from a core with lambda_=0");
  }
  auto         result = std::make_shared<CoreOfLabel>();
  CoreReport & report = result->report;
  report.input.path = "the array";
  report.input.format = "array";
  report.input.geometry = LabelAssembler::CheckGeometry("the array", geometry, options.reading.orthonormalize);

  constexpr double readEnds = 0.05;
  LabelShape       label = OnlyLabel(
    LabelsOf(array, report.input.geometry, options.reading, PartOfProgress(progress, "reading", 0, readEnds)));
  const SpacingWeights weights = ComputeSpacingWeights(geometry.spacing);
  ParameterRecord &    parameters = report.parameters;
  parameters.labels = { label.value };
  parameters.binary = options.reading.binary;
  parameters.threshold = options.reading.threshold;
  parameters.orthonormalize = options.reading.orthonormalize;
  parameters.lambda = { options.lambdas.front().text };
  for (const BumpHeight & height : options.bumps)
  {
    parameters.bumps.push_back(height.text);
  }
  parameters.engine = options.engine == Engine::TetGen ? "tetgen" : "lattice";
  parameters.weights = weights;
  LabelOutcome outcome = ProcessLabel(std::move(label),
                                      report.input.geometry,
                                      weights,
                                      options.lambdas,
                                      options.engine,
                                      PartOfProgress(progress, readEnds, 1),
                                      false,
                                      nullptr,
                                      options.bumps);
  report.labels = { std::move(outcome.record) };
  result->part = std::move(outcome.parts.front());
  return result;
}

std::shared_ptr<CoreOfLabel>
Prune(const CoreOfLabel & core, const std::string & lambda, const ProgressCallback & progress)
{
  if (!core.report.parameters.bumps.empty())
  {
    throw UsageError("this core is pruned by bump height; make one with lambda_=0 to prune by lambda");
  }
  if (!core.hasEdges)
  {
    throw UsageError("the file this core was read from lacks the measures of its edges; write it with keep_edges=True");
  }
  const Lambda        wanted = ParseLambdas(lambda).front();
  const LabelRecord & record = core.report.labels.front();
  const auto &        input = core.report.input;
  const double        done = record.pruned.front().lambdaMm;
  const double limit = LambdaInMillimetres(wanted, core.report.parameters.weights, input.geometry.spacing, record.box);
  if (limit < done)
  {
    throw UsageError("this core is pruned at " + record.pruned.front().lambda + " already, further than " +
                     wanted.text + "; make one with lambda_=0");
  }
  auto                    result = std::make_shared<CoreOfLabel>();
  std::vector<PrunedCore> pruned = PruneAndCertify(core.part,
                                                   record.pruned.front().complex,
                                                   done,
                                                   { wanted },
                                                   { limit },
                                                   record.shape,
                                                   LabelText(record.label, record.name),
                                                   progress);
  result->report = core.report;
  result->report.parameters.lambda = { wanted.text };
  result->report.labels.front().pruned = { std::move(pruned.front().record) };
  result->part = std::move(pruned.front().part);
  return result;
}

std::shared_ptr<SkeletonOfLabel>
MakeSkeletonOf(std::shared_ptr<const CoreOfLabel> core, ParameterValues values, const ProgressCallback & progress)
{
  NameFiles(values);
  auto result = std::make_shared<SkeletonOfLabel>();
  result->report = core->report;
  SkeletonStage stage = SkeletonOptionsFrom(values).stage;
  stage.lambda = ParseLambdas(core->report.parameters.lambda.front()).front();
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
Save(const CoreOfLabel & core, const std::filesystem::path & path, const ModelOptions & options, bool force)
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
  model.provenance = ProvenanceJson(report, { 0 }, 0);
  std::vector<std::string> notes;
  WriteStagedModel(transaction, path, model, options, notes);
  transaction.Commit();
}

void
Save(const SkeletonOfLabel & skeleton, const std::filesystem::path & path, const std::string & also, bool force)
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
  return result;
}

} // namespace voxelcore
