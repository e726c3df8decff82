#pragma once
// Small models.

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "voxelcore/Models/MedialModel.h"

#include <array>
#include <cstdint>
#include <vector>

namespace voxelcore::testing
{

/** A core of the given corners and edges on no face; positions, radii and measures are distinct numbers that need all
 *  bits of a double. */
MedialComplex
MakeCore(std::size_t                                      vertices,
         const std::vector<std::array<ElementIndex, 2>> & looseEdges,
         const std::vector<std::vector<ElementIndex>> &   faces,
         double                                           seed = 0);

/** Label 3: a square 0-1-2-3, an edge 3-4, an isolated vertex 5, a pentagon 1-2-6-7-8. Label 7: two isolated vertices.
 *  Label 300: an edge. */
MedialModel
MixedModel();

/** Squares, edges and vertices of an n^3 grid, each there by chance. */
MedialModel
RandomModel(std::uint64_t seed, int n, int parts);

} // namespace voxelcore::testing
