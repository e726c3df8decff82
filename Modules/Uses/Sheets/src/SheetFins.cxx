// Pieces that hardly stand out are passed over.

#include "SheetPieces.h"

#include "voxelcore/Base/UnionFind.h"

#include <algorithm>
#include <array>
#include <map>

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
    const bool         isFree = one.freeBorder >= kFreeShare * (one.freeBorder + one.seamBorder);
    fins[piece] = one.standOut < height && isFree && 2 * one.drawnBorder <= one.seamBorder ? 1 : 0;
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
  KeepStrips(fins);
  return fins;
}

void
SheetPieces::KeepStrips(std::vector<std::uint8_t> & fins) const
{
  if (std::find(fins.begin(), fins.end(), 1) == fins.end())
  {
    return;
  }
  using Pair = std::array<std::uint32_t, 2>;
  std::map<std::uint32_t, std::map<Pair, double>> lengths; // of each fin's feet, by what it parts there
  for (ElementIndex edge = 0; edge < m_Live.size(); ++edge)
  {
    std::uint32_t fin = kNoPiece;
    Pair          others{ kNoPiece, kNoPiece };
    for (const ElementIndex face : m_Live[edge] == 3 ? FacesOf(edge) : std::span<const ElementIndex>())
    {
      if (m_Alive[face] != 0)
      {
        std::uint32_t & place = fins[m_PieceOf[face]] != 0 ? fin : others[others[0] == kNoPiece ? 0 : 1];
        place = m_PieceOf[face];
      }
    }
    if (fin != kNoPiece && others[1] != kNoPiece &&
        std::min(m_Pieces[others[0]].area, m_Pieces[others[1]].area) > m_Pieces[fin].area)
    {
      lengths[fin][{ std::min(others[0], others[1]), std::max(others[0], others[1]) }] += EdgeLength(edge);
    }
  }
  for (auto & [fin, pairs] : lengths)
  {
    const double least = kFreeShare * m_Pieces[fin].seamBorder; // clang 14 takes no structured bindings into lambdas
    std::erase_if(pairs, [least](const auto & pair) { return pair.second < least; });
    const Pair first = pairs.empty() ? Pair{} : pairs.begin()->first;
    const auto isApart = [&](const auto & pair) {
      return std::find_first_of(first.begin(), first.end(), pair.first.begin(), pair.first.end()) == first.end();
    };
    fins[fin] = std::any_of(pairs.begin(), pairs.end(), isApart) ? 0 : 1;
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
