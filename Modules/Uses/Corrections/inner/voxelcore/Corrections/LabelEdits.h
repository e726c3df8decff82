#pragma once
// What a person says of a label's tree, read, and done to its body before the skeleton is made.

#include "voxelcore/Corrections/TreeEdits.h"
#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Report/Annotations.h"

#include <filesystem>
#include <vector>

namespace voxelcore
{

/** What a person says of one place. */
struct Said
{
  Annotation  annotation;
  TreeEdit    edit;
  std::size_t row = 0; ///< of RowsOf()
};

/** Of those annotations that say anything. \throws InputError, naming `source` and the place in it */
std::vector<Said>
SaidIn(std::vector<Annotation> annotations, const std::filesystem::path & source);

/** Of a table or a point list: ReadAnnotations(). */
std::vector<Said>
ReadEdits(const std::filesystem::path & path);

/** Rows of the branches and junctions, and behind them of what was said elsewhere. What was said with the place of a
 *  row, as that stands in a file, is the row's. Puts what was said in the order of rows, so that who reads these does
 *  the same in the same order. */
std::vector<AnnotationRow>
RowsOf(const SkeletonGraph & graph, std::vector<Said> & said);

/** Edits a label's body by its tree. `options`, by which its skeleton is made then, get the root, the real loops, and
 *  as changed voxels all that makes the body again. */
EditedTree
EditBody(EditedLabel &             label,
         const ImageGeometry &     geometry,
         const MeasuredSkeleton &  tree,
         std::span<const TreeEdit> edits,
         CoreOptions &             options);

/** Gives the branches of the edited tree their names; one that no branch gets is a misfit. */
void
NameBranches(const std::vector<Said> &          said,
             const std::vector<AnnotationRow> & rows,
             const ImageGeometry &              geometry,
             SkeletonPart &                     tree,
             EditedTree &                       edited);

} // namespace voxelcore
