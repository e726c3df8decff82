#include "BruteThickness.h"
#include "VoxelCoreTesting/Threads.h"

#include "voxelcore/Thickness/FineBracket.h"

#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

using testing::Box;
using testing::RandomVolume;
using testing::RandomVolumes;
using testing::ShapeCells;

using Parts = std::array<std::int32_t, 3>;

TEST(FineBracket, PartsAreOddAndTheFewestThatAreShortEnough)
{
  EXPECT_EQ(FineParts({ { 1, 1, 1 }, 1, 0 }, 1), (Parts{ 1, 1, 1 }));
  EXPECT_EQ(FineParts({ { 1, 1, 1 }, 1, 0 }, 0.99), (Parts{ 3, 3, 3 }));
  EXPECT_EQ(FineParts({ { 1, 1, 2 }, 1, 0 }, 0.99), (Parts{ 1, 1, 3 }));
  EXPECT_EQ(FineParts({ { 1, 1, 8 }, 1, 0 }, 1), (Parts{ 1, 1, 5 })) << "8 / 5 is below 2, 8 / 3 is not";
}

TEST(FineBracket, ShapesOfManyBoundaryVerticesAreCutAlongCoarseAxesOnly)
{
  const VoxelShape small = Box({ 9, 9, 9 });
  EXPECT_EQ(PartsForBounds(small, { { 1, 1, 1 }, 1, 0 }), (Parts{ 3, 3, 3 }));
  const VoxelShape large = Box({ 750, 750, 1 });
  EXPECT_EQ(PartsForBounds(large, { { 1, 1, 1 }, 1, 0 }), (Parts{ 1, 1, 1 }));
  EXPECT_EQ(PartsForBounds(large, { { 1, 1, 3 }, 1, 0 }), (Parts{ 1, 1, 3 }));
}

TEST(FineBracket, TheCutShapeIsTheSameShape)
{
  for (const RandomVolume & volume : RandomVolumes(8100, 20))
  {
    SCOPED_TRACE(volume.Describe());
    const Parts      parts{ 3, 1, 5 };
    const VoxelShape cut = CutVoxels(volume.shape, parts);
    const auto &     box = cut.Box();
    EXPECT_EQ(cut.CountVoxels(), 15 * volume.shape.CountVoxels());
    for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
    {
      for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
      {
        for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
        {
          const auto whole = [&](std::int32_t at, std::size_t axis) {
            return volume.shape.Box().lower[axis] + (at - box.lower[axis]) / parts[axis];
          };
          ASSERT_EQ(cut.Contains(x, y, z), volume.shape.Contains(whole(x, 0), whole(y, 1), whole(z, 2)));
        }
      }
    }
    const SpacingWeights weights = ComputeSpacingWeights(volume.spacing);
    const SpacingWeights fine = CutWeights(weights, parts);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double side = static_cast<double>(weights.weight[axis]) * weights.unit;
      EXPECT_NEAR(static_cast<double>(fine.weight[axis]) * fine.unit * parts[axis], side, 1e-12 * side);
    }
  }
}

TEST(FineBracket, WhateverThePartsTheBracketNarrowsAndHoldsWhatBruteForceFinds)
{
  for (const RandomVolume & volume : RandomVolumes(8200, 12))
  {
    SCOPED_TRACE(volume.Describe());
    const ShapeCells          of(volume.shape, volume.spacing);
    const ThicknessBracket    coarse = of.Bracket();
    const std::vector<double> brute = testing::BruteThickness(of);
    for (const Parts & parts : { Parts{ 3, 1, 1 }, Parts{ 1, 5, 3 }, Parts{ 3, 3, 3 } })
    {
      ThicknessBracket bracket = coarse;
      TightenBracket(of.shape, of.weights, parts, bracket);
      for (std::size_t i = 0; i < brute.size(); ++i)
      {
        ASSERT_GE(bracket.lower.values[i], coarse.lower.values[i]);
        ASSERT_LE(bracket.upper.values[i], coarse.upper.values[i]);
        ASSERT_LE(bracket.lower.values[i], bracket.upper.values[i]);
        ASSERT_GE(bracket.upper.values[i], brute[i] * (1 - 1e-6));
      }
    }
  }
}

TEST(FineBracket, IsTheSameForEveryNumberOfThreads)
{
  const RandomVolume volume = RandomVolumes(8300, 1).front();
  const ShapeCells   of(volume.shape, { 1, 1, 2 });
  ThicknessBracket   brackets[2]{ of.Bracket(), of.Bracket() };
  for (const int i : { 0, 1 })
  {
    const testing::Threads threads(1 + 3 * i);
    TightenBracket(of.shape, of.weights, { 3, 3, 3 }, brackets[i]);
  }
  EXPECT_EQ(brackets[0].lower.values, brackets[1].lower.values);
  EXPECT_EQ(brackets[0].upper.values, brackets[1].upper.values);
}

TEST(FineBracket, StopsWhenAsked)
{
  const ShapeCells of(Box({ 8, 8, 8 }), { 1, 1, 1 });
  ThicknessBracket bracket = of.Bracket();
  EXPECT_THROW(
    TightenBracket(of.shape, of.weights, { 3, 3, 3 }, bracket, [](std::string_view, double) { return false; }),
    Cancelled);
}

} // namespace
} // namespace voxelcore
