#include "GraphBuilder.h"
#include "TubeShapes.h"

#include "voxelcore/Skeleton/BranchTips.h"

#include <initializer_list>
#include <iostream>
#include <numbers>
#include <random>

namespace voxelcore::testing
{

namespace
{

/** The graph of a shape as balls end it, and with its tips placed. */
struct Placed
{
  SkeletonGraph before;
  SkeletonGraph after;
};

Placed
PlaceTipsOf(const VoxelShape & shape)
{
  return { GraphOfSurface(SurfaceOf(shape)), GraphOf(shape) };
}

/** Points of a line of a length, anywhere in the voxel in the middle of a box of `side` mm. */
Curve
AnyLine(double length, double side, const Spacing3 & spacing, std::mt19937_64 & random)
{
  std::uniform_real_distribution<double> part(0, 1);
  const Spacing3                         way = AnyDirection(random);
  Spacing3                               centre{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    centre[axis] = side / 2 + part(random) * spacing[axis];
  }
  return SampleCurve(
    [&](double t) {
      Spacing3 p = centre;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        p[axis] += (t - 0.5) * length * way[axis];
      }
      return p;
    },
    static_cast<std::size_t>(4 * length));
}

/** Root mean square of how far the tips lie from the ends of a line, mm. */
double
TipsOff(const SkeletonGraph & graph, const Curve & line)
{
  double squares = 0;
  int    tips = 0;
  for (std::size_t node = 0; node < graph.nodePoints.size(); ++node)
  {
    const Spacing3 & tip = graph.positions[graph.nodePoints[node]];
    const double     off = std::min(Distance(tip, line.front()), Distance(tip, line.back()));
    squares += off * off;
    ++tips;
  }
  return std::sqrt(squares / std::max(tips, 1));
}

TEST(BranchTips, OfStraightTubesLieAtTheCentresOfTheirCaps)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << "\n";
  std::mt19937_64 random(seed);
  double          before = 0;
  double          after = 0;
  double          length = 0;
  int             count = 0;
  for (const double radius : { 2.3, 3.1, 4.2, 5.3 })
  {
    for (int k = 0; k < 4; ++k)
    {
      const Curve line = AnyLine(44, 44 + 2 * radius + 6, { 1, 1, 1 }, random);
      const auto  side = 44 + 2 * radius + 8;
      const auto  placed = PlaceTipsOf(Tube(line, radius, { side, side, side }));
      ASSERT_EQ(placed.after.BranchCount(), 1U) << radius << ", seed " << seed;
      EXPECT_NEAR(placed.after.BranchLength(0), 44, 1.3) << radius << ", seed " << seed;
      length += (placed.after.BranchLength(0) - 44) / 44;
      before += std::pow(TipsOff(placed.before, line), 2);
      after += std::pow(TipsOff(placed.after, line), 2);
      ++count;
    }
  }
  std::cout << "off " << std::sqrt(before / count) << " -> " << std::sqrt(after / count) << " voxels\n";
  EXPECT_LT(std::abs(length / count), 0.006) << "seed " << seed;
  EXPECT_LT(std::sqrt(after / count), 0.2) << "voxels, seed " << seed;
  EXPECT_LT(after, before) << "seed " << seed;
}

/** How far tips of tubes of some lengths, in any direction, lie from the ends of their axes, root mean squares, as
 *  balls end them and as they are placed. Counted are those that have not become a point. */
struct TubesOff
{
  double before = 0;
  double after = 0;
  int    count = 0;
};

TubesOff
TipsOfTubesOff(double radius, std::initializer_list<double> lengths, int each, double side)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << "\n";
  std::mt19937_64 random(seed);
  TubesOff        off;
  for (const double length : lengths)
  {
    for (int k = 0; k < each; ++k)
    {
      const Curve line = AnyLine(length, side, { 1, 1, 1 }, random);
      const auto  placed = PlaceTipsOf(Tube(line, radius, { side, side, side }));
      if (placed.after.BranchCount() == 1)
      {
        off.before += std::pow(TipsOff(placed.before, line), 2);
        off.after += std::pow(TipsOff(placed.after, line), 2);
        ++off.count;
      }
    }
  }
  off.before = std::sqrt(off.before / off.count);
  off.after = std::sqrt(off.after / off.count);
  std::cout << "off " << off.before << " -> " << off.after << " voxels\n";
  return off;
}

// Of a short bar nothing is left between its caps: its middle says how thick it is.
TEST(BranchTips, OfShortTubesLieAtTheCentresOfTheirCaps)
{
  const TubesOff off = TipsOfTubesOff(4, { 12, 13, 14, 16 }, 4, 36);
  EXPECT_GE(off.count, 12);
  EXPECT_LT(off.after, 0.3);
  EXPECT_LT(off.after, 0.55 * off.before);
}

TEST(BranchTips, OfShortThinTubesLieNearTheCentresOfTheirCaps)
{
  const TubesOff off = TipsOfTubesOff(1.4, { 6, 7, 8, 9 }, 6, 24);
  EXPECT_GE(off.count, 20);
  EXPECT_LT(off.after, 0.45);
  EXPECT_LT(off.after, 0.7 * off.before);
}

TEST(BranchTips, OfShortBarsLieAsFarApartAsTheirVolumeSays)
{
  for (const std::int32_t width : { 2, 3, 4 })
  {
    for (const std::int32_t length : { 10, 11, 12 })
    {
      const auto placed = PlaceTipsOf(Box({ length, width, width }));
      ASSERT_EQ(placed.after.BranchCount(), 1U) << width << " x " << length;
      const double radius = width / std::sqrt(std::numbers::pi);
      EXPECT_NEAR(placed.after.BranchLength(0), length - 4 * radius / 3, 0.1) << width << " x " << length;
    }
  }
}

// On a thick rough tube a curve may end far before its cap's centre.
TEST(BranchTips, AreFoundHalfARadiusBeyondTheCurvesEnd)
{
  const Curve  line = SampleCurve([](double t) { return Spacing3{ 25.5 + 50 * t, 24.2, 23.7 }; }, 200);
  const auto   shape = Tube(line, 12, { 100, 48, 48 });
  GraphBuilder builder;
  const double before = 9.5;
  builder.Line({ 25.5 + before, 24.2, 23.7 }, { 75.5, 24.2, 23.7 }, 12);
  SkeletonGraph graph = builder.Graph();
  graph.medial = graph.positions;
  EXPECT_EQ(PlaceTips(graph, shape, GridFromOrigin({ 1, 1, 1 })), 2U);
  EXPECT_NEAR(graph.BranchLength(0), 50, 0.5);
}

TEST(BranchTips, StayWhereAFlangeWouldPutThemOutsideTheShape)
{
  // A rod along x with a disc on its end.
  const VoxelShape shape = ShapeWhere({ 60, 30, 30 }, [](int x, int y, int z) {
    const double off = std::hypot(y + 0.5 - 15, z + 0.5 - 15);
    return (x >= 10 && x < 50 && off <= 4) || (x >= 47 && x < 50 && off <= 8);
  });
  GraphBuilder     builder;
  builder.Line({ 14, 15, 15 }, { 48, 15, 15 }, 4);
  SkeletonGraph graph = builder.Graph();
  graph.medial = graph.positions;
  EXPECT_EQ(PlaceTips(graph, shape, GridFromOrigin({ 1, 1, 1 })), 1U);
  double greatest = 0;
  for (const Spacing3 & place : graph.positions)
  {
    greatest = std::max(greatest, place[0]);
  }
  EXPECT_EQ(greatest, 48);
}

TEST(BranchTips, OfAThickStemAndOfAStubOnItLieAtTheCentresOfTheirCaps)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << "\n";
  std::mt19937_64                        random(seed);
  std::uniform_real_distribution<double> part(0, 1);
  const double                           radius = 11;
  const double                           side = 96;
  double                                 squares = 0;
  double                                 ofStubs = 0;
  int                                    bodies = 0;
  for (int k = 0; k < 8; ++k)
  {
    const Curve    stem = AnyLine(64, side, { 1, 1, 1 }, random);
    const Spacing3 foot =
      stem[static_cast<std::size_t>((0.35 + 0.3 * part(random)) * static_cast<double>(stem.size()))];
    const Spacing3 other = AnyDirection(random);
    Spacing3       out{}; // across the stem
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::size_t i = (axis + 1) % 3;
      const std::size_t j = (axis + 2) % 3;
      out[axis] = other[i] * (stem.back()[j] - stem.front()[j]) - other[j] * (stem.back()[i] - stem.front()[i]);
    }
    const double length = Distance(out, { 0, 0, 0 });
    const Curve  branch = SampleCurve(
      [&](double t) {
        const double far = 20 * t / length;
        return Spacing3{ foot[0] + far * out[0], foot[1] + far * out[1], foot[2] + far * out[2] };
      },
      80);
    const VoxelShape thick = Tube(stem, radius, { side, side, side });
    const VoxelShape thin = Tube(branch, 2.3, { side, side, side });
    const auto       n = static_cast<std::int32_t>(side);
    const auto       placed = PlaceTipsOf(
      ShapeWhere({ n, n, n }, [&](int x, int y, int z) { return thick.Contains(x, y, z) || thin.Contains(x, y, z); }));
    if (placed.after.BranchCount() != 3)
    {
      continue;
    }
    ++bodies;
    const auto off = [&](const Spacing3 & end) {
      double nearest = side;
      for (const ElementIndex point : placed.after.nodePoints)
      {
        nearest = std::min(nearest, Distance(placed.after.positions[point], end));
      }
      return nearest;
    };
    squares += std::pow(off(stem.front()), 2) + std::pow(off(stem.back()), 2);
    ofStubs += std::pow(off(branch.back()), 2);
  }
  std::cout << std::sqrt(squares / (2 * bodies)) << " voxels off, stubs " << std::sqrt(ofStubs / bodies) << ", "
            << bodies << " bodies\n";
  EXPECT_GE(bodies, 6) << "seed " << seed;
  EXPECT_LT(std::sqrt(squares / (2 * bodies)), 0.38) << "voxels, seed " << seed;
  EXPECT_LT(std::sqrt(ofStubs / bodies), 0.45) << "voxels, seed " << seed;
}

// A body is followed through a joint where thin branches leave it. A branch that the joint's ball holds altogether may
// be anything, so that the body is not followed there.
TEST(BranchTips, AreNotPlacedBeyondAJointWithABranchWithinItsBall)
{
  const Spacing3 joint{ 29.5, 20.2, 19.7 };
  const Curve    line = SampleCurve([](double t) { return Spacing3{ 15.5 + 50 * t, 20.2, 19.7 }; }, 200);
  const auto     shape = Tube(line, 8, { 80, 40, 40 });
  const auto     tipPlaced = [&](bool within) {
    GraphBuilder builder;
    builder.Line({ 17.5, 20.2, 19.7 }, joint, 8);
    builder.Line(joint, { 64.5, 20.2, 19.7 }, 8);
    builder.Line(joint, { 29.5, 38.2, 19.7 }, 1); // thin
    if (within)
    {
      builder.Line(joint, { 29.5, 20.2, 16.7 }, 1);
    }
    SkeletonGraph graph = builder.Graph();
    graph.medial = graph.positions;
    PlaceTips(graph, shape, GridFromOrigin({ 1, 1, 1 }));
    double least = 80;
    for (const Spacing3 & place : graph.positions)
    {
      least = std::min(least, place[0]);
    }
    return least;
  };
  EXPECT_NEAR(tipPlaced(false), 15.5, 0.6);
  EXPECT_EQ(tipPlaced(true), 17.5);
}

TEST(BranchTips, OfAFlatEndLieHalfAVoxelBeforeIt)
{
  // A rod along x from 10 to 70 of radius 6: its ends are planes of the grid.
  const VoxelShape shape = ShapeWhere({ 80, 20, 20 }, [](int x, int y, int z) {
    return x >= 10 && x < 70 && Distance({ 0, y + 0.5, z + 0.5 }, { 0, 10.1, 9.8 }) <= 6;
  });
  const auto       placed = PlaceTipsOf(shape);
  ASSERT_EQ(placed.after.BranchCount(), 1U);
  EXPECT_NEAR(placed.after.BranchLength(0), 60 - 1, 0.3);
}

TEST(BranchTips, OfTubesThatWidenOrNarrowTowardsRoundEndsLieInTheMiddleOfTheirEnds)
{
  for (const double slope : { -0.25, 0.25 })
  {
    for (const double from : { 20.0, 38.0 }) // the whole way, or its end alone
    {
      // Along x from 20 to 50.
      const double     thick = slope > 0 ? 4 : 11.5 + slope * (from - 20);
      const auto       radiusAt = [&](double x) { return thick + slope * std::max(0.0, std::min(x, 50.0) - from); };
      const VoxelShape shape = ShapeWhere({ 70, 40, 40 }, [&](int x, int y, int z) {
        const double along = x + 0.5;
        const double beyond = std::max({ 0.0, 20 - along, along - 50 });
        return std::hypot(beyond, y + 0.5 - 20.2, z + 0.5 - 19.7) <= radiusAt(along);
      });
      const auto       placed = PlaceTipsOf(shape);
      ASSERT_EQ(placed.after.BranchCount(), 1U);
      double most = 0;
      for (const Spacing3 & place : placed.after.positions)
      {
        most = std::max(most, place[0]);
      }
      EXPECT_NEAR(most, 50, 0.6) << "slope " << slope << " from " << from;
    }
  }
}

TEST(BranchTips, WhereThereIsNoTubeStay)
{
  // Flat: three times as wide as it is thick.
  const VoxelShape flat = ShapeWhere({ 60, 40, 20 }, [](int x, int y, int z) {
    const double end = std::max(0.0, std::abs(x + 0.5 - 30) - 14);
    return std::pow((y + 0.5 - 20) / 12, 2) + std::pow((z + 0.5 - 10) / 4, 2) + std::pow(end / 12, 2) < 1;
  });
  SkeletonGraph    graph = GraphOfSurface(SurfaceOf(flat));
  ASSERT_GT(graph.BranchCount(), 0U);
  const SkeletonGraph before = graph;
  EXPECT_EQ(PlaceTips(graph, flat, GridFromOrigin({ 1, 1, 1 })), 0U);
  EXPECT_EQ(graph.positions, before.positions);
}

// The place itself is told by volume; how far it is off says only whether it can be the branch's end.
TEST(BranchTips, OfCurvesThatEndShortOfTheirCapsGoOnToThem)
{
  const VoxelShape tube = Tube(SampleCurve(
                                 [](double t) {
                                   return Spacing3{ 10, 10, 10 + 40 * t };
                                 },
                                 200),
                               2.6,
                               { 20, 20, 60 });
  const auto       tipOf = [&](double shortBy) {
    GraphBuilder builder;
    builder.Line({ 10, 10, 10 + shortBy }, { 10, 10, 50 }, 2.5);
    SkeletonGraph graph = builder.Graph();
    graph.medial = graph.positions;
    PlaceTips(graph, tube, GridFromOrigin({ 1, 1, 1 }));
    double least = 60;
    for (const ElementIndex point : graph.nodePoints)
    {
      least = std::min(least, graph.positions[point][2]);
    }
    return least;
  };
  EXPECT_NEAR(tipOf(1), 10, 0.3);
  EXPECT_NEAR(tipOf(5.5), 10, 0.3);
  EXPECT_DOUBLE_EQ(tipOf(9), 19) << "some other end";
}

} // namespace

} // namespace voxelcore::testing
