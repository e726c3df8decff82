#pragma once
// The polygons of a core as triangles.

#include "voxelcore/MedialComplex.h"

namespace voxelcore
{

/** The same complex with each face cut into triangles from one of its corners, the one that makes the best of them; its
 *  diagonals and triangles have its measure. Canonical order. */
MedialComplex
CutIntoTriangles(const MedialComplex & core, const std::array<double, 3> & spacing);

} // namespace voxelcore
