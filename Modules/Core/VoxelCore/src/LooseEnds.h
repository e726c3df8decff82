#pragma once
// Loose ends of a core's curves, and who keeps what they kept.

#include "CoreBall.h"
#include "RemainingElements.h"
#include "ToleranceLevels.h"

#include "voxelcore/Complex/CellComplex.h"
#include "voxelcore/Complex/SimplePairCollapse.h"
#include "voxelcore/Lattice/LatticePoint.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace voxelcore
{

/** Takes vertices with their only edges, level by level. It asks for nothing that fire changes: edges and faces may
 *  burn at the same time. */
class LooseEnds
{
public:
  /** `left`: what is there to begin with; all where it is empty. `scale` is the mm of a lattice unit along each axis,
   *  `weights` (empty: all 1) and `largest` those of TouchingBalls. */
  LooseEnds(const CellComplex &               cells,
            const LiveElements &              left,
            const std::vector<LatticePoint> & points,
            const BallCentre &                scale,
            const std::vector<double> &       weights,
            const std::vector<ElementIndex> & largest,
            const ToleranceLevels &           levels,
            std::vector<CoreBall> &           balls);

  /** Takes what can go at this level, once these edges have burnt; levels are to be taken in order. */
  void
  Take(std::size_t level, std::span<const ElementIndex> burnt);

  /** Whether no vertex waits for a later level. */
  bool
  IsOut() const
  {
    return m_Waiting == 0;
  }

  /** Edges that went with their vertices, and these. */
  std::vector<std::pair<ElementIndex, ElementIndex>>
  TakeGone()
  {
    return std::move(m_Gone);
  }

  /** At which height each vertex went, infinity where it did not. */
  std::vector<double>
  TakeVertexHeights();

private:
  struct Home
  {
    ElementIndex  vertex;
    std::uint32_t next; ///< of the candidates
    double        gap;
  };

  /** Of what a vertex keeps. */
  struct Farthest
  {
    double       gap;
    std::size_t  home;
    WeighedPlace place;
  };
  struct Near
  {
    double       gap;
    ElementIndex vertex;
  };

  /** A list that is added to without branches. */
  class Vertices
  {
  public:
    void
    Clear()
    {
      m_Count = 0;
    }
    std::size_t
    Count() const
    {
      return m_Count;
    }
    ElementIndex
    operator[](std::size_t i) const
    {
      return m_List[i];
    }
    /** Before so many are added. */
    void
    MakeRoom(std::size_t more)
    {
      if (m_List.size() < m_Count + more)
      {
        m_List.resize(2 * (m_Count + more));
      }
    }
    void
    AddIf(ElementIndex vertex, bool isWanted)
    {
      m_List[m_Count] = vertex;
      m_Count += isWanted ? 1 : 0;
    }

  private:
    std::vector<ElementIndex> m_List;
    std::size_t               m_Count = 0;
  };

  WeighedPlace
  PlaceOf(std::uint32_t point) const
  {
    return { PlaceFromFirst(m_Points[point], m_Points.front(), m_Scale), m_Weights.empty() ? 1.0 : m_Weights[point] };
  }
  bool
  IsLive(ElementIndex vertex) const
  {
    return m_Standing[vertex].IsLive();
  }

  void
  FindNeighbours(const LiveElements & left);
  void
  Keep(ElementIndex vertex, std::uint32_t point, double gap);
  // All that one vertex keeps goes to another.
  void
  HandOver(ElementIndex from, ElementIndex to, double gap);

  // When other balls are near enough to the boundary vertices that a loose vertex keeps.
  double
  CostOf(ElementIndex vertex);
  std::uint32_t
  FarthestKept(std::uint32_t last, const CoreBall & heir);
  double
  FindHomes(ElementIndex vertex);
  Farthest
  OfferCandidates(std::uint32_t last);
  double
  OfferHome(Home & home, const WeighedPlace & place, ElementIndex vertex) const;
  ElementIndex
  Uphill(ElementIndex vertex);
  void
  CollectKeepers(ElementIndex vertex, ElementIndex other);
  void
  SearchAround(ElementIndex vertex, const WeighedPlace & place, Home & home);

  // What dropping that edge will ask for, step by step.
  void
  FetchAhead(std::span<const ElementIndex> burnt, std::size_t at) const;
  void
  TakeOpen();
  void
  Drop(ElementIndex edge);
  void
  Remove(ElementIndex vertex);

  const CellComplex &                                m_Cells;
  const std::vector<LatticePoint> &                  m_Points;
  BallCentre                                         m_Scale;
  const std::vector<double> &                        m_Weights; // of the points; empty: all 1
  double                                             m_LargestWeight = 1;
  const ToleranceLevels &                            m_Levels;
  std::vector<CoreBall> &                            m_Balls;
  std::vector<RemainingElements>                     m_Standing;       // vertices, with the edges at each
  std::vector<ElementIndex>                          m_Neighbours;     // along the edges of the core, gone or not
  std::vector<std::uint32_t>                         m_FirstNeighbour; // of each vertex, and the end
  std::vector<std::uint32_t>                         m_NextKept; // rings of the boundary vertices that a ball keeps
  std::vector<std::vector<ElementIndex>>             m_Turns;    // vertices by level
  std::size_t                                        m_Waiting = 0;
  std::vector<ElementIndex>                          m_Open; // vertices whose cost is to be looked at
  std::vector<std::pair<ElementIndex, ElementIndex>> m_Gone;
  double                                             m_Height = 0;

  // What the last cost was made of: Remove() follows a cost computed in the same state.
  ElementIndex      m_Heir = 0;       // the other end of a loose vertex' edge
  bool              m_ToHeir = false; // to which all goes, none farther from it than m_HeirGap
  double            m_HeirGap = 0;
  Vertices          m_Candidates;
  std::vector<Near> m_Around;   // a heap, the nearest on top
  std::uint32_t     m_Look = 0; // number of the last look around
  std::vector<Home> m_NewHomes; // per kept boundary vertex in the order of the ring
};

} // namespace voxelcore
