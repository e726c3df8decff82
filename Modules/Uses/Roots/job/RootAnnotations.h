#pragma once
// Notes of a person on each root: written beside the tables, edited in a text editor, a spreadsheet or 3D Slicer, and
// read back. A root is known by its tip, so that a file holds for other options, too, as long as the root is found.

#include "voxelcore/Models/TableColumns.h"
#include "voxelcore/Roots/RootEdits.h"
#include "voxelcore/Shape/BodyFrame.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

struct RootAnnotation
{
  std::string                 where;  ///< "line 4" or "point 4" of its file
  std::optional<ElementIndex> number; ///< of the root, in its file
  std::optional<Vector3>      tip;    ///< LPS
  RootEdit                    edit;   ///< `other` is a number of its file
};

/** Of annotations.csv (columns root, x, y, z, edit, name; others are passed over) or of a point list of Slicer
 *  (.mrk.json: label "root 4" or "root 4: its name", the edit as description). \throws InputError */
std::vector<RootAnnotation>
ReadRootAnnotations(const std::filesystem::path & path);

/** What they say of these roots: each is the one whose tip is nearest, and no farther than its diameter there; without
 *  a place, the one with its number. Those that are not there are told in `misfits`, a line each. \throws InputError
 *  for a number that stands twice, naming the place in `path` */
std::vector<RootEdit>
EditsOf(const std::vector<RootAnnotation> & annotations,
        const std::filesystem::path &       path,
        const SkeletonGraph &               graph,
        const RootHierarchy &               roots,
        std::vector<std::string> &          misfits);

/** Roots as they were found, what was said of them, and what became of them. */
class RootEditing
{
public:
  /** `path` may be empty: nothing was said. \throws InputError */
  RootEditing(const std::filesystem::path & path, const RootRules & rules);

  /** Of a graph in a frame of the scan that annotations are of. \throws InputError */
  const RootHierarchy &
  operator()(const SkeletonGraph & graph, const RootHierarchy & roots, const BodyFrame & frame);

  RootHierarchy            found;
  std::vector<RootEdit>    edits;
  EditedRoots              edited;
  std::vector<std::string> misfits; ///< what was left out, a line each

private:
  std::filesystem::path       m_Path;
  RootRules                   m_Rules;
  std::vector<RootAnnotation> m_Annotations;
};

inline constexpr auto kAnnotationColumns = std::to_array<Column>({
  { "root", "", "number of the root in the run that wrote the file" },
  { "now", "", "its number in this run" },
  { "x", "mm", "its tip, LPS" },
  { "y", "mm", "" },
  { "z", "mm", "" },
  { "edit", "", "what you fill in" },
  { "name", "", "given to the root by --edits" },
});

/** A row per root as it was found, with what was said of it and its number now. \throws OutputError */
void
WriteRootAnnotations(const std::filesystem::path & csv,
                     const std::filesystem::path & markups,
                     const SkeletonGraph &         graph,
                     const RootEditing &           editing,
                     SpatialUnit                   unit,
                     HeadUnits                     units);

/** The edits as a JSON array. */
std::string
RootEditsJson(const std::vector<RootEdit> & edits);

} // namespace voxelcore
