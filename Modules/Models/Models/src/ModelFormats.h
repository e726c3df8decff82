#pragma once
// The writers behind WriteModel, one per format. All throw OutputError when a file cannot be written completely and
// leave none behind then. Points of a file are those of the parts one after another.

#include "voxelcore/Models/MedialModel.h"

namespace voxelcore
{

/** XML polydata as VTK's writer makes it, appended data in zlib's streams; all that a model holds. */
void
WriteVtp(const std::filesystem::path & path, const MedialModel & model, bool keepEdges);

/** Legacy polydata, version 4.2, binary, as Slicer writes it (5.1 is new to many tools); the same content as .vtp. */
void
WriteVtk(const std::filesystem::path & path, const MedialModel & model, bool keepEdges);

/** Binary PLY in double precision: vertices (radius, lambda, label), faces and edges on no face (lambda, label). */
ModelOmissions
WritePly(const std::filesystem::path & path, const MedialModel & model);

/** Text: v, and per label a group with p (isolated vertices), l (edges on no face) and f. */
ModelOmissions
WriteObj(const std::filesystem::path & path, const MedialModel & model);

/** Binary STL of the triangles of `model`, single precision: the format has no other. Faces must be triangles. */
ModelOmissions
WriteStl(const std::filesystem::path & path, const MedialModel & model);

/** Text: `nv ne nf`, v x y z r, e i j, f i j k, from 0; all edges. Faces must be triangles. */
ModelOmissions
WriteMa(const std::filesystem::path & path, const MedialModel & model);

} // namespace voxelcore
