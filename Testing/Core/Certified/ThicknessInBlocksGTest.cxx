#include "CertifiedFixtures.h"

#include "VoxelCoreTesting/Shapes.h"
#include "VoxelCoreTesting/Threads.h"
#include "voxelcore/Certified/ThicknessInBlocks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voxelcore
{
namespace
{

using testing::Random;
using testing::ShapeWhere;

constexpr std::array<Vector3, 4> kSpacings{ { { 1, 1, 1 }, { 1, 1, 2.5 }, { 2, 1, 3 }, { 0.5, 0.5, 0.5 } } };

/** Struts and plates, as waves above a level leave them; with `noise`, single voxels are turned. */
VoxelShape
Porous(std::uint64_t seed, const std::array<std::int32_t, 3> & size, double level, double noise = 0)
{
  Random              random(seed);
  std::vector<double> waves;
  for (int i = 0; i < 24; ++i)
  {
    waves.push_back(2 * random.Unit() - 1);
  }
  return ShapeWhere(size, [&](int x, int y, int z) {
    double sum = 0;
    for (std::size_t i = 0; i < 6; ++i)
    {
      sum += std::sin(0.8 * (waves[4 * i] * x + waves[4 * i + 1] * y + waves[4 * i + 2] * z) + 6 * waves[4 * i + 3]);
    }
    return (sum > level) != (random.Unit() < noise);
  });
}

std::vector<VoxelBox>
Blocks(const VoxelBox & box, const std::array<std::int32_t, 3> & side)
{
  std::vector<VoxelBox> blocks;
  for (std::int32_t z = 0; z < box.size[2]; z += side[2])
  {
    for (std::int32_t y = 0; y < box.size[1]; y += side[1])
    {
      for (std::int32_t x = 0; x < box.size[0]; x += side[0])
      {
        const std::array<std::int32_t, 3> at{ x, y, z };
        VoxelBox                          block;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          block.lower[axis] = box.lower[axis] + at[axis];
          block.size[axis] = std::min(side[axis], box.size[axis] - at[axis]);
        }
        blocks.push_back(block);
      }
    }
  }
  return blocks;
}

ImageGeometry
GridAround(const VoxelShape & shape, const Vector3 & spacing)
{
  ImageGeometry geometry;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    geometry.size[axis] = shape.Box().lower[axis] + shape.Box().size[axis] + 3;
  }
  geometry.spacing = spacing;
  return geometry;
}

CertifiedRequest
MapRequest(const Vector3 & spacing, bool refined)
{
  CertifiedRequest request;
  request.thickness = ThicknessRequest{ .bounds = false, .alone = true };
  request.surface = SurfaceSource(); // nothing is refined
  if (refined)
  {
    request.surface = [spacing](const VoxelShape & shape, const ProgressCallback & progress) {
      return std::shared_ptr<const SurfaceEstimate>(SurfaceFromLabels(shape, spacing, progress));
    };
  }
  return request;
}

/** Balls that end in the first 20 layers of voxels along x. */
std::vector<char>
AtLowX(const PaintingBalls & balls)
{
  std::vector<char> touches;
  for (std::size_t i = 0; i < balls.Count(); ++i)
  {
    touches.push_back(balls.centres[i][0] - balls.radius[i] < 20 ? 1 : 0);
  }
  return touches;
}

void
ExpectTheSame(const VoxelShape &                  shape,
              const Vector3 &                     spacing,
              const std::array<std::int32_t, 3> & side,
              bool                                refined = false)
{
  const ImageGeometry      geometry = GridAround(shape, spacing);
  const CertifiedRequest   request = MapRequest(spacing, refined);
  const CertifiedThickness whole = *ComputeCertified(shape, geometry, request).thickness;
  const BlockedThickness   parts = ThicknessInBlocks(shape, geometry, request, Blocks(shape.Box(), side), AtLowX);
  ASSERT_EQ(parts.map.values, whole.map.values) << "blocks of " << side[0] << ' ' << side[1] << ' ' << side[2];
  const std::vector<char> touches = AtLowX(whole.balls);
  for (std::size_t i = 0; i < whole.owners.values.size(); ++i)
  {
    const std::uint32_t owner = whole.owners.values[i];
    ASSERT_EQ(parts.atBorder[i], owner == 0 ? 0 : touches[owner - 1]);
  }
}

TEST(ThicknessInBlocks, OfTheVoxelsAsTheyAreIsThatOfTheWholeBitForBit)
{
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
  {
    const Vector3 & spacing = kSpacings[seed % kSpacings.size()];
    SCOPED_TRACE("seed " + std::to_string(seed));
    ExpectTheSame(Porous(seed, { 60, 45, 36 }, 1.0), spacing, { 24, 23, 36 });
    ExpectTheSame(Porous(seed, { 36, 40, 30 }, 0.0, 0.01), spacing, { 9, 40, 15 });
  }
}

TEST(ThicknessInBlocks, OfRandomVoxelsIsThatOfTheWholeBitForBit)
{
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
  {
    Random     random(seed);
    const auto density = 0.3 + 0.6 * random.Unit();
    SCOPED_TRACE("seed " + std::to_string(seed));
    ExpectTheSame(ShapeWhere({ 24, 16, 18 }, [&](int, int, int) { return random.Unit() < density; }),
                  kSpacings[seed % kSpacings.size()],
                  { 8, 8, 6 });
  }
}

TEST(ThicknessInBlocks, ABallGreaterThanAnyBlockIsNotCut)
{
  // What is left of a block's first window says nothing of how far the ball reaches.
  const VoxelShape ball =
    ShapeWhere({ 60, 60, 60 }, [](int x, int y, int z) { return std::hypot(x - 29.5, y - 29.5, z - 29.5) < 28; });
  ExpectTheSame(ball, { 1, 1, 1 }, { 10, 60, 60 });
  const ImageGeometry    geometry = GridAround(ball, { 1, 1, 1 });
  const BlockedThickness parts =
    ThicknessInBlocks(ball, geometry, MapRequest({ 1, 1, 1 }, false), Blocks(ball.Box(), { 30, 60, 60 }), AtLowX);
  EXPECT_NEAR(parts.reach, 27.5, 0.6);
}

TEST(ThicknessInBlocks, AreTheSameForEveryNumberOfThreads)
{
  const VoxelShape    shape = Porous(5, { 60, 40, 40 }, 0.5);
  const ImageGeometry geometry = GridAround(shape, { 1, 1, 2.5 });
  for (const bool refined : { false, true })
  {
    const auto blocks = Blocks(shape.Box(), { 30, 40, 20 });
    const auto find = [&](int threads) {
      const testing::Threads limit(threads);
      return ThicknessInBlocks(shape, geometry, MapRequest(geometry.spacing, refined), blocks, AtLowX);
    };
    const BlockedThickness one = find(1);
    const BlockedThickness three = find(3);
    EXPECT_EQ(one.map.values, three.map.values);
    EXPECT_EQ(one.atBorder, three.atBorder);
  }
}

TEST(ThicknessInBlocks, OfTheSmoothSurfaceIsThatOfTheWholeBitForBit)
{
  ExpectTheSame(Porous(1, { 130, 40, 40 }, 0.8), { 1, 1, 1 }, { 26, 40, 40 }, true);
  ExpectTheSame(Porous(2, { 100, 30, 30 }, 0.8), { 1, 1, 2.5 }, { 20, 15, 30 }, true);
}

TEST(ThicknessInBlocks, StopWhenAsked)
{
  const VoxelShape shape = Porous(5, { 40, 30, 30 }, 0.5);
  EXPECT_THROW(ThicknessInBlocks(shape,
                                 GridAround(shape, { 1, 1, 1 }),
                                 MapRequest({ 1, 1, 1 }, false),
                                 Blocks(shape.Box(), { 20, 30, 30 }),
                                 AtLowX,
                                 [](std::string_view stage, double) { return !stage.starts_with("block 2"); }),
               Cancelled);
}

TEST(ThicknessInBlocks, TheFirstGuessIsThatOfAPlateOrABall)
{
  const ImageGeometry geometry = Grid({ 0.5, 0.5, 0.5 });
  EXPECT_DOUBLE_EQ(GuessReach(Box(30, 30, 6), geometry), 0.5 * 4);
  EXPECT_DOUBLE_EQ(GuessReach(Box(1, 1, 1), geometry), 0.5 * 2);
  EXPECT_DOUBLE_EQ(GuessReach(Box(70, 70, 70), geometry), 0.5 * 36);
}

} // namespace
} // namespace voxelcore
