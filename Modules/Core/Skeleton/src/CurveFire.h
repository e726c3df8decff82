#pragma once
// Fire along curves, from their ends.

#include "voxelcore/Complex/SimplePairCollapse.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <vector>

namespace voxelcore
{

/** What fire along the curves of a collapsed surface finds out. */
struct CurveFire
{
  std::vector<ElementIndex> order;      ///< vertices in the order in which they burned
  std::vector<ElementIndex> nextEdge;   ///< per vertex the edge by which fire left it; kNoEdge when it never did
  std::vector<double>       time;       ///< per vertex; infinite when it never burned
  std::vector<double>       length;     ///< per vertex: how far the fire that burned it had come
  std::vector<double>       prominence; ///< per vertex: the most by which fire fell behind the surface's so far
  std::vector<ElementIndex> winner;     ///< per vertex the edge by which fire came the longest way along the edges;
                                        ///< kNoEdge at an end
  std::vector<ElementIndex> runnerUp;   ///< the same for the second longest; set where fire ended for want of curve
};

constexpr ElementIndex kNoEdge = 0xFFFFFFFFU;

/** The other end of an edge. */
inline ElementIndex
Across(const CellComplex & cells, ElementIndex edge, ElementIndex vertex)
{
  return cells.edges[edge][0] ^ cells.edges[edge][1] ^ vertex;
}

/** Burns the live edges. Fire starts at an end when the surface burned there and goes on from a vertex when one live
 *  edge is left there; it never enters a vertex of a live face, nor a cycle.
 *  The way is measured by chords of about `chord`: the curve follows edges of the complex, and their zigzag must not
 *  count. */
CurveFire
BurnCurves(const MedialComplex &       surface,
           const LiveElements &        live,
           const std::vector<double> & surfaceTime,
           double                      chord);

} // namespace voxelcore
