#include "voxelcore/VoxelCore/ToleranceWeights.h"

#include "VoxelCoreTesting/Cores.h"
#include "VoxelCoreTesting/Threads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <vector>

namespace voxelcore
{
namespace
{

using testing::Spacing3;

std::vector<double>
WeightsOf(const VoxelShape & shape, const Spacing3 & spacing)
{
  return ToleranceWeights(shape, ComputeSpacingWeights(spacing), BoundaryVertices(shape));
}

/** Numbers of a box of voxels, x fastest. */
struct Field
{
  std::array<int, 3>        size;
  std::vector<std::int64_t> values;

  std::int64_t &
  At(int x, int y, int z)
  {
    return values[static_cast<std::size_t>((z * size[1] + y) * size[0] + x)];
  }
  std::int64_t
  AtOrNought(std::array<int, 3> at)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (at[axis] < 0 || at[axis] >= size[axis])
      {
        return 0;
      }
    }
    return At(at[0], at[1], at[2]);
  }
};

/** Runs of `run` voxels from `first` on. */
Field
Summed(Field field, std::size_t axis, int first, int run)
{
  Field sums{ field.size, std::vector<std::int64_t>(field.values.size(), 0) };
  for (int z = 0; z < field.size[2]; ++z)
  {
    for (int y = 0; y < field.size[1]; ++y)
    {
      for (int x = 0; x < field.size[0]; ++x)
      {
        for (int i = first; i < first + run; ++i)
        {
          std::array<int, 3> at{ x, y, z };
          at[axis] += i;
          sums.At(x, y, z) += field.AtOrNought(at);
        }
      }
    }
  }
  return sums;
}

/** As the header says it, run after run. */
std::vector<double>
WeightsByDefinition(const VoxelShape & shape, const Spacing3 & spacing)
{
  const double       thickest = std::max({ spacing[0], spacing[1], spacing[2] });
  const double       thinnest = std::min({ spacing[0], spacing[1], spacing[2] });
  std::array<int, 3> runs{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double q = thickest / spacing[axis];
    runs[axis] = 1;
    while (runs[axis] < kWidestRun && std::pow(2 * runs[axis] + 1, 2) < 6 * q * q - 2 - 1e-6)
    {
      ++runs[axis];
    }
  }
  const auto & box = shape.Box();
  const int    margin = 2 * *std::ranges::max_element(runs) + 2;
  Field        field{ { box.size[0] + 2 * margin, box.size[1] + 2 * margin, box.size[2] + 2 * margin }, {} };
  field.values.assign(static_cast<std::size_t>(field.size[0]) * static_cast<std::size_t>(field.size[1]) *
                        static_cast<std::size_t>(field.size[2]),
                      0);
  for (int z = 0; z < box.size[2]; ++z)
  {
    for (int y = 0; y < box.size[1]; ++y)
    {
      for (int x = 0; x < box.size[0]; ++x)
      {
        field.At(x + margin, y + margin, z + margin) =
          shape.Contains(box.lower[0] + x, box.lower[1] + y, box.lower[2] + z) ? 1 : 0;
      }
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // A run that begins at a voxel and one that ends there: together they lie about it.
    field = Summed(Summed(std::move(field), axis, 0, runs[axis]), axis, 1 - runs[axis], runs[axis]);
  }
  std::vector<double> weights;
  for (const LatticePoint & p : BoundaryVertices(shape))
  {
    const std::array<int, 3> corner{ p.x - box.lower[0] + margin,
                                     p.y - box.lower[1] + margin,
                                     p.z - box.lower[2] + margin };
    std::array<double, 3>    gradient{};
    for (int side = 0; side < 8; ++side)
    {
      const std::array<int, 3> way{ side & 1, side >> 1 & 1, side >> 2 };
      const auto               value =
        static_cast<double>(field.At(corner[0] - 1 + way[0], corner[1] - 1 + way[1], corner[2] - 1 + way[2]));
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        gradient[axis] += way[axis] == 1 ? value : -value;
      }
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      gradient[axis] /= spacing[axis]; // after whole numbers have cancelled
    }
    const double length = std::hypot(gradient[0], gradient[1], gradient[2]);
    const double extent =
      (std::abs(gradient[0]) * spacing[0] + std::abs(gradient[1]) * spacing[1] + std::abs(gradient[2]) * spacing[2]) /
      length;
    const double diagonal = std::hypot(spacing[0], spacing[1], spacing[2]);
    weights.push_back(length == 0 ? 1 : diagonal / std::max(std::sqrt(3.0) * thinnest, extent));
  }
  return weights;
}

TEST(ToleranceWeights, AreNotThereForCubes)
{
  EXPECT_TRUE(WeightsOf(testing::Ellipsoid(12), { 0.7, 0.7, 0.7 }).empty());
}

TEST(ToleranceWeights, AreWhatTheirDefinitionSays)
{
  std::cout << "seeds from 700\n";
  std::size_t smaller = 0;
  for (std::uint64_t seed = 700; seed < 730; ++seed)
  {
    auto volume = testing::MakeRandomVolume(seed, 3, seed % 3 == 0 ? 70 : 12);
    if (seed % 3 == 0) // rows of several words
    {
      testing::Random random(seed);
      volume.shape = testing::RandomShape(random, { 70, 7, 5 }, volume.density);
    }
    volume.spacing = testing::TestSpacings()[1 + seed % 4];
    SCOPED_TRACE(volume.Describe());
    const std::vector<double> expected = WeightsByDefinition(volume.shape, volume.spacing);
    const std::vector<double> found = WeightsOf(volume.shape, volume.spacing);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      ASSERT_NEAR(found[i], std::max(expected[i], 1.0), 1e-9) << i;
      smaller += found[i] > 1.1 ? 1 : 0;
    }
  }
  EXPECT_GT(smaller, 1000U);
}

TEST(ToleranceWeights, OfWallsAlongTheGridAreTheSidesOfAVoxel)
{
  const Spacing3   spacing{ 1, 2, 5 };
  const VoxelShape box = testing::Box({ 60, 40, 20 });
  const auto       points = BoundaryVertices(box);
  const auto       weights = WeightsOf(box, spacing);
  const double     diagonal = std::sqrt(30.0);
  const auto       at = [&](const LatticePoint & p) {
    return weights[static_cast<std::size_t>(std::ranges::find(points, p) - points.begin())];
  };
  EXPECT_NEAR(at({ 0, 20, 10 }), diagonal / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(at({ 30, 40, 10 }), diagonal / 2, 1e-12);
  EXPECT_NEAR(at({ 30, 20, 0 }), diagonal / 5, 1e-12);
}

// Terraces of thick slices must not be taken for walls along and across them.
TEST(ToleranceWeights, OfObliqueWallsFollowTheWallNotItsTerraces)
{
  const Spacing3 spacing{ 1, 1, 4 };
  const double   diagonal = std::sqrt(18.0);
  for (const double degrees : { 10.0, 25.0, 45.0, 60.0, 80.0 })
  {
    const double     turn = degrees * 3.14159265358979 / 180;
    const Spacing3   normal{ std::sin(turn) * 0.8, std::sin(turn) * 0.6, std::cos(turn) };
    const VoxelShape shape = testing::ShapeWhere({ 60, 60, 15 }, [&](int x, int y, int z) {
      return normal[0] * (x - 29.5) + normal[1] * (y - 29.5) + normal[2] * 4 * (z - 7) < 0.13;
    });
    const double     expected = diagonal / std::max(std::sqrt(3.0), normal[0] + normal[1] + 4 * normal[2]);
    const auto       points = BoundaryVertices(shape);
    const auto       weights = WeightsOf(shape, spacing);
    double           worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const LatticePoint & p = points[i];
      if (std::abs(p.x - 30) < 15 && std::abs(p.y - 30) < 15 && std::abs(p.z - 7) < 4)
      {
        worst = std::max(worst, std::abs(weights[i] / expected - 1));
      }
    }
    EXPECT_GT(worst, 0) << degrees;
    EXPECT_LT(worst, 0.2) << degrees;
  }
}

TEST(ToleranceWeights, AreTheSameWhereverTheShapeLiesAndForAnyNumberOfThreads)
{
  const VoxelShape small = testing::Ellipsoid(40);
  const Spacing3   spacing{ 0.5, 0.5, 2.2 };
  VoxelShape       padded(VoxelBox{ { -70, 11, -5 }, { 200, 90, 80 } });
  for (std::int32_t z = 0; z < 40; ++z)
  {
    for (std::int32_t y = 0; y < 40; ++y)
    {
      for (std::int32_t x = 0; x < 40; ++x)
      {
        if (small.Contains(x, y, z))
        {
          padded.Insert(x - 9, y + 33, z + 7);
        }
      }
    }
  }
  const auto             expected = WeightsOf(CropToVoxels(small), spacing);
  const testing::Threads threads(3);
  ASSERT_GT(expected.size(), 1000U);
  EXPECT_EQ(WeightsOf(padded, spacing), expected);
  EXPECT_EQ(WeightsOf(CropToVoxels(padded), spacing), expected);
}

// A slice that hangs in the air alike on both sides.
TEST(ToleranceWeights, WithoutADirectionAreOne)
{
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 2, 2, 2 } });
  shape.Insert(0, 0, 0);
  shape.Insert(1, 1, 0);
  shape.Insert(0, 1, 1);
  shape.Insert(1, 0, 1);
  const auto points = BoundaryVertices(shape);
  const auto weights = WeightsOf(shape, { 1, 1, 1.25 });
  EXPECT_EQ(weights[static_cast<std::size_t>(std::ranges::find(points, LatticePoint{ 1, 1, 1 }) - points.begin())],
            1.0);
}

} // namespace
} // namespace voxelcore
