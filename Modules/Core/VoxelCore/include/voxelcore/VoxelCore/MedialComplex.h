#pragma once
// The voxel core as a complex with geometry: what every later stage works on.

#include "voxelcore/Complex/CellComplex.h"

#include <array>
#include <vector>

namespace voxelcore
{

/** Per element the tolerance from which on it is pruned, in mm: what is left at tolerance h has a value >= h. See
 *  TolerancePruning.h. value(face) <= value(edge) <= value(vertex) along incidences. */
struct ToleranceValues
{
  std::vector<double> vertices;
  std::vector<double> edges;
  std::vector<double> faces;
};

/** A voxel core or a part of it. Canonical order: vertices by exact centre, edges and faces by their sorted vertex
 *  indices; a polygon starts at its smallest vertex, its normal (right-handed in lattice axes) points from the
 *  lexicographically smaller to the greater of its two nearest boundary vertices.
 *
 *  The radius measure of an element is the radius of the smallest ball enclosing all boundary vertices nearest to it
 *  (paper, section 4, step 3). The exact squared measure is rounded once, then turned into mm; both are monotone, so
 *  equal measures stay equal and measure(face) <= measure(edge) <= measure(vertex) along incidences. */
struct MedialComplex
{
  CellComplex                        cells;
  std::vector<std::array<double, 3>> positions;    ///< lattice coordinates (voxel index + 1/2) of each vertex
  std::vector<double>                radius;       ///< mm from each vertex to its nearest boundary vertices
  std::vector<double>                vertexLambda; ///< radius measure in mm
  std::vector<double>                edgeLambda;   ///< radius measure in mm
  std::vector<double>                faceLambda;   ///< radius measure in mm
  ToleranceValues                    tolerances;   ///< empty where they were not asked for

  bool
  HasTolerances() const
  {
    return tolerances.vertices.size() == cells.vertexCount && cells.vertexCount > 0;
  }
};

} // namespace voxelcore
