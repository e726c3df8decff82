#include "LabelFiles.h"

#include "voxelcore/Base/Error.h"
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
  SkeletonFiles            files(path, "the array", targets, transaction);
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
