#include "voxelcore/Masks/CleftFilling.h"

#include "EditedBits.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

using Offset = std::array<std::int32_t, 3>;

/** The rows of a shape at any place; beyond sides that are closed it goes on as it ends there. */
class EndlessRows
{
public:
  EndlessRows(const VoxelShape & shape, const std::optional<std::array<std::int64_t, 3>> & scan)
    : m_Shape(shape)
  {
    const VoxelBox & box = shape.Box();
    for (std::size_t axis = 0; scan && axis < 3; ++axis)
    {
      m_IsClosed[axis] = { box.lower[axis] == 0, box.lower[axis] + box.size[axis] == (*scan)[axis] };
    }
  }

  /** The 64 voxels from x on in row y, z, in indices of the scan. */
  std::uint64_t
  Bits(std::int32_t x, std::int32_t y, std::int32_t z) const
  {
    const auto & lower = m_Shape.Box().lower;
    const auto   row = m_Shape.RowAnywhere(Inside(y - lower[1], 1), Inside(z - lower[2], 2));
    x -= lower[0];
    const std::int32_t  word = x >> 6;
    const auto          shift = static_cast<unsigned>(x & 63);
    const std::uint64_t low = Word(row, word) >> shift;
    return shift == 0 ? low : low | Word(row, word + 1) << (64U - shift);
  }

private:
  std::int32_t
  Inside(std::int32_t at, std::size_t axis) const
  {
    const std::int32_t last = m_Shape.Box().size[axis] - 1;
    at = m_IsClosed[axis][0] ? std::max(at, 0) : at;
    return m_IsClosed[axis][1] ? std::min(at, last) : at;
  }

  std::uint64_t
  Word(const ConstShapeRow & row, std::int32_t word) const
  {
    const std::int32_t last = m_Shape.Box().size[0] - 1;
    if (word < 0)
    {
      return m_IsClosed[0][0] && (row[0] & 1U) != 0 ? ~std::uint64_t{ 0 } : 0;
    }
    const auto          lastWord = static_cast<std::size_t>(last >> 6);
    const auto          at = static_cast<std::size_t>(word);
    const std::uint64_t bits = at <= lastWord ? row[at] : 0;
    if (at < lastWord || !m_IsClosed[0][1] || (row[lastWord] >> (last & 63) & 1U) == 0)
    {
      return bits;
    }
    return at > lastWord ? ~std::uint64_t{ 0 } : bits | ~std::uint64_t{ 0 } << (last & 63);
  }

  const VoxelShape &                 m_Shape;
  std::array<std::array<bool, 2>, 3> m_IsClosed{};
};

/** Per direction the places that are looked at, from a voxel on. */
std::vector<std::vector<Offset>>
Rays(const Vector3 & spacing, double reach)
{
  std::vector<std::vector<Offset>> rays;
  for (int number = 0; number < 27; ++number)
  {
    const Offset step{ number % 3 - 1, number / 3 % 3 - 1, number / 9 - 1 };
    const double length = Length({ step[0] * spacing[0], step[1] * spacing[1], step[2] * spacing[2] });
    if (length > 0)
    {
      rays.emplace_back();
      for (std::int32_t i = 1; i * length <= reach; ++i)
      {
        rays.back().push_back({ i * step[0], i * step[1], i * step[2] });
      }
    }
  }
  return rays;
}

} // namespace

EditedShape
FillClefts(VoxelShape                                         shape,
           const VoxelShape &                                 walls,
           const Vector3 &                                    spacing,
           double                                             reach,
           const std::optional<std::array<std::int64_t, 3>> & scan)
{
  const Additions   before(shape);
  const VoxelBox    box = shape.Box();
  const EndlessRows rows(walls, scan);
  const auto        rays = Rays(spacing, reach);
  VoxelShape        filled(box);
#pragma omp parallel for schedule(dynamic)
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto own = std::as_const(shape).Row(y, z);
      const auto row = filled.Row(y, z);
      for (std::int32_t x = 0; x < box.size[0]; x += 64)
      {
        const auto          word = static_cast<std::size_t>(x >> 6);
        const std::int32_t  left = box.size[0] - x;
        const std::uint64_t inBox = left < 64 ? (std::uint64_t{ 1 } << left) - 1 : ~std::uint64_t{ 0 };
        // Per voxel three more than the number of open directions, in three words of bits; and whether that is eight.
        std::array<std::uint64_t, 3> count{ ~std::uint64_t{ 0 }, ~std::uint64_t{ 0 }, 0 };
        std::uint64_t                isOut = own[word] | ~inBox;
        for (auto ray = rays.begin(); ray != rays.end() && ~isOut != 0; ++ray)
        {
          std::uint64_t open = ~isOut;
          for (auto at = ray->begin(); at != ray->end() && open != 0; ++at)
          {
            open &= ~rows.Bits(box.lower[0] + x + (*at)[0], box.lower[1] + y + (*at)[1], box.lower[2] + z + (*at)[2]);
          }
          for (std::uint64_t & bits : count)
          {
            const std::uint64_t carry = bits & open;
            bits ^= open;
            open = carry;
          }
          isOut |= open;
        }
        row[word] = ~isOut;
      }
    }
  }
  filled.Compact();
  ForWords(shape, filled, [](std::uint64_t & word, std::uint64_t more) { word |= more; });
  return before.To(std::move(shape));
}

} // namespace voxelcore
