#include "BandField.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

struct Mirrored
{
  std::int32_t voxel;
  bool         turned;
};

// A place beyond the scan, mirrored on its border; whether it was.
Mirrored
Mirror(const VoxelBox & scan, std::size_t axis, std::int32_t voxel)
{
  const std::int32_t first = scan.lower[axis];
  const std::int32_t last = first + scan.size[axis] - 1;
  const std::int32_t mirrored = voxel < first ? 2 * first - 1 - voxel : voxel > last ? 2 * last + 1 - voxel : voxel;
  return { std::clamp(mirrored, first, last), voxel < first || voxel > last };
}

// Of each voxel of the scan along an axis, from the box's first on, those of bricks that have its values.
std::vector<std::vector<Mirrored>>
PlacesAlong(std::size_t axis, const BrickGrid & grid, const VoxelBox & scan, const VoxelBox & box)
{
  std::int32_t first = grid.At(0)[axis];
  std::int32_t last = first;
  for (std::size_t brick = 0; brick < grid.Count(); ++brick)
  {
    first = std::min(first, grid.At(brick)[axis]);
    last = std::max(last, grid.At(brick)[axis]);
  }
  std::vector<std::vector<Mirrored>> places(static_cast<std::size_t>(box.size[axis]));
  for (std::int32_t voxel = BrickGrid::kSide * first; voxel < BrickGrid::kSide * (last + 1); ++voxel)
  {
    const Mirrored from = Mirror(scan, axis, voxel);
    const auto     at = static_cast<std::size_t>(from.voxel - box.lower[axis]);
    if (at < places.size())
    {
      places[at].push_back({ voxel, from.turned });
    }
  }
  return places;
}

// The bricks at y and z, in units of bricks.
std::pair<std::size_t, std::size_t>
BricksAt(const BrickGrid & grid, std::int32_t y, std::int32_t z)
{
  const auto firstFrom = [&](std::array<std::int32_t, 2> from) {
    std::size_t low = 0;
    for (std::size_t high = grid.Count(); low < high;)
    {
      const std::size_t middle = (low + high) / 2;
      const auto &      at = grid.At(middle);
      std::array{ at[2], at[1] } < from ? low = middle + 1 : high = middle;
    }
    return low;
  };
  return { firstFrom({ z, y }), firstFrom({ z, y + 1 }) };
}

} // namespace

void
BandField::FillGrey(const VoxelBox & scan, const GreyBoxRows & grey)
{
  if (m_Grid.Count() == 0)
  {
    SetFar(0);
    return;
  }
  const VoxelBox & box = grey.box;
  const auto       placesY = PlacesAlong(1, m_Grid, scan, box);
  const auto       placesZ = PlacesAlong(2, m_Grid, scan, box);
  std::size_t      filled = 0; // rows of bricks
  grey.visit([&](std::int32_t y, std::int32_t z, std::span<const float> values) {
    const auto fill = [&](std::int32_t brickX, bool turned, float * out) {
      const std::int32_t x = brickX * kSide;
      for (std::int32_t k = 0; k < kSide; ++k)
      {
        const Mirrored from = Mirror(scan, 0, x + k);
        const float    value = values[static_cast<std::size_t>(from.voxel - box.lower[0])];
        // Beyond the border nothing is in, whatever lies on this side of it.
        out[k] = turned != from.turned ? -std::abs(value) : value;
      }
    };
    for (const Mirrored & toZ : placesZ[static_cast<std::size_t>(z - box.lower[2])])
    {
      for (const Mirrored & toY : placesY[static_cast<std::size_t>(y - box.lower[1])])
      {
        const auto [first, end] = BricksAt(m_Grid, toY.voxel >> 3, toZ.voxel >> 3);
        const auto row = static_cast<std::size_t>((toZ.voxel & 7) * kSide + (toY.voxel & 7));
        for (std::size_t brick = first; brick < end; ++brick)
        {
          ++filled;
          fill(m_Grid.At(brick)[0], toY.turned != toZ.turned, m_Values.data() + brick * kVoxels + row * kSide);
        }
      }
    }
  });
  if (filled != m_Grid.Count() * kSide * kSide)
  {
    throw std::logic_error("grey values lack rows");
  }
  const auto          count = static_cast<std::ptrdiff_t>(m_Grid.Count());
  std::vector<double> sums(m_Grid.Count());
#pragma omp parallel for schedule(static) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto brick = static_cast<std::size_t>(i);
    for (std::size_t voxel = brick * kVoxels; voxel < (brick + 1) * kVoxels; ++voxel)
    {
      sums[brick] += std::abs(static_cast<double>(m_Values[voxel]));
    }
  }
  double sum = 0;
  for (const double one : sums)
  {
    sum += one;
  }
  SetFar(static_cast<float>(sum / (static_cast<double>(m_Grid.Count()) * kVoxels)));
}

} // namespace voxelcore
