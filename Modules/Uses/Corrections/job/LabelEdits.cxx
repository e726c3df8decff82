#include "voxelcore/Corrections/LabelEdits.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParseReal.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Masks/VoxelChanges.h"
#include "voxelcore/Models/TableColumns.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

/** A coordinate as a table has it, so that it is the same when it is read from there. */
double
AsInTables(double value)
{
  return ParseReal(ShortText(value, tableDigits)).value_or(value);
}

constexpr std::size_t kMostEdits = 10000; // that a person has made

} // namespace

std::vector<Said>
SaidIn(std::vector<Annotation> annotations, const fs::path & source)
{
  std::vector<Said> all;
  for (Annotation & one : annotations)
  {
    Said said{ std::move(one), {} };
    try
    {
      said.edit = ParseTreeEdit(said.annotation.edit);
    }
    catch (const UsageError & error)
    {
      RefuseAnnotation(source, said.annotation, Printable(error.what(), 200));
    }
    if (said.edit.kind == TreeEdit::Kind::None && said.annotation.name.empty())
    {
      continue;
    }
    if (!said.annotation.place)
    {
      RefuseAnnotation(source, said.annotation, "has no place; give x, y and z");
    }
    if (all.size() == kMostEdits)
    {
      RefuseAnnotation(source,
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

std::vector<Said>
ReadEdits(const fs::path & path)
{
  const std::string kinds[]{ "branch", "junction" };
  return SaidIn(ReadAnnotations(path, kinds), path);
}

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

EditedTree
EditBody(EditedLabel &             label,
         const ImageGeometry &     geometry,
         const MeasuredSkeleton &  tree,
         std::span<const TreeEdit> edits,
         CoreOptions &             options)
{
  EditedTree edited = EditTree(label.label.shape, geometry, tree, edits);
  if (edited.root)
  {
    options.skeleton->branches.root = { RootChoice::Kind::Point, *edited.root };
  }
  if (options.skeleton->branches.cutLoops)
  {
    options.skeleton->branches.realLoops = edited.loops;
  }
  VoxelChanges changes = ChangesBetween(label.label.shape, edited.shape);
  if (!changes.empty())
  {
    const ChangedShape changed = ChangeVoxels(label.label.shape, changes);
    label.edits = label.edits.value_or(EditRecord());
    auto & record = label.edits->changed;
    record = record.value_or(EditRecord::Filtered());
    record->voxelsAdded += changed.voxelsAdded;
    record->voxelsRemoved += changed.voxelsRemoved;
    // Who reads the scan by what is recorded gets the same body.
    if (options.edits.change)
    {
      changes.insert(changes.begin(), options.edits.change->begin(), options.edits.change->end());
    }
    options.edits.change = std::move(changes);
    label.label.shape = edited.shape;
    label.label.voxels = label.label.shape.CountVoxels();
  }
  return edited;
}

void
NameBranches(const std::vector<Said> &          said,
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

} // namespace voxelcore
