// Which branches a body has at which threshold: bodies of tubes at random, thin stubs on thick stems.

#include "CurveBranches.h"
#include "TubeShapes.h"
#include "VoxelCoreTesting/Random.h"

#include "voxelcore/Skeleton/BranchTable.h"
#include "voxelcore/VoxelCore/TolerancePruning.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>
#include <vector>

namespace voxelcore::testing
{

namespace
{

struct Rod
{
  Spacing3 from{};
  Spacing3 to{};
  double   radius = 0;
};

/** Voxels, 1 x 1 x `slice` mm, whose centre lies in a rod with round ends. */
VoxelShape
BodyOf(const std::vector<Rod> & rods, double slice = 1)
{
  Spacing3 low{ 0, 0, 0 };
  Spacing3 high{ 0, 0, 0 };
  for (const Rod & rod : rods)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min({ low[axis], rod.from[axis] - rod.radius, rod.to[axis] - rod.radius });
      high[axis] = std::max({ high[axis], rod.from[axis] + rod.radius, rod.to[axis] + rod.radius });
    }
  }
  Size3 size{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    size[axis] = static_cast<std::int32_t>((high[axis] - low[axis]) / (axis == 2 ? slice : 1)) + 4;
  }
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, size });
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      for (std::int32_t x = 0; x < size[0]; ++x)
      {
        const Spacing3 at{ x - 1.5 + low[0], y - 1.5 + low[1], (z - 1.5) * slice + low[2] };
        if (std::any_of(rods.begin(), rods.end(), [&](const Rod & rod) {
              double along = 0;
              double length = 0;
              for (std::size_t axis = 0; axis < 3; ++axis)
              {
                along += (at[axis] - rod.from[axis]) * (rod.to[axis] - rod.from[axis]);
                length += (rod.to[axis] - rod.from[axis]) * (rod.to[axis] - rod.from[axis]);
              }
              const double part = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0;
              Spacing3     nearest{};
              for (std::size_t axis = 0; axis < 3; ++axis)
              {
                nearest[axis] = rod.from[axis] + part * (rod.to[axis] - rod.from[axis]);
              }
              return Distance(at, nearest) <= rod.radius;
            }))
        {
          shape.Insert(x, y, z);
        }
      }
    }
  }
  return shape;
}

Spacing3
RandomDirection(Random & random)
{
  const double z = 2 * random.Unit() - 1;
  const double turn = 2 * std::numbers::pi * random.Unit();
  const double across = std::sqrt(1 - z * z);
  return { across * std::cos(turn), across * std::sin(turn), z };
}

Spacing3
Moved(const Spacing3 & from, const Spacing3 & direction, double way)
{
  return { from[0] + way * direction[0], from[1] + way * direction[1], from[2] + way * direction[2] };
}

/** A thick rod or ball with thinner ones on it. */
std::vector<Rod>
RandomTree(Random & random)
{
  const double     radius = 4 + 6 * random.Unit();
  std::vector<Rod> rods{ { {}, Moved({}, RandomDirection(random), 40 * random.Unit()), radius } };
  for (auto count = random.Between(1, 5); count > 0; --count)
  {
    const Rod    on = rods[static_cast<std::size_t>(random.Between(0, static_cast<std::int64_t>(rods.size()) - 1))];
    const double part = random.Unit();
    Spacing3     from{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      from[axis] = on.from[axis] + part * (on.to[axis] - on.from[axis]);
    }
    const double length = on.radius + 2 + 20 * random.Unit();
    rods.push_back({ from, Moved(from, RandomDirection(random), length), on.radius * (0.3 + 0.6 * random.Unit()) });
  }
  return rods;
}

std::vector<Spacing3>
TipsOf(const CurveSkeleton & skeleton)
{
  const std::vector<int> degrees = Degrees(skeleton.complex.cells);
  std::vector<Spacing3>  tips;
  for (std::size_t vertex = 0; vertex < degrees.size(); ++vertex)
  {
    if (degrees[vertex] == 1)
    {
      tips.push_back(skeleton.places[vertex]);
    }
  }
  return tips;
}

double
DistanceTo(const CurveSkeleton & skeleton, const Spacing3 & point)
{
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t vertex = 0; vertex < skeleton.places.size(); ++vertex)
  {
    // An end lies on the edge beyond its vertex, which stays longer at a lower threshold.
    least = std::min(
      { least, Distance(skeleton.places[vertex], point), Distance(skeleton.complex.positions[vertex], point) });
  }
  return least;
}

TEST(BranchesByThreshold, MoreThresholdNeverGivesMoreBranches)
{
  int fewer = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
  {
    Random              random(seed);
    const MedialComplex surface = SurfaceOf(BodyOf(RandomTree(random)));
    CurveSkeleton       before;
    for (const double threshold : { 0.25, 0.5, 1.0, 1.5, 3.0, 8.0 })
    {
      CurveSkeleton skeleton = SkeletonOf(surface, threshold);
      const auto    tips = TipsOf(skeleton);
      if (threshold > 0.25)
      {
        ASSERT_LE(tips.size(), TipsOf(before).size()) << "seed " << seed << ", threshold " << threshold;
        fewer += tips.size() < TipsOf(before).size() ? 1 : 0;
        for (const Spacing3 & tip : tips)
        {
          ASSERT_LT(DistanceTo(before, tip), 2) << "seed " << seed << ", threshold " << threshold;
        }
      }
      before = std::move(skeleton);
    }
  }
  EXPECT_GT(fewer, 2);
}

/** A tube of elliptic section across a random direction. */
VoxelShape
FlatTube(Random & random, double wide, double thin, double length)
{
  const Spacing3 along = RandomDirection(random);
  Spacing3       across{ along[1], -along[0], 0 };
  for (double & value : across)
  {
    value /= std::hypot(along[0], along[1]);
  }
  const Spacing3     third{ along[1] * across[2] - along[2] * across[1],
                        along[2] * across[0] - along[0] * across[2],
                        along[0] * across[1] - along[1] * across[0] };
  const std::int32_t side = static_cast<std::int32_t>(length + 2 * wide) + 4;
  const Spacing3     centre{ 0.5 * side + random.Unit(), 0.5 * side + random.Unit(), 0.5 * side + random.Unit() };
  VoxelShape         shape(VoxelBox{ { 0, 0, 0 }, { side, side, side } });
  for (std::int32_t z = 0; z < side; ++z)
  {
    for (std::int32_t y = 0; y < side; ++y)
    {
      for (std::int32_t x = 0; x < side; ++x)
      {
        const Spacing3 d{ x + 0.5 - centre[0], y + 0.5 - centre[1], z + 0.5 - centre[2] };
        const auto     onto = [&](const Spacing3 & axis) { return d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2]; };
        const double   beyond = std::max(std::abs(onto(along)) - 0.5 * length, 0.0);
        if (std::hypot(onto(across) / wide, onto(third) / thin, beyond / thin) <= 1)
        {
          shape.Insert(x, y, z);
        }
      }
    }
  }
  return shape;
}

TEST(BranchesByThreshold, PruningByToleranceGivesNoBranches)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
  {
    Random        random(seed);
    const bool    isFlat = seed < 3;
    MedialComplex core = CoreWithTolerancesOf(isFlat ? FlatTube(random, 10, 4, 60) : BodyOf(RandomTree(random)));
    const auto    tipsOf = [&](const LiveElements * part) {
      return TipsOf(SkeletonOf(core, 3, std::numeric_limits<double>::infinity(), 1, 0, part)).size();
    };
    std::size_t before = tipsOf(nullptr);
    EXPECT_EQ(before, isFlat ? 2U : before) << "seed " << seed;
    for (const double height : { 1.0, 1.5, 2.1, 3.0, 5.0 })
    {
      const LiveElements left = LeftByTolerance(core, height);
      EXPECT_LE(tipsOf(&left), before) << "seed " << seed << ", height " << height;
      before = tipsOf(&left);
    }
  }
}

TEST(BranchesByThreshold, AThinStubOnAThickStemIsABranchOnEverySide)
{
  for (const double radius : { 8.0, 20.0 })
  {
    for (int side = 0; side < 3; ++side)
    {
      Random         random(static_cast<std::uint64_t>(side) + 1);
      const Spacing3 along = RandomDirection(random);
      Spacing3       across{ along[1], -along[0], 0 };
      const double   length = Distance(across, { 0, 0, 0 });
      for (double & value : across)
      {
        value /= length;
      }
      const Spacing3 second{ along[1] * across[2] - along[2] * across[1],
                             along[2] * across[0] - along[0] * across[2],
                             along[0] * across[1] - along[1] * across[0] };
      const double   turn = side * 2 * std::numbers::pi / 3;
      const Spacing3 out = Moved(Moved({}, across, std::cos(turn)), second, std::sin(turn));
      // Of radius 2, and 10 high.
      const Spacing3         tip = Moved({}, out, radius + 8);
      const std::vector<Rod> rods{ { Moved({}, along, -1.6 * radius), Moved({}, along, 1.6 * radius), radius },
                                   { {}, tip, 2 } };
      const SkeletonGraph    graph = GraphOf(BodyOf(rods));
      EXPECT_EQ(MeasureBranches(graph).numbers.tips, 3) << "radius " << radius << ", side " << side;
    }
  }
}

/** A thin tube that goes on for a few voxels behind where another one leaves it obliquely forwards: how many of the
 *  runs have three tips, in percent. */
double
ShortEndsFound(double behind, double radius, double slice)
{
  int found = 0;
  int runs = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
  {
    Random         random(seed);
    const Spacing3 along = RandomDirection(random);
    Spacing3       out = RandomDirection(random);
    const double   dot = out[0] * along[0] + out[1] * along[1] + out[2] * along[2];
    out = Moved(out, along, 0.5 - dot);
    const double length = Distance(out, { 0, 0, 0 });
    if (length < 0.8)
    {
      continue;
    }
    const std::vector<Rod> rods{ { Moved({}, along, -30), Moved({}, along, behind), radius },
                                 { {}, Moved({}, out, 22 / length), radius } };
    ++runs;
    found += MeasureBranches(GraphOf(BodyOf(rods, slice), { 1, 1, slice })).numbers.tips == 3 ? 1 : 0;
  }
  std::cout << found << " of " << runs << " have three tips\n";
  EXPECT_GE(runs, 20);
  return 100.0 * found / runs;
}

TEST(BranchesByThreshold, TheShortEndOfAThinTubeBehindAFork)
{
  EXPECT_GE(ShortEndsFound(5, 1.6, 1), 90);
  EXPECT_GE(ShortEndsFound(6, 1.3, 2), 90);
}

TEST(BranchesByThreshold, TheShortEndOfAThickerTubeBehindAFork)
{
  EXPECT_GE(ShortEndsFound(6, 2.4, 1), 95);
  EXPECT_EQ(ShortEndsFound(9, 3, 1), 100);
}

/** How many branches stand out of a stem of radius 5 and a short side of it, whose radius goes evenly from one to the
 *  other; in a fork with an arm of the stem's radius, whose balls hold the side's to 3. Lengths in voxels. */
std::size_t
BranchesBesideAStem(double radiusAtEnd, double radiusAtStem, bool inFork)
{
  constexpr ElementIndex half = 40;
  constexpr ElementIndex side = 7;
  MedialComplex          curve;
  const auto             add = [&](const Spacing3 & place, double radius, ElementIndex joined) {
    const auto vertex = static_cast<ElementIndex>(curve.positions.size());
    curve.positions.push_back(place);
    curve.radius.push_back(radius);
    if (vertex > 0)
    {
      curve.cells.edges.push_back({ joined, vertex });
    }
  };
  for (ElementIndex i = 0; i <= 2 * half; ++i)
  {
    add({ static_cast<double>(i), 0, 0 }, 5, i - 1);
  }
  for (ElementIndex i = 1; i <= side; ++i)
  {
    const double t = static_cast<double>(i - 1) / (side - 1);
    add({ half, static_cast<double>(i), 0 },
        radiusAtStem + t * (radiusAtEnd - radiusAtStem),
        i == 1 ? half : 2 * half + i - 1);
  }
  for (ElementIndex i = 1; inFork && i <= half; ++i)
  {
    add({ half, 0.9 * i, std::sqrt(1 - 0.81) * i }, 5, i == 1 ? half : 2 * half + side + i - 1);
  }
  curve.cells.vertexCount = static_cast<ElementIndex>(curve.positions.size());
  const LiveElements live{ std::vector<std::uint8_t>(curve.positions.size(), 1),
                           std::vector<std::uint8_t>(curve.cells.edges.size(), 1),
                           {} };
  const CurveFire    fire = BurnCurves(curve, live, curve.radius, 8);
  return StandingBranches(curve, fire, curve.radius, { 8, 1 }, 3).size();
}

TEST(BranchesByThreshold, OfShortOnesNoneIsWiderAtItsEndThanWhereItLeaves)
{
  EXPECT_EQ(BranchesBesideAStem(4, 4, true), 4U);
  EXPECT_EQ(BranchesBesideAStem(4, 4.5, true), 4U);
  EXPECT_EQ(BranchesBesideAStem(4.8, 3.6, true), 3U);
}

TEST(BranchesByThreshold, WhatNoOtherHoldsHasABranchThatMayBeWiderAtItsEnd)
{
  EXPECT_EQ(BranchesBesideAStem(4, 4, false), 3U);
  EXPECT_EQ(BranchesBesideAStem(4.8, 3.6, false), 3U);
}

} // namespace

} // namespace voxelcore::testing
