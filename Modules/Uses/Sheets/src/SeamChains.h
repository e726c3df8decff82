#pragma once
// Seams, rods and junctions of a complex whose faces are in pieces.

#include "SheetPieces.h"
#include "ShortRods.h"

#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Sheets/MedialSheets.h"

#include <cstdint>
#include <map>
#include <vector>

namespace voxelcore
{

/** Chains of edges with three faces or more, or with none; rules as in MedialSheets.h. Faces of no sheet are a part of
 *  the rods that end at them. All is borrowed. */
class SeamChains
{
public:
  SeamChains(const MedialComplex &              core,
             const SheetPieces &                pieces,
             const ShortRods &                  shortRods,
             const std::vector<std::uint32_t> & sheetOfFace,
             double                             sliver);

  void
  Find();

  /** Fills in curves, junctions and curveOfEdge. */
  void
  Number(MedialSheets & result);

private:
  /** A seam's edge, or a rod's. */
  struct CurveEdge
  {
    bool                       isRod = false;
    std::vector<std::uint32_t> sheets{};         ///< at the edge, one as often as it is
    std::vector<std::uint32_t> key{};            ///< those that meet in the seam, each once
    std::uint32_t              strip = kNoPiece; ///< it is on the border of these strips, which hang together
  };
  struct Chain
  {
    CurveRecord               record;
    std::vector<ElementIndex> edges;
  };

  bool
  IsSeam(ElementIndex edge) const;
  /** Calls visit(face, whether it is a strip's) for the faces at an edge that are no fins. */
  template <typename TVisit>
  void
  ForFaces(ElementIndex edge, TVisit && visit) const;
  /** What lies between seams is taken for a part of them: all sheets about it meet in one seam, along all its sides. */
  void
  FindSeamEdges();
  /** Short ones, of which those that hang on what is no sheet are drawn together with it. */
  void
  RemoveShortRods();
  bool
  HasFaces(ElementIndex vertex) const;
  /** Draws together what a rod or a seam joins. */
  void
  DrawTogether(const Chain & chain);
  /** Passes over curves that are too short to tell; whether there were any. */
  bool
  RemoveShortOnes();
  /** Whether a seam is shorter than the balls there are wide, or a rod between junctions. */
  bool
  IsJunction(const Chain & chain);
  /** Whether three curves or more end at a seam that is the border of strips alone. */
  bool
  IsPatch(const Chain & chain);
  /** Whether a rod that hangs on a sheet, or on other rods, by one end hardly stands out. */
  bool
  IsSpur(const CurveRecord & rod);
  /** Whether curves pass through a node without stopping. */
  bool
  GoesOn(std::uint32_t node) const;
  void
  FindChains();
  /** Makes chains one seam where the same sheets meet in them and they touch or run along the same strips. */
  void
  GroupChains();
  /** Several chains as one. */
  Chain
  OneOf(std::vector<std::uint32_t> & group) const;

  const MedialComplex &                              m_Core;
  const CellComplex &                                m_Cells;
  const SheetPieces &                                m_Pieces;
  const ShortRods &                                  m_ShortRods;
  const std::vector<std::uint32_t> &                 m_SheetOfFace;
  double                                             m_Sliver;
  UnionFind                                          m_Nodes;   ///< of vertices: what was drawn together
  std::vector<std::uint32_t>                         m_FacesAt; ///< of sheets, at a vertex or a node
  std::map<ElementIndex, CurveEdge>                  m_Edges;
  std::map<std::uint32_t, std::vector<ElementIndex>> m_EdgesAt; ///< by node
  std::map<std::uint32_t, std::size_t>               m_Gone;    ///< edges that spurs took from a node
  std::vector<Chain>                                 m_Chains;
};

} // namespace voxelcore
