#pragma once
// A 64^3 look at the lattice around a brick of 32^3 voxels: one machine word a row.

#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Lattice/LatticePoint.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** Finds the index of a boundary vertex from its coordinates: first index of each lattice row of the shape's box. */
class VertexRows
{
public:
  VertexRows(const VoxelShape & shape, const std::vector<LatticePoint> & points);

  /** Index of the first vertex at or behind x in the lattice row (y, z), in coordinates of the scan. */
  std::uint32_t
  FirstAt(std::int32_t x, std::int32_t y, std::int32_t z) const;

private:
  const std::vector<LatticePoint> * m_Points;
  std::array<std::int32_t, 3>       m_Lower;
  std::size_t                       m_RowsY;
  std::vector<std::uint32_t>        m_Start;
};

/** Local coordinates 0 .. 63; the brick is 16 .. 47, so a ball of radius 15 about any point in it lies in the window.
 *  Bit x of row (y, z) is the lattice corner, or the voxel from corner x to x + 1. */
struct LatticeWindow
{
  static constexpr std::int32_t width = 64;
  static constexpr std::int32_t halo = 16;
  static constexpr std::int32_t brick = 32;

  LatticePoint                            origin{}; ///< lattice coordinates of local (0, 0, 0)
  std::array<std::uint64_t, 64 * 64 + 24> vertex{}; ///< boundary vertices; a scan may read 23 rows from any
  std::array<std::uint64_t, 64 * 64>      voxel{};  ///< voxels of the shape

  /** Moves the window so that its brick starts at lattice corner `brickCorner`. */
  void
  Fill(const VoxelShape & shape, const VertexRows & rows, const LatticePoint & brickCorner);

  static std::size_t
  Row(std::int32_t y, std::int32_t z)
  {
    return static_cast<std::size_t>(z * width + y);
  }

  /** Index of the boundary vertex at local coordinates, which must be one. */
  std::uint32_t
  IndexOf(std::int32_t x, std::int32_t y, std::int32_t z)
  {
    const std::size_t   row = Row(y, z);
    const std::uint64_t below = (std::uint64_t{ 1 } << x) - 1;
    if (m_First[row] == unknown) // most rows are never asked for
    {
      m_First[row] = m_Rows->FirstAt(origin.x, origin.y + y, origin.z + z);
    }
    return m_First[row] + CountBits(vertex[row] & below);
  }

private:
  static constexpr std::uint32_t unknown = 0xFFFFFFFFU;

  const VertexRows *                 m_Rows = nullptr;
  std::array<std::uint32_t, 64 * 64> m_First{}; // index of the row's first vertex in the window
};

} // namespace voxelcore
