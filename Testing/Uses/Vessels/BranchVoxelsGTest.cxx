#include "VesselFixtures.h"

#include "voxelcore/Vessels/BranchVoxels.h"

#include <gtest/gtest.h>

#include <iostream>
#include <map>
#include <omp.h>
#include <set>

namespace voxelcore::testing
{

namespace
{

using Voxel = std::array<std::int32_t, 3>;

/** Three tubes of different radius that meet, in flat voxels at any turn. */
MeasuredBody
ThreeTubes(std::mt19937_64 & random)
{
  const auto    turn = AnyTurn(random);
  const Vector3 spacing{ 1, 1, 1.5 };
  const auto    isIn = [&](const Vector3 & p, const Vector3 & to, double radius) {
    const double t = std::clamp(Dot(p, to) / Dot(to, to), 0.0, 1.0);
    return Distance(p, AddScaled({}, t, to)) <= radius;
  };
  VoxelShape          shape = VoxelsAround({ 40, 40, 40 }, spacing, { .2, .1, .3 }, [&](const Vector3 & p) {
    return isIn(p, AddScaled({}, -30, turn[0]), 5) || isIn(p, AddScaled(AddScaled({}, 22, turn[0]), 20, turn[1]), 3) ||
           isIn(p, AddScaled(AddScaled({}, 22, turn[0]), -20, turn[1]), 4);
  });
  const ImageGeometry geometry = GridOf(shape, spacing);
  return MeasureBody(std::move(shape), geometry);
}

template <typename Visit>
void
ForVoxels(const VoxelShape & shape, const Visit & visit)
{
  const VoxelBox & box = shape.Box();
  for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
  {
    for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
    {
      for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
      {
        if (shape.Contains(x, y, z))
        {
          visit(Voxel{ x, y, z });
        }
      }
    }
  }
}

/** Least distance to the surface of a ball of a branch, by very many balls. */
double
Gap(const MeasuredBody & body, std::size_t branch, const Voxel & voxel)
{
  const Vector3 middle = LatticeToPhysical(body.geometry, { voxel[0] + 0.5, voxel[1] + 0.5, voxel[2] + 0.5 });
  const auto    points = body.graph.Branch(branch);
  double        least = HUGE_VAL;
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    const Vector3 & from = body.graph.positions[points[i - 1]];
    const Vector3   way = Minus(body.graph.positions[points[i]], from);
    for (double t = 0; t <= 1; t += 0.0625)
    {
      const double radius = (1 - t) * body.graph.radius[points[i - 1]] + t * body.graph.radius[points[i]];
      least = std::min(least, Distance(middle, AddScaled(from, t, way)) - radius);
    }
  }
  return least;
}

} // namespace

TEST(BranchVoxels, BelongToTheBranchWhoseBallsAreNearest)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  MeasuredBody    body = ThreeTubes(random);
  // Some turns of the grid give short branches more.
  for (int more = 0; more < 20 && body.graph.BranchCount() != 3; ++more)
  {
    body = ThreeTubes(random);
  }
  ASSERT_EQ(body.graph.BranchCount(), 3U);
  const auto                 field = BranchOfVoxels(body.graph, body.shape, body.geometry);
  std::size_t                at = 0;
  std::array<std::size_t, 3> count{};
  ForVoxels(body.shape, [&](const Voxel & voxel) {
    const std::uint32_t own = field.values[at++];
    ASSERT_TRUE(own >= 1 && own <= 3);
    ++count[own - 1];
    if (at % 7 == 0) // each seventh
    {
      for (std::size_t other = 0; other < 3; ++other)
      {
        // Balls between points are no farther apart than half a voxel.
        EXPECT_LE(Gap(body, own - 1, voxel), Gap(body, other, voxel) + 0.1);
      }
    }
  });
  EXPECT_EQ(at, field.values.size());
  EXPECT_EQ(at, body.shape.CountVoxels());
  // Their volumes, of tubes of 30 by radii of 3 to 5, half a ball at each end, but for what lies in the joint.
  for (const std::size_t n : count)
  {
    EXPECT_GT(1.5 * static_cast<double>(n), 0.6 * 3.14 * 9 * 30);
  }
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  EXPECT_EQ(BranchOfVoxels(body.graph, body.shape, body.geometry).values, field.values);
  omp_set_num_threads(threads);
}

TEST(BranchVoxels, OfEqualBranchesAreThoseOfTheFirst)
{
  // Two branches that mirror each other: the voxels in the mirror are as near to both.
  SkeletonGraph graph;
  graph.positions = { { 2, 4, 4 }, { 2, 0, 4 }, { 6, 4, 4 }, { 6, 0, 4 } };
  graph.radius = { 1, 1, 1, 1 };
  SortBranches(graph, { { 0, 1 }, { 2, 3 } }, false);
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 9, 5, 9 } });
  for (std::int32_t x = 0; x < 9; ++x)
  {
    shape.Insert(x, 2, 4);
  }
  ImageGeometry geometry;
  geometry.size = { 9, 5, 9 };
  const auto field = BranchOfVoxels(graph, shape, geometry);
  EXPECT_EQ(field.values, (std::vector<std::uint32_t>{ 1, 1, 1, 1, 1, 2, 2, 2, 2 }));
}

TEST(BranchVoxels, OfABodyWithoutBranchesAreZero)
{
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 1, 1, 1 } });
  shape.Insert(0, 0, 0);
  EXPECT_EQ(BranchOfVoxels({}, shape, {}).values, std::vector<std::uint32_t>{ 0 });
}

TEST(SkeletonVoxels, AreThinLinesInTheBodyThatFollowItsBranches)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937_64    random(seed);
  const MeasuredBody body = ThreeTubes(random);
  for (std::size_t branch = 0; branch < body.graph.BranchCount(); ++branch)
  {
    SkeletonGraph             one;
    const auto                points = body.graph.Branch(branch);
    std::vector<ElementIndex> line;
    for (const ElementIndex point : points)
    {
      line.push_back(static_cast<ElementIndex>(one.positions.size()));
      one.positions.push_back(body.graph.positions[point]);
      one.radius.push_back(body.graph.radius[point]);
    }
    SortBranches(one, { line }, false);
    VoxelShape voxels(body.shape.Box());
    AddSkeletonVoxels(one, body.shape, body.geometry, voxels);
    std::set<Voxel> all;
    ForVoxels(voxels, [&](const Voxel & voxel) {
      EXPECT_TRUE(body.shape.Contains(voxel[0], voxel[1], voxel[2]));
      all.insert(voxel);
    });
    // A line: two voxels with one neighbour, the others with two, for a smooth branch nearly all of them.
    std::map<std::size_t, std::size_t> neighbours;
    for (const Voxel & voxel : all)
    {
      std::size_t count = 0;
      for (std::int32_t c = 0; c < 27; ++c)
      {
        count +=
          c != 13 && all.contains({ voxel[0] + c % 3 - 1, voxel[1] + c / 3 % 3 - 1, voxel[2] + c / 9 - 1 }) ? 1 : 0;
      }
      ++neighbours[count];
    }
    EXPECT_EQ(neighbours.count(0), 0U);
    EXPECT_GE(neighbours[2], all.size() * 9 / 10);
    // All in one piece.
    std::vector<Voxel> next{ *all.begin() };
    all.erase(all.begin());
    while (!next.empty())
    {
      const Voxel voxel = next.back();
      next.pop_back();
      for (std::int32_t c = 0; c < 27; ++c)
      {
        const Voxel beside{ voxel[0] + c % 3 - 1, voxel[1] + c / 3 % 3 - 1, voxel[2] + c / 9 - 1 };
        if (all.erase(beside) > 0)
        {
          next.push_back(beside);
        }
      }
    }
    EXPECT_TRUE(all.empty());
    for (const ElementIndex point : points)
    {
      const Vector3 place = PhysicalToLattice(body.geometry, body.graph.positions[point]);
      bool          isNear = false;
      ForVoxels(voxels, [&](const Voxel & voxel) {
        const double away = std::max({ std::abs(voxel[0] + 0.5 - place[0]),
                                       std::abs(voxel[1] + 0.5 - place[1]),
                                       std::abs(voxel[2] + 0.5 - place[2]) });
        isNear = isNear || away <= 1.5;
      });
      EXPECT_TRUE(isNear);
    }
  }
}

TEST(SkeletonVoxels, HavePointsByThemselvesAndFaces)
{
  SkeletonGraph graph;
  graph.positions = { { 1, 1, 1 }, { 4, 4, 1 }, { 8, 4, 1 }, { 8, 8, 1 } };
  graph.radius = { 1, 1, 1, 1 };
  graph.faceOffsets = { 0, 3 };
  graph.faceVertices = { 1, 2, 3 };
  graph.closedFace = { 0 };
  SortBranches(graph, {}, false);
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 10, 10, 3 } });
  for (std::int32_t y = 0; y < 10; ++y)
  {
    for (std::int32_t x = 0; x < 10; ++x)
    {
      shape.Insert(x, y, 1);
    }
  }
  VoxelShape voxels(shape.Box());
  AddSkeletonVoxels(graph, shape, {}, voxels);
  for (std::int32_t y = 0; y < 10; ++y)
  {
    for (std::int32_t x = 0; x < 10; ++x)
    {
      // Middles of voxels have whole coordinates.
      const bool isPoint = x == 1 && y == 1;
      const bool isInside = x > y && x < 8 && y > 4;
      const bool isAround = x >= y && x <= 8 && y >= 4;
      const bool is = voxels.Contains(x, y, 1);
      EXPECT_TRUE((!isPoint && !isInside) || is) << x << " " << y;
      EXPECT_TRUE(isPoint || isAround || !is) << x << " " << y;
    }
  }
}

} // namespace voxelcore::testing
