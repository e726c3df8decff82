#pragma once
// A shape with room around it, so that windows about its voxels can be read without asking where they end.

#include "voxelcore/Shape/SimpleVoxel.h"

#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <bit>
#include <utility>

namespace voxelcore
{

using Voxel = std::array<std::int32_t, 3>;

/** Voxels are counted from the lower corner of the shape's box grown by `kRoom` on every side. */
class PaddedShape
{
public:
  static constexpr std::int32_t kRoom = 4;

  explicit PaddedShape(const VoxelShape & shape);

  const Voxel &
  Size() const
  {
    return m_Shape.Box().size;
  }

  /** Up to 31 voxels from one on along x, in the lowest bits. */
  std::uint32_t
  Bits(std::int32_t x, std::int32_t y, std::int32_t z, unsigned count) const
  {
    const auto     row = m_Shape.Row(y, z);
    const auto     word = static_cast<std::size_t>(x) / 64;
    const unsigned shift = static_cast<unsigned>(x) % 64;
    std::uint64_t  bits = row[word] >> shift;
    if (shift + count > 64)
    {
      bits |= row[word + 1] << (64 - shift);
    }
    return static_cast<std::uint32_t>(bits) & ((1U << count) - 1);
  }

  /** With the room. */
  const VoxelShape &
  Voxels() const
  {
    return m_Shape;
  }

  bool
  Contains(const Voxel & at) const
  {
    return Bits(at[0], at[1], at[2], 1) != 0;
  }

  /** Not for voxels on the outermost layer of the room. */
  Neighbourhood
  Around(const Voxel & at) const
  {
    Neighbourhood around = 0;
    unsigned      shift = 0;
    for (std::int32_t z = at[2] - 1; z <= at[2] + 1; ++z)
    {
      for (std::int32_t y = at[1] - 1; y <= at[1] + 1; ++y, shift += 3)
      {
        around |= Bits(at[0] - 1, y, z, 3) << shift;
      }
    }
    return around;
  }

  void
  Flip(const Voxel & at)
  {
    m_Shape.Row(at[1], at[2])[static_cast<std::size_t>(at[0]) / 64] ^= std::uint64_t{ 1 }
                                                                       << (static_cast<unsigned>(at[0]) % 64);
  }

  /** Calls visit(voxel) for the voxels of a row at the boundary, in or out: those whose 27 are neither all in nor all
   *  out. They lie at most one voxel outside the shape's box. */
  template <typename TVisit>
  void
  VisitBoundary(std::int32_t y, std::int32_t z, const TVisit & visit) const;

  /** In a tight box. */
  VoxelShape
  Release() &&
  {
    return CropToVoxels(std::move(m_Shape));
  }

private:
  VoxelShape m_Shape;
};

/** The six that share a face with a voxel. */
inline std::array<Voxel, 6>
FaceNeighbours(const Voxel & at)
{
  const auto [x, y, z] = at;
  return { { { x - 1, y, z }, { x + 1, y, z }, { x, y - 1, z }, { x, y + 1, z }, { x, y, z - 1 }, { x, y, z + 1 } } };
}

template <typename TVisit>
void
PaddedShape::VisitBoundary(std::int32_t y, std::int32_t z, const TVisit & visit) const
{
  const std::size_t            words = m_Shape.WordsPerRow();
  std::array<ConstShapeRow, 9> rows;
  for (std::int32_t k = 0; k < 9; ++k)
  {
    rows[static_cast<std::size_t>(k)] = m_Shape.Row(y + k / 3 - 1, z + k % 3 - 1);
  }
  const auto columns = [&](std::size_t word) {
    std::pair<std::uint64_t, std::uint64_t> anyAll{ 0, ~std::uint64_t{ 0 } };
    for (const ConstShapeRow & row : rows)
    {
      const std::uint64_t bits = row[word];
      anyAll = { anyAll.first | bits, anyAll.second & bits };
    }
    return anyAll;
  };
  std::pair<std::uint64_t, std::uint64_t> before{ 0, 0 };
  auto                                    here = columns(0);
  for (std::size_t word = 0; word < words; ++word)
  {
    const auto          after = word + 1 < words ? columns(word + 1) : std::pair<std::uint64_t, std::uint64_t>{ 0, 0 };
    const auto          left = [](std::uint64_t low, std::uint64_t high) { return high << 1 | low >> 63; };
    const auto          right = [](std::uint64_t low, std::uint64_t high) { return low >> 1 | high << 63; };
    const std::uint64_t any = here.first | left(before.first, here.first) | right(here.first, after.first);
    const std::uint64_t all = here.second & left(before.second, here.second) & right(here.second, after.second);
    for (std::uint64_t mixed = any & ~all; mixed != 0; mixed &= mixed - 1)
    {
      visit(Voxel{ static_cast<std::int32_t>(64 * word) + std::countr_zero(mixed), y, z });
    }
    before = here;
    here = after;
  }
}

} // namespace voxelcore
