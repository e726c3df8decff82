#pragma once
// What a page draws of a label, in fewer triangles than there are: for showing, never for measuring.

#include "voxelcore/Models/DisplayContent.h"

namespace voxelcore
{

/** Triangles, segments, poly lines and single points over points, and per point the one of the original it is. */
struct ShownMesh
{
  std::vector<std::array<float, 3>>         points;
  std::vector<std::uint32_t>                origin;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 2>> segments;
  std::vector<std::vector<std::uint32_t>>   lines;
  std::vector<std::uint32_t>                dots; ///< points to be seen by themselves
};

/** How many triangles the polygons of a complex make, and how many edges are on no face. */
struct ComplexSize
{
  std::size_t triangles = 0;
  std::size_t edges = 0;
};
ComplexSize
SizeOf(const CellComplex & cells);

/** A surface in about `most` triangles: edges collapsed by meshoptimizer (quadric error metric of Garland and Heckbert
 *  1997), pieces, handles and closedness as they were. More triangles are left where fewer would change these. */
ShownMesh
SimplifiedSurface(const LabelSurfaceMesh & mesh, std::size_t most);

/** Triangles, edges on no face and vertices on no edge of a complex. Where these are more than `most`, vertices are
 *  clustered in cells of a grid (Lindstrom 2000), each at its vertex of least quadric error, so that rims and seams
 *  stay. Nothing vanishes: what is narrower than a cell becomes a segment, what is smaller a point. */
ShownMesh
SimplifiedComplex(const MedialComplex & complex, std::size_t most);

/** Branches, points without a branch and faces that stay, all of them. */
ShownMesh
ShownCurves(const SkeletonGraph & curves);

} // namespace voxelcore
