// Clefts within walls are filled by their definition, and gaps between bodies stay.

#include "Core/Shape/FloodFill.h"

#include "voxelcore/Masks/CleftFilling.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace voxelcore::testing
{
namespace
{

constexpr double kReach = 8;

EditedShape
Filled(const VoxelShape & shape, const std::optional<std::array<std::int64_t, 3>> & scan = {})
{
  return FillClefts(shape, shape, { 1, 1, 1 }, kReach, scan);
}

/** With places that fewer than five of the 26 directions lead out of; beyond a closed side, it is as at that side. */
VoxelShape
FilledByDefinition(const VoxelShape &                                 shape,
                   const VoxelShape &                                 walls,
                   const Vector3 &                                    spacing,
                   const std::optional<std::array<std::int64_t, 3>> & scan)
{
  const VoxelBox & box = shape.Box();
  const VoxelBox & outer = walls.Box();
  const auto       isWall = [&](std::array<std::int32_t, 3> at) {
    for (std::size_t axis = 0; scan && axis < 3; ++axis)
    {
      const std::int32_t last = outer.lower[axis] + outer.size[axis] - 1;
      at[axis] = outer.lower[axis] == 0 ? std::max(at[axis], 0) : at[axis];
      at[axis] = last + 1 == (*scan)[axis] ? std::min(at[axis], last) : at[axis];
    }
    return walls.Contains(at[0], at[1], at[2]);
  };
  VoxelShape filled(box);
  for (std::int32_t number = 0; number < box.size[0] * box.size[1] * box.size[2]; ++number)
  {
    const std::int32_t x = box.lower[0] + number % box.size[0];
    const std::int32_t y = box.lower[1] + number / box.size[0] % box.size[1];
    const std::int32_t z = box.lower[2] + number / box.size[0] / box.size[1];
    int                open = 0;
    for (int way = 0; way < 27; ++way)
    {
      const std::array<std::int32_t, 3> step{ way % 3 - 1, way / 3 % 3 - 1, way / 9 - 1 };
      const double length = std::hypot(step[0] * spacing[0], step[1] * spacing[1], step[2] * spacing[2]);
      bool         isMet = false;
      for (std::int32_t i = 1; way != 13 && i * length <= kReach; ++i)
      {
        isMet = isMet || isWall({ x + i * step[0], y + i * step[1], z + i * step[2] });
      }
      open += way != 13 && !isMet;
    }
    if (shape.Contains(x, y, z) || open < 5)
    {
      filled.Insert(x, y, z);
    }
  }
  return filled;
}

TEST(CleftFilling, IsItsDefinition)
{
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (int run = 0; run < 12; ++run)
  {
    const std::array<std::int32_t, 3> size{ 60 + 7 * (run % 3), 9 + run, 14 };
    const VoxelShape                  shape = RandomShape(random, size, 0.1 + 0.02 * run);
    VoxelShape                        walls = shape;
    const VoxelShape                  more = RandomShape(random, size, 0.1);
    for (std::int32_t z = 0; z < size[2]; ++z)
    {
      for (std::int32_t y = 0; y < size[1]; ++y)
      {
        for (std::size_t word = 0; word < walls.WordsPerRow(); ++word)
        {
          walls.Row(y, z)[word] |= std::as_const(more).Row(y, z)[word];
        }
      }
    }
    const Vector3 spacing{ 1, run % 2 == 0 ? 1.0 : 1.5, run % 3 == 0 ? 1.0 : 2.0 };
    const auto    scan =
      run % 4 < 2 ? std::optional(std::array<std::int64_t, 3>{ size[0], size[1] + run % 2, size[2] }) : std::nullopt;
    EXPECT_EQ(VoxelsOf(FillClefts(shape, walls, spacing, kReach, scan).shape),
              VoxelsOf(FilledByDefinition(shape, walls, spacing, scan)))
      << run;
  }
}

TEST(CleftFilling, ATubeWithHolesFillsAndGapsBetweenBodiesStay)
{
  for (const bool isPorous : { false, true })
  {
    // A ring of bark around a rod, or one with a hole in each twenty-fifth voxel.
    const auto    dried = ShapeWhere({ 40, 17, 17 }, [isPorous](int x, int y, int z) {
      const double away = std::hypot(y - 8, z - 8);
      const bool   isHole = isPorous && x % 5 == 0 && (y + z) % 5 == 0;
      return away < 3.5 || (away >= 5.5 && away < 7 && !isHole);
    });
    std::uint64_t cleft = 0;
    std::uint64_t left = 0;
    const auto    filled = Filled(dried).shape;
    for (std::int32_t at = 0; at < 20 * 17 * 17; ++at)
    {
      const std::int32_t x = 10 + at / 17 / 17;
      const std::int32_t y = at / 17 % 17;
      const std::int32_t z = at % 17;
      const double       away = std::hypot(y - 8, z - 8);
      const bool         isCleft = away >= 3.5 && away < 5.5;
      cleft += isCleft;
      left += isCleft && !filled.Contains(x, y, z);
      EXPECT_FALSE(away > 7.5 && filled.Contains(x, y, z)) << "outside of it";
    }
    EXPECT_LT((isPorous ? 3 : 10) * left, cleft);
  }
  const auto plates = ShapeWhere({ 40, 40, 9 }, [](int, int, int z) { return z != 4; });
  EXPECT_EQ(Filled(plates).voxelsAdded, 0U);
  const auto groove = ShapeWhere({ 40, 3, 9 }, [](int, int y, int z) { return z != 4 || y == 0; });
  EXPECT_EQ(Filled(groove).voxelsAdded, 0U);
  EXPECT_EQ(Filled(VoxelShape()).voxelsAdded, 0U);
}

TEST(CleftFilling, IsTheSameOnAnyNumberOfThreads)
{
  Random           random(5);
  const VoxelShape shape = RandomShape(random, { 130, 50, 40 }, 0.2);
  const int        before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Voxels filled = VoxelsOf(Filled(shape).shape);
  omp_set_num_threads(5);
  EXPECT_EQ(VoxelsOf(Filled(shape).shape), filled);
  omp_set_num_threads(before);
}

} // namespace
} // namespace voxelcore::testing
