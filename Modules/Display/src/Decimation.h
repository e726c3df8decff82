#pragma once
// Fewer triangles for showing, never for measuring.

#include "voxelcore/DisplayContent.h"

namespace voxelcore
{

/** A mesh for showing: triangles, poly lines and single points, and per point the one of the original it is (or the nearest).
 */
struct ShownMesh
{
  std::vector<std::array<float, 3>>         points;
  std::vector<std::uint32_t>                origin;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::vector<std::uint32_t>>   lines;
  std::vector<std::uint32_t>                dots; ///< points to be seen by themselves
};

/** A closed surface in about `most` triangles (quadric error metric of Garland and Heckbert 1997). `origin` stays empty. */
ShownMesh
Decimated(const LabelSurfaceMesh & mesh, std::size_t most);

/** Triangles, edges on no face and vertices on no edge of a complex, triangles in about `most` triangles by clustering (Lindstrom 2000), which does with
 *  any number of sheets at an edge. */
ShownMesh
Decimated(const MedialComplex & complex, std::size_t most);

/** Branches, points without a branch and faces that stay, all of them. */
ShownMesh
ShownCurves(const SkeletonGraph & curves);

/** How many triangles its polygons make. */
std::size_t
TriangleCount(const CellComplex & cells);

} // namespace voxelcore
