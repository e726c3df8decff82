// The lattice engine at its limits: long, hollow, far apart, porous, cospherical by the thousand, flat by weight.
// Compared with TetGen where that can be done, else with what is known.

#include "SameCells.h"

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

namespace voxelcore
{
namespace
{

using testing::Box;
using testing::ExpectAgreement;
using testing::Random;
using testing::RandomShape;
using testing::ShapeWhere;
using testing::Size3;

VoxelShape
Hollow(std::int32_t side, std::int32_t wall)
{
  return ShapeWhere({ side, side, side }, [=](int x, int y, int z) {
    const auto deep = [=](int at) { return at >= wall && at < side - wall; };
    return !(deep(x) && deep(y) && deep(z));
  });
}

Size3
AddScaled(int axis, std::int32_t length, std::int32_t width)
{
  Size3 size{ width, width, width };
  size[static_cast<std::size_t>(axis)] = length;
  return size;
}

TEST(ExtremeShapes, SolidBlocks)
{
  for (const std::int32_t side : { 1, 2, 3, 31, 32, 33, 48 })
  {
    SCOPED_TRACE(side);
    ExpectAgreement(Box({ side, side, side }), {});
  }
}

TEST(ExtremeShapes, HollowBlocks)
{
  for (const std::int32_t wall : { 1, 2, 5 })
  {
    SCOPED_TRACE(wall);
    ExpectAgreement(Hollow(36, wall), {});
  }
}

// A rod of n voxels has n cells, a box each, and 5 n + 1 facets.
TEST(ExtremeShapes, CollinearRodsOfAMillionVoxels)
{
  constexpr std::int32_t half = 1 << 19;
  for (const int axis : { 0, 1, 2 })
  {
    SCOPED_TRACE(axis);
    VoxelShape rods(VoxelBox{ { 0, 0, 0 }, AddScaled(axis, 2 * half, 1) });
    for (std::int32_t i = 0; i < 2 * half; ++i)
    {
      if (i != half && i != half + 1) // two rods with a gap of two voxels
      {
        rods.Insert(axis == 0 ? i : 0, axis == 1 ? i : 0, axis == 2 ? i : 0);
      }
    }
    const DelaunayCells   cells = ComputeDelaunayCells(rods, BoundaryVertices(rods), SpacingWeights{}, Engine::Lattice);
    constexpr std::size_t n = 2 * half - 2;
    ASSERT_EQ(cells.CellCount(), n);
    ASSERT_EQ(cells.FacetCount(), 5 * n + 2);
    for (std::size_t cell = 0; cell < n; ++cell)
    {
      const double along = 0.5 + static_cast<double>(cell) + (cell < half ? 0 : 2);
      ASSERT_EQ(cells.centres[cell][static_cast<std::size_t>(axis)], along);
    }
  }
}

TEST(ExtremeShapes, TwoFarClusters)
{
  std::cout << "seeds from 31000\n";
  for (const int axis : { 0, 1, 2 })
  {
    SCOPED_TRACE(axis);
    Random           random(31000 + static_cast<std::uint64_t>(axis));
    constexpr int    distance = (1 << 20) - 9; // as far as the exact range goes
    const VoxelShape near = RandomShape(random, { 9, 9, 9 }, 0.8);
    const VoxelShape far = RandomShape(random, { 9, 9, 9 }, 0.6);
    VoxelShape       both(VoxelBox{ { 0, 0, 0 }, AddScaled(axis, distance + 9, 9) });
    const Size3      shift = { axis == 0 ? distance : 0, axis == 1 ? distance : 0, axis == 2 ? distance : 0 };
    for (std::int32_t z = 0; z < 9; ++z)
    {
      for (std::int32_t y = 0; y < 9; ++y)
      {
        for (std::int32_t x = 0; x < 9; ++x)
        {
          if (near.Contains(x, y, z))
          {
            both.Insert(x, y, z);
          }
          if (far.Contains(x, y, z))
          {
            both.Insert(x + shift[0], y + shift[1], z + shift[2]);
          }
        }
      }
    }
    ExpectAgreement(both, {});
  }
}

TEST(ExtremeShapes, NoiseOfEveryDensity)
{
  std::cout << "seeds from 32000\n";
  for (std::uint64_t percent = 2; percent < 100; percent += 6)
  {
    SCOPED_TRACE(percent);
    Random random(32000 + percent);
    ExpectAgreement(RandomShape(random, { 20, 20, 20 }, 0.01 * static_cast<double>(percent)), {});
  }
}

/** The voxels that meet the open ball about the origin whose squared radius, at most `limit`, has the most lattice
 *  points on it. These points are boundary vertices, no other is nearer: one cell, with all of them. */
void
ExpectOneCellOfManyPoints(std::int32_t limit, std::size_t least)
{
  std::int32_t reach = 0;
  while (reach * reach < limit)
  {
    ++reach;
  }
  std::vector<std::size_t> on(static_cast<std::size_t>(limit) + 1, 0);
  for (std::int32_t x = -reach; x <= reach; ++x)
  {
    for (std::int32_t y = -reach; y <= reach; ++y)
    {
      for (std::int32_t z = -reach; z <= reach; ++z)
      {
        const std::int32_t squared = x * x + y * y + z * z;
        if (squared <= limit)
        {
          ++on[static_cast<std::size_t>(squared)];
        }
      }
    }
  }
  const auto       most = std::max_element(on.begin(), on.end());
  const auto       radius = static_cast<std::int32_t>(most - on.begin());
  const Size3      size{ 2 * reach, 2 * reach, 2 * reach };
  const VoxelShape ball =
    ShapeWhere(size,
               [=](int x, int y, int z) {
                 const auto nearest = [=](int at) {
                   const int low = at - reach;
                   return low >= 0 ? low : -low - 1;
                 };
                 return nearest(x) * nearest(x) + nearest(y) * nearest(y) + nearest(z) * nearest(z) < radius;
               },
               { -reach, -reach, -reach });
  std::cout << *most << " points at squared radius " << radius << '\n';
  ASSERT_GE(*most, least);
  const DelaunayCells                     cells = ExpectAgreement(ball, {});
  std::vector<std::size_t>                corners(cells.CellCount(), 0);
  std::vector<std::vector<std::uint32_t>> points(cells.CellCount());
  for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
  {
    for (const std::uint32_t cell : cells.facetCells[facet])
    {
      if (cell != kOutside)
      {
        const auto polygon = cells.FacetPoints(facet);
        points[cell].insert(points[cell].end(), polygon.begin(), polygon.end());
      }
    }
  }
  std::size_t found = 0;
  for (std::size_t cell = 0; cell < cells.CellCount(); ++cell)
  {
    std::sort(points[cell].begin(), points[cell].end());
    const auto end = std::unique(points[cell].begin(), points[cell].end());
    if (cells.centres[cell] == std::array<double, 3>{ 0, 0, 0 })
    {
      found = static_cast<std::size_t>(end - points[cell].begin());
    }
  }
  EXPECT_EQ(found, *most);
}

TEST(ExtremeShapes, HundredsOfCosphericalPointsAreOneCell)
{
  ExpectOneCellOfManyPoints(1500, 400);
}

TEST(HeavyExtremeShapes, ThousandsOfCosphericalPointsAreOneCell)
{
  ExpectOneCellOfManyPoints(24000, 2000);
}

TEST(ExtremeShapes, BarsOfFourThousandVoxels)
{
  for (const int axis : { 0, 1, 2 })
  {
    SCOPED_TRACE(axis);
    ExpectAgreement(Box(AddScaled(axis, 4096, 2)), {});
  }
}

// The four sides of a square of 4096 voxels: the extent is the largest in two directions at once.
TEST(HeavyExtremeShapes, FramesOfFourThousandVoxelsASide)
{
  constexpr std::int32_t side = 4096;
  for (std::size_t across = 0; across < 3; ++across)
  {
    SCOPED_TRACE(across);
    Size3 size{ side, side, side };
    size[across] = 2;
    VoxelShape frame(VoxelBox{ { 0, 0, 0 }, size });
    const auto insert = [&](std::int32_t u, std::int32_t v, std::int32_t w) {
      Size3 place{};
      place[across] = w;
      place[(across + 1) % 3] = u;
      place[(across + 2) % 3] = v;
      frame.Insert(place[0], place[1], place[2]);
    };
    for (std::int32_t i = 0; i < side; ++i)
    {
      for (const std::int32_t j : { 0, 1, 2, side - 2, side - 1 })
      {
        for (const std::int32_t w : { 0, 1 })
        {
          insert(i, j, w);
          insert(j, i, w);
        }
      }
    }
    ExpectAgreement(frame, {});
  }
}

TEST(ExtremeShapes, FlatByWeight)
{
  std::cout << "seeds from 33000\n";
  for (std::uint64_t seed = 33000; seed < 33012; ++seed)
  {
    SCOPED_TRACE(seed);
    Random         random(seed);
    SpacingWeights weights;
    weights.weight = { 1, 1, 1 };
    weights.weight[seed % 3] = 4096;
    if (seed % 2 == 0)
    {
      weights.weight[(seed + 1) % 3] = 4095;
    }
    const VoxelShape shape = seed < 33006 ? RandomShape(random, { 9, 9, 9 }, 0.75) : testing::Ellipsoid(24);
    ExpectAgreement(shape, weights);
  }
}

} // namespace
} // namespace voxelcore
