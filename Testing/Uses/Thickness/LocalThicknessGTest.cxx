#include "BruteThickness.h"
#include "voxelcore/Thickness/FineBracket.h"
#include "VoxelCoreTesting/Threads.h"

#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

using testing::Box;
using testing::BruteThickness;
using testing::MakeRandomVolume;
using testing::PaintByBrute;
using testing::Random;
using testing::RandomVolume;
using testing::RandomVolumes;
using testing::ShapeCells;
using testing::ShapeWhere;
using testing::Spacing3;
using testing::VoxelCentres;

/** Blurred noise cut so that about half is in: smooth walls and necks of a few voxels. */
VoxelShape
SmoothShape(std::uint64_t seed, std::int32_t n)
{
  Random              random(seed);
  std::vector<double> waves;
  for (int i = 0; i < 24; ++i)
  {
    waves.push_back(2 * random.Unit() - 1);
  }
  return ShapeWhere({ n, n, n }, [&](int x, int y, int z) {
    double sum = 0;
    for (std::size_t i = 0; i < 6; ++i)
    {
      sum += std::sin(0.9 * (waves[4 * i] * x + waves[4 * i + 1] * y + waves[4 * i + 2] * z) + 6 * waves[4 * i + 3]);
    }
    return sum > 0;
  });
}

struct Widths
{
  double        sum = 0;
  double        greatest = 0;
  double        above = 0; ///< of the upper bound above what brute force found
  std::uint64_t voxels = 0;

  double
  Mean() const
  {
    return sum / static_cast<double>(voxels);
  }
};

constexpr std::array<std::int32_t, 3> kWhole{ 1, 1, 1 };

void
ExpectWithin(const ShapeCells & of, Widths & widths)
{
  ThicknessBracket bracket = of.Bracket();
  if (const auto parts = PartsForBounds(of.shape, of.weights); parts != kWhole)
  {
    TightenBracket(of.shape, of.weights, parts, bracket);
  }
  const std::vector<double> brute = BruteThickness(of);
  ASSERT_EQ(bracket.lower.values.size(), brute.size());
  ASSERT_EQ(bracket.upper.values.size(), brute.size());
  // The side of a cube of a voxel's volume.
  const double voxel =
    of.weights.unit *
    std::cbrt(static_cast<double>(of.weights.weight[0] * of.weights.weight[1] * of.weights.weight[2]));
  const std::vector<Vector3> centres = VoxelCentres(of.shape);
  for (std::size_t i = 0; i < brute.size(); ++i)
  {
    ASSERT_GE(bracket.upper.values[i], brute[i] * (1 - 1e-6))
      << centres[i][0] << ' ' << centres[i][1] << ' ' << centres[i][2];
    ASSERT_LE(bracket.lower.values[i], bracket.upper.values[i]);
    ASSERT_GT(bracket.lower.values[i], 0);
    const double width = (bracket.upper.values[i] - bracket.lower.values[i]) / voxel;
    widths.sum += width;
    widths.above += (bracket.upper.values[i] - brute[i]) / voxel;
    widths.greatest = std::max(widths.greatest, width);
    ++widths.voxels;
  }
}

void
Print(const char * what, const Widths & widths)
{
  std::cout << what << ": width of the bracket in voxels, mean " << widths.Mean() << ", of that above brute force "
            << widths.above / static_cast<double>(widths.voxels) << ", greatest " << widths.greatest << " of "
            << widths.voxels << " voxels\n";
}

void
CheckRandomShapes(std::uint64_t firstSeed, int count)
{
  Widths cubes;
  Widths others;
  for (const RandomVolume & volume : RandomVolumes(firstSeed, count))
  {
    SCOPED_TRACE(volume.Describe());
    ExpectWithin(ShapeCells(volume.shape, volume.spacing), volume.spacing[0] == volume.spacing[2] ? cubes : others);
    if (::testing::Test::HasFatalFailure())
    {
      return;
    }
  }
  Print("random, cubes", cubes);
  Print("random, others", others);
  EXPECT_LT(cubes.Mean(), 0.25);
  EXPECT_LT(others.Mean(), 0.25);
}

void
CheckSmoothShapes(std::uint64_t count, std::int32_t n)
{
  for (const Spacing3 & spacing : testing::TestSpacings())
  {
    Widths widths;
    for (std::uint64_t seed = 1; seed <= count; ++seed)
    {
      SCOPED_TRACE(seed);
      ExpectWithin(ShapeCells(SmoothShape(7400 + seed, n), spacing), widths);
      if (::testing::Test::HasFatalFailure())
      {
        return;
      }
    }
    Print("smooth", widths);
    EXPECT_LT(widths.Mean(), 0.25);
  }
}

TEST(LocalThickness, OfRandomShapesLiesInItsBracket)
{
  CheckRandomShapes(7300, 60);
}

TEST(LocalThickness, OfSmoothShapesLiesInItsBracket)
{
  CheckSmoothShapes(1, 12);
}

TEST(HeavyLocalThickness, OfManyRandomShapesLiesInItsBracket)
{
  CheckRandomShapes(7700, 300);
}

TEST(HeavyLocalThickness, OfManySmoothShapesLiesInItsBracket)
{
  CheckSmoothShapes(7, 16);
}

TEST(HeavyLocalThickness, OfSmoothShapesOfManySizesLiesInItsBracket)
{
  for (std::int32_t n = 20; n <= 40; n += 4)
  {
    CheckSmoothShapes(n < 40 ? 7 : 5, n); // 40 in all, with each spacing
  }
}

TEST(LocalThickness, LowerBoundsAreInscribedBalls)
{
  // Of the balls alone: painted one by one.
  for (const RandomVolume & volume : RandomVolumes(7500, 60))
  {
    SCOPED_TRACE(volume.Describe());
    const ShapeCells           of(volume.shape, volume.spacing);
    const ThicknessBalls       balls = FindThicknessBalls(of.shape, of.points, of.cells, of.weights, 0);
    const std::vector<Vector3> centres = VoxelCentres(of.shape);
    std::vector<double>        painted(centres.size(), 0);
    for (std::size_t i = 0; i < balls.inscribed.Count(); ++i)
    {
      PaintByBrute(of,
                   centres,
                   balls.inscribed.centres[i],
                   balls.inscribed.radius[i],
                   2 * balls.inscribed.value[i],
                   painted);
    }
    VoxelValues map = ZeroAtVoxels<float>(of.shape);
    PaintThickness(of.shape, of.weights, balls.inscribed, map);
    for (std::size_t i = 0; i < painted.size(); ++i)
    {
      ASSERT_EQ(map.values[i], static_cast<float>(painted[i]));
    }
    FillWithOwnBalls(of.shape, of.weights, map);
    for (std::size_t i = 0; i < painted.size(); ++i)
    {
      const double own = 2 * testing::BruteDepth(of, centres[i]);
      ASSERT_NEAR(map.values[i], painted[i] > 0 ? painted[i] : own, 1e-6 * own);
    }
  }
}

TEST(LocalThickness, OfASlabIsItsThicknessEverywhere)
{
  for (std::int32_t thick = 1; thick <= 6; ++thick)
  {
    for (const Spacing3 & spacing : testing::TestSpacings())
    {
      const ShapeCells       of(Box({ 40, 40, thick }, { 5, -7, 3 }), spacing);
      const ThicknessBracket bracket = of.Bracket();
      // Far from its sides.
      const std::size_t middle = (static_cast<std::size_t>(thick / 2) * 40 + 20) * 40 + 20;
      EXPECT_FLOAT_EQ(bracket.lower.values[middle], static_cast<float>(thick * spacing[2]));
      EXPECT_NEAR(bracket.upper.values[middle], thick * spacing[2], 0.01 * spacing[2]);
    }
  }
}

TEST(LocalThickness, IsTheSameForEveryNumberOfThreads)
{
  const ShapeCells of(SmoothShape(7600, 40), { 1, 1, 2 });
  ThicknessBracket one;
  {
    const testing::Threads threads(1);
    one = of.Bracket();
  }
  const testing::Threads threads(4);
  const ThicknessBracket four = of.Bracket();
  EXPECT_EQ(one.lower.values, four.lower.values);
  EXPECT_EQ(one.upper.values, four.upper.values);
}

TEST(LocalThickness, StopsWhenAsked)
{
  const ShapeCells of(Box({ 8, 8, 8 }), { 1, 1, 1 });
  EXPECT_THROW(
    BracketThickness(of.shape, of.points, of.cells, of.weights, true, [](std::string_view, double) { return false; }),
    Cancelled);
}

} // namespace
} // namespace voxelcore
