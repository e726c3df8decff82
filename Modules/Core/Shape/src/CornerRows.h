#pragma once
// The four rows of voxels around a row of lattice corners, and which of their words there is anything to see in.

#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** Rows are asked for in scan order, so that what bricks say is looked up once for all their rows. */
class CornerRows
{
public:
  explicit CornerRows(const VoxelShape & shape)
    : m_Shape(shape)
    , m_Lists(2 * (static_cast<std::size_t>(shape.Box().size[1]) / 8 + 2))
  {}

  /** To row (y, z) of corners, box-relative: 0 to the size, included. */
  void
  MoveTo(std::int32_t y, std::int32_t z)
  {
    rows = { m_Shape.RowAnywhere(y - 1, z - 1),
             m_Shape.RowAnywhere(y, z - 1),
             m_Shape.RowAnywhere(y - 1, z),
             m_Shape.RowAnywhere(y, z) };
    // Rows y - 1 and y lie in the same bricks unless y is a multiple of eight; the last row has none of its own.
    const std::int64_t layer = KindOf(z, 2);
    m_List = &m_Lists[static_cast<std::size_t>(KindOf(y, 1))];
    if (m_List->layer != layer)
    {
      m_List->layer = layer;
      ListWords(m_List->words);
    }
  }

  /** Words to look at, rising. In all others, and in the bit before each, all four rows are out, or all are in. */
  const std::vector<std::uint32_t> &
  Words() const
  {
    return m_List->words;
  }

  /** (y - 1, z - 1), (y, z - 1), (y - 1, z), (y, z); background outside the box. */
  std::array<ConstShapeRow, 4> rows;

private:
  struct List
  {
    std::int64_t               layer = -1;
    std::vector<std::uint32_t> words;
  };

  std::int64_t
  KindOf(std::int32_t row, std::size_t axis) const
  {
    const std::int32_t size = m_Shape.Box().size[axis];
    return row == size ? 2 * (std::int64_t{ size } / 8 + 1) : 2 * (std::int64_t{ row } / 8) + (row % 8 == 0 ? 0 : 1);
  }

  void
  ListWords(std::vector<std::uint32_t> & words) const
  {
    words.clear();
    const std::uint64_t * before = BitBricks::Out();
    for (std::size_t word = 0; word < rows[0].size(); ++word)
    {
      const std::uint64_t * own = rows[0].Brick(word);
      const bool isAlike = (own == BitBricks::Out() || own == BitBricks::In()) && rows[1].Brick(word) == own &&
                           rows[2].Brick(word) == own && rows[3].Brick(word) == own;
      if (!isAlike || own != before)
      {
        words.push_back(static_cast<std::uint32_t>(word));
      }
      before = isAlike ? own : nullptr;
    }
  }

  const VoxelShape & m_Shape;
  std::vector<List>  m_Lists; ///< by kind of y
  List *             m_List = nullptr;
};

} // namespace voxelcore
