#pragma once
// Distances along z to the nearest voxels of a shape, slice after slice.

#include "voxelcore/Shape/VoxelShape.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** A number for a place of a slice, of which slices have many. */
using SliceNumber = std::int16_t;

/** For each column along z, the voxels next to a slice that moves up. */
class NearestAlongZ
{
public:
  static constexpr SliceNumber none = -1;

  /** Begins at slice `z`, which may lie outside the shape's box. */
  NearestAlongZ(const VoxelShape & shape, std::int32_t z)
    : m_Shape(shape)
    , m_Size(shape.Box().size)
    , m_Next(z)
    , m_Below(static_cast<std::size_t>(m_Size[0]) * static_cast<std::size_t>(m_Size[1]), kNo)
    , m_Above(m_Below.size(), kUnknown)
  {}

  /** Of the next slices the distances to the nearest voxel in the column, slice by slice and row by row; none where it
   *  is more than `most`. */
  void
  Next(std::int32_t slices, std::int32_t most, std::vector<SliceNumber> & distances)
  {
#pragma omp parallel for schedule(static)
    for (std::int32_t y = 0; y < m_Size[1]; ++y)
    {
      for (std::int32_t slice = 0; slice < slices; ++slice)
      {
        std::size_t column = static_cast<std::size_t>(y) * static_cast<std::size_t>(m_Size[0]);
        std::size_t place = static_cast<std::size_t>(slice) * m_Below.size() + column;
        for (std::int32_t x = 0; x < m_Size[0]; ++x, ++column, ++place)
        {
          const std::int32_t distance = Distance(x, y, m_Next + slice, column);
          distances[place] = distance <= most ? static_cast<SliceNumber>(distance) : none;
        }
      }
    }
    m_Next += slices;
  }

private:
  static constexpr std::int32_t kNo = -1;
  static constexpr std::int32_t kUnknown = -2;
  static constexpr std::int32_t kFar = 0x7FFFFFFF;

  bool
  IsIn(std::int32_t x, std::int32_t y, std::int32_t z) const
  {
    return (m_Shape.Row(y, z)[static_cast<std::size_t>(x) / 64] >> (static_cast<unsigned>(x) & 63U) & 1U) != 0;
  }

  std::int32_t
  Distance(std::int32_t x, std::int32_t y, std::int32_t z, std::size_t column)
  {
    std::int32_t & below = m_Below[column];
    std::int32_t & above = m_Above[column];
    if (above == kUnknown || (above != kNo && above < z))
    {
      below = above == kUnknown ? kNo : above;
      above = std::max(z, 0);
      while (above < m_Size[2] && !IsIn(x, y, above))
      {
        ++above;
      }
      above = above < m_Size[2] ? above : kNo;
    }
    return std::min(below == kNo ? kFar : z - below, above == kNo ? kFar : above - z);
  }

  const VoxelShape &                  m_Shape;
  const std::array<std::int32_t, 3> & m_Size;
  std::int32_t                        m_Next;
  std::vector<std::int32_t>           m_Below;
  std::vector<std::int32_t>           m_Above; ///< or in the slice itself
};

} // namespace voxelcore
