#pragma once
// Whether what lies around a voxel hangs together within ten voxels of it.

#include "voxelcore/Shape/PaddedShape.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace voxelcore
{

/** The part of a shape, or of its background, less than four voxels from one, which itself is left out: seven planes of
 *  seven rows, a byte each, whose last bit is never set. */
class NearWindow
{
public:
  NearWindow(const PaddedShape & shape, const Voxel & centre, bool background)
    : m_Background(background)
  {
    // What lies beyond the room is background.
    const Voxel &      size = shape.Size();
    const std::int32_t first = std::max(0, centre[0] - kReach);
    const auto         count = static_cast<unsigned>(std::min(size[0], centre[0] + kReach + 1) - first);
    for (std::int32_t k = 0; k < kSide; ++k)
    {
      const std::int32_t z = centre[2] - kReach + k;
      std::uint64_t      plane = 0;
      for (std::int32_t j = 0; j < kSide && z >= 0 && z < size[2]; ++j)
      {
        const std::int32_t y = centre[1] - kReach + j;
        if (y >= 0 && y < size[1])
        {
          const std::uint32_t row = shape.Bits(first, y, z, count) << (first + kReach - centre[0]);
          plane |= std::uint64_t{ row } << (8 * j);
        }
      }
      m_Set[static_cast<std::size_t>(k)] = background ? ~plane & kAll : plane;
    }
    m_Set[kReach] &= ~(std::uint64_t{ 1 } << (9 * kReach));
  }

  /** Whether all pieces around the centre hang together here, or one of them ends here; otherwise only a larger window
   *  can tell. */
  std::optional<bool>
  Connects(const Pieces & pieces) const
  {
    std::uint32_t left = (1U << pieces.count) - 2; // those that the first does not lead to
    for (std::size_t from = 0; from < pieces.count; ++from)
    {
      if (from != 0 && (left >> from & 1U) == 0)
      {
        continue;
      }
      const Planes reached = ReachedFrom(pieces.sets[from]);
      if (from == 0)
      {
        for (std::size_t other = 1; other < pieces.count; ++other)
        {
          left &= Meets(reached, pieces.sets[other]) ? ~(1U << other) : ~0U;
        }
        if (left == 0)
        {
          return true;
        }
      }
      if (!ReachesBorder(reached))
      {
        return false;
      }
    }
    return std::nullopt;
  }

private:
  static constexpr std::int32_t  kReach = 3;
  static constexpr std::int32_t  kSide = 2 * kReach + 1;
  static constexpr std::uint64_t kAll = 0x7F7F7F7F7F7F7FU;
  static constexpr std::uint64_t kBorder = kAll & ~(std::uint64_t{ 0x3E3E3E3E3E } << 8);

  using Planes = std::array<std::uint64_t, kSide>;

  /** Of a piece, what lies in the plane k around the centre. */
  static std::uint64_t
  Plane(Neighbourhood piece, std::size_t k)
  {
    const std::uint64_t rows = piece >> (9 * k) & 0x1FFU;
    return ((rows & 7U) | (rows & 0x38U) << 5 | (rows & 0x1C0U) << 10) << (9 * (kReach - 1));
  }

  static bool
  Meets(const Planes & reached, Neighbourhood piece)
  {
    return ((reached[kReach - 1] & Plane(piece, 0)) | (reached[kReach] & Plane(piece, 1)) |
            (reached[kReach + 1] & Plane(piece, 2))) != 0;
  }

  static bool
  ReachesBorder(const Planes & reached)
  {
    std::uint64_t all = reached.front() | reached.back();
    for (const std::uint64_t plane : reached)
    {
      all |= plane & kBorder;
    }
    return all != 0;
  }

  Planes
  ReachedFrom(Neighbourhood piece) const
  {
    Planes reached{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      reached[kReach - 1 + k] = Plane(piece, k);
    }
    for (bool grows = true; grows;)
    {
      grows = false;
      for (std::size_t k = 0; k < kSide; ++k)
      {
        const std::uint64_t beside = (k > 0 ? reached[k - 1] : 0) | (k + 1 < kSide ? reached[k + 1] : 0);
        const std::uint64_t plane = Spread(reached[k], beside) & m_Set[k];
        grows = grows || plane != reached[k];
        reached[k] = plane;
      }
    }
    return reached;
  }

  /** What touches a plane's set, and that of the planes beside it. */
  std::uint64_t
  Spread(std::uint64_t plane, std::uint64_t beside) const
  {
    if (!m_Background)
    {
      return plane | plane << 1 | plane >> 1 | plane << 8 | plane >> 8 | beside;
    }
    const std::uint64_t all = plane | beside;
    const std::uint64_t rows = all | all << 1 | all >> 1;
    return rows | rows << 8 | rows >> 8;
  }

  bool   m_Background;
  Planes m_Set{};
};

/** The part of a shape, or of its background, at most ten voxels from one, which itself is left out. */
class WideWindow
{
public:
  WideWindow(const PaddedShape & shape, const Voxel & centre, bool background)
    : m_Background(background)
  {
    // What lies beyond the room is background.
    const Voxel &      size = shape.Size();
    const std::int32_t first = std::max(0, centre[0] - kReach);
    const std::int32_t end = std::min(size[0], centre[0] + kReach + 1);
    for (std::int32_t row = 0; row < kSide * kSide; ++row)
    {
      const std::int32_t y = centre[1] - kReach + row % kSide;
      const std::int32_t z = centre[2] - kReach + row / kSide;
      std::uint32_t      bits = 0;
      if (y >= 0 && y < size[1] && z >= 0 && z < size[2])
      {
        bits = shape.Bits(first, y, z, static_cast<unsigned>(end - first)) << (first + kReach - centre[0]);
      }
      m_Set[static_cast<std::size_t>(row)] = background ? ~bits & ((1U << kSide) - 1) : bits;
    }
    m_Set[Row(kReach, kReach)] &= ~(1U << kReach);
  }

  /** Whether all pieces around the centre hang together here. */
  bool
  Connects(const Pieces & pieces)
  {
    Put(pieces.sets[0]);
    for (bool grows = true; grows && !Reaches(pieces);)
    {
      grows = false;
      for (std::int32_t i = 0; i < kSide * kSide; ++i)
      {
        grows = Grow(i / kSide, i % kSide) || grows;
      }
      for (std::int32_t i = kSide * kSide - 1; i >= 0; --i)
      {
        grows = Grow(i / kSide, i % kSide) || grows;
      }
    }
    return Reaches(pieces);
  }

private:
  static constexpr std::int32_t kReach = 10;
  static constexpr std::int32_t kSide = 2 * kReach + 1;

  static std::size_t
  Row(std::int32_t y, std::int32_t z)
  {
    return static_cast<std::size_t>(z * kSide + y);
  }

  template <typename TVisit>
  static void
  ForRows(Neighbourhood piece, const TVisit & visit)
  {
    for (std::int32_t k = 0; k < 9; ++k)
    {
      visit(Row(kReach - 1 + k % 3, kReach - 1 + k / 3), (piece >> (3 * k) & 7U) << (kReach - 1));
    }
  }

  void
  Put(Neighbourhood piece)
  {
    m_Reached.fill(0);
    ForRows(piece, [&](std::size_t row, std::uint32_t bits) { m_Reached[row] |= bits; });
  }

  bool
  Reaches(const Pieces & pieces) const
  {
    bool all = true;
    for (std::size_t i = 0; i < pieces.count; ++i)
    {
      bool any = false;
      ForRows(pieces.sets[i], [&](std::size_t row, std::uint32_t bits) { any = any || (m_Reached[row] & bits) != 0; });
      all = all && any;
    }
    return all;
  }

  bool
  Grow(std::int32_t y, std::int32_t z)
  {
    const std::size_t row = Row(y, z);
    const auto        spread = [](std::uint32_t bits) { return bits | bits << 1 | bits >> 1; };
    std::uint32_t     from = m_Reached[row];
    for (std::int32_t dz = -1; dz <= 1; ++dz)
    {
      for (std::int32_t dy = -1; dy <= 1; ++dy)
      {
        const bool isNear = m_Background || dy == 0 || dz == 0;
        if (isNear && y + dy >= 0 && y + dy < kSide && z + dz >= 0 && z + dz < kSide)
        {
          const std::uint32_t bits = m_Reached[Row(y + dy, z + dz)];
          from |= m_Background ? spread(bits) : bits;
        }
      }
    }
    std::uint32_t reached = from & m_Set[row];
    for (std::uint32_t before = 0; before != reached;)
    {
      before = reached;
      reached = spread(reached) & m_Set[row];
    }
    const bool grows = reached != m_Reached[row];
    m_Reached[row] = reached;
    return grows;
  }

  bool                                     m_Background;
  std::array<std::uint32_t, kSide * kSide> m_Set{};
  std::array<std::uint32_t, kSide * kSide> m_Reached{};
};

/** Whether all pieces of a shape or of its background around a voxel hang together within ten voxels of it. */
inline bool
HangTogether(const PaddedShape & shape, const Voxel & centre, const Pieces & pieces, bool background)
{
  if (const auto known = NearWindow(shape, centre, background).Connects(pieces))
  {
    return *known;
  }
  return WideWindow(shape, centre, background).Connects(pieces);
}

} // namespace voxelcore
