#pragma once
// The nearest boundary vertex of a place, found on the packed bits of a shape.

#include "BoundaryBits.h"

#include "voxelcore/Lattice/Rational.h"
#include "voxelcore/Lattice/SpacingWeights.h"

#include <array>
#include <vector>

namespace voxelcore
{

/** Answers from one bit for every 8^3 lattice corners and the bits of those that hold boundary vertices. Places are
 *  box-relative and doubled, so that middles of voxels are integers; squared distances are weighted and, with the
 *  doubled places, four times themselves: at most 3 * 2^24 * 2^42 in the exact range. */
class NearestVertex
{
public:
  NearestVertex(const VoxelShape & shape, const SpacingWeights & weights);
  /** Of the lattice corners in `trusted` alone (box-relative, first to first + size - 1). */
  NearestVertex(const VoxelShape & shape, const SpacingWeights & weights, const VoxelBox & trusted);

  bool
  HasNone() const
  {
    return m_Layers.empty();
  }

  /** A boundary vertex and its squared distance from the place asked for. */
  struct Answer
  {
    std::array<std::int32_t, 3> vertex{ -1, -1, -1 }; ///< doubled
    Int128                      squared = -1;         ///< -1: none is known yet
  };

  /** The squared distance between two doubled places. */
  Int128
  Squared(const std::array<std::int32_t, 3> & a, const std::array<std::int32_t, 3> & b) const;

  /** The nearest one, or `known` when no other is nearer (squared -1: search without a bound). */
  Answer
  Find(const std::array<std::int32_t, 3> & place, Answer known) const;

private:
  void
  SearchLayer(const std::array<std::int32_t, 3> & place, std::int32_t z, Int128 gap, Answer & answer) const;
  void
  SearchRow(const std::array<std::int32_t, 3> & place, std::int32_t y, std::int32_t z, Int128 gap, Answer & answer)
    const;
  void
  SearchCell(const std::array<std::int32_t, 3> &  place,
             const std::array<std::int32_t, 3> &  corner,
             const std::array<std::uint64_t, 8> & layers,
             Answer &                             answer) const;
  Int128
  Gap(const std::array<std::int32_t, 3> & place, std::size_t axis, std::int32_t cell) const;
  std::int32_t
  CellOf(const std::array<std::int32_t, 3> & place, std::size_t axis) const;
  struct Row
  {
    std::size_t firstByte = 0;
    std::size_t firstCell = 0; ///< in m_Layers
  };

  Row
  RowAt(std::int32_t y, std::int32_t z) const
  {
    const auto row = static_cast<std::size_t>(z) * static_cast<std::size_t>(m_Cells[1]) + static_cast<std::size_t>(y);
    return { row * m_RowBytes, m_RowStart[row] };
  }

  std::array<std::int64_t, 3> m_Squares;      // of the weights
  std::array<std::int32_t, 3> m_Cells{};      // along each axis
  std::size_t                 m_RowBytes = 0; // a bit for each cell of a row
  std::vector<std::uint8_t>   m_Occupied;     // rows of cells, x fastest
  std::vector<std::size_t>    m_RowStart;     // per row: occupied cells before it
  /** Per occupied cell its eight layers along z; a layer has a byte for each row, a bit for each corner. */
  std::vector<std::array<std::uint64_t, 8>> m_Layers;
};

} // namespace voxelcore
