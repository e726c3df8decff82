#pragma once
// A complex' faces in pieces, some of which are passed over.

#include "voxelcore/Sheets/MedialSheets.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

namespace voxelcore
{

/** A piece of faces. Lengths as in MedialSheets.h. */
struct SheetPiece
{
  double standOut = 0; ///< infinite without seams
  double freeBorder = 0;
  double seamBorder = 0;
  double drawnBorder = 0; ///< of that, lines that were drawn
  double seamWidth = 0;   ///< mean of twice the radius at its seams
  double area = 0;
};

class SheetPieces
{
public:
  explicit SheetPieces(const MedialComplex & core);

  /** Passes over fins that stand out by less than this share of `sliver`, or of what a rim's bevels may, until there
   *  are none; whether there were any. */
  bool
  RemoveFins(double sliver, double share);

  /** Finds the pieces of the faces that are left. */
  void
  Find();

  /** Draws seams that end on the way on to the nearest border, or to another
   * seam, through what goes round their end: by edges of together less than
   * the radius there and `reach`, or that radius if it is more. Pieces are
   * parted there, too. */
  void
  DrawSeamsOn(double reach);

  /** Parts pieces that hang together only by what lies within the balls of their seams; parts that stand out of these
   *  by less than this, or than their radius, are no reason to. Pieces have to be found before and after. */
  void
  DrawThroughNecks(double height);

  /** Whether an edge parts two pieces where a seam was drawn on. */
  bool
  IsDrawn(ElementIndex edge) const
  {
    return m_Drawn[edge] != 0;
  }

  /** Whether a piece was joined as one that lies between seams; pieces as
   * PieceOfFaces() does not number them. */
  bool
  IsStrip(ElementIndex face) const
  {
    return m_Strip[m_PieceOf[face]] != 0;
  }
  std::uint32_t
  OwnPiece(ElementIndex face) const
  {
    return m_PieceOf[face];
  }

  /** Joins pieces that lie between seams and are slivers. */
  void
  JoinStrips(double height);

  /** Of each face its piece; fins have that of the faces they hang on, or are
   * kNoPiece. Pieces that were joined have one number. */
  std::vector<std::uint32_t>
  PieceOfFaces() const;

  std::span<const ElementIndex>
  FacesOf(ElementIndex edge) const
  {
    return { m_EdgeFaces.data() + m_EdgeOffsets[edge], m_EdgeFaces.data() + m_EdgeOffsets[edge + 1] };
  }
  /** Without fins. */
  std::uint32_t
  LiveCount(ElementIndex edge) const
  {
    return m_Live[edge];
  }
  bool
  IsLive(ElementIndex face) const
  {
    return m_Alive[face] != 0;
  }
  double
  EdgeLength(ElementIndex edge) const;

private:
  /** Of a piece, where it hangs together. */
  bool
  IsInner(ElementIndex edge) const
  {
    return m_Live[edge] == 2 && m_Drawn[edge] == 0;
  }
  /** Of pieces, on a seam. */
  bool
  IsBorder(ElementIndex edge) const
  {
    return m_Live[edge] > 2 || (m_Drawn[edge] != 0 && m_Live[edge] == 2);
  }
  /** Whether a piece stands out of its seams by less than this, or than half of what their balls are wide. */
  static bool
  IsSliver(const SheetPiece & piece, double height)
  {
    return piece.standOut < std::max(height, piece.seamWidth / 2);
  }
  void
  Measure();
  /** Of each vertex the way along faces to a seam's, less the radius there, which `radii` gets. */
  std::vector<double>
  WaysFromSeams(std::vector<double> & radii) const;
  /** Faces round a vertex, from a seam's edge to the next seam's. */
  struct Sector
  {
    ElementIndex              begin; ///< face
    ElementIndex              end;   ///< face
    std::vector<ElementIndex> edges; ///< passed
    ElementIndex              last;  ///< edge
  };
  /** Where a seam ends, or turns back round the tip of a strip, and edges beyond. */
  struct SeamEnd
  {
    ElementIndex              vertex;
    std::vector<ElementIndex> ways;
  };
  std::vector<Sector>
  SectorsAt(ElementIndex vertex, ElementIndex seam) const;
  /** Edges. */
  std::vector<ElementIndex>
  SeamsAt(ElementIndex vertex) const;
  /** Vertices of seams that these lead to by less than `reach`. */
  std::set<ElementIndex>
  NearAlongSeams(ElementIndex from, double reach) const;
  std::vector<SeamEnd>
  EndsAt(ElementIndex vertex, double reach) const;
  void
  DrawOn(const SeamEnd &                    from,
         const std::vector<std::uint32_t> & chains,
         const std::vector<char> &          isEnd,
         double                             reach);
  /** Which pieces are fins; of pieces that hang together one stays. */
  std::vector<std::uint8_t>
  FinsBelow(double sliver, double share) const;
  /** A fin that parts two pairs of larger pieces, each along a quarter of its seams, is none: it lies between these. */
  void
  KeepStrips(std::vector<std::uint8_t> & fins) const;
  /** Fills in all but the area. */
  void
  MeasureStandOut(std::span<const ElementIndex> faces, SheetPiece & piece);
  /** Within a face, square to an edge of it, unit length. */
  Vector3
  Inwards(ElementIndex face, ElementIndex edge) const;

  const MedialComplex &      m_Core;
  std::vector<std::uint64_t> m_EdgeOffsets;
  std::vector<ElementIndex>  m_EdgeFaces;
  std::vector<std::uint32_t> m_Live;          ///< faces per edge without fins
  std::vector<std::uint8_t>  m_Drawn;         ///< edges on which a seam was drawn on
  std::vector<std::uint8_t>  m_Strip;         ///< per piece
  std::vector<std::uint64_t> m_AroundOffsets; ///< per vertex, of its edges
  std::vector<ElementIndex>  m_Around;
  std::vector<std::uint8_t>  m_Alive;
  std::vector<std::uint32_t> m_PieceOf; ///< per face
  std::vector<SheetPiece>    m_Pieces;
  std::vector<std::uint32_t> m_Joined; ///< per piece: the one it belongs to
  std::vector<std::uint32_t> m_Local;  ///< per vertex, while a piece is measured
};

} // namespace voxelcore
