#pragma once
// What a person says of the roots that were found, root by root.
//
// Numbers are those of the axes before any edit. All that goes on from another root is put together first, then roots
// are hung elsewhere, then roots are removed with what springs from them. Levels, stems, whorls and the order of axes
// follow anew.

#include "voxelcore/Roots/RootHierarchy.h"

#include <cstdint>
#include <span>
#include <string>

namespace voxelcore
{

struct RootEdit
{
  enum class Kind : std::uint8_t
  {
    None,      ///< it only has a name
    Remove,    ///< it is none, nor is what springs from it
    Parent,    ///< it springs from the root `other`, at that root's nearest point
    Continues, ///< it is how the root `other` goes on from its nearest point; what that was there springs from it
    Stem       ///< it springs from nothing
  };
  ElementIndex root = 0;
  Kind         kind = Kind::None;
  ElementIndex other = kNoRoot;
  std::string  name{}; ///< empty: as it was
};

/** "continues 3", empty for none. */
std::string
RootEditText(const RootEdit & edit);

/** The same read back into `kind` and `other`. \throws UsageError */
RootEdit
ParseRootEdit(const std::string & text);

struct EditedRoots
{
  RootHierarchy             roots;
  std::vector<ElementIndex> now; ///< per axis as it was the axis that it, or its first part, is now; kNoRoot: removed
};

/** A stem or a loose piece that is hung to another root, or goes on from one, begins at its nearer end, and a straight
 *  line joins it. \throws UsageError for a root that is not there, one with two edits, or one that would spring from
 *  itself */
EditedRoots
EditRoots(const SkeletonGraph &     graph,
          const RootHierarchy &     roots,
          std::span<const RootEdit> edits,
          const RootRules &         rules = {});

} // namespace voxelcore
