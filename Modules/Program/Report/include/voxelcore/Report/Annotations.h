#pragma once
// What a person says of things with a place, such as roots or branches: a table beside the results and a point list of
// 3D Slicer, written, edited by hand, and read back.

#include "voxelcore/Base/SpatialUnit.h"
#include "voxelcore/Complex/CellComplex.h"
#include "voxelcore/Lattice/Vectors.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace voxelcore
{

struct Annotation
{
  std::string                 where;  ///< "line 4" or "point 4" of its file
  std::optional<ElementIndex> number; ///< of the thing, in its file
  std::optional<Vector3>      place;  ///< LPS
  std::string                 edit;   ///< as given
  std::string                 name;
  std::optional<std::int64_t> label; ///< of which alone it is said; only tables have it
};

/** Of a .csv (columns `kinds[0]`, which has the number, x, y, z, edit, name, label; others are passed over) or of a
 *  point list of Slicer (.mrk.json: label "root 4" or "root 4: its name" for a kind "root", the edit as description).
 *  \throws InputError, naming the file and the place in it */
std::vector<Annotation>
ReadAnnotations(const std::filesystem::path & path, std::span<const std::string> kinds);

/** \throws InputError that begins with the file and the place in it */
[[noreturn]] void
RefuseAnnotation(const std::filesystem::path & path, const Annotation & annotation, const std::string & why);

/** A row of the table, and a point of the list. */
struct AnnotationRow
{
  std::string kind;    ///< the label is "root 4: its name"
  std::string number;  ///< empty: none, and the label is the name
  std::string columns; ///< of the table before x, without a comma at the end
  Vector3     place{};
  std::string edit;
  std::string name;
};

/** `head` is the table's first line. \throws OutputError */
void
WriteAnnotations(const std::filesystem::path &      csv,
                 const std::filesystem::path &      markups,
                 const std::string &                head,
                 const std::vector<AnnotationRow> & rows,
                 SpatialUnit                        unit);

} // namespace voxelcore
