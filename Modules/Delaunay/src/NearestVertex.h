#pragma once
// The nearest boundary vertex of a place, found on the packed bits of a shape.

#include "BoundaryBits.h"

#include "voxelcore/Rational.h"
#include "voxelcore/SpacingWeights.h"

#include <array>
#include <vector>

namespace voxelcore
{

/** Answers from the shape's bits and one bit for every 8^3 lattice corners. Places are box-relative and doubled, so that
 *  middles of voxels are integers; squared distances are weighted and, with the doubled places, four times themselves:
 *  at most 3 * 2^24 * 2^42 in the exact range. */
class NearestVertex
{
public:
  NearestVertex(const VoxelShape & shape, const SpacingWeights & weights);

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
  SearchCell(const std::array<std::int32_t, 3> & place, std::int32_t x, std::int32_t y, std::int32_t z, Answer & answer)
    const;
  Int128
  Gap(const std::array<std::int32_t, 3> & place, std::size_t axis, std::int32_t cell) const;
  std::int32_t
  CellOf(const std::array<std::int32_t, 3> & place, std::size_t axis) const;
  const std::uint8_t *
  Row(std::int32_t y, std::int32_t z) const;

  BoundaryBits                m_Bits;
  std::array<std::int64_t, 3> m_Squares;      // of the weights
  std::array<std::int32_t, 3> m_Cells{};      // along each axis
  std::size_t                 m_RowBytes = 0; // a bit for each cell of a row
  std::vector<std::uint8_t>   m_Occupied;     // rows of cells, x fastest
};

} // namespace voxelcore
