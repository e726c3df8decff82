#pragma once
// Tiles of rows of voxels painted with balls, from the greatest down, each voxel once.

#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Thickness/LocalThickness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace voxelcore
{

inline constexpr std::int32_t kTile = 32; ///< rows of a tile along y and along z

/** A ball in lattice units whose centre is given from the lower corner of the box. */
struct PaintedBall
{
  Vector3       centre;
  double        radius;
  double        value; ///< half of what it paints, mm
  std::uint32_t index; ///< among the balls given

  template <typename T>
  T
  Paint() const
  {
    if constexpr (std::is_same_v<T, float>)
    {
      return static_cast<float>(2 * value);
    }
    else
    {
      return index + 1;
    }
  }
};

/** The rows that a ball may touch along an axis: first and end, not below 0, of `size`. */
inline std::array<std::int32_t, 2>
RowsOf(double centre, double radius, double weight, std::int32_t size)
{
  constexpr double rounding = 1e-6;
  const double     reach = radius / weight + rounding;
  const double     most = size;
  return { static_cast<std::int32_t>(std::clamp(std::ceil(centre - reach - 0.5), 0.0, most)),
           static_cast<std::int32_t>(std::clamp(std::floor(centre + reach - 0.5) + 1, 0.0, most)) };
}

/** A tile is 32 x 32 rows; each is painted by one thread. What is left of its rows stands word by word, so that a ball
 *  passes a row that is painted where it might touch it at the cost of a look. */
template <typename T>
class TilePainter
{
public:
  TilePainter(const VoxelShape & shape, const Vector3 & weights, VoxelField<T> & map)
    : m_Shape(shape)
    , m_Weights(weights)
    , m_Map(map)
  {}

  /** `balls`, in the order they are painted, of the tile that begins at row firstY, firstZ. */
  void
  Paint(std::int32_t firstY, std::int32_t firstZ, std::span<const PaintedBall> balls)
  {
    const auto & size = m_Shape.Box().size;
    m_First = { 0, firstY, firstZ };
    m_End = { size[0], std::min(firstY + kTile, size[1]), std::min(firstZ + kTile, size[2]) };
    Begin();
    for (std::size_t i = 0; i < balls.size() && m_Left > 0; ++i)
    {
      PaintBall(balls[i]);
    }
  }

private:
  struct Word
  {
    std::uint64_t open; ///< voxels that are in and not painted
    std::uint64_t in;
    std::size_t   start; ///< where the value of its first voxel that is in stands
  };

  static std::size_t
  At(std::size_t word, std::int32_t y, std::int32_t z)
  {
    return (word * kTile + static_cast<std::size_t>(z)) * kTile + static_cast<std::size_t>(y);
  }

  void
  Begin()
  {
    const std::size_t words = m_Shape.WordsPerRow();
    m_Words.assign(words * kTile * kTile, Word{ 0, 0, 0 });
    m_Left = 0;
    for (std::int32_t z = m_First[2]; z < m_End[2]; ++z)
    {
      for (std::int32_t y = m_First[1]; y < m_End[1]; ++y)
      {
        const auto  bits = m_Shape.Row(y, z);
        std::size_t start = m_Map.rowStarts[static_cast<std::size_t>(z) * static_cast<std::size_t>(m_Map.box.size[1]) +
                                            static_cast<std::size_t>(y)];
        for (std::size_t word = 0; word < words; ++word)
        {
          Word & one = m_Words[At(word, y - m_First[1], z - m_First[2])];
          one = { 0, bits[word], start };
          for (std::uint64_t rest = one.in; rest != 0; rest &= rest - 1, ++start)
          {
            if (m_Map.values[start] == 0)
            {
              one.open |= rest & -rest;
              ++m_Left;
            }
          }
        }
      }
    }
  }

  /** The bits first to end - 1 of all of a row, as far as they are in a word. */
  static std::uint64_t
  BitsOf(std::size_t word, std::int32_t first, std::int32_t end)
  {
    const auto low = std::max<std::int64_t>(first - static_cast<std::int64_t>(64 * word), 0);
    const auto high = std::min<std::int64_t>(end - static_cast<std::int64_t>(64 * word), 64);
    return low >= high ? 0
                       : (~std::uint64_t{ 0 } << static_cast<unsigned>(low)) &
                           (~std::uint64_t{ 0 } >> static_cast<unsigned>(64 - high));
  }

  void
  PaintBall(const PaintedBall & ball)
  {
    std::array<std::array<std::int32_t, 2>, 3> range{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      range[axis] = RowsOf(ball.centre[axis], ball.radius, m_Weights[axis], m_Shape.Box().size[axis]);
      range[axis] = { std::max(range[axis][0], m_First[axis]), std::min(range[axis][1], m_End[axis]) };
      if (range[axis][0] >= range[axis][1])
      {
        return;
      }
    }
    const double              squared = ball.radius * ball.radius;
    std::array<double, kTile> aside; // squared, of the rows along y
    const auto [firstY, endY] = range[1];
    for (std::int32_t y = firstY; y < endY; ++y)
    {
      const double d = (y + 0.5 - ball.centre[1]) * m_Weights[1];
      aside[static_cast<std::size_t>(y - firstY)] = d * d;
    }
    const auto lastWord = static_cast<std::size_t>(range[0][1] - 1) >> 6U;
    for (std::size_t word = static_cast<std::size_t>(range[0][0]) >> 6U; word <= lastWord; ++word)
    {
      const std::uint64_t touched = BitsOf(word, range[0][0], range[0][1]);
      for (std::int32_t z = range[2][0]; z < range[2][1]; ++z)
      {
        const double d = (z + 0.5 - ball.centre[2]) * m_Weights[2];
        const double left = squared - d * d;
        Word * const row = &m_Words[At(word, firstY - m_First[1], z - m_First[2])];
        for (std::int32_t i = 0; i < endY - firstY; ++i)
        {
          const double rest = left - aside[static_cast<std::size_t>(i)];
          if ((row[i].open & touched) != 0 && rest >= 0)
          {
            PaintWord(row[i], word, ball, std::sqrt(rest) / m_Weights[0]);
          }
        }
      }
    }
  }

  void
  PaintWord(Word & one, std::size_t word, const PaintedBall & ball, double half)
  {
    const double  width = m_Shape.Box().size[0];
    const auto    first = static_cast<std::int32_t>(std::clamp(std::ceil(ball.centre[0] - half - 0.5), 0.0, width));
    const auto    end = static_cast<std::int32_t>(std::clamp(std::floor(ball.centre[0] + half - 0.5) + 1, 0.0, width));
    std::uint64_t painted = one.open & BitsOf(word, first, end);
    one.open &= ~painted;
    const T value = ball.template Paint<T>();
    for (; painted != 0; painted &= painted - 1)
    {
      const std::uint64_t before = (painted & -painted) - 1;
      m_Map.values[one.start + CountBits(one.in & before)] = value;
      --m_Left;
    }
  }

  const VoxelShape &          m_Shape;
  Vector3                     m_Weights;
  VoxelField<T> &             m_Map;
  std::array<std::int32_t, 3> m_First{};
  std::array<std::int32_t, 3> m_End{};
  std::uint64_t               m_Left = 0; ///< voxels not painted
  std::vector<Word>           m_Words;    ///< by word, z and y
};

} // namespace voxelcore
