#pragma once
// The collapse behind ComputeBumps().

#include "voxelcore/BumpPruning.h"

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

class BumpCollapse
{
public:
  BumpCollapse(const MedialComplex &             core,
               const SpacingWeights &            weights,
               const std::vector<LatticePoint> & points,
               const std::vector<ElementIndex> & touching,
               double                            floor,
               const ProgressCallback &          progress);

  BumpValues
  Run(const ProgressCallback & progress);

private:
  // Free element e with its only coface, when last looked at. Least first by cost, then measure, dimension, index.
  struct Pair
  {
    double        cost;
    double        measure; // of e
    std::uint32_t isEdge;  // dimension of e: 0 vertex, 1 edge
    ElementIndex  element; // e

    friend bool
    operator>(const Pair & a, const Pair & b)
    {
      if (a.cost != b.cost)
      {
        return a.cost > b.cost;
      }
      if (a.measure != b.measure)
      {
        return a.measure > b.measure;
      }
      return a.isEdge != b.isEdge ? a.isEdge > b.isEdge : a.element > b.element;
    }
  };
  // Number of live cofaces and the exclusive-or of their indices: with one left, that is its index.
  struct Cofaces
  {
    ElementIndex count = 0;
    ElementIndex exclusiveOr = 0;
  };

  static constexpr double kLive = -2;
  static constexpr double kBelowFloor = -1;

  void
  DropBelow(double floor, const ProgressCallback & progress);
  void
  CountCofaces();
  void
  FindNeighbours();

  // Centre and radius of a vertex' ball in mm, beside each other in memory.
  struct Ball
  {
    std::array<double, 3> centre;
    double                radius;
  };
  static double
  Distance(const std::array<double, 3> & p, const std::array<double, 3> & q)
  {
    const double dx = p[0] - q[0];
    const double dy = p[1] - q[1];
    const double dz = p[2] - q[2];
    return std::sqrt(dx * dx + dy * dy + dz * dz);
  }
  // How far a boundary vertex lies from the ball of y, in mm.
  double
  Gap(std::uint32_t point, ElementIndex y) const
  {
    const LatticePoint & p = (*m_Points)[point];
    return Distance({ m_Scale[0] * p.x, m_Scale[1] * p.y, m_Scale[2] * p.z }, m_Balls[y].centre) - m_Balls[y].radius;
  }
  // By how much the ball of x sticks out of the ball of y, in mm.
  double
  Protrusion(ElementIndex x, ElementIndex y) const
  {
    const Ball & p = m_Balls[x];
    const Ball & q = m_Balls[y];
    return Distance(p.centre, q.centre) + (p.radius - q.radius);
  }

  void
  Keep(ElementIndex vertex, std::uint32_t point);

  // When fire has crossed the only face of a free edge.
  double
  FaceCost(ElementIndex edge);
  // When other balls are near enough to the boundary vertices that a loose vertex keeps.
  double
  VertexCost(ElementIndex vertex);
  void
  CollectKeepers(ElementIndex vertex, ElementIndex other);

  void
  OfferVertex(ElementIndex vertex);
  void
  OfferEdge(ElementIndex edge);
  void
  RemoveFace(ElementIndex edge);
  void
  RemoveVertex(ElementIndex vertex);
  void
  DropEdge(ElementIndex edge);
  void
  Push(const Pair & pair);

  bool
  IsLive(ElementIndex vertex) const
  {
    return m_Bumps.vertices[vertex] == kLive;
  }

  const MedialComplex *             m_Core;
  const std::vector<LatticePoint> * m_Points;
  std::array<double, 3>             m_Scale; // mm a lattice unit
  std::vector<Ball>                 m_Balls;
  double                            m_Level = 0;
  BumpValues                        m_Bumps; // kLive while the element is there
  std::vector<Cofaces>              m_VertexCofaces;
  std::vector<Cofaces>              m_EdgeCofaces;
  std::vector<std::uint32_t>        m_NeighbourStart; // per vertex into m_Neighbours
  std::vector<ElementIndex>         m_Neighbours;     // along the edges of the core, gone or not
  std::vector<ElementIndex> m_Uphill; // the neighbour towards which the radius grows most steeply; self at a top
  std::vector<ElementIndex> m_Witness;
  std::vector<double>       m_Burnt; // when fire reached the vertex; 0 at first
  // The boundary vertices that a core vertex keeps, as a ring: the last of them, and of each the next.
  std::vector<std::uint32_t> m_LastKept;
  std::vector<std::uint32_t> m_NextKept;
  std::vector<Pair>          m_Heap;

  // Boundary vertices that are no longer followed one by one: none of those a vertex keeps is farther from its ball.
  std::vector<double> m_Reserve;
  std::size_t         m_Looks = 0;

  // What the last cost was made of: RemoveFace() and RemoveVertex() follow a cost computed in the same state.
  struct Reached
  {
    ElementIndex vertex;
    ElementIndex witness;
    double       time;
  };
  struct Home
  {
    ElementIndex vertex;
    double       gap;
  };
  ElementIndex              m_Heir = 0; // the other end of a loose vertex' edge
  std::vector<Reached>      m_Reached;
  std::vector<ElementIndex> m_Keepers;  // candidates
  std::vector<Home>         m_NewHomes; // per kept boundary vertex in the order of the ring
};

} // namespace voxelcore
