#pragma once
// Rods that hang on sheets and hardly stand out of these.

#include "SheetPieces.h"

#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Sheets/MedialSheets.h"

#include <cstdint>
#include <map>
#include <vector>

namespace voxelcore
{

/** Rods hang together where no sheet parts them. Such a net is short when it stands out of the sheets it hangs on by
 *  less than `sliver`, or by less than it is thick, as MedialSheets.h says. */
class ShortRods
{
public:
  ShortRods(const MedialComplex &              core,
            const SheetPieces &                pieces,
            const std::vector<std::uint32_t> & sheetOfFace,
            double                             sliver);

  /** Of short nets. */
  const std::vector<ElementIndex> &
  Edges() const
  {
    return m_Edges;
  }
  /** Of each of these edges the number of its net. */
  const std::vector<std::uint32_t> &
  NetsOfEdges() const
  {
    return m_NetsOfEdges;
  }

private:
  struct Reached
  {
    double       way = 0; // less the radius at the foot
    ElementIndex foot = 0;
  };
  struct Net
  {
    double standOut = 0;
    double length = 0;
    double thickness = 0; // times length
  };

  bool
  IsFoot(ElementIndex vertex) const
  {
    return m_SheetsAt.contains(vertex);
  }
  void
  FindRods(const std::vector<std::uint32_t> & sheetOfFace);
  void
  MeasureFromFeet();
  /** From one sheet to another a rod stands out by its whole length. */
  void
  MeasureBridges();

  const MedialComplex &                              m_Core;
  const SheetPieces &                                m_Pieces;
  std::map<ElementIndex, std::vector<ElementIndex>>  m_Around;   ///< rods at a vertex
  std::map<ElementIndex, std::vector<std::uint32_t>> m_SheetsAt; ///< at a rod's vertex on sheets, ascending
  UnionFind                                          m_Nets;     ///< of edges
  std::map<std::uint32_t, Net>                       m_Hanging;  ///< nets that hang on sheets
  std::map<ElementIndex, Reached>                    m_Ways;
  std::vector<ElementIndex>                          m_Edges;
  std::vector<std::uint32_t>                         m_NetsOfEdges;
};

} // namespace voxelcore
