#pragma once

#include "voxelcore/Complex/CellComplex.h"

#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace voxelcore
{

/** The area of a flat polygon, in squares of the unit of `positions`. */
inline double
PolygonArea(const std::vector<std::array<double, 3>> & positions, std::span<const ElementIndex> corners)
{
  std::array<double, 3> sum{ 0, 0, 0 };
  const auto &          first = positions[corners[0]];
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
  {
    std::array<double, 3> a;
    std::array<double, 3> b;
    for (std::size_t k = 0; k < 3; ++k)
    {
      a[k] = positions[corners[i]][k] - first[k];
      b[k] = positions[corners[i + 1]][k] - first[k];
    }
    sum[0] += a[1] * b[2] - a[2] * b[1];
    sum[1] += a[2] * b[0] - a[0] * b[2];
    sum[2] += a[0] * b[1] - a[1] * b[0];
  }
  return std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / 2;
}

} // namespace voxelcore
