// Pieces of torn rods against what was there before they were torn.

#include "voxelcore/Masks/TornPieces.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>

namespace voxelcore::testing
{
namespace
{

using Place = std::array<double, 3>;

/** Voxels of 1 x 1 x `slice` mm whose centres are in, of 60 x 40 x 60 mm. */
VoxelShape
ShapeOf(double slice, const std::function<bool(const Place &)> & isIn)
{
  const std::int32_t depth = static_cast<std::int32_t>(60 / slice);
  VoxelShape         shape({ { 3, -5, 7 }, { 60, 40, depth } });
  for (std::int32_t z = 0; z < depth; ++z)
  {
    for (std::int32_t y = 0; y < 40; ++y)
    {
      for (std::int32_t x = 0; x < 60; ++x)
      {
        if (isIn({ x + 0.5, y + 0.5, (z + 0.5) * slice }))
        {
          shape.Insert(3 + x, -5 + y, 7 + z);
        }
      }
    }
  }
  return shape;
}

bool
IsInStem(const Place & p)
{
  return std::hypot(p[0] - 10, p[1] - 20) <= 5;
}

/** A lateral of radius 1.5 that leaves the stem at half its height, rising or falling, whole but for a gap. */
bool
IsInLateral(const Place & p, double slope, double from, double to)
{
  const double along = p[0] - 10;
  const double across = std::hypot(p[1] - 20, p[2] - 30 - slope * along) / std::hypot(1, slope);
  return along > 0 && across <= 1.5 && (along < from || along > to) && p[0] < 50;
}

std::int64_t
PiecesOf(const VoxelShape & shape)
{
  return ComputeShapeTopology(shape).betti[0];
}

} // namespace

TEST(TornPieces, ALateralTornAnywhereIsWholeAgainAndNothingElseIsChanged)
{
  for (const double slice : { 1.0, 2.0 })
  {
    for (const double slope : { 0.0, 0.4, -0.7 })
    {
      for (const double from : { 5.0, 14.0, 24.0 })
      {
        SCOPED_TRACE(::testing::Message() << slice << " " << slope << " " << from);
        const auto shape =
          ShapeOf(slice, [&](const Place & p) { return IsInStem(p) || IsInLateral(p, slope, from, from + 4); });
        const TornPieces joined = JoinTornPieces(shape, { 1, 1, slice }, 2);
        ASSERT_GT(PiecesOf(shape), 1);
        EXPECT_EQ(PiecesOf(joined.shape), 1);
        EXPECT_EQ(joined.piecesJoined, static_cast<std::uint64_t>(PiecesOf(shape) - 1));
        EXPECT_EQ(joined.shape.CountVoxels(), shape.CountVoxels() + joined.voxelsAdded);
        EXPECT_LE(joined.voxelsAdded, 12U);
      }
    }
  }
}

TEST(TornPieces, WhatIsFarOrRoundOrBesideOrSmallStaysApart)
{
  const auto joined = [](const std::function<bool(const Place &)> & isIn) {
    return JoinTornPieces(ShapeOf(1, isIn), { 1, 1, 1 }, 2).piecesJoined;
  };
  const auto with = [&](const std::function<bool(const Place &)> & isIn) {
    return joined([&](const Place & p) { return IsInStem(p) || isIn(p); });
  };
  EXPECT_EQ(with([](const Place & p) { return IsInLateral(p, 0, 0, 9); }), 1U);
  EXPECT_EQ(with([](const Place & p) { return IsInLateral(p, 0, 0, 15); }), 0U) << "far";
  EXPECT_EQ(with([](const Place & p) { return std::hypot(p[0] - 19, p[1] - 20, p[2] - 30) <= 2; }), 0U) << "round";
  EXPECT_EQ(joined([](const Place & p) {
              return (IsInStem(p) && std::abs(p[2] - 30) < 8) ||
                     (std::hypot(p[0] - 19, p[1] - 20) <= 1.5 && std::abs(p[2] - 30) < 14);
            }),
            0U)
    << "beside the stem, with ends that lead away from it";
  EXPECT_EQ(
    with([](const Place & p) { return p[0] > 17 && p[0] < 21 && p[1] > 20 && p[1] < 21 && p[2] > 30 && p[2] < 31; }),
    0U)
    << "a speck";
}

TEST(TornPieces, APieceIsJoinedOnceAndByItsNearerEnd)
{
  // A rod between two plates: 2 mm from one, 4 from the other, and the plates hang together already.
  const auto       plates = [](const Place & p) { return p[0] < 10 || p[0] > 40 || (p[1] < 5 && p[0] <= 40); };
  const VoxelShape shape = ShapeOf(1, [&](const Place & p) {
    return plates(p) || (std::hypot(p[1] - 20, p[2] - 30) <= 1.5 && p[0] > 12 && p[0] < 36);
  });
  const TornPieces joined = JoinTornPieces(shape, { 1, 1, 1 }, 2);
  EXPECT_EQ(joined.piecesJoined, 1U);
  const TopologyNumbers numbers = ComputeShapeTopology(joined.shape);
  EXPECT_EQ(numbers.betti[0], 1);
  EXPECT_EQ(numbers.betti[1], 0);
}

TEST(TornPieces, SeveralPiecesInARowBecomeOne)
{
  const VoxelShape shape = ShapeOf(1, [](const Place & p) {
    return IsInStem(p) || (IsInLateral(p, 0.2, 5, 8) && (p[0] < 26 || p[0] > 29) && (p[0] < 38 || p[0] > 41));
  });
  const TornPieces joined = JoinTornPieces(shape, { 1, 1, 1 }, 2);
  EXPECT_EQ(joined.piecesJoined, 3U);
  EXPECT_EQ(PiecesOf(joined.shape), 1);
}

TEST(TornPieces, NothingAndOnePieceAreLeftAlone)
{
  EXPECT_EQ(JoinTornPieces(VoxelShape(), { 1, 1, 1 }, 2).shape.CountVoxels(), 0U);
  const VoxelShape stem = ShapeOf(1, IsInStem);
  const TornPieces same = JoinTornPieces(stem, { 1, 1, 1 }, 2);
  EXPECT_EQ(same.shape.CountVoxels(), stem.CountVoxels());
  EXPECT_EQ(same.piecesJoined, 0U);
}

} // namespace voxelcore::testing
