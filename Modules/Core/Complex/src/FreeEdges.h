#pragma once
// Edges with one face left, and what their removal asks for.

#include "voxelcore/Base/Prefetch.h"
#include "voxelcore/Complex/CellComplex.h"

#include <span>

namespace voxelcore
{

/** Has memory fetched, step by step, for edges that come soon after the one at place `next` of a list: of each with one
 *  face left that face's edges, and for all that is asked of edges `fetchEdge(edge)`. */
template <typename TFetchEdge>
void
FetchFreeEdges(const CellComplex &           complex,
               const Cofaces *               cofaces,
               std::span<const ElementIndex> list,
               std::size_t                   next,
               const TFetchEdge &            fetchEdge)
{
  const auto faceAhead = [&](std::size_t steps, auto && what) {
    if (next + steps < list.size())
    {
      if (const Cofaces own = cofaces[list[next + steps]]; own.count == 1)
      {
        what(own.exclusiveOr);
      }
    }
  };
  if (next + 24 < list.size())
  {
    fetchEdge(list[next + 24]);
  }
  faceAhead(16, [&](ElementIndex face) { FetchLine(&complex.faceOffsets[face]); });
  faceAhead(12, [&](ElementIndex face) { FetchLine(&complex.faceEdges[complex.faceOffsets[face]]); });
  faceAhead(6, [&](ElementIndex face) {
    for (const ElementIndex edge : complex.FaceEdges(face))
    {
      fetchEdge(edge);
    }
  });
}

} // namespace voxelcore
