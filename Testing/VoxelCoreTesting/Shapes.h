#pragma once
// Voxel shapes for tests: by rule, at random, and the spacings they are tried at.

#include "VoxelCoreTesting/Random.h"

#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace voxelcore::testing
{

using Size3 = std::array<std::int32_t, 3>;
using Spacing3 = std::array<double, 3>;

/** The voxels lower + (x,y,z), 0 <= (x,y,z) < size, for which inside(x, y, z). */
template <typename TInside>
VoxelShape
ShapeWhere(const Size3 & size, TInside inside, const Size3 & lower = { 0, 0, 0 })
{
  VoxelShape shape(VoxelBox{ lower, size });
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      for (std::int32_t x = 0; x < size[0]; ++x)
      {
        if (inside(x, y, z))
        {
          shape.Insert(lower[0] + x, lower[1] + y, lower[2] + z);
        }
      }
    }
  }
  return shape;
}

inline VoxelShape
Box(const Size3 & size, const Size3 & lower = { 0, 0, 0 })
{
  return ShapeWhere(
    size,
    [](int, int, int) { return true; },
    lower);
}

/** Each voxel in by itself with the given chance. */
inline VoxelShape
RandomShape(Random & random, const Size3 & size, double density)
{
  return ShapeWhere(size, [&](int, int, int) { return random.Chance(density); });
}

/** Semi-axes 0.45 n, 0.30 n, 0.20 n about n/2, voxel i sampled at i + 0.5. */
inline VoxelShape
Ellipsoid(std::int32_t n)
{
  return ShapeWhere({ n, n, n }, [n](int x, int y, int z) {
    const auto term = [n](int at, double semiAxis) {
      const double d = (at + 0.5 - 0.5 * n) / (semiAxis * n);
      return d * d;
    };
    return term(x, 0.45) + term(y, 0.30) + term(z, 0.20) <= 1.0;
  });
}

/** Spacings in mm that random tests take in turn. */
inline const std::array<Spacing3, 6> &
TestSpacings()
{
  static const std::array<Spacing3, 6> spacings{
    { { 1, 1, 1 }, { 1, 1, 2 }, { 3, 3, 7 }, { 0.48828125, 0.48828125, 2.5 }, { 2, 1, 3 }, { 0.7, 0.7, 0.7 } }
  };
  return spacings;
}

/** A random volume with all that is needed to make it again. */
struct RandomVolume
{
  std::uint64_t seed = 0;
  double        density = 0;
  Spacing3      spacing{ 1, 1, 1 };
  VoxelShape    shape;

  std::string
  Describe() const
  {
    std::ostringstream text;
    text << "seed " << seed << ", size " << shape.Box().size[0] << " x " << shape.Box().size[1] << " x "
         << shape.Box().size[2] << ", density " << density << ", spacing " << spacing[0] << " : " << spacing[1] << " : "
         << spacing[2];
    return text.str();
  }
};

/** Sides from least to greatest, each by itself; density 5 to 95 %; one of the test spacings: all by the seed. */
inline RandomVolume
MakeRandomVolume(std::uint64_t seed, std::int32_t least, std::int32_t greatest)
{
  Random       random(seed);
  RandomVolume volume;
  volume.seed = seed;
  const auto side = [&] { return static_cast<std::int32_t>(random.Between(least, greatest)); };
  Size3      size{ side(), side(), side() };
  if (random.Chance(0.3))
  {
    size = { size[0], size[0], size[0] };
  }
  volume.density = 0.05 * static_cast<double>(random.Between(1, 19));
  // Half of them isotropic: the common case, and the one with most cospherical points.
  const auto & spacings = TestSpacings();
  volume.spacing =
    random.Chance(0.5) ? spacings[0] : spacings[static_cast<std::size_t>(random.Between(1, spacings.size() - 1))];
  volume.shape = RandomShape(random, size, volume.density);
  return volume;
}

/** Volumes of 3 to 10 voxels a side by consecutive seeds, printed; every other one is dense. */
inline std::vector<RandomVolume>
RandomVolumes(std::uint64_t firstSeed, int count)
{
  std::cout << "seeds from " << firstSeed << '\n';
  std::vector<RandomVolume> volumes;
  for (int i = 0; i < count; ++i)
  {
    volumes.push_back(MakeRandomVolume(firstSeed + static_cast<std::uint64_t>(i), 3, 10));
    if (i % 2 == 0) // dense ones have thick parts and with them large measures
    {
      Random random(volumes.back().seed);
      volumes.back().density = 0.97;
      volumes.back().shape = RandomShape(random, volumes.back().shape.Box().size, 0.97);
    }
  }
  return volumes;
}

} // namespace voxelcore::testing
