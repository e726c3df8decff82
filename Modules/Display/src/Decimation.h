#pragma once
// Fewer triangles for showing, never for measuring.

#include "voxelcore/DisplayContent.h"

namespace voxelcore
{

/** A mesh for showing: triangles and poly lines over points, and per point the one of the original it is (or the nearest). */
struct ShownMesh
{
  std::vector<std::array<float, 3>>         points;
  std::vector<std::uint32_t>                origin;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::vector<std::uint32_t>>   lines;
};

/** A closed surface in about `most` triangles (quadric error metric of Garland and Heckbert 1997). `origin` stays empty. */
ShownMesh
Decimated(const LabelSurfaceMesh & mesh, std::size_t most);

/** Triangles, and edges on no face, of a complex; in about `most` triangles by clustering (Lindstrom 2000), which does with
 *  any number of sheets at an edge. */
ShownMesh
Decimated(const MedialComplex & complex, std::size_t most);

/** How many triangles its polygons make. */
std::size_t
TriangleCount(const CellComplex & cells);

} // namespace voxelcore
