#include "NearestVertex.h"

#include "voxelcore/Base/CountBits.h"

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
  : NearestVertex(shape,
                  weights,
                  { { 0, 0, 0 }, { shape.Box().size[0] + 1, shape.Box().size[1] + 1, shape.Box().size[2] + 1 } })
{}

NearestVertex::NearestVertex(const VoxelShape & shape, const SpacingWeights & weights, const VoxelBox & trusted)
{
  const auto isTrusted = [&trusted](std::int32_t at, std::size_t axis) {
    return at >= trusted.lower[axis] && at < trusted.lower[axis] + trusted.size[axis];
  };
  const auto & size = shape.Box().size;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    m_Squares[axis] = weights.weight[axis] * weights.weight[axis];
    m_Cells[axis] = size[axis] / 8 + 1;
  }
  m_RowBytes = (static_cast<std::size_t>(m_Cells[0]) + 7) / 8;
  const auto rows = static_cast<std::size_t>(m_Cells[1]) * static_cast<std::size_t>(m_Cells[2]);
  m_Occupied.assign(m_RowBytes * rows, 0);
  m_RowStart.reserve(rows);
  const BoundaryBits                        bits(shape);
  std::vector<std::array<std::uint64_t, 8>> row(m_RowBytes * 8);
  for (std::int32_t cellZ = 0; cellZ < m_Cells[2]; ++cellZ)
  {
    for (std::int32_t cellY = 0; cellY < m_Cells[1]; ++cellY)
    {
      for (unsigned line = 0; line < 64; ++line)
      {
        const unsigned z = line / 8;
        const unsigned y = line % 8;
        if (!isTrusted(8 * cellY + static_cast<std::int32_t>(y), 1) ||
            !isTrusted(8 * cellZ + static_cast<std::int32_t>(z), 2))
        {
          continue;
        }
        // A word of corners is a line of eight cells.
        bits.VisitWords(8 * cellY + static_cast<std::int32_t>(y),
                        8 * cellZ + static_cast<std::int32_t>(z),
                        0,
                        static_cast<std::int32_t>(m_RowBytes),
                        [&](std::int32_t word, std::uint64_t corners) {
                          corners &= BoundaryBits::Between(trusted.lower[0], trusted.lower[0] + trusted.size[0], word);
                          for (auto cell = static_cast<std::size_t>(8 * word); corners != 0; ++cell, corners >>= 8)
                          {
                            row[cell][z] |= (corners & 0xFFU) << (8 * y);
                          }
                        });
      }
      const std::size_t firstByte = m_RowStart.size() * m_RowBytes;
      m_RowStart.push_back(m_Layers.size());
      for (std::size_t cell = 0; cell < row.size(); ++cell)
      {
        if (std::any_of(row[cell].begin(), row[cell].end(), [](std::uint64_t layer) { return layer != 0; }))
        {
          m_Occupied[firstByte + cell / 8] |= static_cast<std::uint8_t>(1U << cell % 8);
          m_Layers.push_back(row[cell]);
          row[cell] = {};
        }
      }
    }
  }
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
  const Row          row = RowAt(y, z);
  const std::int32_t start = CellOf(place, 0);
  // The number of a cell among the occupied ones, counted from the row's first.
  const auto number = [&](std::int32_t x) {
    std::size_t before = row.firstCell;
    for (std::int32_t byte = 0; byte < x / 8; ++byte)
    {
      before += CountBits(m_Occupied[row.firstByte + static_cast<std::size_t>(byte)]);
    }
    const unsigned last = m_Occupied[row.firstByte + static_cast<std::size_t>(x / 8)];
    return before + CountBits(last & ((1U << x % 8) - 1));
  };
  GoOutward(start, m_Cells[0], [&](std::int32_t x) {
    if (answer.squared >= 0 && gap + Gap(place, 0, x) >= answer.squared)
    {
      return false;
    }
    if ((m_Occupied[row.firstByte + static_cast<std::size_t>(x / 8)] >> x % 8 & 1U) != 0)
    {
      SearchCell(place, { 8 * x, 8 * y, 8 * z }, m_Layers[number(x)], answer);
    }
    return true;
  });
}

void
NearestVertex::SearchCell(const std::array<std::int32_t, 3> &  place,
                          const std::array<std::int32_t, 3> &  corner,
                          const std::array<std::uint64_t, 8> & layers,
                          Answer &                             answer) const
{
  const auto square = [&](std::int32_t at, std::size_t axis) {
    const std::int64_t d = 2 * std::int64_t{ at } - place[axis];
    return Int128{ d * d } * m_Squares[axis];
  };
  for (std::int32_t z = 0; z < 8; ++z)
  {
    std::uint64_t layer = layers[static_cast<std::size_t>(z)];
    const Int128  ofLayer = square(corner[2] + z, 2);
    for (std::int32_t y = 0; layer != 0; ++y, layer >>= 8)
    {
      const Int128 ofRow = ofLayer + square(corner[1] + y, 1);
      if (answer.squared >= 0 && ofRow >= answer.squared)
      {
        continue;
      }
      for (auto bits = static_cast<unsigned>(layer & 0xFFU); bits != 0; bits &= bits - 1)
      {
        const std::int32_t x = corner[0] + std::countr_zero(bits);
        const Int128       squared = ofRow + square(x, 0);
        if (answer.squared < 0 || squared < answer.squared)
        {
          answer = { { 2 * x, 2 * (corner[1] + y), 2 * (corner[2] + z) }, squared };
        }
      }
    }
  }
}

} // namespace voxelcore
