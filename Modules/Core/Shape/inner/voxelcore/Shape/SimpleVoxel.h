#pragma once
// Voxels that may change sides without a change of topology.

#include <array>
#include <cstddef>
#include <cstdint>

namespace voxelcore
{

/** Bits of the 27 voxels around one, which is bit 13; x runs fastest, bit 0 is (-1,-1,-1). */
using Neighbourhood = std::uint32_t;

/** Spreads a set of the 27 by one voxel along an axis, both ways. */
constexpr Neighbourhood
SpreadAlong(Neighbourhood set, unsigned step, Neighbourhood first, Neighbourhood last)
{
  return set | ((set & ~last) << step) | ((set & ~first) >> step);
}

constexpr Neighbourhood kAll27 = 0x7FFFFFFU;
constexpr Neighbourhood kCentre27 = 1U << 13;
constexpr Neighbourhood kFirstX = 0x1249249U;
constexpr Neighbourhood kLastX = kFirstX << 2;
constexpr Neighbourhood kFirstY = 0x01C0E07U;
constexpr Neighbourhood kLastY = kFirstY << 6;
constexpr Neighbourhood kFirstZ = 0x1FFU;
constexpr Neighbourhood kLastZ = kFirstZ << 18;
constexpr Neighbourhood kFaces27 = 1U << 4 | 1U << 10 | 1U << 12 | 1U << 14 | 1U << 16 | 1U << 22;
constexpr Neighbourhood kCorners27 = (kFirstX | kLastX) & (kFirstY | kLastY) & (kFirstZ | kLastZ);

/** A set and what touches it over faces. */
constexpr Neighbourhood
SpreadOverFaces(Neighbourhood set)
{
  return SpreadAlong(set, 1, kFirstX, kLastX) | SpreadAlong(set, 3, kFirstY, kLastY) |
         SpreadAlong(set, 9, kFirstZ, kLastZ);
}

/** A set and what touches it over faces, edges or corners. */
constexpr Neighbourhood
SpreadOverCorners(Neighbourhood set)
{
  return SpreadAlong(SpreadAlong(SpreadAlong(set, 1, kFirstX, kLastX), 3, kFirstY, kLastY), 9, kFirstZ, kLastZ);
}

/** Sets of the 27 that do not hang together; at most 6 of a shape, 8 of a background. */
struct Pieces
{
  std::array<Neighbourhood, 8> sets{};
  std::size_t                  count = 0;
};

/** The pieces of `within` that reach into `from`, where a piece holds whatever `spread` leads to. */
template <typename TSpread>
constexpr Pieces
FindPieces(Neighbourhood within, Neighbourhood from, TSpread spread)
{
  Pieces pieces;
  for (Neighbourhood left = within & from; left != 0; ++pieces.count)
  {
    Neighbourhood piece = left & (~left + 1);
    for (Neighbourhood before = 0; before != piece;)
    {
      before = piece;
      piece = spread(piece) & within;
    }
    pieces.sets[pieces.count] = piece;
    left &= ~piece;
  }
  return pieces;
}

/** Pieces of the shape that touch the centre over a face; they hang together over faces next to it. */
constexpr Pieces
ShapePieces(Neighbourhood shape)
{
  return FindPieces(shape & ~kCentre27 & ~kCorners27, kFaces27, SpreadOverFaces);
}

/** Pieces of the background around the centre, which hang together over corners. */
constexpr Pieces
BackgroundPieces(Neighbourhood shape)
{
  return FindPieces(~shape & kAll27 & ~kCentre27, kAll27, SpreadOverCorners);
}

/** Whether the voxel in the centre, in or out, is simple for 6-connected shapes in a 26-connected background: its flip
 *  changes neither components nor loops nor cavities (Bertrand and Malandain 1994). */
constexpr bool
IsSimpleVoxel(Neighbourhood shape)
{
  return ShapePieces(shape).count == 1 && BackgroundPieces(shape).count == 1;
}

/** Remembers answers of IsSimpleVoxel: most of a boundary looks alike. */
class SimpleVoxels
{
public:
  bool
  IsSimple(Neighbourhood shape)
  {
    const Neighbourhood around = shape & ~kCentre27;
    Neighbourhood &     known = m_Known[around * 0x9E3779B1U >> 21U];
    if ((known & ~kCentre27) != around)
    {
      known = around | (IsSimpleVoxel(around) ? kCentre27 : 0);
    }
    return (known & kCentre27) != 0;
  }

private:
  std::array<Neighbourhood, 2048> m_Known{}; // what lies around a voxel, its own bit the answer: of nothing, no
};

} // namespace voxelcore
