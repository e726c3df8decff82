#pragma once
// When pairs go: see PairRemoval.h.

#include "PairRemoval.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>

namespace voxelcore
{

inline constexpr ElementIndex kNoPair = std::numeric_limits<ElementIndex>::max();

/** In place of the number of cofaces: this edge has gone with a vertex, which is the exclusiveOr. */
inline constexpr ElementIndex kWithVertex = std::numeric_limits<ElementIndex>::max();

/** By this pairs are ordered; no two are equal. A pair is named by its lower element e: a vertex, whose only edge goes
 *  with it, or an edge with its only face. */
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

/** A key, and the time of a pair that has gone before, all of whose keys are greater. That pair is named by its edge;
 *  each edge is in one pair at most. */
struct RemovalTime
{
  PairKey      key;
  ElementIndex before; ///< or kNoPair
};

/** The elements of one dimension, of those that can be lower ones. Plain pointers: loops over vectors would look them
 *  up after each flag that is written. */
struct LowerElements
{
  std::span<const double> measure;
  std::span<const double> cofaceMeasure; ///< of the elements one dimension up
  Cofaces *               cofaces; ///< live ones; of one that has gone as the lower of a pair: none, and the upper
  ElementIndex *
    after; ///< the latest of its removers, where it can matter; once it has gone, its TimeNode, where it has one

  PairKey
  KeyOf(bool isEdge, ElementIndex element, ElementIndex upper) const
  {
    return { measure[element], cofaceMeasure[upper], isEdge, element };
  }
};

/** Where a pair that has gone stands in its time, when that does not begin with it, as nine of ten do. Times branch as
 *  a tree whose nodes are pairs: each follows the one before it, and what two times have in common is the way from the
 *  root to where they part. A jump leads far up, by a number of steps that depends on the depth alone, so that a place
 *  on the way is found in a number of steps logarithmic in its length (E. W. Myers: An applicative random-access stack,
 *  1983). */
struct TimeNode
{
  ElementIndex before = kNoPair; ///< the pair before it
  ElementIndex jump = kNoPair;   ///< a pair further up, or kNoPair above the first
  ElementIndex first = kNoPair;  ///< the pair with which the time begins
  ElementIndex depth = 1;        ///< keys of the time; 0 is that of kNoPair
};

/** The nodes of all; each thread takes chunks of its own. */
class TimeNodes
{
public:
  static constexpr ElementIndex kChunk = 4096;

  TimeNodes(std::size_t mostPairs, std::size_t threads)
    : m_Chunks(mostPairs / kChunk + threads + 1)
  {}

  const TimeNode &
  operator[](ElementIndex node) const
  {
    return m_Chunks[node / kChunk][node % kChunk];
  }
  TimeNode &
  operator[](ElementIndex node)
  {
    return m_Chunks[node / kChunk][node % kChunk];
  }

  /** Its first node. */
  ElementIndex
  NewChunk()
  {
    const ElementIndex chunk = m_Count.fetch_add(1, std::memory_order_relaxed);
    m_Chunks[chunk] = std::make_unique<TimeNode[]>(kChunk);
    return chunk * kChunk;
  }

private:
  std::vector<std::unique_ptr<TimeNode[]>> m_Chunks;
  std::atomic<ElementIndex>                m_Count = 0;
};

/** What is known of the pairs that have gone, and of when others will. Each thread has its own. */
class RemovalTimes
{
public:
  RemovalTimes(const CollapseState & state, ElementIndex * vertexAfter, ElementIndex * edgeAfter, TimeNodes & nodes)
    : m_Vertices{ state.vertexMeasure, state.edgeMeasure, state.vertexCofaces.data(), vertexAfter }
    , m_Edges{ state.edgeMeasure, state.faceMeasure, state.edgeCofaces.data(), edgeAfter }
    , m_Nodes(&nodes)
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
    const ElementIndex vertex = VertexOf(edge);
    if (vertex != kNoPair)
    {
      return { m_Vertices.KeyOf(false, vertex, edge), BeforeOf(m_Vertices.after[vertex]) };
    }
    return { m_Edges.KeyOf(true, edge, m_Edges.cofaces[edge].exclusiveOr), BeforeOf(m_Edges.after[edge]) };
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
      // Keys rise on the way up: where that at the end of a jump is not greater, none that it passes is.
      const ElementIndex jump = NodeOf(after).jump;
      after = jump != time.before && jump != kNoPair && !(key < TimeOf(jump).key) ? jump : time.before;
    }
    return { key, after };
  }

  PairKey
  FirstKey(const RemovalTime & time) const
  {
    if (time.before == kNoPair)
    {
      return time.key;
    }
    const ElementIndex first = NodeOf(time.before).first;
    return TimeOf(first == kNoPair ? time.before : first).key;
  }

  bool
  IsEarlier(const RemovalTime & a, const RemovalTime & b) const
  {
    const ElementIndex depthA = NodeOf(a.before).depth;
    const ElementIndex depthB = NodeOf(b.before).depth;
    const ElementIndex depth = std::min(depthA, depthB);
    ElementIndex       upA = AtDepth(a.before, depth);
    ElementIndex       upB = AtDepth(b.before, depth);
    if (upA == upB) // up to there they are the same
    {
      const PairKey keyA = KeyAfter(a, depth);
      const PairKey keyB = KeyAfter(b, depth);
      return keyA < keyB || (!(keyB < keyA) && depthA < depthB); // equal keys: one time goes on where the other ends
    }
    // At equal depths jumps are equally long: up to the last pairs that are not the same.
    for (;;)
    {
      const TimeNode nodeA = NodeOf(upA);
      const TimeNode nodeB = NodeOf(upB);
      if (nodeA.jump != nodeB.jump)
      {
        upA = nodeA.jump;
        upB = nodeB.jump;
        continue;
      }
      const RemovalTime timeA = TimeOf(upA);
      const RemovalTime timeB = TimeOf(upB);
      if (timeA.before == timeB.before)
      {
        return timeA.key < timeB.key;
      }
      upA = timeA.before;
      upB = timeB.before;
    }
  }

  /** A pair goes after pair `before` or kNoPair. The node for it, if it needs one. */
  ElementIndex
  NoteRemoval(ElementIndex before)
  {
    if (before == kNoPair)
    {
      return kNoPair;
    }
    const TimeNode     node = NodeOf(before);
    const TimeNode     next = NodeOf(node.jump);
    const ElementIndex beyond = NodeOf(next.jump).depth;
    if (m_Free % TimeNodes::kChunk == 0)
    {
      m_Free = m_Nodes->NewChunk();
    }
    const bool isLong = node.depth - next.depth == next.depth - beyond;
    (*m_Nodes)[m_Free] = { before,
                           isLong ? next.jump : before,
                           node.first == kNoPair ? before : node.first,
                           node.depth + 1 };
    return m_Free++;
  }

private:
  /** The vertex with which an edge has gone; kNoPair where it went with a face. */
  ElementIndex
  VertexOf(ElementIndex edge) const
  {
    const Cofaces & own = m_Edges.cofaces[edge];
    return own.count == kWithVertex ? own.exclusiveOr : kNoPair;
  }

  ElementIndex
  BeforeOf(ElementIndex node) const
  {
    return node == kNoPair ? kNoPair : (*m_Nodes)[node].before;
  }

  TimeNode
  NodeOf(ElementIndex pair) const
  {
    if (pair == kNoPair)
    {
      return { kNoPair, kNoPair, kNoPair, 0 };
    }
    const ElementIndex vertex = VertexOf(pair);
    const ElementIndex node = vertex != kNoPair ? m_Vertices.after[vertex] : m_Edges.after[pair];
    return node == kNoPair ? TimeNode() : (*m_Nodes)[node];
  }

  /** The pair that lies so deep on the way to this one. */
  ElementIndex
  AtDepth(ElementIndex pair, ElementIndex depth) const
  {
    for (TimeNode node = NodeOf(pair); node.depth > depth; node = NodeOf(pair))
    {
      pair = NodeOf(node.jump).depth >= depth ? node.jump : TimeOf(pair).before;
    }
    return pair;
  }

  /** The key of a time that comes after so many. */
  PairKey
  KeyAfter(const RemovalTime & time, ElementIndex count) const
  {
    return NodeOf(time.before).depth == count ? time.key : TimeOf(AtDepth(time.before, count + 1)).key;
  }

  LowerElements m_Vertices;
  LowerElements m_Edges;
  TimeNodes *   m_Nodes;
  ElementIndex  m_Free = 0; ///< where the next node comes, but at the beginning of a chunk
};

} // namespace voxelcore
