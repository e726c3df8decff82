#pragma once
// Medial surfaces as files: .vtp .vtk .ply .obj .stl .ma

#include "voxelcore/VoxelCore/PlacedCore.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace voxelcore
{

using ModelPart = PlacedCore;

/** Which files are read. */
enum class Precision
{
  Exact,  ///< only those with every digit of every number
  AsSaved ///< also what another program saved with fewer digits; `rounded` says so
};

/** A file's content. */
struct MedialModel
{
  std::vector<ModelPart> parts;      ///< by label, then component, each once
  std::string            provenance; ///< JSON text of the field array Provenance; may be empty
  bool        hasEdges = true;       ///< reading: no edge's measure is missing (--keep-edges, or no edge on a face)
  std::string refined{};    ///< "labels", "grey" or "mesh": the surface its cores are refined to; empty: they are not
  bool        inLps = true; ///< positions are known to be in LPS: files say so (SPACE), and ReadModel takes no other
  SpatialUnit unit = SpatialUnit::Millimetres; ///< of all lengths; files say so (Units)
  std::string rounded{}; ///< reading: what lost digits, such as "its points are in single precision"; empty: nothing
};

/** How to write. */
struct ModelOptions
{
  bool triangles = false; ///< polygons as fans of triangles; a diagonal has the measure of its face
  bool keepEdges = false; ///< store the measures of edges that lie on faces (EdgeVertices, EdgeLambda)
};

/** What a format could not hold. */
struct ModelOmissions
{
  std::uint64_t vertices = 0; ///< isolated vertices left out
  std::uint64_t edges = 0;    ///< edges on no face left out
  std::uint64_t labels = 0;   ///< labels, or components of them, merged into one
};

/** The same core with each polygon cut into the fan of triangles from its first vertex, in the order of the polygons,
 *  as ModelOptions::triangles writes it. A diagonal lies within its face and has the face's two nearest boundary
 *  vertices: so its measure is the face's. */
MedialComplex
Triangulated(const MedialComplex & core);

/** Whether `path` ends in an extension WriteModel knows. */
bool
IsModelPath(const std::filesystem::path & path);

/** Writes `model` to the file `path` in the format of `formatOf`'s extension (so that a temporary name can be given).
 *  .vtp (raw appended data) and .vtk (version 4.2, binary) hold everything; .ply doubles, without Provenance and the
 *  measures of edges on faces; .obj places, cells and labels as groups; .ma the balls, all edges and triangles; .stl
 *  triangles in single precision. Equal models give equal bytes. Components are the cell array `Component` (in .ply a
 *  property, in .obj part of a group's name), which is there only when a label is split.
 *  Tolerances, where every part has them, are the point and cell arrays `Tolerance` of .vtp and .vtk. Edges that
 *  outlast their faces, and vertices that outlast their edges, are cells there too: the cells with Tolerance >= h are
 *  then what is left at height h, for every h from the file's own.
 *  Local thickness, where every part has it, is the point array `Thickness` (.vtp and .vtk);
 *  what labels leave open of radii, of cores refined from them, `RadiusMargin`.
 *  Refined cores have their displacements as the point array `Displacement`, and the surface as the field string
 *  `Refined` (.vtp and .vtk).
 *  \throws OutputError with one line when it cannot be written completely; a broken file is removed.
 *  \throws UsageError for an unknown extension, or when edges are to be kept whose measures are not known.
 *  \throws Error when parts are not sorted by label and component or not in canonical order. */
ModelOmissions
WriteModel(const std::filesystem::path & path,
           const std::filesystem::path & formatOf,
           const MedialModel &           model,
           const ModelOptions &          options = {});

/** The library that writes models, as it is loaded: "VTK 9.1.0", or "no VTK". */
std::string
ModelLibrary();

/** Reads a .vtp or .vtk that WriteModel wrote, or another program saved again (VTK, ParaView, 3D Slicer: in text,
 *  base64 or raw, of either byte order, compressed, with further arrays). Of WriteModel's own .vtp every bit is as it
 *  was written, and writing it again gives the same bytes. Edges come back in canonical order; without hasEdges the
 *  measures of those on faces that are no lines are NaN. A part without vertices leaves no trace in a file. Written
 *  with `triangles`, the triangles are the faces. \throws InputError when it is missing or damaged, or lacks what
 *  WriteModel writes, which is named. */
MedialModel
ReadModel(const std::filesystem::path & path, Precision precision = Precision::Exact);

/** Whether two models, or two parts, are the same to the last bit. */
bool
SameBits(const MedialModel & a, const MedialModel & b);
bool
SameBits(const ModelPart & a, const ModelPart & b);

/** \throws InputError unless VTK's own reader opens the file without complaint and finds in it `model`, which ReadModel
 *  found. False where VoxelCore was built without VTK, or another program saved the file, and nothing was read. */
[[nodiscard]] bool
RequireVtkReads(const std::filesystem::path & path, const MedialModel & model);

} // namespace voxelcore
