#include "BrickSums.h"

#include "voxelcore/Base/EightLanes.h"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr std::size_t kCube = BrickGrid::kSide;
constexpr std::size_t kMostRows = 3 * kCube;
using Eight = EightFloats;
using Lines = std::array<float, kMostRows * kCube * kCube>;

// Eight voxels that lie beside each other along x, `along` apart in a column of bricks, after one another in `to`.
template <std::size_t Radius>
[[gnu::always_inline]] inline void
SumColumn(const std::array<const float *, 3> & from,
          std::size_t                          along,
          const float *                        weights,
          float *                              to,
          std::size_t                          apart)
{
  Eight column[kCube + 2 * Radius];
  for (std::size_t i = 0; i < kCube + 2 * Radius; ++i)
  {
    const std::size_t layer = i + kCube - Radius;
    column[i] = EightAt(from[layer / kCube] + (layer % kCube) * along)->lanes;
  }
  for (std::size_t i = 0; i < kCube; ++i)
  {
    Eight sum = weights[0] * column[i + Radius];
    for (std::size_t k = 1; k <= Radius; ++k)
    {
      sum += weights[k] * (column[i + Radius - k] + column[i + Radius + k]);
    }
    EightAt(to + i * apart)->lanes = sum;
  }
}

// The sum of the eight that lie `Shift` before and behind those in the middle of three times eight.
template <std::size_t Shift, std::size_t... I>
[[gnu::always_inline]] inline void
AddBeside(const Eight (&row)[3], float weight, Eight & sum, std::index_sequence<I...>)
{
  sum += weight * (__builtin_shufflevector(row[0], row[1], static_cast<int>(kCube - Shift + I)...) +
                   __builtin_shufflevector(row[1], row[2], static_cast<int>(Shift + I)...));
}

template <std::size_t... Less>
[[gnu::always_inline]] inline void
SumRowsOf(const std::array<const float *, 3> & from, const float * weights, float * to, std::index_sequence<Less...>)
{
  for (std::size_t at = 0; at < BrickGrid::kCells; at += kCube)
  {
    Eight row[3];
    for (std::size_t part = 0; part < from.size(); ++part)
    {
      row[part] = EightAt(from[part] + at)->lanes;
    }
    Eight sum = weights[0] * row[1];
    (AddBeside<Less + 1>(row, weights[Less + 1], sum, std::make_index_sequence<kCube>{}), ...);
    EightAt(to + at)->lanes = sum;
  }
}

// sum(std::integral_constant<std::size_t, radius>): loops of known length, for each radius that kernels have.
template <typename TSum>
[[gnu::always_inline]] inline void
WithRadius(std::size_t radius, TSum sum)
{
  const auto any = [&]<std::size_t... Less>(std::index_sequence<Less...>) __attribute__((always_inline))
  {
    (void)((radius == Less + 1 && (sum(std::integral_constant<std::size_t, Less + 1>{}), true)) || ...);
  };
  any(std::make_index_sequence<kCube>{});
}

// Along z, of the lines first to end along y of a brick; to `rows` of them a layer.
VOXELCORE_EIGHT_LANES void
SumLayers(const std::array<const float *, 3> & from,
          std::size_t                          first,
          std::size_t                          end,
          const Kernel &                       kernel,
          float *                              to,
          std::size_t                          rows)
{
  WithRadius(
    kernel.radius,
    [&](auto radius) __attribute__((always_inline)) {
      for (std::size_t line = first; line < end; ++line)
      {
        const std::size_t at = line * kCube;
        SumColumn<decltype(radius)::value>({ from[0] + at, from[1] + at, from[2] + at },
                                           kCube * kCube,
                                           kernel.weights.data(),
                                           to + (line - first) * kCube,
                                           rows * kCube);
      }
    });
}

// Along y, of the lines that SumLayers made.
VOXELCORE_EIGHT_LANES void
SumLines(const float * from, const Kernel & kernel, float * to)
{
  WithRadius(
    kernel.radius,
    [&](auto radius) __attribute__((always_inline)) {
      constexpr std::size_t side = decltype(radius)::value;
      constexpr std::size_t rows = kCube + 2 * side;
      for (std::size_t layer = 0; layer < kCube; ++layer)
      {
        const float * const middle = from + (layer * rows + side) * kCube;
        SumColumn<side>({ middle - kCube * kCube, middle, middle + kCube * kCube },
                        kCube,
                        kernel.weights.data(),
                        to + layer * kCube * kCube,
                        kCube);
      }
    });
}

VOXELCORE_EIGHT_LANES void
SumRows(const std::array<const float *, 3> & from, const Kernel & kernel, float * to)
{
  WithRadius(
    kernel.radius,
    [&](auto radius) __attribute__((always_inline)) {
      SumRowsOf(from, kernel.weights.data(), to, std::make_index_sequence<decltype(radius)::value>{});
    });
}

} // namespace

const float *
BrickSums::AlongZAndY(std::int32_t brick)
{
  if (brick < 0)
  {
    return Block(brick, 1);
  }
  for (std::size_t i = 0; i < m_Bricks.size(); ++i)
  {
    if (m_Bricks[i] == brick)
    {
      return m_Kept[i].data();
    }
  }
  const auto &      around = m_Grid.Neighbours(static_cast<std::size_t>(brick));
  const Kernel &    kernelY = m_Kernels[1];
  const std::size_t rows = kCube + 2 * kernelY.radius;
  Lines             lines;
  for (std::size_t y = 0; y < 3; ++y)
  {
    const std::size_t at = BrickGrid::kSelf - 3 + 3 * y;
    const std::size_t first = y == 0 ? kCube - kernelY.radius : 0;
    const std::size_t end = y == 2 ? kernelY.radius : kCube;
    float * const     to = lines.data() + (y == 0 ? 0 : y == 1 ? kernelY.radius : kernelY.radius + kCube) * kCube;
    if (around[at] >= 0)
    {
      SumLayers({ Block(around[at - 9], 0), Block(around[at], 1), Block(around[at + 9], 2) },
                first,
                end,
                m_Kernels[2],
                to,
                rows);
      continue;
    }
    for (std::size_t layer = 0; layer < kCube; ++layer)
    {
      std::fill_n(to + layer * rows * kCube, (end - first) * kCube, Block(around[at], 1)[0]);
    }
  }
  float * const sums = m_Kept[m_Turn].data();
  SumLines(lines.data(), kernelY, sums);
  m_Bricks[m_Turn] = brick;
  m_Turn = (m_Turn + 1) % m_Bricks.size();
  return sums;
}

void
BrickSums::Of(std::size_t brick, float * sums)
{
  const auto &                       around = m_Grid.Neighbours(brick);
  const float * const                before = AlongZAndY(around[BrickGrid::kSelf - 1]);
  const float * const                middle = AlongZAndY(static_cast<std::int32_t>(brick));
  const std::array<const float *, 3> three{ before, middle, AlongZAndY(around[BrickGrid::kSelf + 1]) };
  SumRows(three, m_Kernels[0], sums);
}

} // namespace voxelcore
