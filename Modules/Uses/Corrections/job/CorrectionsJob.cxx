#include "voxelcore/Corrections/CorrectionsJob.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParseReal.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Jobs/CoreJobSteps.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/LabelVolumes.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Jobs/SkeletonFiles.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Masks/VoxelChanges.h"
#include "voxelcore/Models/TableColumns.h"
#include "voxelcore/Report/Annotations.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
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

/** A coordinate as a table has it, so that it is the same when it is read from there. */
double
AsInTables(double value)
{
  return ParseReal(ShortText(value, tableDigits)).value_or(value);
}

constexpr std::size_t kMostEdits = 10000; // that a person has made

/** What a person says. */
struct Said
{
  Annotation  annotation;
  TreeEdit    edit;
  std::size_t row = 0;
};

std::vector<Said>
ReadEdits(const fs::path & path)
{
  const std::string kinds[]{ "branch", "junction" };
  std::vector<Said> all;
  for (Annotation & one : ReadAnnotations(path, kinds))
  {
    Said said{ std::move(one), {} };
    try
    {
      said.edit = ParseTreeEdit(said.annotation.edit);
    }
    catch (const UsageError & error)
    {
      RefuseAnnotation(path, said.annotation, Printable(error.what(), 200));
    }
    if (said.edit.kind == TreeEdit::Kind::None && said.annotation.name.empty())
    {
      continue;
    }
    if (!said.annotation.place)
    {
      RefuseAnnotation(path, said.annotation, "has no place; give x, y and z");
    }
    if (all.size() == kMostEdits)
    {
      RefuseAnnotation(path,
                       said.annotation,
                       "there are more than " + std::to_string(kMostEdits) + " edits; give fewer");
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      said.edit.place[k] = AsInTables((*said.annotation.place)[k]);
    }
    all.push_back(std::move(said));
  }
  return all;
}

fs::path
Beside(const fs::path & output, const char * ending)
{
  return (output.parent_path() / output.stem()).string() + ending;
}

/** Rows of the branches and junctions, and behind them of what was said elsewhere. What was said with the place of a
 *  row, as that stands in a file, is the row's. Puts what was said in the order of rows, so that who reads these does
 *  the same in the same order. */
std::vector<AnnotationRow>
RowsOf(const SkeletonGraph & graph, std::vector<Said> & said)
{
  std::vector<AnnotationRow> rows;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const std::string number = std::to_string(branch);
    rows.push_back({ "branch", number, number + ",", PlaceOfBranch(graph, branch), {}, {} });
  }
  for (std::size_t node = 0; node < graph.nodePoints.size(); ++node)
  {
    if (graph.nodeKinds[node] == NodeKind::Junction)
    {
      const std::string number = std::to_string(node);
      rows.push_back({ "junction", number, "," + number, graph.positions[graph.nodePoints[node]], {}, {} });
    }
  }
  std::map<Vector3, std::size_t> rowAt;
  for (std::size_t row = 0; row < rows.size(); ++row)
  {
    Vector3 & place = rows[row].place;
    std::transform(place.begin(), place.end(), place.begin(), AsInTables);
    rowAt.try_emplace(place, row);
  }
  for (Said & one : said)
  {
    const auto at = rowAt.find(one.edit.place);
    one.row = at == rowAt.end() ? rows.size() : at->second;
    if (at == rowAt.end())
    {
      rows.push_back({ {}, {}, ",", one.edit.place, {}, {} });
    }
    else
    {
      rowAt.erase(at);
    }
    rows[one.row].edit = TreeEditText(one.edit);
    rows[one.row].name = one.annotation.name;
  }
  ranges::stable_sort(said, {}, &Said::row);
  return rows;
}

/** Gives the branches of the edited tree their names. */
void
Name(const std::vector<Said> &          said,
     const std::vector<AnnotationRow> & rows,
     const ImageGeometry &              geometry,
     SkeletonPart &                     tree,
     EditedTree &                       edited)
{
  for (std::size_t i = 0; i < said.size(); ++i)
  {
    const std::string & name = said[i].annotation.name;
    if (name.empty() || rows[said[i].row].kind == "junction")
    {
      continue;
    }
    tree.names.resize(tree.graph.BranchCount());
    std::string & misfit = edited.outcomes[i].misfit;
    if (const auto branch = BranchMeant(tree.graph, geometry, said[i].edit.place))
    {
      tree.names[branch->branch] = name;
    }
    else if (misfit.empty() && said[i].edit.kind == TreeEdit::Kind::None)
    {
      misfit = "no branch passes there any more";
    }
  }
}

/** One line for each edit that was left out. */
void
TellMisfits(const fs::path & path, const std::vector<Said> & said, const EditedTree & edited, SkeletonResult & result)
{
  std::size_t done = 0;
  for (std::size_t i = 0; i < said.size(); ++i)
  {
    const auto & [where, number, place, edit, name] = said[i].annotation;
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
RunCorrectionsJob(const CorrectionsOptions & options, const JobContext & given)
{
  const JobContext        context = ForwardOnly(given);
  const SkeletonOptions & making = options.making;
  if (IsFinishedCore(making.input, making.reading, making.resolution))
  {
    throw UsageError("--edits, --annotations: need a scan, but " + making.input.string() +
                     " is a medial surface; give the scan");
  }
  if (making.output.extension() != ".vtp")
  {
    throw UsageError(making.output.string() + ": with --edits or --annotations a skeleton is written as .vtp");
  }
  OutputTransaction transaction(making.force, context.temporaries);
  CoreOptions       core = CoreOptionsOf(making);
  const fs::path    table = Beside(making.output, "_annotations.csv");
  const fs::path    markups = Beside(making.output, "_annotations.mrk.json");
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
  EditedLabel &         label = scan.edited.labels.front();
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
  EditedTree edited = isOne ? EditedTree() : EditTree(before, geometry, *found->skeleton, edits);
  if (edited.root)
  {
    core.skeleton->branches.root = { RootChoice::Kind::Point, *edited.root };
  }
  if (core.skeleton->branches.cutLoops)
  {
    core.skeleton->branches.realLoops = edited.loops;
  }
  VoxelChanges changes = ChangesBetween(before, edited.shape);
  if (!changes.empty())
  {
    const ChangedShape changed = ChangeVoxels(before, changes);
    label.edits = label.edits.value_or(EditRecord());
    auto & record = label.edits->changed;
    record = record.value_or(EditRecord::Filtered());
    record->voxelsAdded += changed.voxelsAdded;
    record->voxelsRemoved += changed.voxelsRemoved;
    // Who reads the scan by what is recorded gets the same body.
    if (core.edits.change)
    {
      changes.insert(changes.begin(), core.edits.change->begin(), core.edits.change->end());
    }
    core.edits.change = std::move(changes);
    label.label.shape = edited.shape;
    label.label.voxels = label.label.shape.CountVoxels();
  }
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
    Name(said, rows, geometry, *outcome.skeleton, edited);
  };
  CoreResult made = StageCoreJob(core, transaction, part, false, {}, &scan);
  result.report = std::move(made.report);
  result.warnings = std::move(made.warnings);
  result.notes = std::move(made.notes);
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
