#include "VoxelCoreTesting/SurfaceNoise.h"
#include "VoxelCoreTesting/Threads.h"

#include "voxelcore/Masks/ShapeSmoothing.h"
#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

namespace voxelcore::testing
{
namespace
{

using Vector = std::array<double, 3>;

/** Voxels of a cube of side n whose centre, measured from the middle of the cube, satisfies the rule. */
VoxelShape
Sampled(std::int32_t n, const std::function<bool(const Vector &)> & inside)
{
  return ShapeWhere({ n, n, n }, [&](int x, int y, int z) {
    return inside({ x + 0.5 - 0.5 * n, y + 0.5 - 0.5 * n, z + 0.5 - 0.5 * n });
  });
}

double
Dot(const Vector & a, const Vector & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double
Length(const Vector & a)
{
  return std::sqrt(Dot(a, a));
}

/** A direction and a place within a voxel, at random. */
struct Chance
{
  explicit Chance(std::uint64_t seed)
  {
    Random random(seed);
    do
    {
      direction = { random.Unit() - 0.5, random.Unit() - 0.5, random.Unit() - 0.5 };
    } while (Length(direction) > 0.5 || Length(direction) < 0.1);
    const double length = Length(direction);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      direction[axis] /= length;
      place[axis] = random.Unit() - 0.5;
    }
  }

  Vector direction{};
  Vector place{};
};

VoxelShape
Ball(std::int32_t n, double radius, const Vector & centre)
{
  return Sampled(n, [&](const Vector & p) {
    return Length({ p[0] - centre[0], p[1] - centre[1], p[2] - centre[2] }) <= radius;
  });
}

VoxelShape
RoughRod(std::int32_t n, double radius, const Chance & chance)
{
  return Sampled(n, [&](const Vector & p) {
    const Vector from{ p[0] - chance.place[0], p[1] - chance.place[1], p[2] - chance.place[2] };
    const double along = std::clamp(Dot(from, chance.direction), -0.5 * n + radius + 2, 0.5 * n - radius - 2);
    return Length({ from[0] - along * chance.direction[0],
                    from[1] - along * chance.direction[1],
                    from[2] - along * chance.direction[2] }) <= radius;
  });
}

std::size_t
CountDifferences(const VoxelShape & a, const VoxelShape & b, std::int32_t n)
{
  std::size_t count = 0;
  for (std::int32_t z = 0; z < n; ++z)
  {
    for (std::int32_t y = 0; y < n; ++y)
    {
      for (std::int32_t x = 0; x < n; ++x)
      {
        count += a.Contains(x, y, z) != b.Contains(x, y, z) ? 1 : 0;
      }
    }
  }
  return count;
}

TEST(ShapeSmoothing, KeepsTheTopologyOfRandomVolumes)
{
  std::uint64_t changed = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
  {
    const RandomVolume  volume = MakeRandomVolume(seed, 1, 14);
    const SmoothedShape smooth = SmoothShape(volume.shape);
    ASSERT_EQ(ComputeShapeTopology(smooth.shape), ComputeShapeTopology(volume.shape)) << volume.Describe();
    ASSERT_EQ(smooth.shape.CountVoxels() + smooth.voxelsRemoved, volume.shape.CountVoxels() + smooth.voxelsAdded);
    changed += smooth.voxelsAdded + smooth.voxelsRemoved;
  }
  EXPECT_GT(changed, 1000U);
}

TEST(ShapeSmoothing, LeavesCleanBodiesNearlyAsTheyAre)
{
  double sum = 0; // changed voxels over boundary vertices
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
  {
    const Chance chance(seed);
    const double radius = 3 + 0.7 * static_cast<double>(seed);
    const auto   check = [&](const VoxelShape & shape, const char * what) {
      const SmoothedShape smooth = SmoothShape(shape);
      const auto          vertices = static_cast<double>(BoundaryVertices(shape).size());
      const auto          part = static_cast<double>(smooth.voxelsAdded + smooth.voxelsRemoved) / vertices;
      EXPECT_LE(part, 0.02) << what << ", seed " << seed;
      sum += part / 24;
    };
    check(Ball(30, radius, chance.place), "ball");
    check(RoughRod(40, 2.5 + 0.2 * static_cast<double>(seed), chance), "rod");
    // The flat side of half a ball; its edge is sharp.
    const std::int32_t n = 36;
    const VoxelShape   half = Sampled(n, [&](const Vector & p) {
      return Dot({ p[0] - chance.place[0], p[1] - chance.place[1], p[2] - chance.place[2] }, chance.direction) <= 0 &&
             Length(p) <= 16;
    });
    const VoxelShape   smooth = SmoothShape(half).shape;
    const auto         isAmid = [&](int x, int y, int z) {
      return Length({ x + 0.5 - 0.5 * n, y + 0.5 - 0.5 * n, z + 0.5 - 0.5 * n }) < 11;
    };
    const auto amid = [&](const VoxelShape & shape) {
      return ShapeWhere({ n, n, n }, [&](int x, int y, int z) { return isAmid(x, y, z) && shape.Contains(x, y, z); });
    };
    EXPECT_EQ(CountDifferences(amid(half), amid(smooth), n), 0U) << "half ball, seed " << seed;
  }
  EXPECT_LE(sum, 0.006) << "on average";
}

TEST(ShapeSmoothing, LeavesThinThingsAsTheyAre)
{
  for (const Size3 & size : { Size3{ 1, 1, 1 },
                              Size3{ 20, 1, 1 },
                              Size3{ 1, 20, 2 },
                              Size3{ 2, 2, 20 },
                              Size3{ 15, 15, 1 },
                              Size3{ 2, 1, 1 } })
  {
    const SmoothedShape smooth = SmoothShape(Box(size));
    EXPECT_EQ(smooth.voxelsAdded + smooth.voxelsRemoved, 0U) << size[0] << " x " << size[1] << " x " << size[2];
  }
  EXPECT_EQ(SmoothShape(VoxelShape()).shape.CountVoxels(), 0U);
}

TEST(ShapeSmoothing, TakesNoiseAwayAndKeepsTheVolume)
{
  const std::int32_t n = 44;
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
  {
    const Chance     chance(seed);
    const VoxelShape clean = seed % 2 == 0 ? RoughRod(n, 7, chance) : Ball(n, 17, chance.place);
    const VoxelShape rough = Flipped(clean, n, seed, true);
    const VoxelShape smooth = SmoothShape(rough).shape;
    const auto       before = static_cast<double>(CountDifferences(clean, rough, n));
    EXPECT_GT(before, 100);
    EXPECT_LT(static_cast<double>(CountDifferences(clean, smooth, n)), 0.45 * before) << "seed " << seed;
    const auto voxels = static_cast<double>(rough.CountVoxels());
    EXPECT_NEAR(static_cast<double>(smooth.CountVoxels()), voxels, 0.005 * voxels) << "seed " << seed;
  }
}

TEST(ShapeSmoothing, MovesTheBoundaryByNoMoreThanItSays)
{
  double largest = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
  {
    const std::int32_t n = 12;
    const VoxelShape   shape =
      seed % 2 == 0 ? MakeRandomVolume(seed, 6, n).shape : Flipped(Ball(n, 4.5, Chance(seed).place), n, seed, false);
    const SmoothedShape smooth = SmoothShape(shape);
    const auto          isFlipped = [&](int x, int y, int z) {
      return shape.Contains(x, y, z) != smooth.shape.Contains(x, y, z);
    };
    for (int at = 0; at < (n + 2) * (n + 2) * (n + 2); ++at)
    {
      const int x = at % (n + 2) - 1;
      const int y = at / (n + 2) % (n + 2) - 1;
      const int z = at / (n + 2) / (n + 2) - 1;
      if (!isFlipped(x, y, z))
      {
        continue;
      }
      const bool was = shape.Contains(x, y, z);
      int        others = 0;
      int        kept = 0;
      for (int k = 0; k < 27; ++k)
      {
        const Size3 d{ k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1 };
        others += shape.Contains(x + d[0], y + d[1], z + d[2]) != was ? 1 : 0;
        const bool isFace = std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]) == 1;
        kept += isFace && smooth.shape.Contains(x + d[0], y + d[1], z + d[2]) == was ? 1 : 0;
      }
      EXPECT_GT(others, 0) << "not at the boundary, seed " << seed;
      EXPECT_GT(kept, 0) << "nothing of its kind beside it, seed " << seed;
    }
    // The distance of the two boundaries, by comparing all with all.
    const auto before = BoundaryVertices(shape);
    const auto after = BoundaryVertices(smooth.shape);
    double     shift = 0;
    for (const auto & [from, to] : { std::pair(&before, &after), std::pair(&after, &before) })
    {
      for (const LatticePoint & p : *from)
      {
        double nearest = std::numeric_limits<double>::infinity();
        for (const LatticePoint & q : *to)
        {
          nearest = std::min(nearest, Length({ double(p.x - q.x), double(p.y - q.y), double(p.z - q.z) }));
        }
        shift = std::max(shift, nearest);
      }
    }
    EXPECT_EQ(smooth.largestShift, shift) << "seed " << seed;
    EXPECT_LE(shift, std::sqrt(3.0));
    largest = std::max(largest, shift);
  }
  EXPECT_GT(largest, 0);
}

TEST(ShapeSmoothing, IsTheSameForAnyNumberOfThreadsAndAnyPlace)
{
  const std::int32_t n = 40;
  const VoxelShape   rough = Flipped(Ball(n, 15, { 0.2, 0.1, -0.3 }), n, 3, true);
  const auto         run = [&](int threads, const VoxelShape & shape) {
    const Threads only(threads);
    return SmoothShape(shape).shape;
  };
  const VoxelShape one = run(1, rough);
  EXPECT_EQ(CountDifferences(one, run(4, rough), n), 0U);
  const VoxelShape moved =
    ShapeWhere({ n, n, n }, [&](int x, int y, int z) { return rough.Contains(x, y, z); }, { 57, -20, 9 });
  const VoxelShape movedBack = run(2, moved);
  for (std::int32_t at = 0; at < n * n * n; ++at)
  {
    const Size3 p{ at % n, at / n % n, at / n / n };
    ASSERT_EQ(movedBack.Contains(p[0] + 57, p[1] - 20, p[2] + 9), one.Contains(p[0], p[1], p[2]));
  }
}

TEST(ShapeSmoothing, TurnsWithTheShapeButForTies)
{
  const std::int32_t n = 36;
  const VoxelShape   rough = Flipped(Ball(n, 14, { 0.2, 0.1, -0.3 }), n, 5, true);
  const VoxelShape   smooth = SmoothShape(rough).shape;
  const auto         flipped = static_cast<double>(CountDifferences(rough, smooth, n));
  EXPECT_GT(flipped, 100);
  for (int turn = 1; turn < 8; ++turn)
  {
    const auto at = [&](const VoxelShape & shape, int x, int y, int z) {
      return shape.Contains(turn % 2 == 1 ? n - 1 - y : x,
                            turn % 2 == 1 ? z : y,
                            turn / 4 == 1 ? n - 1 - (turn % 2 == 1 ? x : z) : (turn % 2 == 1 ? x : z));
    };
    const auto turned = [&](const VoxelShape & shape) {
      return ShapeWhere({ n, n, n }, [&](int x, int y, int z) { return at(shape, x, y, z); });
    };
    EXPECT_LE(static_cast<double>(CountDifferences(SmoothShape(turned(rough)).shape, turned(smooth), n)),
              0.03 * flipped);
  }
}

TEST(ShapeSmoothing, StopsWhenAsked)
{
  EXPECT_THROW(SmoothShape(Box({ 4, 4, 4 }), [](std::string_view, double) { return false; }), Cancelled);
}

} // namespace
} // namespace voxelcore::testing
