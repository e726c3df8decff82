#pragma once
// The polygons of a complex as triangles.

#include "voxelcore/Complex/CellComplex.h"
#include "voxelcore/Lattice/ImageGeometry.h"

#include <vector>

namespace voxelcore
{

/** A complex of triangles, in canonical order. */
struct TriangleComplex
{
  CellComplex               cells;
  std::vector<ElementIndex> polygons; ///< of each triangle the polygon it was cut from
};

/** The same complex with each face cut into triangles from one of its corners, the one that makes the best of them in
 *  places (lattice coordinates times `spacing`). */
TriangleComplex
CutIntoTriangles(const CellComplex & cells, const std::vector<Vector3> & positions, const Vector3 & spacing);

} // namespace voxelcore
