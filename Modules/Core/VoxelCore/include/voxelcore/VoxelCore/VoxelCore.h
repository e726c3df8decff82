#pragma once
// The voxel core of a voxel shape (Yan, Letscher, Ju: "Voxel Cores", SIGGRAPH 2018, sections 3.2 and 4).

#include "voxelcore/Delaunay/DelaunayCells.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

namespace voxelcore
{

/** What a core is made for. */
enum class CoreUse
{
  Any,
  Pruning ///< by lambda, and then it is used up: without the corners of its faces, which its edges tell
};

/** The core as the dual of the Delaunay cells inside the shape (Definition 3.2): a vertex per cell, an edge per inner
 *  facet, a face per Delaunay edge that is not on the boundary. `points` are the boundary vertices the cells refer to.
 *  Move the cells in, and the points where nobody needs them later: their memory is given back on the way.
 *  \throws InputError above 2^31 edges; CertificateError when the cells do not fit together (an engine's fault). */
MedialComplex
BuildVoxelCore(const VoxelShape &        shape,
               std::vector<LatticePoint> points,
               DelaunayCells             cells,
               const SpacingWeights &    weights,
               CoreUse                   use = CoreUse::Any);

/** Boundary vertices, Delaunay cells and core in one call. Empty for an empty shape. */
MedialComplex
ComputeVoxelCore(const VoxelShape &       shape,
                 const SpacingWeights &   weights,
                 Engine                   engine = Engine::Auto,
                 const ProgressCallback & progress = {});

} // namespace voxelcore
