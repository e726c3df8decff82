// What a band field starts from: distances to the boundary, or grey values.

#include "BandTile.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

// Flags of the voxels of a brick and of those around it; `farInside` and `farOutside` where there is no brick.
tile::Rows
BandField::GatherRows(const std::vector<Flags> & flags, bool farInside, bool farOutside, std::size_t brick) const
{
  constexpr std::int32_t bricks = tile::kSide / kSide;
  tile::Rows             rows{};
  for (std::int32_t n = 0; n < bricks * bricks * bricks; ++n)
  {
    const std::array<std::int32_t, 3> place{ n % bricks, n / bricks % bricks, n / bricks / bricks };
    // By way of a neighbour: beyond one that has no brick, what can be nearer than it is of its kind.
    std::int32_t found = static_cast<std::int32_t>(brick);
    for (std::array<std::int32_t, 3> left{ place[0] - 2, place[1] - 2, place[2] - 2 };
         found >= 0 && left != std::array<std::int32_t, 3>{ 0, 0, 0 };)
    {
      std::int32_t neighbour = 13;
      for (std::size_t axis = 0, stride = 1; axis < 3; ++axis, stride *= 3)
      {
        const std::int32_t one = std::clamp(left[axis], -1, 1);
        neighbour += one * static_cast<std::int32_t>(stride);
        left[axis] -= one;
      }
      found = m_Neighbours[static_cast<std::size_t>(found)][static_cast<std::size_t>(neighbour)];
    }
    const std::uint64_t all = (found == kFarInside ? farInside : farOutside) ? 0xFF : 0;
    for (std::int32_t row = 0; row < 64; ++row)
    {
      const std::uint64_t bits =
        found < 0 ? all : flags[static_cast<std::size_t>(found)][static_cast<std::size_t>(row)];
      const std::int32_t y = place[1] * kSide + (row & 7);
      const std::int32_t z = place[2] * kSide + (row >> 3);
      rows[static_cast<std::size_t>(z * tile::kSide + y)] |= bits << (place[0] * kSide);
    }
  }
  return rows;
}

void
BandField::FillDistances(double clip)
{
  m_Far = static_cast<float>(clip);
  const auto count = static_cast<std::ptrdiff_t>(m_Bricks.size());
#pragma omp parallel for schedule(dynamic, 16) if (count > kManyBricks)
  for (std::ptrdiff_t brick = 0; brick < count; ++brick)
  {
    FillBrickDistances(static_cast<std::size_t>(brick), clip);
  }
}

void
BandField::Clip(double clip)
{
  m_Far = static_cast<float>(clip);
  std::transform(m_Values.begin(), m_Values.end(), m_Values.begin(), [&](float value) {
    return std::clamp(value, -m_Far, m_Far);
  });
}

void
BandField::FillBrickDistances(std::size_t brick, double clip)
{
  const double     half = 0.5 * std::min({ m_Sides[0], m_Sides[1], m_Sides[2] });
  const Vector3    squares = Times(m_Sides, m_Sides);
  const tile::Rows labels = GatherRows(m_Labels, true, false, brick);
  tile::Rows       outside = labels;
  for (std::uint64_t & row : outside)
  {
    row = ~row & ((std::uint64_t{ 1 } << tile::kSide) - 1);
  }
  for (const bool inside : { true, false })
  {
    const auto least = tile::SquaredDistances(inside ? outside : labels, squares);
    for (std::size_t voxel = 0; voxel < kVoxels; ++voxel)
    {
      if ((((m_Labels[brick][voxel >> 3] >> (voxel & 7)) & 1) != 0) == inside)
      {
        const double distance = std::min(std::sqrt(least[voxel]) - half, clip);
        m_Values[brick * kVoxels + voxel] = static_cast<float>(inside ? distance : -distance);
      }
    }
  }
}

void
BandField::FillGrey(const VoxelBox & scan, const GreyRows & rows)
{
  const auto          count = static_cast<std::ptrdiff_t>(m_Bricks.size());
  std::vector<double> sums(m_Bricks.size());
#pragma omp parallel for schedule(dynamic, 16) if (count > kManyBricks)
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
