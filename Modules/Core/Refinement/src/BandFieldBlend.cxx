// How former values of a band field stay where it may not be smoothed.

#include "BandField.h"

#include <algorithm>

namespace voxelcore
{

namespace
{

constexpr float kSavedUnits = 24000; // to Far(), so that values may be somewhat greater

} // namespace

BandField::Snapshot
BandField::Save(const SmoothingZones & zones) const
{
  Snapshot saved;
  for (std::size_t brick = 0; brick < m_Grid.Count(); ++brick)
  {
    if (zones.AnyIn(m_Level, m_Grid.At(brick)))
    {
      saved.bricks.push_back(static_cast<std::uint32_t>(brick));
    }
  }
  const float unit = kSavedUnits / m_Far;
  const auto  count = static_cast<std::ptrdiff_t>(saved.bricks.size());
  saved.values.resize(saved.bricks.size() * kVoxels);
#pragma omp parallel for schedule(static) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const float * const from = m_Values.data() + saved.bricks[static_cast<std::size_t>(i)] * kVoxels;
    std::transform(
      from,
      from + kVoxels,
      saved.values.begin() + i * static_cast<std::ptrdiff_t>(kVoxels),
      [&](float value) { return static_cast<std::int16_t>(std::clamp(value * unit, -32767.0F, 32767.0F)); });
  }
  return saved;
}

std::vector<std::uint8_t>
BandField::LeftOut(const SmoothingZones & zones, int passes) const
{
  const auto                count = static_cast<std::ptrdiff_t>(m_Grid.Count());
  std::vector<std::uint8_t> bricks(m_Grid.Count(), 0);
#pragma omp parallel for schedule(dynamic, 16) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto brick = static_cast<std::size_t>(i);
    bricks[brick] = zones.AnyLeftOutIn(m_Level, m_Grid.At(brick)) ? 1 : 0;
  }
  std::size_t reach = 0;
  for (const Kernel & kernel : m_Binomial)
  {
    reach = std::max(reach, 2 * kernel.radius * static_cast<std::size_t>(passes));
  }
  for (std::size_t ring = 0; ring < reach; ring += kSide)
  {
    bricks = m_Grid.AndAround(bricks);
  }
  return bricks;
}

std::vector<std::uint8_t>
BandField::BlendWith(const Snapshot & former, const SmoothingZones & zones, float weight)
{
  const float                unit = m_Far / kSavedUnits;
  std::vector<std::uint32_t> places(m_Grid.Count(), 0); // one more than in the snapshot
  for (std::size_t i = 0; i < former.bricks.size(); ++i)
  {
    places[former.bricks[i]] = static_cast<std::uint32_t>(i + 1);
  }
  const auto formerOf = [&](std::size_t brick, BrickValues & values) {
    const auto from =
      former.values.begin() + (static_cast<std::ptrdiff_t>(places[brick]) - 1) * static_cast<std::ptrdiff_t>(kVoxels);
    const bool saved = places[brick] != 0;
    if (saved)
    {
      std::transform(from, from + static_cast<std::ptrdiff_t>(kVoxels), values.begin(), [&](std::int16_t value) {
        return unit * static_cast<float>(value);
      });
    }
    return saved;
  };
  return Blend(formerOf, zones, weight);
}

std::vector<std::uint8_t>
BandField::BlendWith(const BandField & former, const SmoothingZones & zones, float weight)
{
  const auto formerOf = [&](std::size_t brick, BrickValues & values) {
    const auto from = static_cast<std::size_t>(former.m_Grid.Find(m_Grid.At(brick))) * kVoxels;
    std::copy_n(former.m_Values.begin() + static_cast<std::ptrdiff_t>(from), kVoxels, values.begin());
    return true;
  };
  return Blend(formerOf, zones, weight);
}

// formerOf(brick, values): whether it has changed, and what its values were.
template <typename TFormer>
std::vector<std::uint8_t>
BandField::Blend(const TFormer & formerOf, const SmoothingZones & zones, float weight)
{
  const auto                count = static_cast<std::ptrdiff_t>(m_Grid.Count());
  std::vector<std::uint8_t> changed = LeftOut(zones, 0);
#pragma omp parallel for schedule(dynamic, 16) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto  brick = static_cast<std::size_t>(i);
    BrickValues former;
    if (changed[brick] == 0 || !formerOf(brick, former))
    {
      changed[brick] = 0;
      continue;
    }
    BrickValues parts;
    zones.Fill(m_Level, m_Grid.At(brick), parts);
    float * const values = m_Values.data() + brick * kVoxels;
    for (std::size_t voxel = 0; voxel < kVoxels; ++voxel)
    {
      values[voxel] = former[voxel] + parts[voxel] * (values[voxel] - former[voxel]);
    }
  }
  // Sums reach one or two bricks far, and what is evaluated one more.
  std::size_t reach = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    reach = std::max(reach, m_GaussToSpline[axis].radius + m_Gauss[axis].radius);
  }
  changed = m_Grid.AndAround(changed);
  if (reach > kSide)
  {
    changed = m_Grid.AndAround(changed);
  }
  if (HasAllCoefficients())
  {
    FindCoefficientsOf(weight, changed);
  }
  return m_Grid.AndAround(changed);
}

} // namespace voxelcore
