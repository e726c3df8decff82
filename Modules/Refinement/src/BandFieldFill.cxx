// What a band field starts from: distances to the boundary, or grey values.

#include "BandField.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace voxelcore
{

// Calls take(place in the tile, neighbour, voxel in it) for the voxels of a brick and `margin` voxels around it.
template <typename TTake>
void
BandField::GatherTile(std::size_t brick, std::int32_t margin, TTake take) const
{
  std::size_t at = 0;
  for (std::int32_t z = -margin; z < kSide + margin; ++z)
  {
    for (std::int32_t y = -margin; y < kSide + margin; ++y)
    {
      const std::int32_t rowNeighbour = 3 * (BrickOf(y) + 1) + 9 * (BrickOf(z) + 1);
      const std::int32_t rowVoxel = 8 * (y & 7) + 64 * (z & 7);
      for (std::int32_t x = -margin; x < kSide + margin; ++x)
      {
        take(at++,
             m_Neighbours[brick][static_cast<std::size_t>(rowNeighbour + BrickOf(x) + 1)],
             static_cast<std::size_t>(rowVoxel + (x & 7)));
      }
    }
  }
}

void
BandField::FillDistances(double clip)
{
  m_Far = static_cast<float>(clip);
  const auto count = static_cast<std::ptrdiff_t>(m_Bricks.size());
#pragma omp parallel for schedule(dynamic, 16) if (count > 16)
  for (std::ptrdiff_t brick = 0; brick < count; ++brick)
  {
    FillBrickDistances(static_cast<std::size_t>(brick), clip);
  }
}

void
BandField::FillBrickDistances(std::size_t brick, double clip)
{
  constexpr std::int32_t  side = kSide + 2 * kReach;
  constexpr std::uint32_t full = (1U << side) - 1;
  constexpr double        none = 1000;
  const double            half = 0.5 * std::min({ m_Sides[0], m_Sides[1], m_Sides[2] });
  const Vector3           squares{ m_Sides[0] * m_Sides[0], m_Sides[1] * m_Sides[1], m_Sides[2] * m_Sides[2] };
  // Rows of labels around the brick, then for each kind squared distances by x alone, by x and y, by all.
  std::array<std::uint32_t, static_cast<std::size_t>(side) * side> rows{};
  GatherTile(brick, kReach, [&](std::size_t at, std::int32_t neighbour, std::size_t voxel) {
    const bool in = neighbour >= 0
                      ? ((m_Labels[static_cast<std::size_t>(neighbour)][voxel >> 3] >> (voxel & 7)) & 1) != 0
                      : neighbour == kFarInside;
    rows[at / side] |= (in ? 1U : 0U) << (at % side);
  });
  for (const bool inside : { true, false })
  {
    std::array<std::array<double, kSide>, static_cast<std::size_t>(side) * side> byX;
    for (std::size_t row = 0; row < rows.size(); ++row)
    {
      const std::uint32_t other = inside ? ~rows[row] & full : rows[row];
      for (std::int32_t x = 0; x < kSide; ++x)
      {
        const std::uint32_t up = other >> (x + kReach);
        const std::uint32_t down = other << (31 - x - kReach);
        const std::int32_t  d = std::min(std::countr_zero(up), std::countl_zero(down));
        byX[row][static_cast<std::size_t>(x)] = d > kReach ? none : d * d * squares[0];
      }
    }
    std::array<std::array<double, kSide>, static_cast<std::size_t>(side) * kSide> byY;
    for (std::int32_t z = 0; z < side; ++z)
    {
      for (std::int32_t y = 0; y < kSide; ++y)
      {
        auto & to = byY[static_cast<std::size_t>(z * kSide + y)];
        to.fill(none);
        for (std::int32_t d = -kReach; d <= kReach; ++d)
        {
          const auto & from = byX[static_cast<std::size_t>(z * side + y + kReach + d)];
          for (std::size_t x = 0; x < kSide; ++x)
          {
            to[x] = std::min(to[x], from[x] + d * d * squares[1]);
          }
        }
      }
    }
    for (std::int32_t z = 0; z < kSide; ++z)
    {
      for (std::int32_t y = 0; y < kSide; ++y)
      {
        std::array<double, kSide> least;
        least.fill(none);
        for (std::int32_t d = -kReach; d <= kReach; ++d)
        {
          const auto & from = byY[static_cast<std::size_t>((z + kReach + d) * kSide + y)];
          for (std::size_t x = 0; x < kSide; ++x)
          {
            least[x] = std::min(least[x], from[x] + d * d * squares[2]);
          }
        }
        const auto row = static_cast<std::size_t>(z * kSide + y);
        for (std::size_t x = 0; x < kSide; ++x)
        {
          if ((((m_Labels[brick][row] >> x) & 1) != 0) == inside)
          {
            const double distance = std::min(std::sqrt(least[x]) - half, clip);
            m_Values[brick * kVoxels + row * kSide + x] = static_cast<float>(inside ? distance : -distance);
          }
        }
      }
    }
  }
}

void
BandField::FillGrey(const VoxelBox & scan, const GreyRows & rows)
{
  const auto          count = static_cast<std::ptrdiff_t>(m_Bricks.size());
  std::vector<double> sums(m_Bricks.size());
#pragma omp parallel for schedule(dynamic, 16) if (count > 16)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto brick = static_cast<std::size_t>(i);
    // A place beyond the scan, mirrored on its border; whether it was.
    const auto mirror = [&](std::size_t axis, std::int32_t voxel, bool & turned) {
      const std::int32_t last = scan.lower[axis] + scan.size[axis] - 1;
      turned = turned != (voxel < scan.lower[axis] || voxel > last);
      const std::int32_t mirrored = voxel < scan.lower[axis] ? 2 * scan.lower[axis] - 1 - voxel
                                    : voxel > last           ? 2 * last + 1 - voxel
                                                             : voxel;
      return std::clamp(mirrored, scan.lower[axis], last);
    };
    double sum = 0;
    for (std::size_t row = 0; row < 64; ++row)
    {
      bool                 turned = false;
      const auto           y = mirror(1, m_Bricks[brick][1] * kSide + static_cast<std::int32_t>(row & 7), turned);
      const auto           z = mirror(2, m_Bricks[brick][2] * kSide + static_cast<std::int32_t>(row >> 3), turned);
      const std::int32_t   x = m_Bricks[brick][0] * kSide;
      std::array<float, 8> values{};
      const std::int32_t   from = std::max(x, scan.lower[0]);
      const std::int32_t   to = std::min(x + kSide, scan.lower[0] + scan.size[0]);
      if (from < to)
      {
        rows(from, y, z, std::span<float>(values.data() + (from - x), static_cast<std::size_t>(to - from)));
      }
      float * const out = m_Values.data() + brick * kVoxels + row * 8;
      for (std::int32_t k = 0; k < kSide; ++k)
      {
        bool               turnedHere = turned;
        const std::int32_t place = mirror(0, x + k, turnedHere);
        float              value = 0;
        if (place >= from && place < to)
        {
          value = values[static_cast<std::size_t>(place - x)];
        }
        else
        {
          rows(place, y, z, std::span<float>(&value, 1));
        }
        // Beyond the border nothing is in, whatever lies on this side of it.
        out[k] = turnedHere ? -std::abs(value) : value;
        sum += std::abs(static_cast<double>(value));
      }
    }
    sums[brick] = sum;
  }
  double sum = 0;
  for (const double one : sums)
  {
    sum += one;
  }
  m_Far = m_Bricks.empty() ? 0.0F : static_cast<float>(sum / (static_cast<double>(m_Bricks.size()) * kVoxels));
}

} // namespace voxelcore
