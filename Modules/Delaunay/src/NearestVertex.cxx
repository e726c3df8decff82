#include "NearestVertex.h"

namespace voxelcore
{

namespace
{

// Calls visit(cell) for first, first - 1, ... or first, first + 1, ... until visit says no or the cells end.
template <typename TVisit>
void
GoOutward(std::int32_t first, std::int32_t count, TVisit visit)
{
  for (std::int32_t cell = first; cell >= 0 && visit(cell); --cell)
  {}
  for (std::int32_t cell = first + 1; cell < count && visit(cell); ++cell)
  {}
}

} // namespace

NearestVertex::NearestVertex(const VoxelShape & shape, const SpacingWeights & weights)
  : m_Bits(shape)
{
  const auto & size = shape.Box().size;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    m_Squares[axis] = weights.weight[axis] * weights.weight[axis];
    m_Cells[axis] = size[axis] / 8 + 1;
  }
  m_RowBytes = (static_cast<std::size_t>(m_Cells[0]) + 7) / 8;
  m_Occupied.assign(m_RowBytes * static_cast<std::size_t>(m_Cells[1]) * static_cast<std::size_t>(m_Cells[2]), 0);
  for (std::int32_t z = 0; z <= size[2]; ++z)
  {
    for (std::int32_t y = 0; y <= size[1]; ++y)
    {
      std::uint8_t * row = m_Occupied.data() + (static_cast<std::size_t>(z / 8) * static_cast<std::size_t>(m_Cells[1]) +
                                                static_cast<std::size_t>(y / 8)) *
                                                 m_RowBytes;
      // A word of corners is eight cells: a byte of the row.
      for (std::size_t word = 0; word < m_RowBytes; ++word)
      {
        const std::uint64_t bits = m_Bits.Word(y, z, static_cast<std::int32_t>(word));
        for (unsigned cell = 0; bits != 0 && cell < 8; ++cell)
        {
          row[word] |= static_cast<std::uint8_t>((bits >> (8 * cell) & 0xFFU) != 0 ? 1U << cell : 0U);
        }
      }
    }
  }
}

const std::uint8_t *
NearestVertex::Row(std::int32_t y, std::int32_t z) const
{
  return m_Occupied.data() +
         (static_cast<std::size_t>(z) * static_cast<std::size_t>(m_Cells[1]) + static_cast<std::size_t>(y)) *
           m_RowBytes;
}

Int128
NearestVertex::Squared(const std::array<std::int32_t, 3> & a, const std::array<std::int32_t, 3> & b) const
{
  Int128 sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int64_t d = std::int64_t{ a[axis] } - b[axis];
    sum += Int128{ d * d } * m_Squares[axis];
  }
  return sum;
}

std::int32_t
NearestVertex::CellOf(const std::array<std::int32_t, 3> & place, std::size_t axis) const
{
  return std::clamp(place[axis] / 16, 0, m_Cells[axis] - 1);
}

// The squared distance along an axis between the place and the corners of a cell.
Int128
NearestVertex::Gap(const std::array<std::int32_t, 3> & place, std::size_t axis, std::int32_t cell) const
{
  const std::int64_t low = std::int64_t{ 16 } * cell - place[axis];
  const std::int64_t high = place[axis] - (std::int64_t{ 16 } * cell + 14);
  const std::int64_t gap = std::max({ low, high, std::int64_t{ 0 } });
  return Int128{ gap * gap } * m_Squares[axis];
}

NearestVertex::Answer
NearestVertex::Find(const std::array<std::int32_t, 3> & place, Answer known) const
{
  GoOutward(CellOf(place, 2), m_Cells[2], [&](std::int32_t z) {
    const Int128 gap = Gap(place, 2, z);
    if (known.squared >= 0 && gap >= known.squared)
    {
      return false;
    }
    SearchLayer(place, z, gap, known);
    return true;
  });
  return known;
}

void
NearestVertex::SearchLayer(const std::array<std::int32_t, 3> & place, std::int32_t z, Int128 gap, Answer & answer) const
{
  GoOutward(CellOf(place, 1), m_Cells[1], [&](std::int32_t y) {
    const Int128 both = gap + Gap(place, 1, y);
    if (answer.squared >= 0 && both >= answer.squared)
    {
      return false;
    }
    SearchRow(place, y, z, both, answer);
    return true;
  });
}

void
NearestVertex::SearchRow(const std::array<std::int32_t, 3> & place,
                         std::int32_t                        y,
                         std::int32_t                        z,
                         Int128                              gap,
                         Answer &                            answer) const
{
  const std::uint8_t * row = Row(y, z);
  GoOutward(CellOf(place, 0), m_Cells[0], [&](std::int32_t x) {
    if (answer.squared >= 0 && gap + Gap(place, 0, x) >= answer.squared)
    {
      return false;
    }
    if ((row[x >> 3] >> (x & 7) & 1U) != 0)
    {
      SearchCell(place, x, y, z, answer);
    }
    return true;
  });
}

void
NearestVertex::SearchCell(const std::array<std::int32_t, 3> & place,
                          std::int32_t                        x,
                          std::int32_t                        y,
                          std::int32_t                        z,
                          Answer &                            answer) const
{
  for (std::int32_t cz = 8 * z; cz < 8 * z + 8; ++cz)
  {
    for (std::int32_t cy = 8 * y; cy < 8 * y + 8; ++cy)
    {
      const std::int64_t dy = 2 * std::int64_t{ cy } - place[1];
      const std::int64_t dz = 2 * std::int64_t{ cz } - place[2];
      const Int128       row = Int128{ dy * dy } * m_Squares[1] + Int128{ dz * dz } * m_Squares[2];
      if (answer.squared >= 0 && row >= answer.squared)
      {
        continue;
      }
      for (std::uint64_t bits = m_Bits.Word(cy, cz, x >> 3) >> (8 * (x & 7)) & 0xFFU; bits != 0; bits &= bits - 1)
      {
        const std::array<std::int32_t, 3> vertex{ 2 * (8 * x + std::countr_zero(bits)), 2 * cy, 2 * cz };
        const std::int64_t                dx = std::int64_t{ vertex[0] } - place[0];
        const Int128                      squared = row + Int128{ dx * dx } * m_Squares[0];
        if (answer.squared < 0 || squared < answer.squared)
        {
          answer = { vertex, squared };
        }
      }
    }
  }
}

} // namespace voxelcore
