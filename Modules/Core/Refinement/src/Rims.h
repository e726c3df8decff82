#pragma once
// Where sheets have rims.

#include "voxelcore/Complex/CellComplex.h"
#include "voxelcore/Lattice/Vectors.h"

#include <vector>

namespace voxelcore
{

/** Vertices by sheets so wide that some rings of triangles can be taken off all around, one flag (0 or 1) each. Strips
 *  that are left beside the axis of a tube have no rim: measures there are noise. */
std::vector<std::uint8_t>
OnWideSheets(const CellComplex & cells, const std::vector<Cofaces> & facesAtEdges);

/** Vertices that have edges and no faces, one flag (0 or 1) each. */
std::vector<std::uint8_t>
VerticesOnLines(const CellComplex & cells);

/** The greatest part of a step that leaves a displacement within a voxel; lattice coordinates. */
double
PartWithinAVoxel(const Vector3 & displacement, const Vector3 & step);

} // namespace voxelcore
