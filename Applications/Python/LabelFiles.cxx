#include "LabelFiles.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Jobs/OutputTransaction.h"
#include "voxelcore/Jobs/SkeletonFiles.h"
#include "voxelcore/Jobs/SkeletonTargets.h"
#include "voxelcore/Jobs/StagedModel.h"

#include <utility>

namespace voxelcore
{

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
  MedialModel       model = ModelOf(core);
  CoreReport        report = core.report;
  report.parameters.model = options;
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
  SkeletonTargets   targets;
  targets.network = skeleton.part.network.has_value();
  targets.also = also.empty() ? std::vector<std::string>() : ParseAlso(also);
  if (IsFolderOutput(path))
  {
    throw UsageError(path.string() + ": give a file, .vtp or .csv");
  }
  SkeletonFiles files(path, "the array", targets, transaction);
  if (files.NeedsSurface() && !skeleton.surface)
  {
    throw UsageError("--also ma: a skeleton that was read has no medial surface; make it of the array");
  }
  std::vector<std::string> notes;
  files.Add(report, 0, skeleton.part, files.NeedsSurface() ? skeleton.surface->part : ModelPart(), notes);
  files.Finish(report, notes);
  ReportProgress(progress, "writing", 1);
  transaction.Commit();
}

void
SaveSwc(const SkeletonOfLabel &       skeleton,
        const std::filesystem::path & path,
        bool                          force,
        const ProgressCallback &      progress)
{
  OutputTransaction transaction(force);
  transaction.CheckTarget(path);
  SkeletonModel model;
  model.unit = skeleton.report.input.geometry.unit;
  model.parts = { skeleton.part };
  WriteSwc(transaction.Stage(path), model, { skeleton.report.skeleton->branches.root });
  ReportProgress(progress, "writing", 1);
  transaction.Commit();
}

ResultsRead
ReadResults(const std::filesystem::path & path)
{
  ResultsRead   results;
  auto          found = ReadSkeletonIfAny(path);
  const bool    areSkeletons = found.has_value();
  SkeletonModel skeletons = areSkeletons ? std::move(*found) : SkeletonModel();
  MedialModel   model;
  if (!areSkeletons)
  {
    model = ReadModel(path); // says what is wrong when it is neither
  }
  const CoreReport  report = ParseProvenance(areSkeletons ? skeletons.provenance : model.provenance, path.string());
  const std::size_t count = areSkeletons ? skeletons.parts.size() : model.parts.size();
  RequireFittingProvenance(report.labels.size() == count && report.skeleton.has_value() == areSkeletons, path);
  for (std::size_t i = 0; i < count; ++i)
  {
    CoreReport one = report;
    one.labels = { report.labels[i] };
    const LabelRecord & record = one.labels.front();
    if (!areSkeletons)
    {
      auto core = std::make_shared<CoreOfLabel>();
      core->report = std::move(one);
      core->part = std::move(model.parts[i]);
      core->hasEdges = model.hasEdges;
      core->refined = model.refined;
      results.cores.push_back(std::move(core));
      continue;
    }
    SkeletonPart & part = skeletons.parts[i];
    RequireFittingProvenance(part.label == record.label && part.component == record.component && record.skeleton, path);
    part.name = record.name;
    part.network = record.skeleton->network;
    part.table = MeasureBranches(part.graph, { one.skeleton->branches.root });
    one.labels.front().skeleton->numbers = part.table.numbers;
    auto skeleton = std::make_shared<SkeletonOfLabel>();
    skeleton->part = std::move(part);
    skeleton->report = std::move(one);
    results.skeletons.push_back(std::move(skeleton));
  }
  return results;
}

std::map<std::int64_t, std::string>
NamesOfLabels(const std::filesystem::path & path)
{
  std::map<std::int64_t, std::string> names;
  const ReadOptions                   options;
  const LabelMap                      volume = ReadLabelVolume(path, options);
  for (const LabelShape & label : volume.labels)
  {
    names[label.value] = label.name;
  }
  return names;
}

} // namespace voxelcore
