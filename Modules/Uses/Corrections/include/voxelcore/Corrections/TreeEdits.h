#pragma once
// What a person says of a tree, place by place, done to the body that the tree is of.
//
// The mask that an edited tree stands for is that body with the voxels of each edit put in or taken out. Its skeleton
// is made and certified as any other, so the edited tree has its topology.
//
// Edits name places and no numbers, so they hold for another threshold or version as long as the tree passes there. All
// places are looked up in the tree as it was before any edit.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Lattice/TopologyNumbers.h"
#include "voxelcore/Shape/VoxelShape.h"
#include "voxelcore/Skeleton/MeasuredSkeleton.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace voxelcore
{

struct TreeEdit
{
  enum class Kind : std::uint8_t
  {
    None,      ///< the branch here only has a name
    Cut,       ///< the body ends here, across the branch
    Remove,    ///< the branch here is none, nor is what springs from it
    Join,      ///< the tip here goes on, straight, to that at the other place
    Path,      ///< a branch runs from the branch here straight through these places
    Root,      ///< the hierarchy begins at the tip here
    Loop,      ///< the loop here is real: CutLoops leaves it
    Background ///< the voxel here is none of the body
  };
  Kind                 kind = Kind::None;
  Vector3              place{};    ///< LPS
  std::vector<Vector3> further{};  ///< LPS; of Join one, of Path one or more
  double               radius = 0; ///< of Path; 0: that of the branch which it leaves
};

/** "join 12.5 3 40", "path 1 2 3; 4 5 6 radius 0.5", "cut"; empty for none. */
std::string
TreeEditText(const TreeEdit & edit);

/** The same read back into all but the place. \throws UsageError */
TreeEdit
ParseTreeEdit(const std::string & text);

/** What became of an edit. */
struct TreeEditOutcome
{
  std::string                              misfit;   ///< why it was left out; empty: it was done
  std::vector<std::array<std::int32_t, 3>> voxels;   ///< put in by Join and Path, taken out by others; each once
  std::array<std::int64_t, 3>              change{}; ///< made to pieces, loops and cavities
};

struct EditedTree
{
  VoxelShape                   shape;
  std::optional<Vector3>       root;     ///< the place of a tip, where an edit says so
  std::vector<Vector3>         loops;    ///< places on loops that are real
  std::vector<TreeEditOutcome> outcomes; ///< one an edit
  std::vector<std::size_t>     order;    ///< in which they were done
};

/** Does the edits that fit, one after the other; those left out change nothing. First come names, root and loops, then
 *  voxels, cuts, removals from the tips on inwards, joins, paths, of one kind in the order given: so none depends on
 *  where it stands among others. `tree` is that of the shape, its loops not cut. A place on a branch is one of
 *  BranchMeant(), one at a tip lies within twice its radius, or within three voxel diagonals if that is more.
 *
 *  - Cut: takes out the voxels of a slab across the branch, so thick that no two touch across it, which hang together
 *    with the place, out to twice the radius or, where that does not part the body, four or 1.4 times; where none of
 *    them does, of a slab a little before or behind, within the radius or one and a half voxel diagonals; and what is
 *    then loose and no larger.
 *  - Remove: cuts at the base, from the ball at the junction on, as soon as that parts and tears nothing else, and
 *    takes out all behind.
 *  - Join: where no tip and no branch is at a place any more, as its end has receded, the line runs on from there to
 *    the nearest point of the tree, by at most the length of the gap.
 *  - Join, Path: put in the voxels within the radius of their lines; where that does not fit up to a voxel's diagonal
 *    more, which closes holes beside rough walls, or less, which keeps off other branches.
 *  - Background: takes out the voxel.
 *
 *  Each is left out unless it changes the topology numbers (ComputeShapeTopology) as IsChangeOf() says. */
EditedTree
EditTree(const VoxelShape &        shape,
         const ImageGeometry &     geometry,
         const MeasuredSkeleton &  tree,
         std::span<const TreeEdit> edits);

/** A cut parts a piece or opens a loop; a removal takes no piece away but its own, and makes no loop or cavity; a join
 *  joins two pieces or closes a loop; a path does that or ends free; a voxel that is taken out makes no cavity; others
 *  change nothing. */
bool
IsChangeOf(TreeEdit::Kind kind, const std::array<std::int64_t, 3> & change);

/** By code of its own: the outcomes make of `before`, voxel by voxel, the edited shape, each with a change of its kind;
 *  and `certified`, counted in the skeleton of the edited shape, is `counted`, of the shape before, with all of these.
 *  \throws CertificateError that begins with `name` */
void
RequireEdits(const VoxelShape &        before,
             const TopologyNumbers &   counted,
             std::span<const TreeEdit> edits,
             const EditedTree &        edited,
             const TopologyNumbers &   certified,
             const std::string &       name);

/** The branch that a place means: BranchAt(), by one and a half voxel diagonals at least: so far do thin branches move
 *  when a threshold does. */
std::optional<BranchPoint>
BranchMeant(const SkeletonGraph & graph, const ImageGeometry & geometry, const Vector3 & place);

/** Where an annotation of a branch is put: in the middle of its points. */
Vector3
PlaceOfBranch(const SkeletonGraph & graph, std::size_t branch);

} // namespace voxelcore
