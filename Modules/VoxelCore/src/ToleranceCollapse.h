#pragma once
// The collapse behind ComputeTolerances().

#include "RemainingElements.h"

#include "voxelcore/BucketQueue.h"
#include "voxelcore/TolerancePruning.h"

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

class ToleranceCollapse
{
public:
  ToleranceCollapse(const MedialComplex &             core,
                    const SpacingWeights &            weights,
                    const std::vector<LatticePoint> & points,
                    TouchingBalls                     touching,
                    double                            floor,
                    const ProgressCallback &          progress);

  ToleranceValues
  Run(const ProgressCallback & progress);

private:
  using Position = std::array<double, 3>;

  static constexpr double kBelowFloor = -1;
  // Up to so many voxel diagonals heights are measured. Ends of long curves drag along all that their lost parts kept:
  // beyond, the sum of what each vertex stuck out of the next stands for a look at it, which is never too small.
  static constexpr double kMeasured = 4;

  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  // Free element e with its only coface, when last looked at. Least first by cost, then measure, dimension, index.
  struct Pair
  {
    double        cost;
    double        measure; // of e
    std::uint32_t isEdge;  // dimension of e: 0 vertex, 1 edge
    ElementIndex  element; // e

    friend bool
    operator<(const Pair & a, const Pair & b)
    {
      if (a.cost != b.cost)
      {
        return a.cost < b.cost;
      }
      if (a.measure != b.measure)
      {
        return a.measure < b.measure;
      }
      return a.isEdge != b.isEdge ? a.isEdge < b.isEdge : a.element < b.element;
    }
  };
  // What is asked of a vertex again and again lies in one line of the cache. Lengths in mm.
  struct alignas(64) Vertex
  {
    Position      centre;
    double        radius;
    double        burnt = 0; // when fire reached it
    double        bound = 0; // none of the boundary vertices it keeps is farther from its ball
    ElementIndex  witness;   // the ball that fire came with
    ElementIndex  uphill; // the neighbour towards which the radius grows most steeply; self at a top; kNone: not asked
    std::uint32_t lastKept;   // of the ring of boundary vertices it keeps; m_NextKept has the next of each
    std::uint32_t neighbours; // into m_Neighbours; they end where the next vertex' begin
  };
  // A pair whose turn is not near, without the measure, which can be looked up.
  struct WaitingPair
  {
    double        cost;
    std::uint32_t isEdge;
    ElementIndex  element;

    double
    Key() const
    {
      return cost;
    }
  };
  struct Wake
  {
    const MedialComplex * core;

    Pair
    operator()(const WaitingPair & waiting) const
    {
      const auto & measures = waiting.isEdge != 0 ? core->edgeLambda : core->vertexLambda;
      return { waiting.cost, measures[waiting.element], waiting.isEdge, waiting.element };
    }
  };
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

  static double
  SquaredDistance(const Position & p, const Position & q)
  {
    const double dx = p[0] - q[0];
    const double dy = p[1] - q[1];
    const double dz = p[2] - q[2];
    return dx * dx + dy * dy + dz * dz;
  }
  Position
  PlaceOf(std::uint32_t point) const
  {
    const LatticePoint & p = (*m_Points)[point];
    const LatticePoint & first = m_Points->front(); // as TouchingBalls has it
    return { m_Scale[0] * (p.x - first.x), m_Scale[1] * (p.y - first.y), m_Scale[2] * (p.z - first.z) };
  }
  // How far a place lies from the ball of y.
  static double
  Gap(const Position & place, const Vertex & y)
  {
    return std::sqrt(SquaredDistance(place, y.centre)) - y.radius;
  }
  // By how much the ball of x sticks out of the ball of y.
  static double
  Protrusion(const Vertex & x, const Vertex & y)
  {
    return std::sqrt(SquaredDistance(x.centre, y.centre)) + (x.radius - y.radius);
  }
  bool
  IsLive(ElementIndex vertex) const
  {
    return m_VertexStanding[vertex].IsLive();
  }

  // ToleranceSetup.cxx
  void
  DropBelow(double floor, const ProgressCallback & progress);
  void
  CountCofaces();
  void
  FindNeighbours();

  void
  Keep(ElementIndex vertex, std::uint32_t point, double gap);
  // All that one vertex keeps goes to another.
  void
  HandOver(ElementIndex from, ElementIndex to, double gap);

  // When fire has crossed the only face of a free edge.
  double
  FaceCost(ElementIndex edge, std::vector<Reached> & reached) const;
  // When other balls are near enough to the boundary vertices that a loose vertex keeps.
  double
  VertexCost(ElementIndex vertex);
  double
  FindHomes(ElementIndex vertex);
  ElementIndex
  Uphill(ElementIndex vertex);
  void
  CollectKeepers(ElementIndex vertex, ElementIndex other);
  void
  CollectAround(ElementIndex vertex);

  void
  OfferAll();
  void
  OfferVertex(ElementIndex vertex);
  void
  RemoveLoose();
  void
  Fetch() const;
  void
  FetchFace(ElementIndex face) const;
  void
  OfferEdges(std::span<const ElementIndex> edges);
  void
  RemoveFace(ElementIndex edge);
  void
  RemoveVertex(ElementIndex vertex);
  void
  DropEdge(ElementIndex edge);
  ToleranceValues
  TakeTolerances();

  const MedialComplex *                m_Core;
  const std::vector<LatticePoint> *    m_Points;
  Position                             m_Scale; // mm a lattice unit
  double                               m_Level = 0;
  double                               m_Measured;       // level up to which gaps are looked at, mm
  std::vector<double>                  m_FaceTolerances; // infinity while the face is there
  std::vector<Vertex>                  m_Vertices;       // and one at the end, where neighbours end
  std::vector<RemainingElements>       m_VertexStanding;
  std::vector<RemainingElements>       m_EdgeStanding;
  std::vector<ElementIndex>            m_Neighbours; // along the edges of the core, gone or not
  std::vector<std::uint32_t>           m_NextKept;
  BucketQueue<Pair, WaitingPair, Wake> m_Queue;
  std::vector<ElementIndex>            m_Loose; // vertices whose cost is to be looked at
  std::vector<ElementIndex>            m_Freed; // edges of the last face that are free now

  // What the last cost was made of: RemoveFace() and RemoveVertex() follow a cost computed in the same state.
  std::vector<Reached>      m_Reached;
  ElementIndex              m_Heir = 0;       // the other end of a loose vertex' edge
  bool                      m_ToHeir = false; // to which all goes, none farther from it than m_HeirGap
  double                    m_HeirGap = 0;
  std::vector<ElementIndex> m_Keepers; // candidates
  std::vector<ElementIndex> m_Around;
  std::vector<Home>         m_NewHomes; // per kept boundary vertex in the order of the ring
};

} // namespace voxelcore
