#include "BruteThickness.h"

#include "PlaceGrid.h"
#include "SquareGrid.h"
#include "voxelcore/Lattice/Vectors.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <vector>

namespace voxelcore
{
namespace
{

using testing::BruteDepth;
using testing::Random;
using testing::RandomVolume;
using testing::RandomVolumes;
using testing::ShapeCells;

double
Real(Random & random, double least, double greatest)
{
  return least + (greatest - least) * 1e-6 * static_cast<double>(random.Between(0, 1'000'000));
}

Vector3
Place(Random & random, double least, double greatest)
{
  return { Real(random, least, greatest), Real(random, least, greatest), Real(random, least, greatest) };
}

/** On a sheet, in a cloud, and now and then far off. */
std::vector<Vector3>
RandomPlaces(Random & random)
{
  std::vector<Vector3> places;
  const auto           count = random.Between(1, 400);
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(count); ++i)
  {
    places.push_back(Place(random, -20, 20));
    if (random.Chance(0.5))
    {
      places.back()[2] = 3;
    }
    if (random.Chance(0.01))
    {
      places.back()[0] = 1e7;
    }
  }
  return places;
}

TEST(PlaceGrid, ShowsAllPlacesInABallOfAnyCubesOnceAndThatWhichIsNearest)
{
  for (std::uint64_t seed = 9100; seed < 9140; ++seed)
  {
    SCOPED_TRACE(seed);
    Random                     random(seed);
    const std::vector<Vector3> places = RandomPlaces(random);
    const PlaceGrid            grid(
      places.size(),
      [&](std::size_t i) { return places[i]; },
      Real(random, 0.01, 10));
    ASSERT_EQ(std::set(grid.Order().begin(), grid.Order().end()).size(), places.size());
    std::vector<Vector3> arranged = places;
    grid.Arrange(arranged);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      ASSERT_EQ(arranged[i], places[grid.Order()[i]]);
    }
    for (int asked = 0; asked < 20; ++asked)
    {
      const Ball                 ball{ Place(random, -40, 40), Real(random, 0, 30) };
      std::multiset<std::size_t> seen;
      grid.Visit(ball, [&](std::size_t i) {
        seen.insert(i);
        return false;
      });
      double nearest = ball.radius;
      for (std::size_t i = 0; i < arranged.size(); ++i)
      {
        const double away = Distance(arranged[i], ball.centre);
        ASSERT_LE(seen.count(i), 1U);
        ASSERT_TRUE(seen.count(i) == 1 || away > ball.radius);
        nearest = std::min(nearest, away);
      }
      Ball shrinking = ball;
      grid.Visit(shrinking, [&](std::size_t i) {
        const double away = Distance(arranged[i], ball.centre);
        const bool   isNearer = away < shrinking.radius;
        shrinking.radius = std::min(shrinking.radius, away);
        return isNearer;
      });
      ASSERT_EQ(shrinking.radius, nearest);
    }
  }
}

TEST(SquareGrid, TellsHowFarTheBoundaryIsFromPlacesInARandomShape)
{
  for (const RandomVolume & volume : RandomVolumes(9200, 40))
  {
    SCOPED_TRACE(volume.Describe());
    const ShapeCells of(volume.shape, volume.spacing);
    const SquareGrid grid(of.shape, of.weights);
    const VoxelBox & box = of.shape.Box();
    Random           random(volume.seed);
    for (int asked = 0; asked < 200; ++asked)
    {
      Vector3 place{};
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        place[axis] = box.lower[axis] + Real(random, 0, box.size[axis]);
      }
      const auto voxel = [&](std::size_t axis) { return static_cast<std::int32_t>(std::floor(place[axis])); };
      if (!of.shape.Contains(voxel(0), voxel(1), voxel(2)))
      {
        continue;
      }
      const double depth = BruteDepth(of, place) / of.weights.unit;
      ASSERT_NEAR(grid.Distance(place, std::numeric_limits<double>::infinity()), depth, 1e-9 * (1 + depth));
      ASSERT_EQ(grid.Distance(place, 0.5 * depth), 0.5 * depth);
      ASSERT_TRUE(grid.IsFree(place, depth * (1 - 1e-9)));
      ASSERT_FALSE(grid.IsFree(place, depth * (1 + 1e-9) + 1e-9));
    }
  }
}

} // namespace
} // namespace voxelcore
