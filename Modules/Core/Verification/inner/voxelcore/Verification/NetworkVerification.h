#pragma once
// Rechecks the network of several labels against their voxels by other means than the code that made it.

#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace voxelcore
{

/** A contact of two labels as a network has it. */
struct ClaimedContact
{
  std::array<std::int64_t, 2>        labels{};
  std::uint64_t                      voxels = 0;
  std::uint64_t                      faces = 0;
  std::vector<std::array<double, 3>> places;
};

/** A network and its labels. Everything is borrowed and must outlive the call. */
struct NetworkClaims
{
  std::vector<std::pair<std::int64_t, const VoxelShape *>> labels; ///< value and voxels; a shared voxel is the first's

  std::span<const std::array<double, 3>> positions;
  std::span<const std::int64_t>          pointLabels;
  std::span<const std::uint8_t>          contactPoints;
  std::span<const std::uint64_t>         branchOffsets; ///< as in SkeletonGraph
  std::span<const std::uint32_t>         branchPoints;
  std::span<const std::uint64_t>         faceOffsets; ///< of faces that stay
  std::span<const std::uint32_t>         faceVertices;

  std::vector<ClaimedContact>        contacts;
  std::vector<std::array<double, 3>> gaps; ///< where labels follow each other that do not touch

  std::int64_t components = 0; ///< of the labels' union
  std::int64_t euler = 0;
};

/** What does not hold, a clause each; empty when all does: the union's components and cycles are those of points and
 *  branches; each branch is of one label; labels meet in contact points alone, and each of these is a place of a
 *  contact or a gap; at each place of a contact branches of both labels end; the contacts are those of the voxels, each
 *  with its number of voxels and of faces, found here by a flood from voxel to voxel. */
std::vector<std::string>
CheckNetwork(const NetworkClaims & claims);

} // namespace voxelcore
