#include "BandField.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

void
BandField::FillGrey(const VoxelBox & scan, const GreyRows & rows)
{
  const auto          count = static_cast<std::ptrdiff_t>(m_Grid.Count());
  std::vector<double> sums(m_Grid.Count());
#pragma omp parallel for schedule(dynamic, 16) if (count > BrickGrid::kMany)
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
      const auto           y = mirror(1, m_Grid.At(brick)[1] * kSide + static_cast<std::int32_t>(row & 7), turned);
      const auto           z = mirror(2, m_Grid.At(brick)[2] * kSide + static_cast<std::int32_t>(row >> 3), turned);
      const std::int32_t   x = m_Grid.At(brick)[0] * kSide;
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
  SetFar(m_Grid.Count() == 0 ? 0.0F : static_cast<float>(sum / (static_cast<double>(m_Grid.Count()) * kVoxels)));
}

} // namespace voxelcore
