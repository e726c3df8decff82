#pragma once
// Fire that burns the sheets of a core from their rims.

#include "CoreBall.h"
#include "RemainingElements.h"
#include "ToleranceLevels.h"

#include "voxelcore/Complex/CellComplex.h"
#include "voxelcore/Complex/SimplePairCollapse.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** Burns edges with their faces, level by level and, within a level, in waves. It asks for nothing but edges and faces:
 *  what becomes of vertices, and of edges that bound no face, is for others to see, at the same time. */
class RimFire
{
public:
  /** `left`: what is there to begin with; all where it is empty. Where `touched` are weighed, a ball must not lie
   *  farther from what those before it touch; else these must not stick out of it. */
  RimFire(const CellComplex &     cells,
          const LiveElements &    left,
          const ToleranceLevels & levels,
          const TouchedPlaces &   touched,
          std::vector<CoreBall> & balls);

  /** Burns what goes at this level; levels are to be taken in order. */
  void
  Burn(std::size_t level);

  /** Whether nothing is left to burn at any later level. */
  bool
  IsOut() const
  {
    return m_Waiting == 0;
  }

  /** How many edges have burnt. */
  std::size_t
  BurntCount() const
  {
    return m_Burnt.size();
  }
  /** Some of those that have burnt, in that order; safe while others burn. */
  std::span<const ElementIndex>
  Burnt(std::size_t first, std::size_t end) const
  {
    return { m_Burnt.data() + first, end - first };
  }

  /** Frees what is asked for no more once nothing is left to burn. */
  void
  KeepLevelsOnly();

  /** At which height each face burnt, infinity where it did not; after KeepLevelsOnly(). */
  std::vector<double>
  TakeFaceHeights();
  /** The same of edges. */
  std::vector<double>
  TakeEdgeHeights();

private:
  // A face is known by the place of its first corner, where its level stands. How many corners it has stands at the
  // next one, and then which of its first sides are free. So nobody has to ask for its number, nor for where its
  // corners are, and what a cost needs of the edges around it lies in one place.
  using Word = std::uint16_t;

  static constexpr std::size_t kNoted = 16; ///< sides that are noted as free

  struct Reached
  {
    ElementIndex vertex;
    ElementIndex witness;
    double       time;
  };
  struct ReachedVertices
  {
    std::vector<Reached> list; ///< as long as the largest face asks for
    std::size_t          count = 0;
  };

  bool
  IsSideFree(std::uint32_t place, std::size_t side) const
  {
    return side < kNoted ? (m_Faces[place + 2] >> side & 1) != 0 : m_Edges[m_Cells.faceEdges[place + side]].IsFree();
  }
  void
  NoteFree(const RemainingElements & edge)
  {
    if (edge.Side() < kNoted)
    {
      m_Faces[edge.Coface() + 2] |= static_cast<Word>(1U << edge.Side());
    }
  }
  std::span<const ElementIndex>
  VerticesAt(std::uint32_t place) const
  {
    return { &m_Cells.faceVertices[place], m_Faces[place + 1] };
  }
  std::span<const ElementIndex>
  EdgesAt(std::uint32_t place) const
  {
    return { &m_Cells.faceEdges[place], m_Faces[place + 1] };
  }

  void
  GatherFaces(const LiveElements & left);
  void
  OfferAll();
  double
  CostOf(ElementIndex edge, ReachedVertices & reached) const;
  TwoLengths
  WorstGaps(ElementIndex a, ElementIndex c, const CoreBall & y) const;
  std::uint64_t
  MeetingCorners(std::uint32_t place, std::size_t count) const;
  std::size_t
  OuterFreeSide(std::uint32_t place, std::size_t side) const;
  void
  Remove(ElementIndex edge, std::size_t level);
  void
  FetchFace(std::uint32_t place) const;
  void
  FetchAhead(std::size_t at) const;
  void
  Wait(ElementIndex edge, double cost)
  {
    AddToTurn(m_Turns[m_Levels.LevelOf(cost)], edge);
    ++m_Waiting;
  }

  const CellComplex &                    m_Cells;
  const ToleranceLevels &                m_Levels;
  const TouchedPlaces &                  m_Touched;
  std::vector<CoreBall> &                m_Balls;
  bool                                   m_FetchesAhead;
  std::vector<RemainingElements>         m_Edges;
  std::vector<Word>                      m_Faces;
  std::vector<std::vector<ElementIndex>> m_Turns; // edges by level
  std::size_t                            m_Waiting = 0;
  std::vector<ElementIndex>              m_Open; // free edges, wave after wave
  ReachedVertices                        m_Reached;
  std::vector<ElementIndex>              m_Burnt; // never moves
};

} // namespace voxelcore
