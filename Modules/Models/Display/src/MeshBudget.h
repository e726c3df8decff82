#pragma once
// How many triangles each mesh of a page gets.

#include <cstddef>
#include <vector>

namespace voxelcore
{

/** A mesh that asks for its part of a budget. */
struct MeshDemand
{
  std::size_t triangles = 0;
  double      weight = 1; ///< up to 1: how much a triangle of it matters
};

/** How many triangles of a budget each mesh gets: in proportion to its own, but a few dozen at least where that is to
 *  be had. */
std::vector<std::size_t>
SharesOfBudget(const std::vector<MeshDemand> & meshes, std::size_t budget);

} // namespace voxelcore
