#pragma once
// What is nearest to the edges of a core, while nobody asks for it.

#include "voxelcore/Refinement/Refinement.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** Each point by how far its index is from that of the one before, in as few bytes as that takes: the points of an edge
 *  are near each other. */
class PackedEdgePoints
{
public:
  PackedEdgePoints() = default;

  explicit PackedEdgePoints(EdgePoints plain);

  EdgePoints
  Take() &&;

private:
  std::vector<std::uint8_t> m_Bytes; ///< per edge how many points it has, and the points
  std::size_t               m_Edges = 0;
  std::size_t               m_Points = 0;
};

} // namespace voxelcore
