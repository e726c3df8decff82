#include "voxelcore/Corrections/CorrectionsJob.h"
#include "voxelcore/Corrections/LabelEdits.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Jobs/CoreJobSteps.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/LabelVolumes.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Jobs/SkeletonFiles.h"
#include "voxelcore/Models/TableColumns.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

constexpr auto kColumns = std::to_array<Column>({
  { "branch", "", "number of the branch before edits" },
  { "junction", "", "number of the junction before edits" },
  { "x", "mm", "its place, LPS: of a branch in its middle" },
  { "y", "mm", "" },
  { "z", "mm", "" },
  { "edit", "", "what you fill in" },
  { "name", "", "what you call it" },
});

fs::path
Beside(const fs::path & output, const char * ending)
{
  return (output.parent_path() / output.stem()).string() + ending;
}

bool
IsOfAnother(const Said & said, std::int64_t label)
{
  return said.annotation.label.value_or(label) != label;
}

/** One line for each edit that was left out. */
void
TellMisfits(const fs::path & path, const std::vector<Said> & said, const EditedTree & edited, SkeletonResult & result)
{
  std::size_t done = 0;
  for (std::size_t i = 0; i < said.size(); ++i)
  {
    const auto & [where, number, place, edit, name, label] = said[i].annotation;
    if (edited.outcomes[i].misfit.empty())
    {
      ++done;
      continue;
    }
    result.warnings.push_back(path.string() + ": " + where + ": '" + Printable(edit.empty() ? name : edit) +
                              "' is left out: " + edited.outcomes[i].misfit);
  }
  result.notes.push_back(std::to_string(done) + " of " + std::to_string(said.size()) + " edits done as " +
                         path.string() + " says");
}

} // namespace

SkeletonResult
RunCorrectionsJob(const CorrectionsOptions & asked, const JobContext & given)
{
  CorrectionsOptions      options = asked;
  const JobContext        context = ForwardOnly(given);
  const SkeletonOptions & making = options.making;
  if (IsFinishedCore(making.input, making.reading, making.resolution))
  {
    throw UsageError("--edits, --annotations: need a scan, but " + making.input.string() +
                     " is a medial surface; give the scan");
  }
  OutputTransaction transaction(making.force, context.temporaries);
  NameInFolder(options.making, transaction);
  if (making.output.extension() != ".vtp")
  {
    throw UsageError(making.output.string() + ": with --edits or --annotations a skeleton is written as .vtp");
  }
  CoreOptions    core = CoreOptionsOf(making);
  const fs::path table = Beside(making.output, "_annotations.csv");
  const fs::path markups = Beside(making.output, "_annotations.mrk.json");
  CheckCoreTargets(core, transaction);
  {
    const SkeletonFiles files(making.output, making.input, making.targets, transaction);
    CheckTargets(transaction, { making.output, table, markups, ColumnsBeside(table) });
  }
  std::vector<Said> said = options.edits ? ReadEdits(*options.edits) : std::vector<Said>();

  StagePlan      plan(context.progress, { 0.1, 0.4, 0.1, 0.4 });
  SkeletonResult result;
  ScanAtHand     scan;
  scan.volume = ReadScanOrMesh(making.input, making.reading, making.resolution, plan.Next("reading"));
  scan.edited = EditLabels(std::move(scan.volume.labels),
                           scan.volume.geometry,
                           making.edits,
                           making.reading.labels != "all",
                           making.input.string());
  if (scan.edited.labels.size() != 1)
  {
    throw UsageError(making.input.string() + ": " + std::to_string(scan.edited.labels.size()) +
                     " labels; choose one with --labels, or take all as one with --binary");
  }
  EditedLabel & label = scan.edited.labels.front();
  const auto    others = std::erase_if(said, [&](const Said & one) { return IsOfAnother(one, label.label.value); });
  const ImageGeometry & geometry = scan.volume.geometry;
  CertifiedRequest      request = RequestOf(core, MakeSurfaceSource(core.refine, core.scan, core.reading, scan.volume));
  RequireLengthsOf(making.input, geometry.unit, request);
  request.scan = BorderOf(scan.volume);
  // Where nothing is edited or cut, the tree that is written is the one whose places are named.
  const bool                  isOne = said.empty() && !request.skeleton->branches.cutLoops;
  std::optional<LabelOutcome> found;
  std::vector<AnnotationRow>  rows;
  if (const auto progress = plan.Next(); !isOne)
  {
    request.skeleton->branches.cutLoops = false; // edits name places on them, too
    found = ProcessLabel(label, geometry, request, progress);
    rows = RowsOf(found->skeleton->graph, said);
  }
  const VoxelShape      before = isOne ? VoxelShape() : label.label.shape;
  std::vector<TreeEdit> edits;
  std::transform(said.begin(), said.end(), std::back_inserter(edits), [](const Said & one) { return one.edit; });
  (void)plan.Next("editing");
  EditedTree edited = isOne ? EditedTree() : EditBody(label, geometry, *found->skeleton, edits, core);
  JobContext part = context;
  part.progress = plan.Next();
  scan.done = [&](LabelOutcome & outcome) {
    if (isOne)
    {
      rows = RowsOf(outcome.skeleton->graph, said);
      return;
    }
    RequireEdits(before,
                 found->record.shape,
                 edits,
                 edited,
                 outcome.record.skeleton->topology,
                 LabelText(outcome.record.label, outcome.record.name));
    NameBranches(said, rows, geometry, *outcome.skeleton, edited);
  };
  CoreResult made = StageCoreJob(core, transaction, part, false, {}, &scan);
  result.report = std::move(made.report);
  result.warnings = std::move(made.warnings);
  result.notes = std::move(made.notes);
  if (others > 0)
  {
    result.notes.push_back(others == 1 ? "1 edit of another label is passed over"
                                       : std::to_string(others) + " edits of other labels are passed over");
  }
  if (options.edits)
  {
    TellMisfits(*options.edits, said, edited, result);
  }
  const SpatialUnit unit = result.report.input.geometry.unit;
  WriteAnnotations(transaction.Stage(table),
                   transaction.Stage(markups),
                   HeadLine(kColumns, context.Heads(unit)),
                   rows,
                   unit);
  WriteTextFile(transaction.Stage(ColumnsBeside(table)),
                TablesJson({ { "annotations", ColumnsJson(kColumns, unit) } }));
  Finish(transaction, context);
  return result;
}

} // namespace voxelcore
