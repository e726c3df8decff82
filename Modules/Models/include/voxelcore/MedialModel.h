#pragma once
// Medial surfaces as files: .vtp .vtk .ply .obj .stl .ma

#include "voxelcore/ImageGeometry.h"
#include "voxelcore/MedialComplex.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace voxelcore
{

/** The core of one label as it stands in a file: positions in LPS mm, polygons oriented for LPS. */
struct ModelPart
{
  std::int64_t  label = 0;
  MedialComplex core; ///< positions here are LPS mm; radii and measures mm as ever
};

/** A file's content. */
struct MedialModel
{
  std::vector<ModelPart> parts;           ///< by label
  std::string            provenance;      ///< JSON text of the field array Provenance; may be empty
  bool                   hasEdges = true; ///< reading: the measures of edges on faces were stored (--keep-edges)
};

/** How to write. */
struct ModelOptions
{
  bool triangles = false; ///< polygons as triangles
  bool keepEdges = false; ///< store the measures of edges that lie on faces (EdgeVertices, EdgeLambda)
};

/** What a format could not hold. */
struct ModelOmissions
{
  std::uint64_t vertices = 0; ///< isolated vertices left out
  std::uint64_t edges = 0;    ///< edges on no face left out
  std::uint64_t labels = 0;   ///< labels merged into one
};

/** Moves a core from lattice coordinates to LPS mm; reverses polygons when the geometry is left-handed, so that their
 *  normals still point from the smaller to the greater of their boundary vertices. */
ModelPart
ToPhysical(MedialComplex core, const ImageGeometry & geometry, std::int64_t label);

/** Whether `path` ends in an extension WriteModel knows. */
bool
IsModelPath(const std::filesystem::path & path);

/** Writes `model` to the file `path` in the format of `formatOf`'s extension (so that a temporary name can be given).
 *  \throws OutputError with one line when it cannot be written completely; a broken file is removed.
 *  \throws UsageError for an unknown extension. */
ModelOmissions
WriteModel(const std::filesystem::path & path,
           const std::filesystem::path & formatOf,
           const MedialModel &           model,
           const ModelOptions &          options = {});

/** Reads a .vtp that WriteModel wrote (polygons, not triangles), with every bit as it was written.
 *  \throws InputError when it is missing, damaged, or was not written by VoxelCore. */
MedialModel
ReadModel(const std::filesystem::path & path);

} // namespace voxelcore
