#include "CellTracer.h"

#include "VoxelCells.h"

#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Base/Library.h"

#include <algorithm>

namespace voxelcore
{

std::uint8_t
CellTracer::CornerMask(std::int32_t x, std::int32_t y, std::int32_t z) const
{
  const auto pair = [&](std::int32_t row, std::int32_t layer) {
    return static_cast<unsigned>(m_Window.vertex[LatticeWindow::Row(row, layer)] >> x) & 3U;
  };
  return static_cast<std::uint8_t>(pair(y, z) | (pair(y + 1, z) << 2) | (pair(y, z + 1) << 4) |
                                   (pair(y + 1, z + 1) << 6));
}

// Marks the brick's voxels that have a cell of their own and numbers those cells ahead.
void
CellTracer::FindVoxelCells()
{
  const auto & table = VoxelCells();
  auto         next = static_cast<std::uint32_t>(m_Result.CellCount());
  for (std::int32_t z = 0; z < brickWidth; ++z)
  {
    for (std::int32_t y = 0; y < brickWidth; ++y)
    {
      const auto          row = static_cast<std::size_t>(z * brickWidth + y);
      const std::size_t   corner = LatticeWindow::Row(y + halo, z + halo);
      const std::size_t   layer = corner + LatticeWindow::width;
      const std::uint64_t touched =
        m_Window.vertex[corner] | m_Window.vertex[corner + 1] | m_Window.vertex[layer] | m_Window.vertex[layer + 1];
      std::uint32_t candidates =
        static_cast<std::uint32_t>((m_Window.voxel[corner] & (touched | (touched >> 1))) >> halo);
      std::uint32_t found = 0;
      for (; candidates != 0; candidates &= candidates - 1)
      {
        const int x = std::countr_zero(candidates);
        if (table[CornerMask(x + halo, y + halo, z + halo)].spansSpace)
        {
          found |= std::uint32_t{ 1 } << x;
        }
      }
      m_VoxelBits[row] = found;
      m_VoxelFirst[row] = next;
      next += CountBits(found);
    }
  }
}

void
CellTracer::SeedVoxelCells()
{
  constexpr std::array<std::array<std::int32_t, 3>, 6> beyondStep{
    { { -1, 0, 0 }, { 1, 0, 0 }, { 0, -1, 0 }, { 0, 1, 0 }, { 0, 0, -1 }, { 0, 0, 1 } }
  };
  const auto & table = VoxelCells();
  for (std::int32_t z = halo; z < halo + brickWidth; ++z)
  {
    for (std::int32_t y = halo; y < halo + brickWidth; ++y)
    {
      const auto row = static_cast<std::size_t>((z - halo) * brickWidth + y - halo);
      for (std::uint32_t bits = m_VoxelBits[row]; bits != 0; bits &= bits - 1)
      {
        const std::int32_t           x = halo + std::countr_zero(bits);
        const unsigned               mask = CornerMask(x, y, z);
        const VoxelCell &            shape = table[mask];
        std::array<std::uint32_t, 8> index{};
        for (unsigned c = 0; c < 8; c += 2)
        {
          if ((mask >> c & 3U) != 0)
          {
            index[c] = m_Window.IndexOf(x, y + static_cast<int>((c >> 1) & 1U), z + static_cast<int>(c >> 2));
            index[c + 1] = index[c] + (mask >> c & 1U);
          }
        }
        const auto &        t = shape.tetrahedron;
        const std::uint32_t cell = NewCell({ index[t[0]], index[t[1]], index[t[2]], index[t[3]] });
        for (const VoxelCell::Facet & facet : shape.Facets())
        {
          std::array<std::uint32_t, 4> corners;
          for (std::size_t i = 0; i < 4; ++i)
          {
            corners[i] = index[facet.corners[i]];
          }
          const std::span<const std::uint32_t> polygon(corners.data(), facet.size);
          const std::uint8_t                   side = facet.side;
          if (side == 6)
          {
            AddFacet(cell, polygon);
            continue;
          }
          const std::int32_t bx = x + beyondStep[side][0];
          const std::int32_t by = y + beyondStep[side][1];
          const std::int32_t bz = z + beyondStep[side][2];
          if (((m_Window.voxel[LatticeWindow::Row(by, bz)] >> bx) & 1U) == 0)
          {
            AddVoxelSide(cell, side / 2U, polygon);
            continue;
          }
          const std::int32_t rx = bx - halo;
          const std::int32_t ry = by - halo;
          const std::int32_t rz = bz - halo;
          const auto         inBrick = [](std::int32_t r) { return r >= 0 && r < brickWidth; };
          if (inBrick(rx) && inBrick(ry) && inBrick(rz))
          {
            const auto beyondRow = static_cast<std::size_t>(rz * brickWidth + ry);
            if ((m_VoxelBits[beyondRow] >> rx) & 1U)
            {
              // Both voxels have a cell: they share this facet, and the first of the two makes it.
              if (side % 2 == 1)
              {
                const std::uint32_t below = (std::uint32_t{ 1 } << rx) - 1;
                NewFacet(cell,
                         m_VoxelFirst[beyondRow] +
                           static_cast<std::uint32_t>(CountBits(m_VoxelBits[beyondRow] & below)),
                         polygon);
              }
              continue;
            }
          }
          AddFacet(cell, polygon);
        }
      }
      // Inside voxels that meet the boundary in one square only: their square starts a trace.
      for (std::uint32_t rest =
             static_cast<std::uint32_t>((m_Window.voxel[LatticeWindow::Row(y, z)] & FullSides(y, z)) >> halo) &
             ~m_VoxelBits[row];
           rest != 0;
           rest &= rest - 1)
      {
        const std::int32_t x = halo + std::countr_zero(rest);
        const unsigned     mask = CornerMask(x, y, z);
        if (CountBits(mask) == 4)
        {
          SeedSquare(x, y, z, mask);
        }
      }
    }
  }
}

std::uint64_t
CellTracer::FullSides(std::int32_t y, std::int32_t z) const
{
  const std::size_t   corner = LatticeWindow::Row(y, z);
  const std::size_t   layer = corner + LatticeWindow::width;
  const std::uint64_t a = m_Window.vertex[corner];
  const std::uint64_t b = m_Window.vertex[corner + 1];
  const std::uint64_t c = m_Window.vertex[layer];
  const std::uint64_t d = m_Window.vertex[layer + 1];
  const std::uint64_t across = a & b & c & d;
  const auto          both = [](std::uint64_t one, std::uint64_t other) { return one & other & (one & other) >> 1; };
  return across | across >> 1 | both(a, b) | both(c, d) | both(a, c) | both(b, d);
}

void
CellTracer::SeedSquare(std::int32_t x, std::int32_t y, std::int32_t z, unsigned mask)
{
  const auto side = static_cast<std::size_t>(
    std::find(voxelSideMasks.begin(), voxelSideMasks.end(), static_cast<std::uint8_t>(mask)) - voxelSideMasks.begin());
  if (side == voxelSideMasks.size())
  {
    return;
  }
  const std::array<std::int32_t, 3> step{ side / 2 == 0 ? 1 : 0, side / 2 == 1 ? 1 : 0, side / 2 == 2 ? 1 : 0 };
  const std::int32_t                sign = side % 2 == 0 ? -1 : 1;
  const std::size_t                 beyond = LatticeWindow::Row(y + sign * step[1], z + sign * step[2]);
  if ((m_Window.voxel[beyond] >> (x + sign * step[0])) & 1U)
  {
    return; // not on the boundary: the voxel beyond is in
  }
  // The whole voxel's cell lists its sides counter-clockwise from outside.
  const VoxelCell &            cube = VoxelCells()[255];
  std::array<std::uint32_t, 4> square{};
  for (const VoxelCell::Facet & facet : cube.Facets())
  {
    if (facet.side == side)
    {
      ranges::transform(facet.corners, square.begin(), [&](std::uint8_t c) {
        return m_Window.IndexOf(x + (c & 1), y + ((c >> 1) & 1), z + (c >> 2));
      });
    }
  }
  if (const std::uint32_t met = m_Front.TakeOrInsert(KeyOf(square), NextFacet(square.size())); met != FacetTable::none)
  {
    NoteVoxelSide(met); // a cell found earlier has this square, and knows that it is on the boundary
    return;
  }
  const std::uint32_t facet = NewFacet(kOpen, kOutside, square);
  m_Stack.push_back({ facet, 0.0 }); // the square's smallest sphere is empty
}

} // namespace voxelcore
