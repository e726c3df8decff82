// Where a band field may be smoothed by passes that reach far.

#include "BandTile.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

// 1 up to `from`, 0 from `to` on.
double
Ramp(double value, double from, double to)
{
  return std::clamp((to - value) / (to - from), 0.0, 1.0);
}

} // namespace

// A ball that touches the boundary nearest to a voxel has its centre farther from it by the voxel's own distance, or nearer
// by it on its own side.
BandField::Parts
BandField::FindThick(double radius) const
{
  constexpr double   steps = 0.5; // what distances to centres are off by
  constexpr double   other = 3;   // voxels farther from the boundary are asked on their own side alone
  const auto         count = static_cast<std::ptrdiff_t>(m_Bricks.size());
  const Vector3      squares = Times(m_Sides, m_Sides);
  std::vector<Flags> in(m_Bricks.size(), Flags{});
  std::vector<Flags> out(m_Bricks.size(), Flags{});
  for (std::size_t i = 0; i < m_Values.size(); ++i)
  {
    const auto bit = static_cast<std::uint8_t>(1U << (i & 7));
    auto &     flags = m_Values[i] > 0 ? in : out;
    if (std::abs(m_Values[i]) >= static_cast<float>(radius - steps))
    {
      flags[i / kVoxels][(i % kVoxels) >> 3] |= bit;
    }
  }
  Parts parts(m_Values.size());
  if (std::none_of(in.begin(), in.end(), [](const Flags & flags) { return flags != Flags{}; }))
  {
    return parts;
  }
#pragma omp parallel for schedule(dynamic, 16) if (count > kManyBricks)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto brick = static_cast<std::size_t>(i);
    const auto toIn = tile::SquaredDistances(GatherRows(in, true, false, brick), squares);
    const auto toOut = tile::SquaredDistances(GatherRows(out, false, true, brick), squares);
    for (std::size_t voxel = 0; voxel < kVoxels; ++voxel)
    {
      const double distance = m_Values[brick * kVoxels + voxel];
      double       gap = 0;
      if (distance > -other)
      {
        gap = std::max(gap, std::sqrt(toIn[voxel]) - (radius - distance));
      }
      if (distance < other)
      {
        gap = std::max(gap, std::sqrt(toOut[voxel]) - (radius + distance));
      }
      parts[brick * kVoxels + voxel] = static_cast<std::uint8_t>(std::lround(255 * Ramp(gap, 1, 2)));
    }
  }
  return parts;
}

// The curvatures of the level set through a voxel, root of the sum of their squares: from differences two voxels apart, which
// see less of ripples.
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
    const std::int32_t neighbour = 1 + BrickOf(p[0]) + 3 * (1 + BrickOf(p[1])) + 9 * (1 + BrickOf(p[2]));
    return static_cast<double>(ValueAt(m_Neighbours[brick][static_cast<std::size_t>(neighbour)],
                                       (p[0] & 7) + kSide * (p[1] & 7) + kSide * kSide * (p[2] & 7)));
  };
  Vector3                slope{};
  std::array<Vector3, 3> bend{};
  const Vector3          step = Along({ 0, 0, 0 }, apart, m_Sides);
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
  const Vector3          n = Along({ 0, 0, 0 }, 1 / length, slope);
  std::array<Vector3, 3> across{};
  for (std::size_t k = 0; k < 3; ++k)
  {
    across[k] = Along(bend[k], -Dot(bend[k], n), n);
  }
  Vector3 along{};
  for (std::size_t k = 0; k < 3; ++k)
  {
    along = Along(along, n[k], across[k]);
  }
  double squares = 0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Vector3 row = Along(across[k], -n[k], along);
    squares += Dot(row, row);
  }
  return std::sqrt(squares) / length;
}

void
BandField::LeaveOutBends(Parts & parts, double radius, double near) const
{
  constexpr float onSurface = 1; // units on either side
  const auto      count = static_cast<std::ptrdiff_t>(m_Bricks.size());

  std::vector<Flags> bent(m_Bricks.size(), Flags{});
#pragma omp parallel for schedule(dynamic, 16) if (count > kManyBricks)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto brick = static_cast<std::size_t>(i);
    for (std::size_t voxel = 0; voxel < kVoxels; ++voxel)
    {
      if (std::abs(m_Values[brick * kVoxels + voxel]) <= onSurface && CurvatureAt(brick, voxel) > 1 / radius)
      {
        bent[brick][voxel >> 3] |= static_cast<std::uint8_t>(1U << (voxel & 7));
      }
    }
  }
  LeaveOutAround(bent, near, parts);
}

void
BandField::TakeBackAround(const std::vector<LatticePoint> & places, double near, const BandField & former)
{
  std::vector<Flags> flags(m_Bricks.size(), Flags{});
  for (const LatticePoint & p : places)
  {
    const std::int32_t brick = Find({ BrickOf(p.x), BrickOf(p.y), BrickOf(p.z) });
    flags[static_cast<std::size_t>(brick)][static_cast<std::size_t>((p.y & 7) + 8 * (p.z & 7))] |=
      static_cast<std::uint8_t>(1U << (p.x & 7));
  }
  Parts parts(m_Values.size(), 255);
  LeaveOutAround(flags, near, parts);
  for (std::size_t i = 0; i < m_Values.size(); ++i)
  {
    m_Values[i] = former.m_Values[i] + static_cast<float>(parts[i]) / 255 * (m_Values[i] - former.m_Values[i]);
  }
}

void
BandField::LeaveOutAround(const std::vector<Flags> & flags, double near, Parts & parts) const
{
  const auto    count = static_cast<std::ptrdiff_t>(m_Bricks.size());
  const Vector3 squares = Times(m_Sides, m_Sides);
#pragma omp parallel for schedule(dynamic, 16) if (count > kManyBricks)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto brick = static_cast<std::size_t>(i);
    const auto first = parts.begin() + static_cast<std::ptrdiff_t>(brick * kVoxels);
    if (std::none_of(first, first + kVoxels, [](std::uint8_t part) { return part != 0; }))
    {
      continue;
    }
    const auto toFlag = tile::SquaredDistances(GatherRows(flags, false, false, brick), squares);
    for (std::size_t voxel = 0; voxel < kVoxels; ++voxel)
    {
      std::uint8_t & part = parts[brick * kVoxels + voxel];
      part = static_cast<std::uint8_t>(std::lround(part * (1 - Ramp(std::sqrt(toFlag[voxel]), near, near + 2))));
    }
  }
}

} // namespace voxelcore
