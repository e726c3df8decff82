// Pieces that hardly stand out are passed over.

#include "SheetPieces.h"

#include "voxelcore/UnionFind.h"

#include <algorithm>

namespace voxelcore
{

namespace
{

constexpr double kFreeShare = 0.25;  ///< of a fin's border that is free, at least
constexpr double kBevel = 1.0 / 3.0; ///< of the balls' width at its seams a fin may always stand out

} // namespace

std::vector<std::uint8_t>
SheetPieces::FinsBelow(double sliver, double share) const
{
  UnionFind sets(m_Pieces.size());
  for (ElementIndex edge = 0; edge < m_Live.size(); ++edge)
  {
    std::uint32_t before = kNoPiece;
    for (const ElementIndex face : FacesOf(edge))
    {
      if (m_Alive[face] != 0)
      {
        before == kNoPiece ? void() : sets.Unite(before, m_PieceOf[face]);
        before = m_PieceOf[face];
      }
    }
  }
  std::vector<std::uint8_t>  fins(m_Pieces.size(), 0);
  std::vector<std::uint32_t> kept(m_Pieces.size(),
                                  kNoPiece); // per set one that stays
  for (std::uint32_t piece = 0; piece < m_Pieces.size(); ++piece)
  {
    const SheetPiece & one = m_Pieces[piece];
    const double       height = share * std::max(sliver, kBevel * one.seamWidth);
    fins[piece] = one.standOut < height && one.freeBorder >= kFreeShare * (one.freeBorder + one.seamBorder) ? 1 : 0;
    std::uint32_t & stays = kept[sets.Find(piece)];
    if (stays == kNoPiece || one.standOut > m_Pieces[stays].standOut || (fins[stays] != 0 && fins[piece] == 0))
    {
      stays = fins[piece] == 0 || stays == kNoPiece || fins[stays] != 0 ? piece : stays;
    }
  }
  for (const std::uint32_t piece : kept)
  {
    if (piece != kNoPiece)
    {
      fins[piece] = 0;
    }
  }
  KeepBridges(fins);
  return fins;
}

void
SheetPieces::KeepBridges(std::vector<std::uint8_t> & fins) const
{
  if (std::find(fins.begin(), fins.end(), 1) == fins.end())
  {
    return;
  }
  UnionFind           rest(m_Pieces.size()); // without fins
  std::vector<double> areas(m_Pieces.size(), 0);
  const auto          forBorders = [&](auto && visit) {
    for (ElementIndex edge = 0; edge < m_Live.size(); ++edge)
    {
      const auto faces = IsBorder(edge) ? FacesOf(edge) : std::span<const ElementIndex>();
      for (const ElementIndex one : faces)
      {
        for (const ElementIndex other : faces)
        {
          if (m_Alive[one] != 0 && m_Alive[other] != 0 && fins[m_PieceOf[other]] == 0)
          {
            visit(m_PieceOf[one], m_PieceOf[other]);
          }
        }
      }
    }
  };
  forBorders([&](std::uint32_t one, std::uint32_t other) { fins[one] == 0 ? void(rest.Unite(one, other)) : void(); });
  for (std::uint32_t piece = 0; piece < m_Pieces.size(); ++piece)
  {
    areas[rest.Find(piece)] += m_Pieces[piece].area;
  }
  std::vector<std::uint32_t> hangsOn(m_Pieces.size(), kNoPiece);
  std::vector<std::uint32_t> bridges;
  forBorders([&](std::uint32_t fin, std::uint32_t other) {
    const std::uint32_t part = rest.Find(other);
    if (fins[fin] != 0 && areas[part] > m_Pieces[fin].area)
    {
      hangsOn[fin] = hangsOn[fin] == kNoPiece ? part : hangsOn[fin];
      hangsOn[fin] != part ? bridges.push_back(fin) : void();
    }
  });
  for (const std::uint32_t fin : bridges)
  {
    fins[fin] = 0;
  }
}

bool
SheetPieces::RemoveFins(double sliver, double share)
{
  bool any = false;
  for (bool removed = true; removed;)
  {
    Find();
    const std::vector<std::uint8_t> fins = FinsBelow(sliver, share);
    removed = false;
    for (ElementIndex face = 0; face < m_PieceOf.size(); ++face)
    {
      if (m_PieceOf[face] != kNoPiece && fins[m_PieceOf[face]] != 0)
      {
        m_Alive[face] = 0;
        removed = any = true;
        for (const ElementIndex edge : m_Core.cells.FaceEdges(face))
        {
          --m_Live[edge];
        }
      }
    }
  }
  return any;
}

} // namespace voxelcore
