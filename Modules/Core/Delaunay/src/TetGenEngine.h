#pragma once
// TetGen behind the engine interface. The one file that knows tetgen.h is TetGenEngine.cxx.

#include "Tetrahedra.h"

namespace voxelcore
{

/** All tetrahedra of the Delaunay tetrahedralization of the points, from TetGen. One call at a time in a process
 *  (further ones wait): TetGen keeps its filters in static variables.
 *  \throws InputError above TetGen's limit of 94 million points, Error when it gives up, Cancelled: TetGen cannot be
 *  stopped, so its thread is then left to finish on its own. */
Tetrahedra
TetGenTetrahedra(const std::vector<LatticePoint> & points,
                 const SpacingWeights &            weights,
                 const ProgressCallback &          progress);

/** The engine. */
DelaunayCells
TetGenCells(const VoxelShape &                shape,
            const std::vector<LatticePoint> & points,
            const SpacingWeights &            weights,
            const ProgressCallback &          progress);

} // namespace voxelcore
