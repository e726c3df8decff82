#include "voxelcore/VoxelCore/BallUnion.h"

#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace voxelcore
{

namespace
{

/** Puts in the bits first <= i <= last of a row. */
void
FillBits(const ShapeRow & row, std::int32_t first, std::int32_t last)
{
  const auto          from = static_cast<std::size_t>(first) >> 6U;
  const auto          to = static_cast<std::size_t>(last) >> 6U;
  const std::uint64_t head = ~std::uint64_t{ 0 } << (static_cast<std::uint32_t>(first) & 63U);
  const std::uint64_t tail = ~std::uint64_t{ 0 } >> (63U - (static_cast<std::uint32_t>(last) & 63U));
  if (from == to)
  {
    row[from] |= head & tail;
    return;
  }
  row[from] |= head;
  std::fill(row.begin() + static_cast<std::ptrdiff_t>(from) + 1,
            row.begin() + static_cast<std::ptrdiff_t>(to),
            ~std::uint64_t{ 0 });
  row[to] |= tail;
}

/** A ball whose centre is given from the box's first voxel's lower corner. */
class Ball
{
public:
  Ball(const VoxelShape &            shape,
       const std::array<double, 3> & spacing,
       const std::array<double, 3> & centre,
       double                        radius)
    : m_Spacing(spacing)
    , m_Squared(radius * radius)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      m_Centre[k] = centre[k] - shape.Box().lower[k];
      // One voxel more on each side; what is in is decided voxel by voxel.
      const double reach = radius / spacing[k] + 1;
      const double most = shape.Box().size[k];
      m_First[k] = static_cast<std::int32_t>(std::clamp(std::floor(m_Centre[k] - reach), 0.0, most));
      m_End[k] = static_cast<std::int32_t>(std::clamp(std::ceil(m_Centre[k] + reach), 0.0, most));
    }
  }

  /** Its part in the slices first <= z < end. */
  void
  Fill(VoxelShape & shape, std::int32_t first, std::int32_t end) const
  {
    for (std::int32_t z = std::max(first, m_First[2]); z < std::min(end, m_End[2]); ++z)
    {
      const double dz = Offset(z, 2);
      for (std::int32_t y = m_First[1]; y < m_End[1]; ++y)
      {
        const double dy = Offset(y, 1);
        FillRow(shape.Row(y, z), m_Squared - dy * dy - dz * dz);
      }
    }
  }

private:
  double
  Offset(std::int32_t voxel, std::size_t axis) const
  {
    return (voxel + 0.5 - m_Centre[axis]) * m_Spacing[axis];
  }
  void
  FillRow(const ShapeRow & row, double squared) const
  {
    if (!(squared > 0))
    {
      return;
    }
    const auto   isIn = [&](std::int32_t x) { return Offset(x, 0) * Offset(x, 0) < squared; };
    const double half = std::sqrt(squared) / m_Spacing[0];
    const double lower = std::max(std::floor(m_Centre[0] - half) - 1, static_cast<double>(m_First[0]));
    const double upper = std::min(std::ceil(m_Centre[0] + half) + 1, static_cast<double>(m_End[0]) - 1);
    auto         first = static_cast<std::int32_t>(lower);
    auto         last = static_cast<std::int32_t>(upper);
    while (first <= last && !isIn(first))
    {
      ++first;
    }
    while (first <= last && !isIn(last))
    {
      --last;
    }
    if (first <= last)
    {
      FillBits(row, first, last);
    }
  }

  std::array<double, 3>       m_Spacing;
  double                      m_Squared;
  std::array<double, 3>       m_Centre{};
  std::array<std::int32_t, 3> m_First{};
  std::array<std::int32_t, 3> m_End{};
};

} // namespace

VoxelShape
UnionOfBalls(const VoxelBox &                       box,
             const std::array<double, 3> &          spacing,
             std::span<const std::array<double, 3>> centres,
             std::span<const double>                radius,
             const ProgressCallback &               progress)
{
  VoxelShape shape(box);
  // Slab by slab, so that threads never write to the same row.
  constexpr std::int32_t thickness = 4;
  constexpr std::int32_t slabs = 16;
  for (std::int32_t first = 0; first < box.size[2]; first += slabs * thickness)
  {
    ReportProgress(progress, "balls", static_cast<double>(first) / box.size[2]);
    RunEach(slabs, [&](std::size_t slab) {
      const std::int32_t begin = first + static_cast<std::int32_t>(slab) * thickness;
      const std::int32_t end = std::min(begin + thickness, box.size[2]);
      for (std::size_t i = 0; begin < end && i < centres.size(); ++i)
      {
        Ball(shape, spacing, centres[i], radius[i]).Fill(shape, begin, end);
      }
    });
  }
  return shape;
}

} // namespace voxelcore
