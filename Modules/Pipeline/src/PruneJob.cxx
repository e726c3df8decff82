#include "voxelcore/PruneJob.h"

#include "JobTools.h"
#include "voxelcore/Error.h"
#include "voxelcore/OutputNames.h"

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
  if (!model.hasEdges)
  {
    throw InputError(where + ": does not hold the measures of its edges; make it with 'voxelcore core --keep-edges'");
  }
  if (made.parameters.lambda.size() != 1 || made.labels.size() != model.parts.size())
  {
    throw InputError(where + ": its field Provenance does not fit its cells; make the file again");
  }
  for (std::size_t i = 0; i < made.labels.size(); ++i)
  {
    if (made.labels[i].label != model.parts[i].label || made.labels[i].component != model.parts[i].component ||
        made.labels[i].pruned.size() != 1)
    {
      throw InputError(where + ": its field Provenance does not fit its cells; make the file again");
    }
  }
}

} // namespace

PruneResult
RunPruneJob(const PruneOptions & options, const JobContext & context)
{
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
  for (std::size_t i = 0; i < options.lambdas.size(); ++i)
  {
    transaction.CheckTarget(FileOutputPath(options.output, options.lambdas, i));
  }
  if (options.report)
  {
    transaction.CheckTarget(*options.report);
  }

  ReportProgress(context.progress, "reading", 0);
  MedialModel model = ReadModel(options.core);
  report = ParseProvenance(model.provenance, options.core.string());
  RequirePrunable(options, model, report);
  const std::string doneText = report.parameters.lambda.front();
  report.command = options.command;
  report.input.path = options.core.string();
  report.parameters.lambda.clear();
  for (const Lambda & lambda : options.lambdas)
  {
    report.parameters.lambda.push_back(lambda.text);
  }
  report.parameters.model = options.model;
  report.parameters.engine = "none";
  report.parameters.threads = options.threads;
  report.seconds.read = watch.Lap();

  std::vector<MedialModel> models(options.lambdas.size());
  for (std::size_t i = 0; i < model.parts.size(); ++i)
  {
    Stopwatch           labelWatch;
    LabelRecord &       label = report.labels[i];
    const std::string   labelText = LabelText(label.label, label.name);
    const PrunedRecord  done = label.pruned.front();
    std::vector<double> thresholds;
    for (const Lambda & lambda : options.lambdas)
    {
      thresholds.push_back(
        LambdaInMillimetres(lambda, report.parameters.weights, report.input.geometry.spacing, label.box));
      if (thresholds.back() < done.lambdaMm)
      {
        throw InputError(options.core.string() + ": is pruned at " + doneText + " already; for " + lambda.text +
                         " give a file made with a smaller --lambda, best 0");
      }
    }
    const double share = 0.1 + 0.8 * static_cast<double>(i) / static_cast<double>(model.parts.size());
    auto         pruned = PruneAndCertify(std::move(model.parts[i]),
                                  done.complex,
                                  done.lambdaMm,
                                  options.lambdas,
                                  thresholds,
                                  label.shape,
                                  labelText,
                                  PartOfProgress(context.progress, "prune", share, share));
    label.pruned.clear();
    for (std::size_t k = 0; k < pruned.size(); ++k)
    {
      pruned[k].record.output = FileOutputPath(options.output, options.lambdas, k).string();
      label.pruned.push_back(std::move(pruned[k].record));
      models[k].parts.push_back(std::move(pruned[k].part));
    }
    label.seconds = labelWatch.Lap();
  }
  report.seconds.prune = watch.Lap();

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
    WriteStagedModel(transaction,
                     FileOutputPath(options.output, options.lambdas, k),
                     models[k],
                     options.model,
                     result.notes);
    models[k] = MedialModel();
  }
  report.seconds.write = watch.Lap();
  report.seconds.total = total.Lap();
  report.peakMemoryMb = PeakMemoryMb();
  if (options.report)
  {
    WriteTextFile(transaction.Stage(*options.report), ReportJson(report));
  }
  ReportProgress(context.progress, "done", 1);
  transaction.Commit();
  return result;
}

} // namespace voxelcore
