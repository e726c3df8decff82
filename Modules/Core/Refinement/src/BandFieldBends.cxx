// Where a band field has its surface bent.

#include "BandField.h"

#include "voxelcore/Lattice/Vectors.h"

#include <cmath>

namespace voxelcore
{

// The curvatures of the level set through a voxel, root of the sum of their squares, less than 0 where the inside is
// convex: from differences two voxels apart, which see less of ripples.
double
BandField::CurvatureAt(std::size_t brick, std::size_t voxel) const
{
  const std::array<std::int32_t, 3> at{ static_cast<std::int32_t>(voxel & 7),
                                        static_cast<std::int32_t>((voxel >> 3) & 7),
                                        static_cast<std::int32_t>(voxel >> 6) };
  constexpr std::int32_t            apart = 2;
  const auto                        value = [&](std::size_t k, std::int32_t stepK, std::size_t l, std::int32_t stepL) {
    std::array<std::int32_t, 3> p = at;
    p[k] += apart * stepK;
    p[l] += apart * stepL;
    const std::int32_t neighbour = 1 + (p[0] >> 3) + 3 * (1 + (p[1] >> 3)) + 9 * (1 + (p[2] >> 3));
    const float *      block = Block(m_Values, m_Grid.Neighbours(brick)[static_cast<std::size_t>(neighbour)]);
    return static_cast<double>(block[(p[0] & 7) + kSide * (p[1] & 7) + kSide * kSide * (p[2] & 7)]);
  };
  Vector3                slope{};
  std::array<Vector3, 3> bend{};
  const Vector3          step = AddScaled({ 0, 0, 0 }, apart, m_Sides);
  const double           here = m_Values[brick * kVoxels + voxel];
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double up = value(k, 1, k, 0);
    const double down = value(k, -1, k, 0);
    slope[k] = (up - down) / (2 * step[k]);
    bend[k][k] = (up + down - 2 * here) / (step[k] * step[k]);
    for (std::size_t l = 0; l < k; ++l)
    {
      const double sum = value(k, 1, l, 1) + value(k, -1, l, -1) - value(k, 1, l, -1) - value(k, -1, l, 1);
      bend[k][l] = bend[l][k] = sum / (4 * step[k] * step[l]);
    }
  }
  const double length = Length(slope);
  if (!(length > 0))
  {
    return 0;
  }
  // Of the bends what lies across the slope, from both sides.
  const Vector3          n = AddScaled({ 0, 0, 0 }, 1 / length, slope);
  std::array<Vector3, 3> across{};
  for (std::size_t k = 0; k < 3; ++k)
  {
    across[k] = AddScaled(bend[k], -Dot(bend[k], n), n);
  }
  Vector3 along{};
  for (std::size_t k = 0; k < 3; ++k)
  {
    along = AddScaled(along, n[k], across[k]);
  }
  double squares = 0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Vector3 row = AddScaled(across[k], -n[k], along);
    squares += Dot(row, row);
  }
  const double sum = across[0][0] + across[1][1] + across[2][2];
  return std::copysign(std::sqrt(squares), sum) / length;
}

void
BandField::MarkBends(double most, double radius, SmoothingZones & zones, bool convexAlone) const
{
  const auto                    count = static_cast<std::ptrdiff_t>(m_Grid.Count());
  std::vector<BrickGrid::Flags> bent(m_Grid.Count(), BrickGrid::Flags{});
#pragma omp parallel for schedule(dynamic, 16) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto brick = static_cast<std::size_t>(i);
    for (std::size_t voxel = 0; voxel < kVoxels; ++voxel)
    {
      if (std::abs(m_Values[brick * kVoxels + voxel]) > static_cast<float>(most))
      {
        continue;
      }
      const double curvature = CurvatureAt(brick, voxel);
      if ((convexAlone ? -curvature : std::abs(curvature)) > 1 / radius)
      {
        bent[brick][voxel >> 3] |= static_cast<std::uint8_t>(1U << (voxel & 7));
      }
    }
  }
  for (std::size_t brick = 0; brick < bent.size(); ++brick)
  {
    const auto & at = m_Grid.At(brick);
    for (std::int32_t row = 0; row < kSide * kSide; ++row)
    {
      for (std::int32_t x = 0; x < kSide; ++x)
      {
        if ((bent[brick][static_cast<std::size_t>(row)] >> x & 1) != 0)
        {
          zones.Mark(kSide * at[0] + x, kSide * at[1] + (row & 7), kSide * at[2] + (row >> 3));
        }
      }
    }
  }
}

} // namespace voxelcore
