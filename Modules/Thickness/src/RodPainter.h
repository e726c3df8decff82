#pragma once
// Rows of voxels painted with balls, from the first ball on, each voxel once.

#include "voxelcore/LocalThickness.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace voxelcore
{

inline constexpr std::int32_t kAlong = 16; ///< rows of voxels of a rod along y and along z

/** A ball in lattice units whose centre is given from the lower corner of the box. */
struct PaintedBall
{
  Vector3       centre;
  double        squared; ///< of the radius
  float         painted; ///< mm
  std::uint32_t index;   ///< among the balls given

  template <typename T>
  T
  Paint() const
  {
    if constexpr (std::is_same_v<T, float>)
    {
      return painted;
    }
    else
    {
      return index + 1;
    }
  }
};

/** The rods, of 16 x 16 rows each, of a slab that is 16 voxels high; each is painted by one thread. */
template <typename T>
class RodPainter
{
public:
  RodPainter(const VoxelShape & shape, const Vector3 & weights, VoxelField<T> & map)
    : m_Shape(shape)
    , m_Weights(weights)
    , m_Map(map)
  {}

  /** `balls`, in the order they are painted, of which `chosen` may touch the rod that begins at row firstY, firstZ. */
  void
  Paint(std::int32_t                   firstY,
        std::int32_t                   firstZ,
        std::span<const PaintedBall>   balls,
        std::span<const std::uint32_t> chosen)
  {
    const auto & size = m_Shape.Box().size;
    m_FirstY = firstY;
    m_FirstZ = firstZ;
    m_EndY = std::min(firstY + kAlong, size[1]);
    m_EndZ = std::min(firstZ + kAlong, size[2]);
    Begin();
    for (std::size_t i = 0; i < chosen.size() && m_Left > 0; ++i)
    {
      PaintBall(balls[chosen[i]]);
    }
  }

private:
  /** The voxels of a row that are in have ranks; m_Next leads from each to the first one at or behind it that is not
   *  painted. */
  void
  Begin()
  {
    const std::size_t words = m_Shape.WordsPerRow();
    m_Ranks.clear();
    m_Next.clear();
    m_RowNext.clear();
    m_Left = 0;
    for (std::int32_t z = m_FirstZ; z < m_EndZ; ++z)
    {
      for (std::int32_t y = m_FirstY; y < m_EndY; ++y)
      {
        const auto    bits = m_Shape.Row(y, z);
        std::uint32_t rank = 0;
        for (std::size_t word = 0; word < words; ++word)
        {
          m_Ranks.push_back(rank);
          rank += static_cast<std::uint32_t>(std::popcount(bits[word]));
        }
        m_Ranks.push_back(rank);
        m_RowNext.push_back(m_Next.size());
        const auto values = m_Map.Row(y, z);
        for (std::uint32_t i = 0; i < rank; ++i)
        {
          const bool isPainted = values[i] != 0;
          m_Next.push_back(isPainted ? i + 1 : i);
          m_Left += isPainted ? 0 : 1;
        }
        m_Next.push_back(rank);
      }
    }
  }

  void
  PaintBall(const PaintedBall & ball)
  {
    const auto range = [&](std::size_t axis, std::int32_t first, std::int32_t end) {
      const double reach = std::sqrt(ball.squared) / m_Weights[axis] + 1;
      const double low = std::clamp(ball.centre[axis] - reach, static_cast<double>(first), static_cast<double>(end));
      const double high = std::clamp(ball.centre[axis] + reach, static_cast<double>(first), static_cast<double>(end));
      return std::array<std::int32_t, 2>{ static_cast<std::int32_t>(low), static_cast<std::int32_t>(std::ceil(high)) };
    };
    const auto ys = range(1, m_FirstY, m_EndY);
    const auto zs = range(2, m_FirstZ, m_EndZ);
    for (std::int32_t z = zs[0]; z < zs[1]; ++z)
    {
      const double dz = (z + 0.5 - ball.centre[2]) * m_Weights[2];
      const double left = ball.squared - dz * dz;
      for (std::int32_t y = ys[0]; y < ys[1] && left >= 0; ++y)
      {
        const double dy = (y + 0.5 - ball.centre[1]) * m_Weights[1];
        const double squared = left - dy * dy;
        if (squared >= 0)
        {
          PaintRow(y, z, ball.centre[0], std::sqrt(squared) / m_Weights[0], ball.template Paint<T>());
        }
      }
    }
  }

  /** How many voxels of a row that are in lie before x. */
  std::uint32_t
  RankOf(const ConstShapeRow & bits, const std::uint32_t * ranks, std::int32_t x) const
  {
    const auto word = static_cast<std::size_t>(x) >> 6U;
    const auto rest = static_cast<unsigned>(x) & 63U;
    return rest == 0
             ? ranks[word]
             : ranks[word] + static_cast<std::uint32_t>(std::popcount(bits[word] & ((std::uint64_t{ 1 } << rest) - 1)));
  }

  void
  PaintRow(std::int32_t y, std::int32_t z, double centre, double half, T value)
  {
    const double width = m_Shape.Box().size[0];
    const auto   first = static_cast<std::int32_t>(std::clamp(std::ceil(centre - half - 0.5), 0.0, width));
    const auto   end = static_cast<std::int32_t>(std::clamp(std::floor(centre + half - 0.5) + 1, 0.0, width));
    if (first >= end)
    {
      return;
    }
    const auto            row = static_cast<std::size_t>((z - m_FirstZ) * (m_EndY - m_FirstY) + (y - m_FirstY));
    const auto            bits = m_Shape.Row(y, z);
    const std::uint32_t * ranks = m_Ranks.data() + row * (m_Shape.WordsPerRow() + 1);
    const std::uint32_t   last = RankOf(bits, ranks, end);
    std::uint32_t *       next = m_Next.data() + m_RowNext[row];
    std::uint32_t         at = Follow(next, RankOf(bits, ranks, first));
    if (at >= last)
    {
      return;
    }
    T * values = m_Map.values.data() +
                 m_Map.rowStarts[static_cast<std::size_t>(z) * static_cast<std::size_t>(m_Shape.Box().size[1]) +
                                 static_cast<std::size_t>(y)];
    while (at < last)
    {
      values[at] = value;
      next[at] = at + 1;
      --m_Left;
      at = Follow(next, at + 1);
    }
  }

  /** Halves the way on the way (Tarjan, van Leeuwen 1984). */
  static std::uint32_t
  Follow(std::uint32_t * next, std::uint32_t at)
  {
    while (next[at] != at)
    {
      next[at] = next[next[at]];
      at = next[at];
    }
    return at;
  }

  const VoxelShape &         m_Shape;
  Vector3                    m_Weights;
  VoxelField<T> &            m_Map;
  std::int32_t               m_FirstY = 0;
  std::int32_t               m_FirstZ = 0;
  std::int32_t               m_EndY = 0;
  std::int32_t               m_EndZ = 0;
  std::uint64_t              m_Left = 0; ///< voxels not painted
  std::vector<std::uint32_t> m_Ranks;    ///< per row and word, and at the row's end
  std::vector<std::size_t>   m_RowNext;  ///< where each row begins in m_Next
  std::vector<std::uint32_t> m_Next;
};

} // namespace voxelcore
