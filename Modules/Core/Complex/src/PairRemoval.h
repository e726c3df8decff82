#pragma once
// The removals of a simple-pair collapse, in whatever order is fast.
//
// The collapse is defined by an order: always the pair of smallest key goes, of all that are simple at that moment.
// Which element goes with which follows from it, and little of it has to be obeyed. Let pair p = (a, b), a on the
// boundary of b, become simple by the removal of pairs r, the removers of a.
//
// When does p go? While p waits, only smaller keys go. So the keys that went last, read backwards from any moment, each
// being greater than all that followed it, are a falling sequence, the time; it ends with the key of the pair that
// goes. Of the latest remover of a, the keys above that of p, and then p's own, are the time of p, and times are
// ordered lexicographically. The first key of a time is the greatest of all that have gone.
//
// Which pairs may go at once? p goes at its time unless another element a' of the boundary of b took b before. Its pair
// has a time whose first key is at least its own. So when the keys of all others a' that are left are greater than the
// first of p's time, p goes as defined, whatever else happens: p is safe. An element left on the boundary of an element
// that is left is itself left, so that this asks for the measures alone. What is not safe waits until no safe pair is
// left; then the one with the smallest time goes as defined, since whatever goes before it would be safe or be waiting.
//
// Nearly all pairs are safe: most faces go with the edge of smallest measure. So the work goes by neighbourhood, and in
// several parts of the complex side by side, and what comes out does not depend on that.

#include "voxelcore/Complex/SimplePairCollapse.h"

namespace voxelcore
{

/** A complex, its measures, and what is left of it. Of an element that has been removed as the lower one of a pair, the
 *  cofaces are none, and their exclusiveOr is the upper one. An edge that has gone with a vertex names it: kWithVertex
 *  in RemovalTimes.h. */
struct CollapseState
{
  const CellComplex &     complex;
  std::span<const double> vertexMeasure;
  std::span<const double> edgeMeasure;
  std::span<const double> faceMeasure;
  LiveElements &          live;
  std::vector<Cofaces> &  vertexCofaces; // live ones
  std::vector<Cofaces> &  edgeCofaces;
};

/** Removes the pairs below the threshold.
 *  \throws Cancelled when the callback says so. */
void
RemovePairs(const CollapseState & state, double threshold, const ProgressCallback & progress);

} // namespace voxelcore
