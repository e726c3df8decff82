#include "voxelcore/Jobs/PruneJob.h"

#include "FacelessLabels.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/SystemCalls.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/OutputNames.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

namespace
{

/** What a file must hold to be pruned on. */
void
RequirePrunable(const PruneOptions & options, const MedialModel & model, const CoreReport & made)
{
  const std::string where = options.core.string();
  const bool        hasTolerance = !made.parameters.tolerances.empty();
  if (!options.tolerances.empty() && !hasTolerance)
  {
    throw InputError(where + ": does not hold tolerances; make it with 'voxelcore core --tolerance 0'");
  }
  if (options.tolerances.empty() && !model.hasEdges)
  {
    throw InputError(where + ": does not hold the measures of its edges; make it with 'voxelcore core --keep-edges'");
  }
  bool fits = made.parameters.lambda.size() == 1 && made.parameters.tolerances.size() <= 1 &&
              made.labels.size() == model.parts.size();
  for (std::size_t i = 0; fits && i < made.labels.size(); ++i)
  {
    fits = made.labels[i].label == model.parts[i].label && made.labels[i].component == model.parts[i].component &&
           made.labels[i].pruned.size() == 1 && made.labels[i].pruned.front().tolerance.has_value() == hasTolerance &&
           model.parts[i].core.HasTolerances() == hasTolerance;
  }
  RequireFittingProvenance(fits, where);
}

/** \throws InputError when the file is pruned beyond one of the thresholds, or not by lambda. */
void
RequireSmaller(const PruneOptions & options, const CertifiedShape & shape, const PrunedRecord & done)
{
  if (done.tolerance && done.tolerance->heightMm > 0)
  {
    throw InputError(options.core.string() +
                     ": is pruned by tolerance already; give --tolerance, or a file made with --lambda");
  }
  const SpacingWeights weights = ComputeSpacingWeights(shape.geometry.spacing);
  for (const Lambda & lambda : options.lambdas)
  {
    if (LambdaInMillimetres(lambda, weights, shape.geometry.spacing, shape.box) < done.lambdaMm)
    {
      throw InputError(options.core.string() + ": is pruned at " + done.lambda + " already; for " + lambda.text +
                       " give a file made with a smaller --lambda, best 0");
    }
  }
}

/** \throws InputError when the file is pruned beyond one of the heights. */
void
RequireLower(const PruneOptions & options, const CoreReport & made, const ToleranceNumbers & done)
{
  for (const Tolerance & height : options.tolerances)
  {
    if (ToleranceInMillimetres(height, made.input.geometry.spacing) < done.heightMm)
    {
      throw InputError(options.core.string() + ": is pruned at tolerance " + done.height + " already; for " +
                       height.text + " give a file made with a smaller --tolerance, best 0");
    }
  }
}

/** All results of one label. */
std::vector<CertifiedCore>
PruneLabel(ModelPart                part,
           const PruneOptions &     options,
           const CoreReport &       made,
           const LabelRecord &      label,
           const ProgressCallback & progress)
{
  const CertifiedShape shape = RecordedShape(made, label);
  const PrunedRecord & done = label.pruned.front();
  if (!options.tolerances.empty())
  {
    RequireLower(options, made, *done.tolerance);
    return PruneCertified({ done, std::move(part) }, shape, options.tolerances);
  }
  RequireSmaller(options, shape, done);
  return PruneCertified({ done, std::move(part) }, shape, options.lambdas, progress);
}

} // namespace

PruneResult
RunPruneJob(const PruneOptions & options, const JobContext & given)
{
  const JobContext  context = ForwardOnly(given);
  Stopwatch         total;
  Stopwatch         watch;
  PruneResult       result;
  CoreReport &      report = result.report;
  OutputTransaction transaction(options.force, context.temporaries);
  if (!IsModelPath(options.output))
  {
    throw UsageError(options.output.string() + ": unknown extension; use .vtp .vtk .ply .obj .stl or .ma");
  }
  transaction.Protect(options.core);
  const std::vector<std::string> suffixes = ResultSuffixes(options.lambdas, options.tolerances);
  for (const std::string & suffix : suffixes)
  {
    transaction.CheckTarget(FileOutputPath(options.output, suffix));
  }
  if (options.report)
  {
    transaction.CheckTarget(*options.report);
  }

  ReportProgress(context.progress, "reading", 0);
  MedialModel model = ReadModel(options.core);
  report = ParseProvenance(model.provenance, options.core.string());
  RequirePrunable(options, model, report);
  CertifiedRequest request;
  request.lambdas = options.lambdas;
  request.tolerances = options.tolerances;
  RequireLengthsOf(options.core, report.input.geometry.unit, request);
  report.command = options.command;
  report.input.path = options.core.string();
  NoteRefinedAt(report.parameters);
  // Of what is pruned by tolerance on, the lambda stays what it was.
  report.parameters.tolerances.clear();
  for (const Tolerance & height : options.tolerances)
  {
    report.parameters.tolerances.push_back(height.text);
  }
  if (!options.lambdas.empty())
  {
    report.parameters.lambda.clear();
  }
  for (const Lambda & lambda : options.lambdas)
  {
    report.parameters.lambda.push_back(lambda.text);
  }
  report.parameters.model = options.model;
  report.parameters.engine = "none";
  report.parameters.threads = options.threads;
  report.seconds.read = watch.Lap();

  std::vector<std::uint64_t> faces;
  for (const LabelRecord & label : report.labels)
  {
    faces.push_back(label.pruned.front().complex.faces);
  }
  std::vector<MedialModel> models(suffixes.size());
  for (std::size_t i = 0; i < model.parts.size(); ++i)
  {
    Stopwatch     labelWatch;
    LabelRecord & label = report.labels[i];
    const auto    share = [&](std::size_t done) {
      return 0.1 + 0.8 * static_cast<double>(done) / static_cast<double>(model.parts.size());
    };
    auto pruned = PruneLabel(std::move(model.parts[i]),
                             options,
                             report,
                             label,
                             PartOfProgress(context.progress, "prune", share(i), share(i + 1)));
    label.pruned.clear();
    for (std::size_t k = 0; k < pruned.size(); ++k)
    {
      label.pruned.push_back({ std::move(pruned[k].numbers), FileOutputPath(options.output, suffixes[k]).string() });
      models[k].parts.push_back(std::move(pruned[k].core));
    }
    label.seconds = labelWatch.Lap();
  }
  report.seconds.prune = watch.Lap();
  TellFacelessLabels(report, faces, result.notes, result.warnings);

  ReportProgress(context.progress, "writing", 0.9);
  std::vector<std::size_t> all(report.labels.size());
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    all[i] = i;
  }
  for (std::size_t k = 0; k < models.size(); ++k)
  {
    models[k].provenance = ProvenanceJson(report, all, k);
    models[k].hasEdges = options.model.keepEdges;
    models[k].refined = model.refined;
    models[k].unit = model.unit;
    WriteStagedModel(transaction, FileOutputPath(options.output, suffixes[k]), models[k], options.model, result.notes);
    models[k] = MedialModel();
  }
  report.seconds.write = watch.Lap();
  report.seconds.total = total.Lap();
  report.peakMemoryMb = PeakMemoryMb();
  if (options.report)
  {
    WriteTextFile(transaction.Stage(*options.report), ReportJson(report));
  }
  Finish(transaction, context);
  return result;
}

} // namespace voxelcore
