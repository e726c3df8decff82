#pragma once
// What fire has taken between two heights, to be given other heights and collapsed anew.

#include "CoreBall.h"
#include "ToleranceLevels.h"

#include "voxelcore/Complex/SimplePairCollapse.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** Its elements are numbered anew, in the same order; whatever such an element bounds is here, too. */
class RimStrip
{
public:
  using Level = std::uint16_t;

  /** A face at an edge of several. */
  struct Meeting
  {
    ElementIndex edge; ///< of the core
    ElementIndex face; ///< of the core
    ElementIndex node; ///< of the strip, or Staying()
  };

  /** Of all elements those whose values lie in (low, high], in mm. */
  RimStrip(const CellComplex &     cells,
           const ToleranceValues & values,
           const ToleranceLevels & levels,
           double                  low,
           double                  high);

  /** Of the core. */
  const std::vector<ElementIndex> &
  Faces() const
  {
    return m_Faces;
  }
  ElementIndex
  EdgeOfCore(ElementIndex edge) const
  {
    return m_Edges[edge];
  }
  /** Those that are here. */
  std::span<const ElementIndex>
  EdgesOf(ElementIndex face) const
  {
    return { m_FaceEdges.data() + m_FaceOffsets[face], m_FaceEdges.data() + m_FaceOffsets[face + 1] };
  }
  const Cofaces &
  FacesAt(ElementIndex edge) const
  {
    return m_FacesAt[edge];
  }
  /** Where not just two faces of the strip meet; by edge. */
  const std::vector<Meeting> &
  Meetings() const
  {
    return m_Meetings;
  }
  /** Stands for all faces above the strip. */
  ElementIndex
  Staying() const
  {
    return static_cast<ElementIndex>(m_Faces.size());
  }
  const std::vector<Level> &
  FaceLevels() const
  {
    return m_FaceLevels;
  }

  /** Gives the faces these levels, none lower than before, and so raises what they are bounded by. */
  void
  RaiseTo(std::vector<Level> levels);

  /** Heights when everything has gone that is simple at its turn. Ends the strip's life. */
  void
  Collapse(const ToleranceLevels & levels, ToleranceValues & values);

private:
  void
  ConnectEdges(const CellComplex & cells);
  void
  ConnectFaces(const CellComplex & cells, const std::vector<double> & heights, double high);
  struct Turn
  {
    bool         isEdge;
    ElementIndex element;
  };
  void
  Offer(Level level, const Turn & offered)
  {
    AddToTurn(m_Turns[std::max(m_Level, std::size_t{ level })], offered);
  }
  void
  OfferEdge(ElementIndex edge)
  {
    if (m_EdgeLevels[edge] != kGone && m_FacesAt[edge].count == 1)
    {
      Offer(m_EdgeLevels[edge], { true, edge });
    }
  }
  void
  OfferVertex(ElementIndex vertex)
  {
    if (vertex != kNobody && m_VertexLevels[vertex] != kGone && m_EdgesAt[vertex].count == 1 &&
        m_FacesAt[m_EdgesAt[vertex].exclusiveOr].count == 0)
    {
      Offer(m_VertexLevels[vertex], { false, vertex });
    }
  }
  void
  RemoveEdge(ElementIndex edge, double height, ToleranceValues & values);
  void
  RemoveVertex(ElementIndex vertex, double height, ToleranceValues & values);

  static constexpr Level kGone = 0xFFFF;

  std::vector<ElementIndex>                m_Faces;
  std::vector<ElementIndex>                m_Edges;
  std::vector<ElementIndex>                m_Vertices;
  std::vector<Level>                       m_FaceLevels;
  std::vector<Level>                       m_EdgeLevels;
  std::vector<Level>                       m_VertexLevels;
  std::vector<Cofaces>                     m_FacesAt; // of each edge
  std::vector<Cofaces>                     m_EdgesAt; // of each vertex
  std::vector<std::array<ElementIndex, 2>> m_Ends;    // of each edge, those that are here
  std::vector<std::uint32_t>               m_FaceOffsets{ 0 };
  std::vector<ElementIndex>                m_FaceEdges; // of each face, those that are here
  std::vector<Meeting>                     m_Meetings;  // where not just two faces of the strip meet; by edge
  std::size_t                              m_Level = 0;
  std::vector<std::vector<Turn>>           m_Turns;
};

} // namespace voxelcore
