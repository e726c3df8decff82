#include "LatticeWindow.h"

#include <algorithm>

namespace voxelcore
{

VertexRows::VertexRows(const VoxelShape & shape, const std::vector<LatticePoint> & points)
  : m_Points(&points)
  , m_Lower(shape.Box().lower)
  , m_RowsY(static_cast<std::size_t>(shape.Box().size[1]) + 1)
  , m_Start(m_RowsY * (static_cast<std::size_t>(shape.Box().size[2]) + 1) + 1, 0)
{
  std::size_t row = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::size_t own =
      static_cast<std::size_t>(points[i].z - m_Lower[2]) * m_RowsY + static_cast<std::size_t>(points[i].y - m_Lower[1]);
    while (row < own)
    {
      m_Start[++row] = static_cast<std::uint32_t>(i);
    }
  }
  while (++row < m_Start.size())
  {
    m_Start[row] = static_cast<std::uint32_t>(points.size());
  }
}

std::uint32_t
VertexRows::FirstAt(std::int32_t x, std::int32_t y, std::int32_t z) const
{
  const std::size_t row = static_cast<std::size_t>(z - m_Lower[2]) * m_RowsY + static_cast<std::size_t>(y - m_Lower[1]);
  const auto        begin = m_Points->begin() + m_Start[row];
  const auto        end = m_Points->begin() + m_Start[row + 1];
  const auto        at =
    std::lower_bound(begin, end, x, [](const LatticePoint & p, std::int32_t value) { return p.x < value; });
  return static_cast<std::uint32_t>(at - m_Points->begin());
}

namespace
{

// 65 voxels of a row, from one bit before `offset` on, which may lie anywhere; beyond the row is background.
class RowReader
{
public:
  RowReader(std::size_t wordsPerRow, std::int64_t offset)
    : m_Word(offset >> 6)
    , m_Before((offset - 1) >> 6)
    , m_Shift(static_cast<unsigned>(offset & 63))
  {
    const auto isIn = [&](std::int64_t word) { return word >= 0 && word < static_cast<std::int64_t>(wordsPerRow); };
    m_HasLow = isIn(m_Word);
    m_HasHigh = m_Shift != 0 && isIn(m_Word + 1);
    m_HasBefore = isIn(m_Before);
  }

  std::uint64_t
  Here(const ConstShapeRow & row) const
  {
    return (m_HasLow ? row[static_cast<std::size_t>(m_Word)] >> m_Shift : 0) |
           (m_HasHigh ? row[static_cast<std::size_t>(m_Word + 1)] << (64 - m_Shift) : 0);
  }
  std::uint64_t
  BitBefore(const ConstShapeRow & row) const
  {
    return m_HasBefore ? row[static_cast<std::size_t>(m_Before)] >> ((m_Shift - 1) & 63U) & 1U : 0;
  }

private:
  std::int64_t m_Word;
  std::int64_t m_Before;
  unsigned     m_Shift;
  bool         m_HasLow;
  bool         m_HasHigh;
  bool         m_HasBefore;
};

// Of each lattice row, whether any and all of the four voxels around it in a layer are in.
struct LayerPairs
{
  std::array<std::uint64_t, LatticeWindow::width> any;
  std::array<std::uint64_t, LatticeWindow::width> all;
};

} // namespace

void
LatticeWindow::Fill(const VoxelShape & shape, const VertexRows & rows, const LatticePoint & brickCorner)
{
  m_Rows = &rows;
  m_First.fill(unknown);
  origin = { brickCorner.x - halo, brickCorner.y - halo, brickCorner.z - halo };
  const auto &    box = shape.Box();
  const RowReader reader(shape.WordsPerRow(), std::int64_t{ origin.x } - box.lower[0]);
  // Rows of the window that the box has, and the one before them.
  const std::int32_t firstY = std::max(-1, box.lower[1] - origin.y);
  const std::int32_t endY = std::min(width, box.lower[1] + box.size[1] - origin.y);
  LayerPairs         pairs[2]{};
  for (std::int32_t z = -1; z < width; ++z)
  {
    const std::int32_t boxZ = origin.z + z - box.lower[2];
    // Row y of the window stands at y + 1: step after step, so that several are made at a time.
    std::array<std::uint64_t, width + 1> here{};
    std::array<std::uint64_t, width + 1> before{};
    if (boxZ >= 0 && boxZ < box.size[2])
    {
      for (std::int32_t y = firstY; y < endY; ++y)
      {
        const ConstShapeRow row = shape.Row(origin.y + y - box.lower[1], boxZ);
        const auto          place = static_cast<std::size_t>(y + 1);
        here[place] = reader.Here(row);
        before[place] = reader.BitBefore(row);
      }
    }
    LayerPairs & own = pairs[z & 1];
    for (std::size_t y = 0; y < width; ++y)
    {
      const std::uint64_t low = here[y] << 1 | before[y];
      const std::uint64_t high = here[y + 1] << 1 | before[y + 1];
      own.any[y] = here[y] | low | here[y + 1] | high;
      own.all[y] = here[y] & low & here[y + 1] & high;
    }
    if (z >= 0)
    {
      const LayerPairs & below = pairs[(z - 1) & 1];
      const std::size_t  at = Row(0, z);
      for (std::size_t y = 0; y < width; ++y)
      {
        voxel[at + y] = here[y + 1];
        vertex[at + y] = (own.any[y] | below.any[y]) & ~(own.all[y] & below.all[y]);
      }
    }
  }
}

} // namespace voxelcore
