#pragma once
// Whether the numbers of a core that comes from outside can be those of any shape.

#include "voxelcore/VoxelCore/MedialComplex.h"

#include <string>

namespace voxelcore
{

/** What a core's numbers have been through. */
struct NumbersFrom
{
  bool        isRefined = false; ///< its vertices were moved to a smooth surface
  double      rounding = 0;      ///< as the largest coordinate in the file may be off, in its unit
  std::size_t firstPoint = 0;    ///< number in the file of the core's first vertex
};

/** Why the places, radii and measures of a core are not those of any shape, in the middle of a sentence; empty when
 *  they may be. All are finite, radii and measures not below 0; the measures of edges may be unknown (NaN). No place is
 *  so far off that doubles could not tell places within a voxel apart.
 *
 *  The ends of an edge have nearest boundary vertices in common (the edge is dual to a face of Delaunay cells, whose
 *  corners are nearest to both). So the two radii and the length of the edge are the sides of a triangle, whose third
 *  corner is such a boundary vertex: none is longer than the other two together. One that is more than twice as long is
 *  refused. Refinement moves vertices by up to a voxel, which the file does not know, and radii may vanish: of refined
 *  cores a side may be longer by what a hundred edges of middle length are. */
std::string
FaultOfNumbers(const MedialComplex & core, const NumbersFrom & from = {});

} // namespace voxelcore
