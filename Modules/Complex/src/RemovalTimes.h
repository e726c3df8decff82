#pragma once
// When pairs go: see PairRemoval.h.

#include "PairRemoval.h"

#include <algorithm>
#include <limits>

namespace voxelcore
{

inline constexpr ElementIndex kNoPair = std::numeric_limits<ElementIndex>::max();

/** By this pairs are ordered; no two are equal. A pair is named by its lower element e: a vertex, whose only edge goes with
 *  it, or an edge with its only face. */
struct PairKey
{
  double       measure;
  double       cofaceMeasure;
  bool         isEdge;
  ElementIndex element;

  friend bool
  operator<(const PairKey & a, const PairKey & b)
  {
    if (a.measure != b.measure)
    {
      return a.measure < b.measure;
    }
    if (a.cofaceMeasure != b.cofaceMeasure)
    {
      return a.cofaceMeasure < b.cofaceMeasure;
    }
    return a.isEdge != b.isEdge ? a.isEdge < b.isEdge : a.element < b.element;
  }
};

/** A key, and the time of a pair that has gone before, all of whose keys are greater. That pair is named by its edge; each
 *  edge is in one pair at most. */
struct RemovalTime
{
  PairKey      key;
  ElementIndex before; ///< or kNoPair
};

/** The elements of one dimension, of those that can be lower ones. Plain pointers: loops over vectors would look them up
 *  after each flag that is written. */
struct LowerElements
{
  const double * measure;
  const double * cofaceMeasure; ///< of the elements one dimension up
  Cofaces *      cofaces;       ///< live ones; of one that has gone as the lower of a pair: none, and the upper
  ElementIndex *
    after; ///< the latest of its removers, where it can matter; once it has gone, the pair before it in its time

  PairKey
  KeyOf(bool isEdge, ElementIndex element, ElementIndex upper) const
  {
    return { measure[element], cofaceMeasure[upper], isEdge, element };
  }
};

/** What is known of the pairs that have gone, and of when others will. */
class RemovalTimes
{
public:
  RemovalTimes(const CollapseState & state, ElementIndex * vertexAfter, ElementIndex * edgeAfter)
    : m_Vertices{ state.vertexMeasure.data(), state.edgeMeasure.data(), state.vertexCofaces.data(), vertexAfter }
    , m_Edges{ state.edgeMeasure.data(), state.faceMeasure.data(), state.edgeCofaces.data(), edgeAfter }
    , m_Ends(state.complex.edges.data())
    , m_LiveVertices(state.live.vertices.data())
  {}

  const LowerElements &
  Vertices() const
  {
    return m_Vertices;
  }
  const LowerElements &
  Edges() const
  {
    return m_Edges;
  }

  /** Of a pair that has gone. */
  RemovalTime
  TimeOf(ElementIndex edge) const
  {
    for (const ElementIndex vertex : m_Ends[edge])
    {
      if (m_LiveVertices[vertex] == 0 && m_Vertices.cofaces[vertex].exclusiveOr == edge)
      {
        return { m_Vertices.KeyOf(false, vertex, edge), m_Vertices.after[vertex] };
      }
    }
    return { m_Edges.KeyOf(true, edge, m_Edges.cofaces[edge].exclusiveOr), m_Edges.after[edge] };
  }

  /** Of a pair that has become simple with the removal of pair `after`, or kNoPair. */
  RemovalTime
  TimeOf(const PairKey & key, ElementIndex after) const
  {
    while (after != kNoPair)
    {
      const RemovalTime time = TimeOf(after);
      if (key < time.key)
      {
        break;
      }
      after = time.before;
    }
    return { key, after };
  }

  PairKey
  FirstKey(RemovalTime time) const
  {
    while (time.before != kNoPair)
    {
      time = TimeOf(time.before);
    }
    return time.key;
  }

  bool
  IsEarlier(const RemovalTime & a, const RemovalTime & b) const
  {
    if (a.before == b.before)
    {
      return a.key < b.key;
    }
    const std::vector<PairKey> keysA = ListKeys(a);
    const std::vector<PairKey> keysB = ListKeys(b);
    return std::lexicographical_compare(keysA.begin(), keysA.end(), keysB.begin(), keysB.end());
  }

private:
  std::vector<PairKey>
  ListKeys(RemovalTime time) const
  {
    std::vector<PairKey> keys{ time.key };
    while (time.before != kNoPair)
    {
      time = TimeOf(time.before);
      keys.push_back(time.key);
    }
    std::reverse(keys.begin(), keys.end());
    return keys;
  }

  LowerElements                       m_Vertices;
  LowerElements                       m_Edges;
  const std::array<ElementIndex, 2> * m_Ends;
  const std::uint8_t *                m_LiveVertices;
};

} // namespace voxelcore
