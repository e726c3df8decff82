#pragma once
// Which of many places lie in a ball.

#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Lattice/ImageGeometry.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace voxelcore
{

struct Ball
{
  Vector3 centre{};
  double  radius = 0;
};

/** Places in the order of the cubes they lie in, so that near ones stand together; eight cubes along each axis are a
 *  block, and blocks without places cost a number. */
class PlaceGrid
{
public:
  /** `placeOf` gives the places 0 to count - 1. Cubes of `side`, or of as many times as much as keeps blocks fewer than
   *  places: speed alone depends on it. */
  PlaceGrid(std::size_t count, const std::function<Vector3(std::size_t)> & placeOf, double side);

  /** The places by cubes. */
  const std::vector<std::uint32_t> &
  Order() const
  {
    return m_Order;
  }

  /** Puts what belongs to the places, in the order they were given, in theirs. */
  template <typename T>
  void
  Arrange(std::vector<T> & values) const
  {
    std::vector<bool> isThere(values.size(), false);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      if (isThere[i])
      {
        continue;
      }
      const T     first = values[i];
      std::size_t to = i;
      for (; m_Order[to] != i; to = m_Order[to])
      {
        values[to] = values[m_Order[to]];
        isThere[to] = true;
      }
      values[to] = first;
      isThere[to] = true;
    }
  }

  /** look(i), i in this order, for each place in the ball, and for others near it. Where it has put a ball there that
   *  lies in the ball, it returns true, and places in that one alone are then looked for. */
  template <typename TLook>
  void
  Visit(const Ball & ball, const TLook & look) const
  {
    InCubes     there = Enter(ball);
    const Range x = BlocksOf(there, 0);
    const Range y = BlocksOf(there, 1);
    const Range z = BlocksOf(there, 2);
    for (std::array<std::int64_t, 3> at{ 0, 0, z.first }; at[2] <= z.last; ++at[2])
    {
      for (at[1] = y.first; at[1] <= y.last; ++at[1])
      {
        for (at[0] = x.first; at[0] <= x.last; ++at[0])
        {
          const std::uint32_t block =
            m_BlockAt[static_cast<std::size_t>((at[2] * m_Blocks[1] + at[1]) * m_Blocks[0] + at[0])];
          if (block != kNone)
          {
            VisitBlock(m_Found[block], at, ball, there, look);
          }
        }
      }
    }
  }

private:
  static constexpr unsigned      kEdge = 8;
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  static constexpr double        kRounding = 1e-6; ///< of a cube's side: more than coordinates are off

  struct Range
  {
    std::int64_t first;
    std::int64_t last;
  };
  struct Block
  {
    std::array<std::uint64_t, kEdge> cubes{};   ///< by z, bit 8 y + x: whether it holds a place
    std::array<std::uint16_t, kEdge> before{};  ///< by z, how many before these do
    std::uint32_t                    first = 0; ///< in m_Begin
  };

  /** A ball in cubes from the lowest one, a little greater. */
  struct InCubes
  {
    Vector3 centre;
    double  reach;
    double  squared;
  };

  double
  CubesTo(double coordinate, std::size_t axis) const
  {
    return (coordinate - m_Low[axis]) * m_PerSide;
  }
  InCubes
  Enter(const Ball & ball) const
  {
    const double reach = ball.radius * m_PerSide * (1 + kRounding) + kRounding;
    return { { CubesTo(ball.centre[0], 0), CubesTo(ball.centre[1], 1), CubesTo(ball.centre[2], 2) },
             reach,
             reach * reach };
  }
  std::array<std::int64_t, 3>
  CubeOf(const Vector3 & place) const;
  Range
  BlocksOf(const InCubes & ball, std::size_t axis) const
  {
    const auto   most = static_cast<double>(m_Blocks[axis] - 1);
    const double first = std::floor((ball.centre[axis] - ball.reach) / kEdge);
    const double last = std::floor((ball.centre[axis] + ball.reach) / kEdge);
    return { static_cast<std::int64_t>(std::clamp(first, 0.0, most + 1)),
             static_cast<std::int64_t>(std::clamp(last, -1.0, most)) };
  }
  /** Of eight in a row, those from `middle` - `half` to `middle` + `half`: the first and the end. */
  static std::array<unsigned, 2>
  CubesWithin(double middle, double half)
  {
    // Rounded down, as what is below 0 is cut off.
    return { static_cast<unsigned>(std::clamp(middle - half, 0.0, 8.0)),
             static_cast<unsigned>(std::clamp(middle + half + 1, 0.0, 8.0)) };
  }
  /** From a coordinate to the cube that begins there, squared. */
  static double
  SquaredGap(double middle, double cube)
  {
    const double from = cube - middle;
    const double gap = std::max({ from, -1 - from, 0.0 });
    return gap * gap;
  }

  template <typename TLook>
  void
  VisitBlock(const Block &                       block,
             const std::array<std::int64_t, 3> & at,
             const Ball &                        ball,
             InCubes &                           there,
             const TLook &                       look) const
  {
    const Vector3 corner{ static_cast<double>(at[0] * kEdge),
                          static_cast<double>(at[1] * kEdge),
                          static_cast<double>(at[2] * kEdge) };
    const auto [firstZ, endZ] = CubesWithin(there.centre[2] - corner[2], there.reach);
    const auto [firstY, endY] = CubesWithin(there.centre[1] - corner[1], there.reach);
    const std::uint64_t rows = Bits(kEdge * firstY, kEdge * endY);
    for (unsigned z = firstZ; z < endZ; ++z)
    {
      const std::uint64_t layer = block.cubes[z];
      for (std::uint64_t left = layer & rows; left != 0;)
      {
        const unsigned y = static_cast<unsigned>(std::countr_zero(left)) / kEdge;
        std::uint64_t  row = left & Bits(kEdge * y, kEdge * (y + 1));
        left ^= row;
        const double rest =
          there.squared - SquaredGap(there.centre[2], corner[2] + z) - SquaredGap(there.centre[1], corner[1] + y);
        if (rest < 0)
        {
          continue;
        }
        const auto [first, end] = CubesWithin(there.centre[0] - corner[0], std::sqrt(rest));
        row &= Bits(kEdge * y + first, kEdge * y + end);
        for (; row != 0; row &= row - 1)
        {
          const std::size_t cube = block.first + block.before[z] + CountBits(layer & ((row & -row) - 1));
          for (std::uint32_t i = m_Begin[cube]; i < m_Begin[cube + 1]; ++i)
          {
            if (look(i))
            {
              there = Enter(ball);
            }
          }
        }
      }
    }
  }
  /** Bits first to end - 1. */
  static std::uint64_t
  Bits(unsigned first, unsigned end)
  {
    const auto below = [](unsigned bit) { return bit < 64 ? (std::uint64_t{ 1 } << bit) - 1 : ~std::uint64_t{ 0 }; };
    return below(end) & ~below(first);
  }

  Vector3                     m_Low{};
  double                      m_PerSide = 1;
  std::array<std::int64_t, 3> m_Blocks{ 1, 1, 1 };
  std::vector<std::uint32_t>  m_BlockAt; ///< by x, y, z
  std::vector<Block>          m_Found;
  std::vector<std::uint32_t>  m_Begin; ///< of each cube with places, where they begin; then their end
  std::vector<std::uint32_t>  m_Order;
};

} // namespace voxelcore
