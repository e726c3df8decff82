#include "LeastChange.h"

#include "LeastWays.h"

#include "voxelcore/Shape/ShapeTopology.h"

#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace voxelcore::testing
{

namespace
{

using Place = VoxelPlace;

/** Of the shape with a cavity: one voxel, or two that touch, whose loss leaves one piece with neither loop nor cavity
 *  at the least cost, by trying all. */
std::uint64_t
CheapestOpening(const GreyCase & grey, const std::vector<std::uint64_t> & weight)
{
  const GreyGrid   grid(grey);
  const VoxelShape shape = grey.Level(1);
  const auto       isOpened = [&](std::size_t a, std::size_t b) {
    const VoxelShape opened = ShapeWhere(grey.size, [&](int x, int y, int z) {
      const Place at{ x, y, z };
      return shape.Contains(x, y, z) && at != grid.At(a) && at != grid.At(b);
    });
    return ComputeShapeTopology(opened).betti == std::array<std::int64_t, 3>{ 1, 0, 0 };
  };
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  for (std::size_t a = 0; a < weight.size(); ++a)
  {
    if (weight[a] > 0 && weight[a] < least && isOpened(a, a))
    {
      least = weight[a];
    }
    grid.VisitAround(a, 3, [&](std::size_t b) {
      if (b > a && weight[a] > 0 && weight[b] > 0 && weight[a] + weight[b] < least && isOpened(a, b))
      {
        least = weight[a] + weight[b];
      }
    });
  }
  return least;
}

/** A case of `size` voxels; value(place) gives grey values. Levels are 50, 100, 200. */
template <typename TValue>
GreyCase
Make(const Size3 & size, const TValue & value)
{
  GreyCase grey{ size, {}, { 50, 100, 200 } };
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      for (std::int32_t x = 0; x < size[0]; ++x)
      {
        grey.grey.push_back(value(Place{ x, y, z }));
      }
    }
  }
  return grey;
}

std::vector<std::uint64_t>
Weights(const GreyCase & grey, const std::function<bool(std::size_t)> & isOpen)
{
  const GreyGrid             grid(grey);
  std::vector<std::uint64_t> weight(grid.Count(), 0);
  for (std::size_t voxel = 0; voxel < grid.Count(); ++voxel)
  {
    const Place at = grid.At(voxel);
    weight[voxel] = isOpen(voxel) ? grey.Cost(at[0], at[1], at[2]) : 0;
  }
  return weight;
}

std::vector<char>
Where(const GreyCase & grey, const std::function<bool(const Place &, std::uint32_t)> & isIn)
{
  const GreyGrid    grid(grey);
  std::vector<char> result(grid.Count());
  for (std::size_t voxel = 0; voxel < grid.Count(); ++voxel)
  {
    result[voxel] = isIn(grid.At(voxel), grey.grey[voxel]) ? 1 : 0;
  }
  return result;
}

/** Two balls of kernel with a bar between them whose values are `low` to `high`. */
GreyCase
TwoBalls(Random & random, std::int64_t low, std::int64_t high, double noise)
{
  const auto   length = static_cast<double>(random.Between(8, 16));
  const double radius = static_cast<double>(random.Between(15, 45)) / 10;
  const double slope = static_cast<double>(random.Between(-10, 10)) / 40;
  const Size3  size{ 32, 15, 15 };
  const auto   middle = static_cast<double>(random.Between(13, 17));
  return Make(size, [&](const Place & at) {
    const double x = at[0];
    const double away = std::hypot(at[1] - 7.0, at[2] - 7.0 - slope * (x - 15));
    const bool   isBall = std::hypot(x - 15 + length / 2 + 4, at[1] - 7.0, at[2] - 7.0) <= 5.5 ||
                        std::hypot(x - 15 - length / 2 - 4, at[1] - 7.0, at[2] - 7.0) <= 5.5;
    if (isBall)
    {
      return 250U;
    }
    if (away > radius)
    {
      return 10U;
    }
    // Weakest near its middle, with noise.
    const double range = static_cast<double>(high - low);
    const double value = static_cast<double>(low) + range * std::min(1.0, std::abs(x - middle) / length) * (1 - noise) +
                         range * noise * static_cast<double>(random.Between(0, 1000)) / 1000;
    return static_cast<std::uint32_t>(std::min(value, static_cast<double>(high)));
  });
}

LeastChangeCase
Neck(std::uint64_t seed)
{
  Random          random(seed);
  LeastChangeCase one{ TwoBalls(random, 105, 195, 0.5), {}, 2, 0 };
  one.request.pieces = 2;
  one.request.loops = 0;
  one.request.cavities = 0;
  const GreyGrid grid(one.grey);
  one.least = VertexCut(grid,
                        Where(one.grey, [](const Place & at, std::uint32_t v) { return v == 250 && at[0] < 15; }),
                        Where(one.grey, [](const Place & at, std::uint32_t v) { return v == 250 && at[0] > 15; }),
                        Weights(one.grey, [&](std::size_t v) { return one.grey.grey[v] >= 100; }))
                .Run();
  return one;
}

LeastChangeCase
Gap(std::uint64_t seed)
{
  Random          random(seed);
  LeastChangeCase one{ TwoBalls(random, 52, 98, 0.8), {}, 1, 0 };
  const GreyGrid  grid(one.grey);
  one.least =
    CheapestWay(grid,
                Where(one.grey, [](const Place & at, std::uint32_t v) { return v == 250 && at[0] < 15; }),
                Where(one.grey, [](const Place & at, std::uint32_t v) { return v == 250 && at[0] > 15; }),
                Weights(one.grey, [&](std::size_t v) { return one.grey.grey[v] >= 50 && one.grey.grey[v] < 100; }),
                1)
      .cost;
  return one;
}

LeastChangeCase
WeakRing(std::uint64_t seed)
{
  Random       random(seed);
  const double thick = static_cast<double>(random.Between(15, 32)) / 10;
  const auto   arc = static_cast<std::int32_t>(random.Between(3, 6));
  const auto   isWeak = [&](const Place & at) { return at[0] > 12 && std::abs(at[1] - 12) < arc; };
  const auto   value = [&](const Place & at) {
    const double away = std::hypot(std::hypot(at[0] - 12, at[1] - 12) - 8, at[2] - 4);
    return away > thick ? 10U : isWeak(at) ? static_cast<std::uint32_t>(random.Between(105, 195)) : 250U;
  };
  LeastChangeCase one{ Make({ 25, 25, 9 }, value), {}, 1, 0 };
  one.least =
    VertexCut(GreyGrid(one.grey),
              Where(one.grey, [&](const Place & at, std::uint32_t v) { return v == 250 && at[1] < 12; }),
              Where(one.grey, [&](const Place & at, std::uint32_t v) { return v == 250 && at[1] > 12; }),
              Weights(one.grey, [&](std::size_t v) { return one.grey.grey[v] >= 100 && one.grey.grey[v] < 200; }))
      .Run();
  return one;
}

LeastChangeCase
Cavity(std::uint64_t seed)
{
  Random       random(seed);
  const double inner = static_cast<double>(random.Between(10, 24)) / 10;
  const double outer = inner + static_cast<double>(random.Between(15, 40)) / 10;
  const auto   value = [&](const Place & at) {
    const double radius = std::hypot(at[0] - 8, at[1] - 8, at[2] - 8);
    return radius > outer
               ? 10U
               : static_cast<std::uint32_t>(radius > inner ? random.Between(105, 195) : random.Between(60, 98));
  };
  LeastChangeCase one{ Make({ 17, 17, 17 }, value), {}, 1, 0 };
  // A voxel that opens the cavity may open a second hole over its edges: then all openings of one or two are tried.
  const auto    walls = Weights(one.grey, [&](std::size_t v) { return one.grey.grey[v] >= 100; });
  const auto    way = CheapestWay(GreyGrid(one.grey),
                               Where(one.grey, [](const Place &, std::uint32_t v) { return v >= 50 && v < 100; }),
                               Where(one.grey, [](const Place &, std::uint32_t v) { return v < 50; }),
                               walls,
                               3);
  std::uint64_t all = 0;
  for (const std::uint64_t weight :
       Weights(one.grey, [&](std::size_t v) { return one.grey.grey[v] >= 50 && one.grey.grey[v] < 100; }))
  {
    all += weight;
  }
  one.least = std::min(way.voxels.size() <= 2 ? CheapestOpening(one.grey, walls) : way.cost, all);
  return one;
}

} // namespace

std::vector<std::pair<const char *, LeastChangeCase (*)(std::uint64_t)>>
LeastChangeKinds()
{
  return { { "neck cut", &Neck },
           { "gap bridged", &Gap },
           { "ring cut", &WeakRing },
           { "cavity opened or filled", &Cavity } };
}

bool
StaysBetween(const GreyCase & grey, const VoxelShape & result)
{
  for (std::int32_t z = 0; z < grey.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < grey.size[1]; ++y)
    {
      for (std::int32_t x = 0; x < grey.size[0]; ++x)
      {
        const std::uint32_t value = grey.At(x, y, z);
        if (result.Contains(x, y, z) ? value < grey.levels[0] : value >= grey.levels[2])
        {
          return false;
        }
      }
    }
  }
  return true;
}

} // namespace voxelcore::testing
