#pragma once
// TetGen behind the engine interface. The one file that knows tetgen.h is TetGenEngine.cxx.

#include "voxelcore/DelaunayCells.h"

namespace voxelcore
{

/** Tetrahedra as an engine that does not merge gives them. */
struct Tetrahedra
{
  std::vector<std::array<std::uint32_t, 4>> corners;
  /** The tetrahedron opposite to each corner; kOutside where there is none. */
  std::vector<std::array<std::uint32_t, 4>> neighbours;
};

/** All tetrahedra of the Delaunay tetrahedralization of the points, from TetGen. One call at a time in a process
 *  (further ones wait): TetGen keeps its filters in static variables.
 *  \throws InputError above TetGen's limit of 94 million points, Error when it gives up, Cancelled: TetGen cannot be
 *  stopped, so its thread is then left to finish on its own. */
Tetrahedra
TetGenTetrahedra(const std::vector<LatticePoint> & points,
                 const SpacingWeights &            weights,
                 const ProgressCallback &          progress);

/** Unites cospherical tetrahedra inside the shape into cells with polygonal facets, not yet in canonical order. */
DelaunayCells
MergeTetrahedra(Tetrahedra                        tetrahedra,
                const VoxelShape &                shape,
                const std::vector<LatticePoint> & points,
                const SpacingWeights &            weights);

/** The engine. */
DelaunayCells
TetGenCells(const VoxelShape &                shape,
            const std::vector<LatticePoint> & points,
            const SpacingWeights &            weights,
            const ProgressCallback &          progress);

} // namespace voxelcore
