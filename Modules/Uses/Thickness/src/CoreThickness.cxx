#include "voxelcore/Thickness/CoreThickness.h"

#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace voxelcore
{

namespace
{

struct Step
{
  std::array<std::int32_t, 3> by;
  double                      squared; ///< of its length, in lattice units
};

/** The 26 steps to neighbours, the shortest first. */
std::vector<Step>
StepsToNeighbours(const SpacingWeights & weights)
{
  std::vector<Step> steps;
  for (std::int32_t z = -1; z <= 1; ++z)
  {
    for (std::int32_t y = -1; y <= 1; ++y)
    {
      for (std::int32_t x = -1; x <= 1; ++x)
      {
        double     squared = 0;
        const auto by = std::array{ x, y, z };
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const auto d = static_cast<double>(by[axis] * weights.weight[axis]);
          squared += d * d;
        }
        if (squared > 0)
        {
          steps.push_back({ by, squared });
        }
      }
    }
  }
  std::stable_sort(steps.begin(), steps.end(), [](const Step & a, const Step & b) { return a.squared < b.squared; });
  return steps;
}

struct Waiting
{
  std::array<std::int32_t, 3> voxel;
  std::size_t                 at;
};

/** The voxels without an owner, in scan order. */
std::vector<Waiting>
WithoutOwner(const VoxelShape & shape, const VoxelOwners & owners)
{
  std::vector<Waiting> waiting;
  const auto &         box = shape.Box();
  std::size_t          at = 0;
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto bits = shape.Row(y, z);
      for (std::size_t word = 0; word < bits.size(); ++word)
      {
        for (std::uint64_t rest = bits[word]; rest != 0; rest &= rest - 1, ++at)
        {
          if (owners.values[at] == 0)
          {
            const auto x = static_cast<std::int32_t>(64 * word) + std::countr_zero(rest);
            waiting.push_back({ { box.lower[0] + x, box.lower[1] + y, box.lower[2] + z }, at });
          }
        }
      }
    }
  }
  return waiting;
}

} // namespace

PaintingBalls
BallsOfCore(const MedialComplex & core)
{
  return { core.positions, core.radius, core.radius };
}

VoxelRanks::VoxelRanks(const VoxelShape & shape)
  : m_Shape(&shape)
{
  const auto &  size = shape.Box().size;
  std::uint64_t count = 0;
  m_Before.reserve(static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]) * shape.WordsPerRow());
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      for (const std::uint64_t word : shape.Row(y, z))
      {
        m_Before.push_back(count);
        count += CountBits(word);
      }
    }
  }
}

std::size_t
VoxelRanks::At(std::int32_t x, std::int32_t y, std::int32_t z) const
{
  const auto & box = m_Shape->Box();
  const auto   across = static_cast<std::uint32_t>(x - box.lower[0]);
  const auto   row = m_Shape->Row(y - box.lower[1], z - box.lower[2]);
  const auto   word = across >> 6U;
  const auto   index = static_cast<std::size_t>(z - box.lower[2]) * static_cast<std::size_t>(box.size[1]) +
                     static_cast<std::size_t>(y - box.lower[1]);
  const std::uint64_t below = row[word] & ((std::uint64_t{ 1 } << (across & 63U)) - 1);
  return m_Before[index * m_Shape->WordsPerRow() + word] + CountBits(below);
}

void
SpreadOwners(const VoxelShape &     shape,
             const SpacingWeights & weights,
             const PaintingBalls &  balls,
             VoxelOwners &          owners)
{
  std::vector<Waiting> waiting = WithoutOwner(shape, owners);
  if (waiting.empty())
  {
    return;
  }
  const std::vector<Step> steps = StepsToNeighbours(weights);
  const VoxelRanks        ranks(shape);
  while (!waiting.empty())
  {
    std::vector<std::pair<std::size_t, std::uint32_t>> found;
    std::vector<Waiting>                               left;
    for (const Waiting & one : waiting)
    {
      std::uint32_t owner = 0;
      double        squared = 0;
      for (const Step & step : steps)
      {
        if (owner != 0 && step.squared > squared)
        {
          break;
        }
        const std::int32_t x = one.voxel[0] + step.by[0];
        const std::int32_t y = one.voxel[1] + step.by[1];
        const std::int32_t z = one.voxel[2] + step.by[2];
        if (!shape.Contains(x, y, z))
        {
          continue;
        }
        const std::uint32_t other = owners.values[ranks.At(x, y, z)];
        if (other != 0 && (owner == 0 || balls.value[other - 1] > balls.value[owner - 1] ||
                           (balls.value[other - 1] == balls.value[owner - 1] && other < owner)))
        {
          owner = other;
          squared = step.squared;
        }
      }
      if (owner != 0)
      {
        found.emplace_back(one.at, owner);
      }
      else
      {
        left.push_back(one);
      }
    }
    if (found.empty())
    {
      return;
    }
    for (const auto & [at, owner] : found)
    {
      owners.values[at] = owner;
    }
    waiting = std::move(left);
  }
}

VoxelOwners
OwnersAmong(const PaintingBalls &    balls,
            const VoxelShape &       shape,
            const SpacingWeights &   weights,
            const ProgressCallback & progress)
{
  VoxelOwners owners = ZeroAtVoxels<std::uint32_t>(shape);
  PaintOwners(shape, weights, balls, owners, progress);
  SpreadOwners(shape, weights, balls, owners);
  return owners;
}

VoxelValues
ThicknessOfOwners(const VoxelShape &     shape,
                  const SpacingWeights & weights,
                  const PaintingBalls &  balls,
                  const VoxelOwners &    owners)
{
  VoxelValues map = DiametersOfOwners(balls, owners);
  FillWithOwnBalls(shape, weights, map);
  return map;
}

float
ValueNear(const VoxelShape & shape, const VoxelRanks & ranks, const VoxelValues & map, const Vector3 & place)
{
  std::array<std::int32_t, 3> voxel{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    voxel[axis] = static_cast<std::int32_t>(std::floor(place[axis]));
  }
  if (shape.Contains(voxel[0], voxel[1], voxel[2]))
  {
    return map.values[ranks.At(voxel[0], voxel[1], voxel[2])];
  }
  double least = std::numeric_limits<double>::infinity();
  float  value = 0;
  for (std::int32_t z = voxel[2] - 2; z <= voxel[2] + 2; ++z)
  {
    for (std::int32_t y = voxel[1] - 2; y <= voxel[1] + 2; ++y)
    {
      for (std::int32_t x = voxel[0] - 2; x <= voxel[0] + 2; ++x)
      {
        const double dx = x + 0.5 - place[0];
        const double dy = y + 0.5 - place[1];
        const double dz = z + 0.5 - place[2];
        const double squared = dx * dx + dy * dy + dz * dz;
        if (squared < least && shape.Contains(x, y, z))
        {
          least = squared;
          value = map.values[ranks.At(x, y, z)];
        }
      }
    }
  }
  return value;
}

} // namespace voxelcore
