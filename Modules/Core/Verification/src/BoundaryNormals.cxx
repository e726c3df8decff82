#include "BoundaryNormals.h"

#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace voxelcore::verification
{

BoundaryNormals::BoundaryNormals(const VoxelShape & shape, const SpacingWeights & weights)
  : m_Shape(shape)
{
  const std::int64_t thickest = std::max({ weights.weight[0], weights.weight[1], weights.weight[2] });
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int64_t side = weights.weight[axis];
    const std::int64_t wanted = 6 * thickest * thickest - 2 * side * side;
    std::int32_t       run = 32;
    while (run > 1 && (2 * run - 1) * (2 * run - 1) * side * side >= wanted)
    {
      --run;
    }
    m_Runs[axis] = run;
    for (std::int32_t offset = -run; offset < run; ++offset)
    {
      // A run of runs about each of the two voxels, which begin at offsets -1 and 0.
      const std::int64_t behind = std::max(0, run - std::abs(offset + 1));
      const std::int64_t before = std::max(0, run - std::abs(offset));
      m_Lines[axis].sum.push_back(before + behind);
      m_Lines[axis].difference.push_back(before - behind);
    }
    m_Sides[axis] = static_cast<double>(side);
  }
  m_Diagonal = std::hypot(m_Sides[0], m_Sides[1], m_Sides[2]);
  m_Least = std::sqrt(3.0) * *ranges::min_element(m_Sides);
  m_Largest = std::max(1.0, m_Diagonal / m_Least);
}

double
BoundaryNormals::WeightAt(const LatticePoint & corner) const
{
  std::array<std::int64_t, 3> differences{};
  const auto [rx, ry, rz] = m_Runs;
  for (std::int32_t z = -rz; z < rz; ++z)
  {
    for (std::int32_t y = -ry; y < ry; ++y)
    {
      for (std::int32_t x = -rx; x < rx; ++x)
      {
        if (!m_Shape.Contains(corner.x + x, corner.y + y, corner.z + z))
        {
          continue;
        }
        const auto i = static_cast<std::size_t>(x + rx);
        const auto j = static_cast<std::size_t>(y + ry);
        const auto k = static_cast<std::size_t>(z + rz);
        differences[0] += m_Lines[0].difference[i] * m_Lines[1].sum[j] * m_Lines[2].sum[k];
        differences[1] += m_Lines[0].sum[i] * m_Lines[1].difference[j] * m_Lines[2].sum[k];
        differences[2] += m_Lines[0].sum[i] * m_Lines[1].sum[j] * m_Lines[2].difference[k];
      }
    }
  }
  std::array<double, 3> normal{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    normal[axis] = static_cast<double>(std::abs(differences[axis])) / m_Sides[axis];
  }
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  if (length == 0)
  {
    return 1;
  }
  const double extent = (normal[0] * m_Sides[0] + normal[1] * m_Sides[1] + normal[2] * m_Sides[2]) / length;
  return std::clamp(m_Diagonal / std::max(m_Least, extent), 1.0, m_Largest);
}

} // namespace voxelcore::verification
