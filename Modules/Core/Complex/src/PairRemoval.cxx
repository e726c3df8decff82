#include "PairRemoval.h"

#include "FreeEdges.h"
#include "RemovalTimes.h"

#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <atomic>

namespace voxelcore
{

namespace
{

// One at work, on the elements all of whose vertices lie in its range; others are at work on others.
class Worker
{
public:
  Worker(const CollapseState & state,
         const RemovalTimes &  times,
         double                threshold,
         std::size_t           firstVertex,
         std::size_t           lastVertex)
    : m_State(state)
    , m_Times(times)
    , m_Threshold(threshold)
    , m_FirstVertex(firstVertex)
    , m_VertexCount(lastVertex - firstVertex)
    , m_OwnsAll(m_VertexCount == state.complex.vertexCount)
  {}

  // From now on, what is not safe waits its turn.
  void
  KeepUnsafe()
  {
    m_KeepsUnsafe = true;
  }

  // Removes what is safe when these can go, and all that is safe then.
  void
  RemoveFrom(std::size_t firstVertex, std::size_t lastVertex, std::size_t firstEdge, std::size_t lastEdge);

  // Removes the pair of smallest time among those that wait, and all that is safe then. False when none was left.
  bool
  RemoveNext();

private:
  // A pair that waits.
  struct Turn
  {
    RemovalTime time;
    PairKey     first;
  };

  bool
  OwnsVertex(ElementIndex vertex) const
  {
    return vertex - m_FirstVertex < m_VertexCount;
  }
  bool
  OwnsEdge(ElementIndex edge) const
  {
    const auto & ends = m_State.complex.edges[edge];
    return m_OwnsAll || (OwnsVertex(ends[0]) && OwnsVertex(ends[1]));
  }
  bool
  OwnsFace(ElementIndex face) const
  {
    const auto sides = m_State.complex.FaceEdges(face);
    return m_OwnsAll || std::all_of(sides.begin(), sides.end(), [&](ElementIndex edge) { return OwnsEdge(edge); });
  }

  bool
  GoesLater(const Turn & a, const Turn & b) const
  {
    // Most times begin with keys of their own; to look further would take memory from here and there.
    return b.first < a.first || (!(a.first < b.first) && m_Times.IsEarlier(b.time, a.time));
  }

  void
  Wait(const RemovalTime & time, const PairKey & first)
  {
    if (m_KeepsUnsafe)
    {
      m_Turns.push_back({ time, first });
      std::push_heap(m_Turns.begin(), m_Turns.end(), [&](const Turn & a, const Turn & b) { return GoesLater(a, b); });
    }
  }

  // Whether all elements of a boundary but the lower one of the pair have keys above the first of the pair's time.
  template <typename TElements>
  static bool
  IsSafe(const LowerElements & lower, const TElements & boundary, const PairKey & key, const PairKey & first)
  {
    bool isLess = false;
    bool isEqual = false;
    for (const ElementIndex other : boundary) // without jumps, which would be hard to foretell
    {
      const bool   isOther = other != key.element;
      const double measure = lower.measure[other];
      isLess |= isOther & (measure < first.measure);
      isEqual |= isOther & (measure == first.measure);
    }
    return !isLess && (!isEqual || std::all_of(boundary.begin(), boundary.end(), [&](ElementIndex other) {
      return other == key.element || first < PairKey{ lower.measure[other], key.cofaceMeasure, key.isEdge, other };
    }));
  }

  void
  ConsiderVertex(ElementIndex vertex);
  void
  ConsiderEdge(ElementIndex edge);

  void
  RemoveVertexAndEdge(const RemovalTime & time, double first, ElementIndex edge);
  void
  RemoveEdgeAndFace(const RemovalTime & time, double first, ElementIndex face);

  // An element has lost a coface with a pair that is named by its edge. Whether it can go now.
  bool
  LoseCoface(const LowerElements & lower,
             ElementIndex          element,
             ElementIndex          coface,
             ElementIndex          pair,
             const RemovalTime &   time,
             double                first)
  {
    Cofaces & cofaces = lower.cofaces[element];
    cofaces.Remove(coface);
    // Keys below that of the element's own pair are no part of its time.
    if (first >= lower.measure[element] && cofaces.count > 0)
    {
      ElementIndex & after = lower.after[element];
      if (after == kNoPair || m_Times.IsEarlier(m_Times.TimeOf(after), time))
      {
        after = pair;
      }
    }
    return cofaces.count == 1;
  }

  void
  RemoveOpen()
  {
    const LowerElements & edges = m_Times.Edges();
    while (!m_Edges.empty() || !m_Vertices.empty())
    {
      while (!m_Edges.empty())
      {
        m_Round.swap(m_Edges);
        for (std::size_t next = 0; next < m_Round.size(); ++next)
        {
          FetchFreeEdges(m_State.complex, edges.cofaces, m_Round, next, [&](ElementIndex edge) {
            FetchLine(&edges.cofaces[edge]);
            FetchLine(&edges.measure[edge]);
            FetchLine(&edges.after[edge]);
          });
          ConsiderEdge(m_Round[next]);
        }
        m_Round.clear();
      }
      if (!m_Vertices.empty())
      {
        const ElementIndex vertex = m_Vertices.back();
        m_Vertices.pop_back();
        ConsiderVertex(vertex);
      }
    }
  }

  const CollapseState       m_State;
  RemovalTimes              m_Times;
  const double              m_Threshold;
  const std::size_t         m_FirstVertex;
  const std::size_t         m_VertexCount;
  const bool                m_OwnsAll;
  bool                      m_KeepsUnsafe = false;
  std::vector<ElementIndex> m_Vertices; // that have one coface left
  std::vector<ElementIndex> m_Edges;
  std::vector<ElementIndex> m_Round; // of them, those in turn: it is known ahead which memory they need
  std::vector<Turn>         m_Turns; // a heap
};

void
Worker::ConsiderVertex(ElementIndex vertex)
{
  const LowerElements & vertices = m_Times.Vertices();
  const Cofaces         cofaces = vertices.cofaces[vertex];
  if (cofaces.count != 1 || !(vertices.measure[vertex] < m_Threshold))
  {
    return;
  }
  const ElementIndex edge = cofaces.exclusiveOr;
  const PairKey      key = vertices.KeyOf(false, vertex, edge);
  if (!(key.cofaceMeasure < m_Threshold) || !OwnsEdge(edge))
  {
    return;
  }
  const RemovalTime time = m_Times.TimeOf(key, vertices.after[vertex]);
  const PairKey     first = m_Times.FirstKey(time);
  if (IsSafe(vertices, m_State.complex.edges[edge], key, first))
  {
    RemoveVertexAndEdge(time, first.measure, edge);
  }
  else
  {
    Wait(time, first);
  }
}

void
Worker::ConsiderEdge(ElementIndex edge)
{
  const LowerElements & edges = m_Times.Edges();
  const Cofaces         cofaces = edges.cofaces[edge];
  if (cofaces.count != 1 || !(edges.measure[edge] < m_Threshold))
  {
    return;
  }
  const ElementIndex face = cofaces.exclusiveOr;
  const PairKey      key = edges.KeyOf(true, edge, face);
  if (!(key.cofaceMeasure < m_Threshold) || !OwnsFace(face))
  {
    return;
  }
  const RemovalTime time = m_Times.TimeOf(key, edges.after[edge]);
  const PairKey     first = m_Times.FirstKey(time);
  if (IsSafe(edges, m_State.complex.FaceEdges(face), key, first))
  {
    RemoveEdgeAndFace(time, first.measure, face);
  }
  else
  {
    Wait(time, first);
  }
}

void
Worker::RemoveVertexAndEdge(const RemovalTime & time, double first, ElementIndex edge)
{
  const LowerElements & vertices = m_Times.Vertices();
  const ElementIndex    vertex = time.key.element;
  vertices.after[vertex] = m_Times.NoteRemoval(time.before);
  vertices.cofaces[vertex] = { 0, edge };
  m_Times.Edges().cofaces[edge] = { kWithVertex, vertex };
  m_State.live.vertices[vertex] = 0;
  m_State.live.edges[edge] = 0;
  for (const ElementIndex other : m_State.complex.edges[edge])
  {
    if (other != vertex && LoseCoface(vertices, other, edge, edge, time, first))
    {
      m_Vertices.push_back(other);
    }
  }
}

void
Worker::RemoveEdgeAndFace(const RemovalTime & time, double first, ElementIndex face)
{
  const LowerElements & vertices = m_Times.Vertices();
  const LowerElements & edges = m_Times.Edges();
  const ElementIndex    edge = time.key.element;
  edges.after[edge] = m_Times.NoteRemoval(time.before);
  edges.cofaces[edge] = { 0, face };
  m_State.live.edges[edge] = 0;
  m_State.live.faces[face] = 0;
  for (const ElementIndex other : m_State.complex.FaceEdges(face))
  {
    if (other != edge && LoseCoface(edges, other, face, edge, time, first))
    {
      m_Edges.push_back(other);
    }
  }
  for (const ElementIndex vertex : m_State.complex.edges[edge])
  {
    if (LoseCoface(vertices, vertex, edge, edge, time, first))
    {
      m_Vertices.push_back(vertex);
    }
  }
}

void
Worker::RemoveFrom(std::size_t firstVertex, std::size_t lastVertex, std::size_t firstEdge, std::size_t lastEdge)
{
  for (std::size_t vertex = firstVertex; vertex < lastVertex; ++vertex)
  {
    if (m_State.vertexCofaces[vertex].count == 1)
    {
      ConsiderVertex(static_cast<ElementIndex>(vertex));
      RemoveOpen();
    }
  }
  for (std::size_t edge = firstEdge; edge < lastEdge; ++edge)
  {
    // What is another's may be changing.
    if (OwnsEdge(static_cast<ElementIndex>(edge)) && m_State.edgeCofaces[edge].count == 1)
    {
      m_Edges.push_back(static_cast<ElementIndex>(edge));
    }
  }
  RemoveOpen();
}

bool
Worker::RemoveNext()
{
  if (m_Turns.empty())
  {
    return false;
  }
  std::pop_heap(m_Turns.begin(), m_Turns.end(), [&](const Turn & a, const Turn & b) { return GoesLater(a, b); });
  const Turn turn = m_Turns.back();
  m_Turns.pop_back();
  const PairKey & key = turn.time.key;
  const Cofaces   cofaces = (key.isEdge ? m_Times.Edges() : m_Times.Vertices()).cofaces[key.element];
  if (cofaces.count == 1) // else its coface has gone with another element
  {
    (this->*(key.isEdge ? &Worker::RemoveEdgeAndFace
                        : &Worker::RemoveVertexAndEdge))(turn.time, turn.first.measure, cofaces.exclusiveOr);
    RemoveOpen();
  }
  return true;
}

} // namespace

void
RemovePairs(const CollapseState & state, double threshold, const ProgressCallback & progress)
{
  const std::size_t         vertices = state.complex.vertexCount;
  const std::size_t         edges = state.complex.edges.size();
  std::vector<ElementIndex> vertexAfter(vertices, kNoPair);
  std::vector<ElementIndex> edgeAfter(edges, kNoPair);
  // Vertices and edges of a block are neighbours where both are in order, as those of a core are.
  const std::size_t  blocks = edges / 1024 + 1;
  TimeNodes          nodes(edges, blocks + 1);
  const RemovalTimes times(state, vertexAfter.data(), edgeAfter.data(), nodes);
  std::atomic<bool>  isCancelled = false;
  const auto         report = [&] {
    try
    {
      ReportProgress(progress, "prune", 0.0);
    }
    catch (...)
    {
      isCancelled = true;
      throw;
    }
  };
  const auto vertexAt = [&](std::size_t block) { return vertices * block / blocks; };
  const auto edgeAt = [&](std::size_t block) { return edges * block / blocks; };
  const auto removeBlock = [&](Worker & worker, std::size_t block) {
    worker.RemoveFrom(vertexAt(block), vertexAt(block + 1), edgeAt(block), edgeAt(block + 1));
  };
  RunInParts(blocks > 10, blocks, [&](std::size_t firstBlock, std::size_t lastBlock) {
    Worker worker(state, times, threshold, vertexAt(firstBlock), vertexAt(lastBlock));
    for (std::size_t block = firstBlock; block < lastBlock && !isCancelled; ++block)
    {
      if (firstBlock == 0 && block % 64 == 0)
      {
        report(); // from the calling thread
      }
      removeBlock(worker, block);
    }
  });
  // What lies across the parts, and what is not safe.
  Worker worker(state, times, threshold, 0, vertices);
  worker.KeepUnsafe();
  for (std::size_t block = 0; block < blocks; ++block)
  {
    removeBlock(worker, block);
  }
  for (std::size_t count = 1; worker.RemoveNext(); ++count)
  {
    if (count % 0x10000 == 0)
    {
      report();
    }
  }
}

} // namespace voxelcore
