// Closing and filling of hollows, against their definitions.

#include "Core/Shape/FloodFill.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Masks/ShapeClosing.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cstdlib>

namespace voxelcore::testing
{
namespace
{

using Offsets = std::vector<std::array<std::int32_t, 3>>;

Offsets
OffsetsOf(const LatticeBall & ball)
{
  constexpr std::int32_t most = 12;
  Offsets                offsets;
  for (std::int32_t z = -most; z <= most; ++z)
  {
    for (std::int32_t y = -most; y <= most; ++y)
    {
      for (std::int32_t x = -most; x <= most; ++x)
      {
        const std::array<std::int64_t, 3> at{ ball.weight[0] * x, ball.weight[1] * y, ball.weight[2] * z };
        if (at[0] * at[0] + at[1] * at[1] + at[2] * at[2] <= ball.squaredRadius)
        {
          offsets.push_back({ x, y, z });
        }
      }
    }
  }
  return offsets;
}

/** A voxel is in when each ball that holds it holds a voxel of the shape. */
VoxelShape
ClosedByDefinition(const VoxelShape & shape, const LatticeBall & ball)
{
  const Offsets offsets = OffsetsOf(ball);
  const auto &  box = shape.Box();
  return ShapeWhere(
    box.size,
    [&](int i, int j, int k) {
      return std::ranges::all_of(offsets, [&](const auto & to) {
        return std::ranges::any_of(offsets, [&](const auto & from) {
          return shape.Contains(box.lower[0] + i + to[0] + from[0],
                                box.lower[1] + j + to[1] + from[1],
                                box.lower[2] + k + to[2] + from[2]);
        });
      });
    },
    box.lower);
}

bool
Holds(const VoxelShape & more, const VoxelShape & less)
{
  const Voxels all = VoxelsOf(more);
  const Voxels part = VoxelsOf(less);
  return std::includes(all.begin(), all.end(), part.begin(), part.end());
}

LatticeBall
RandomBall(Random & random, const Spacing3 & spacing)
{
  LatticeBall ball;
  ball.weight = ComputeSpacingWeights(spacing).weight;
  const auto most = *std::ranges::max_element(ball.weight);
  ball.squaredRadius = random.Between(0, 5 * most * most);
  return ball;
}

/** Every two components that became one hang together by steps of no more than the ball's diameter from face to
 *  face. */
void
ExpectNoFartherJoined(const VoxelShape & shape, const VoxelShape & closed, const LatticeBall & ball)
{
  const std::vector<Voxels> before = FloodBySize(shape);
  const auto                near = [&](const Voxels & a, const Voxels & b) {
    for (const auto & p : a)
    {
      for (const auto & q : b)
      {
        std::int64_t squared = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const std::int64_t gap =
            std::max(std::abs(p[axis] - q[axis]) - 1, 0) * ball.weight[2 - axis]; // z comes first
          squared += gap * gap;
        }
        if (squared <= 4 * ball.squaredRadius)
        {
          return true;
        }
      }
    }
    return false;
  };
  UnionFind sets(before.size());
  for (std::size_t a = 0; a < before.size(); ++a)
  {
    for (std::size_t b = 0; b < a; ++b)
    {
      if (sets.Find(a) != sets.Find(b) && near(before[a], before[b]))
      {
        sets.Unite(a, b);
      }
    }
  }
  for (const Voxels & joined : FloodBySize(closed))
  {
    std::size_t first = before.size();
    for (std::size_t a = 0; a < before.size(); ++a)
    {
      if (std::ranges::binary_search(joined, before[a].front()))
      {
        first = first == before.size() ? a : first;
        EXPECT_EQ(sets.Find(a), sets.Find(first));
      }
    }
  }
}

void
ExpectAsDefined(std::uint64_t firstSeed, int count)
{
  for (RandomVolume & volume : RandomVolumes(firstSeed, count))
  {
    SCOPED_TRACE(volume.Describe());
    Random            random(volume.seed);
    const double      density = 0.02 * static_cast<double>(random.Between(1, 20));
    VoxelShape        shape = RandomShape(random, volume.shape.Box().size, density);
    const LatticeBall ball = RandomBall(random, volume.spacing);
    const EditedShape edited = CloseShape(shape, ball);
    const VoxelShape  expected = ClosedByDefinition(shape, ball);
    ExpectTight(edited.shape, VoxelsOf(expected));
    EXPECT_EQ(edited.voxelsAdded, expected.CountVoxels() - shape.CountVoxels());
    EXPECT_TRUE(Holds(edited.shape, shape));
    EXPECT_EQ(CloseShape(edited.shape, ball).voxelsAdded, 0U);
    ExpectNoFartherJoined(shape, edited.shape, ball);
    VoxelShape more = shape;
    for (int n = 0; n < 5; ++n)
    {
      const auto at = [&](std::size_t axis) {
        return static_cast<std::int32_t>(random.Between(0, more.Box().size[axis] - 1));
      };
      const std::int32_t x = at(0);
      const std::int32_t y = at(1);
      more.Insert(x, y, at(2));
    }
    EXPECT_TRUE(Holds(CloseShape(more, ball).shape, edited.shape));
    const EditedShape filled = FillHollows(shape, ball);
    EXPECT_TRUE(Holds(filled.shape, FillCavities(shape).shape));
    EXPECT_EQ(FillHollows(shape, { ball.weight, 0 }).shape.CountVoxels(), FillCavities(shape).shape.CountVoxels());
    if (::testing::Test::HasFailure())
    {
      return;
    }
  }
}

ImageGeometry
Geometry(const Spacing3 & spacing)
{
  ImageGeometry geometry;
  geometry.size = { 100, 100, 100 };
  geometry.spacing = spacing;
  return geometry;
}

LatticeBall
BallOf(const char * width, const Spacing3 & spacing = { 1, 1, 1 })
{
  return BallOfDiameter(ParseGapWidth(width), Geometry(spacing));
}

TEST(ShapeClosing, IsWhatTheDefinitionSays)
{
  ExpectAsDefined(1, 150);
}

TEST(HeavyShapeClosing, IsWhatTheDefinitionSays)
{
  ExpectAsDefined(1000, 5000);
}

TEST(ShapeClosing, GapsUpToTheWidthCloseAndNoneWider)
{
  for (const Spacing3 & spacing : { Spacing3{ 1, 1, 1 }, Spacing3{ 0.7, 0.7, 0.7 }, Spacing3{ 1, 1, 3 } })
  {
    for (std::int32_t axis = 0; axis < 2; ++axis) // those of the smallest spacing
    {
      for (std::int32_t gap = 1; gap <= 9; ++gap)
      {
        Size3 size{ 20, 20, 20 };
        size[static_cast<std::size_t>(axis)] = gap + 4;
        const auto plates = ShapeWhere(size, [&](int x, int y, int) {
          const int at = axis == 0 ? x : y;
          return at < 2 || at >= gap + 2;
        });
        for (std::int32_t width = 1; width <= 10; ++width)
        {
          const auto closed = CloseShape(plates, BallOf((std::to_string(width) + "vox").c_str(), spacing));
          EXPECT_EQ(closed.componentsJoined, gap <= width / 2 * 2 ? 1U : 0U) << gap << " by " << width;
        }
      }
    }
  }
}

TEST(ShapeClosing, ReachesOverWordsAndBordersLikeAnywhere)
{
  // Two plates across x whose gap lies at a seam of words, and one whose other side is the image's border.
  for (const std::int32_t gap : { 4, 66 })
  {
    const auto width = std::to_string(gap) + "vox";
    const auto walls = ShapeWhere({ 260, 2 * gap + 1, 2 * gap + 1 },
                                  [&](int x, int, int) { return x < 63 || (x >= 63 + gap && x < 200); });
    const auto closed = CloseShape(walls, BallOf(width.c_str()));
    EXPECT_EQ(closed.componentsJoined, 1U);
    EXPECT_EQ(closed.shape.Box().size[0], 200) << "the border is no wall";
  }
}

TEST(ShapeClosing, IsTheSameOnAnyNumberOfThreads)
{
  Random            random(5);
  const VoxelShape  shape = RandomShape(random, { 130, 70, 60 }, 0.02);
  const LatticeBall ball = BallOf("6vox", { 1, 1, 2 });
  const int         before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Voxels closed = VoxelsOf(CloseShape(shape, ball).shape);
  const Voxels filled = VoxelsOf(FillHollows(shape, ball).shape);
  omp_set_num_threads(5);
  EXPECT_EQ(VoxelsOf(CloseShape(shape, ball).shape), closed);
  EXPECT_EQ(VoxelsOf(FillHollows(shape, ball).shape), filled);
  omp_set_num_threads(before);
}

TEST(ShapeClosing, NothingStaysNothing)
{
  EXPECT_EQ(CloseShape(VoxelShape(), BallOf("4vox")).shape.CountVoxels(), 0U);
  EXPECT_EQ(FillHollows(VoxelShape(VoxelBox{ { 1, 2, 3 }, { 4, 4, 4 } }), BallOf("4vox")).shape.CountVoxels(), 0U);
}

/** A tube along x with a wall of 2 voxels and a lumen of 8 x 8, closed at its ends, with a hole of `hole` voxels
 *  through its wall, and a rod two voxels beside it. */
VoxelShape
TubeAndRod(std::int32_t hole)
{
  return ShapeWhere({ 40, 18, 12 }, [hole](int x, int y, int z) {
    const bool isRod = y >= 14;
    const bool isBody = y < 12;
    const bool isLumen = x >= 2 && x < 38 && y >= 2 && y < 10 && z >= 2 && z < 10;
    const bool isHole = x >= 20 && x < 20 + hole && y >= 5 && y < 5 + hole && z >= 10;
    return isRod || (isBody && !isLumen && !isHole);
  });
}

TEST(ShapeClosing, LumensBehindHolesFillAndPartsStayApart)
{
  constexpr std::uint64_t lumen = 36 * 8 * 8;
  const auto              filled = FillHollows(TubeAndRod(3), BallOf("4vox"));
  EXPECT_EQ(filled.cavitiesFilled, 1U);
  EXPECT_EQ(filled.componentsJoined, 0U);
  EXPECT_GE(filled.voxelsAdded, lumen);
  EXPECT_LE(filled.voxelsAdded, lumen + 3 * 3 * 2) << "a hole becomes a dent";
  EXPECT_EQ(CloseShape(TubeAndRod(3), BallOf("4vox")).componentsJoined, 1U) << "closing by itself joins the rod";
  EXPECT_EQ(FillHollows(TubeAndRod(6), BallOf("4vox")).voxelsAdded, 0U) << "a hole wider than that is a mouth";
  EXPECT_EQ(FillHollows(TubeAndRod(0), BallOf("4vox")).voxelsAdded, lumen);
}

TEST(ShapeClosing, WidthsAreNumbersWithUnits)
{
  EXPECT_EQ(ParseGapWidth("4vox").unit, SpatialUnit::Voxels);
  EXPECT_EQ(ParseGapWidth(" 2.5 mm").text, "2.5mm");
  EXPECT_EQ(ParseGapWidth("2.5").unit, SpatialUnit::Millimetres);
  for (const char * text : { "", "x", "0", "0vox", "-1mm", "3%", "4voxels", "inf" })
  {
    EXPECT_THROW(ParseGapWidth(text), UsageError) << text;
  }
  EXPECT_EQ(BallOf("2.8mm", { 0.7, 0.7, 0.7 }).squaredRadius, 4) << "rounding in mm loses no voxel";
  EXPECT_EQ(BallOf("4vox", { 1, 1, 3 }).squaredRadius, 4);
  EXPECT_EQ(BallOf("4vox", { 3, 3, 1 }).squaredRadius, 4);
  EXPECT_THROW(BallOf("2001vox"), InputError);
  ImageGeometry inVoxels = Geometry({ 1, 1, 1 });
  inVoxels.unit = SpatialUnit::Voxels;
  EXPECT_THROW(BallOfDiameter(ParseGapWidth("2mm"), inVoxels), InputError);
  EXPECT_EQ(BallOfDiameter(ParseGapWidth("2vox"), inVoxels).squaredRadius, 1);
}

// A lumen that the scan's border cuts ends there; one that opens within the scan stays open.
TEST(ShapeClosing, ALumenThatTheBorderOfTheScanCutsIsClosedThere)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const bool isUpper : { false, true })
    {
      for (const std::int32_t margin : { 0, 1 })
      {
        constexpr std::int32_t side = 17;
        VoxelShape             tube({ { margin, margin, margin }, { side, side, side } });
        std::uint64_t          lumen = 0;
        for (std::int32_t along = 0; along < side; ++along)
        {
          for (std::int32_t u = 0; u < side; ++u)
          {
            for (std::int32_t v = 0; v < side; ++v)
            {
              const std::int32_t square = (u - 8) * (u - 8) + (v - 8) * (v - 8);
              const bool         isEnd = isUpper ? along < 2 : along > side - 3;
              if (square > 64)
              {
                continue;
              }
              std::array<std::int32_t, 3> at{ u, u, v };
              at[axis] = along;
              at[axis == 0 ? 1 : 0] = u;
              at[axis == 2 ? 1 : 2] = v;
              if (square > 25 || isEnd)
              {
                tube.Insert(at[0] + margin, at[1] + margin, at[2] + margin);
              }
              else
              {
                ++lumen;
              }
            }
          }
        }
        const std::int64_t size = side + 2 * margin;
        EXPECT_EQ(FillHollows(tube, BallOf("4vox")).voxelsAdded, 0U);
        const EditedShape filled =
          FillHollows(tube, BallOf("4vox"), {}, std::array<std::int64_t, 3>{ size, size, size });
        EXPECT_EQ(filled.voxelsAdded, margin == 0 ? lumen : 0) << axis << isUpper << margin;
      }
    }
  }
}

} // namespace
} // namespace voxelcore::testing
