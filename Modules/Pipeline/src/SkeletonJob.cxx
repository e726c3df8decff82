#include "voxelcore/SkeletonJob.h"

#include "JobTools.h"
#include "SkeletonFiles.h"
#include "voxelcore/ComplexTopology.h"
#include "voxelcore/CoreJob.h"
#include "voxelcore/Error.h"
#include "voxelcore/Sha256.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace voxelcore
{

namespace
{

using Json = nlohmann::ordered_json;

/** The lattice a skeleton's lengths in voxels and percent refer to. */
struct Scale
{
  SpacingWeights weights;
  Vector3        spacing{ 1, 1, 1 };
};

Json
ParametersJson(const SkeletonOptions & options)
{
  Json json = { { "lambda", options.lambda.text },
                { "threshold", options.threshold.text },
                { "plates", options.plates ? Json(options.plates->text) : Json(nullptr) },
                { "smooth", options.smooth.text } };
  AddBranchOptions(json, options.branches);
  return json;
}

/** From a certified surface to the measured graph. */
SkeletonPart
MakeSkeleton(const ModelPart &        surface,
             const LabelRecord &      record,
             const SkeletonOptions &  options,
             const Scale &            scale,
             const ProgressCallback & progress)
{
  const auto length = [&](const Lambda & l) {
    return LambdaInMillimetres(l, scale.weights, scale.spacing, record.box);
  };
  const double      voxel = *std::min_element(scale.spacing.begin(), scale.spacing.end());
  const std::string text = LabelText(record.label, record.name);
  CurveOptions      curves;
  curves.branchThreshold = length(options.threshold);
  if (options.plates)
  {
    curves.plateThreshold = length(*options.plates);
  }
  curves.sampling = 1.5 * voxel;
  curves.voxel = voxel;
  const CurveSkeleton   skeleton = ComputeCurveSkeleton(surface.core, curves, progress);
  const TopologyNumbers topology = ComputeComplexTopology(skeleton.complex.cells);
  RequireEqualTopology(record.shape, topology, "its skeleton", text);

  SkeletonPart part;
  part.label = record.label;
  part.component = record.component;
  part.name = record.name;
  part.graph = BuildSkeletonGraph(skeleton);
  FitBranches(part.graph, length(options.smooth), 0.5 * voxel);
  const double limit = options.branches.pruneLength ? length(*options.branches.pruneLength) : 0;
  if (PruneBranches(part.graph, { limit, options.branches.pruneRadii }) > 0)
  {
    FitBranches(part.graph, length(options.smooth), 0.5 * voxel);
  }
  const SkeletonNumbers numbers = MeasureBranches(part.graph).numbers;
  if (part.graph.FaceCount() == 0 && (numbers.components != topology.betti[0] || numbers.cycles != topology.betti[1]))
  {
    throw CertificateError(text +
                           ": certificate failed: the branches do not have the shape's topology; nothing was "
                           "written; this is a fault of VoxelCore, please report it with the scan");
  }
  return part;
}

bool
IsCoreFile(const std::filesystem::path & input)
{
  return input.extension() == ".vtp";
}

/** Skeletons of all labels of a scan; one label's core is in memory at a time. */
void
FromScan(const SkeletonOptions & options, const JobContext & context, SkeletonFiles & files, Json & provenance)
{
  LabelVolume volume =
    ReadLabelVolume(options.input, options.reading, PartOfProgress(context.progress, "reading", 0, 0.05));
  EditedLabels edited = EditLabels(volume,
                                   options.edits,
                                   options.reading.labels != "all",
                                   options.input.string(),
                                   PartOfProgress(context.progress, "editing", 0.05, 0.05));
  const Scale  scale{ ComputeSpacingWeights(volume.geometry.spacing), volume.geometry.spacing };
  files.warnings = volume.warnings;
  files.notes.insert(files.notes.end(), edited.notes.begin(), edited.notes.end());
  provenance["input"] = { { "sha256", ScanSha256(options.input) }, { "format", volume.format },
                          { "size", volume.geometry.size },        { "spacing_mm", volume.geometry.spacing },
                          { "origin_mm", volume.geometry.origin }, { "direction", volume.geometry.direction } };
  provenance["reading"] = { { "labels", options.reading.labels }, { "binary", options.reading.binary } };
  files.spacing = scale.spacing;
  for (std::size_t i = 0; i < edited.labels.size(); ++i)
  {
    const double  from = 0.05 + 0.9 * static_cast<double>(i) / static_cast<double>(edited.labels.size());
    const double  to = 0.05 + 0.9 * static_cast<double>(i + 1) / static_cast<double>(edited.labels.size());
    EditedLabel & one = edited.labels[i];
    LabelOutcome  outcome = ProcessLabel(std::move(one.label),
                                        volume.geometry,
                                        scale.weights,
                                        { options.lambda },
                                        options.engine,
                                        NamedPartOfProgress(context.progress, one.label.name, from, 0.5 * (from + to)));
    outcome.record.component = one.component;
    files.Add(MakeSkeleton(outcome.parts.front(),
                           outcome.record,
                           options,
                           scale,
                           PartOfProgress(context.progress, "skeleton", 0.5 * (from + to), to)),
              outcome.record.shape,
              &outcome.parts.front());
  }
}

void
FromCore(const SkeletonOptions & options, const JobContext & context, SkeletonFiles & files, Json & provenance)
{
  ReportProgress(context.progress, "reading", 0);
  MedialModel      model = ReadModel(options.input);
  const CoreReport made = ParseProvenance(model.provenance, options.input.string());
  if (made.labels.size() != model.parts.size())
  {
    throw InputError(options.input.string() + ": its field Provenance does not fit its cells; make the file again");
  }
  const Scale scale{ made.parameters.weights, made.input.geometry.spacing };
  provenance["core"] = Json::parse(model.provenance);
  files.spacing = scale.spacing;
  for (std::size_t i = 0; i < model.parts.size(); ++i)
  {
    const double share = 0.05 + 0.9 * static_cast<double>(i) / static_cast<double>(model.parts.size());
    files.Add(MakeSkeleton(model.parts[i],
                           made.labels[i],
                           options,
                           scale,
                           PartOfProgress(context.progress, "skeleton", share, share)),
              made.labels[i].shape,
              &model.parts[i]);
  }
  if (!made.parameters.lambda.empty() && made.parameters.lambda.front() != "0")
  {
    files.notes.push_back(options.input.string() + " is pruned at lambda " + made.parameters.lambda.front() +
                          ": parts thinner than that have no branches; for these make the core with --lambda 0");
  }
}

} // namespace

SkeletonResult
RunSkeletonJob(const SkeletonOptions & options, const JobContext & context)
{
  OutputTransaction transaction(options.force, context.temporaries);
  if (options.output.extension() != ".vtp")
  {
    throw UsageError(options.output.string() +
                     ": unknown extension; a skeleton is written as .vtp, other files by --also");
  }
  transaction.Protect(options.input);
  SkeletonFiles files(options.output, options.branches, transaction);
  Json          provenance = { { "voxelcore", { { "version", VoxelCoreVersion() } } } };
  provenance["skeleton"] = ParametersJson(options);
  IsCoreFile(options.input) ? FromCore(options, context, files, provenance)
                            : FromScan(options, context, files, provenance);
  ReportProgress(context.progress, "writing", 0.95);
  provenance["spacing_mm"] = files.spacing;
  files.model.provenance = provenance.dump();
  SkeletonResult result = files.Write();
  ReportProgress(context.progress, "done", 1);
  transaction.Commit();
  return result;
}

SkeletonResult
RunMeasureJob(const MeasureJobOptions & options, const JobContext & context)
{
  OutputTransaction transaction(options.force, context.temporaries);
  const std::string extension = options.output.extension().string();
  if (extension != ".csv" && extension != ".vtp")
  {
    throw UsageError(options.output.string() + ": unknown extension; use .csv or .vtp");
  }
  transaction.Protect(options.skeleton);
  SkeletonFiles files(options.output, options.branches, transaction);
  ReportProgress(context.progress, "reading", 0);
  SkeletonModel model = ReadSkeletonVtp(options.skeleton);
  try
  {
    const Json made = Json::parse(model.provenance);
    files.spacing = made.at("spacing_mm").get<Vector3>();
    for (const Json & label : made.at("labels"))
    {
      for (SkeletonPart & part : model.parts)
      {
        if (part.label == label.at("label") && part.component == label.at("component"))
        {
          part.name = label.at("name").get<std::string>();
        }
      }
    }
  }
  catch (const nlohmann::json::exception &)
  {
    throw InputError(options.skeleton.string() + ": its field Provenance lacks the spacing; make the file again");
  }
  const double voxel = *std::min_element(files.spacing.begin(), files.spacing.end());
  double       limit = 0;
  if (options.branches.pruneLength)
  {
    const Lambda & length = *options.branches.pruneLength;
    if (length.unit == Lambda::Unit::Percent)
    {
      throw UsageError("--prune-branches " + length.text + ": percent needs the scan; give mm, vox or r");
    }
    limit = length.value * (length.unit == Lambda::Unit::Voxel ? voxel : 1);
  }
  for (SkeletonPart & part : model.parts)
  {
    PruneBranches(part.graph, { limit, options.branches.pruneRadii });
    files.Add(std::move(part), std::nullopt, nullptr);
  }
  files.model.provenance = model.provenance;
  SkeletonResult result = files.Write();
  ReportProgress(context.progress, "done", 1);
  transaction.Commit();
  return result;
}

} // namespace voxelcore
