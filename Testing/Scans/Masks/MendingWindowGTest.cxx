#include "MendingWindow.h"

#include "VoxelCoreTesting/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <deque>
#include <set>

namespace voxelcore::testing
{
namespace
{

Voxel
InPiece(const Voxel & centre, Neighbourhood piece)
{
  const std::int32_t bit = std::countr_zero(piece);
  return { centre[0] + bit % 3 - 1, centre[1] + bit / 3 % 3 - 1, centre[2] + bit / 9 - 1 };
}

/** The same voxel by voxel, in a list of those reached. */
bool
HangTogetherByFlood(const PaddedShape & shape, const Voxel & centre, const Pieces & pieces, bool background)
{
  const auto isIn = [&](const Voxel & at) {
    bool isInRoom = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (std::abs(at[axis] - centre[axis]) > 10)
      {
        return false;
      }
      isInRoom = isInRoom && at[axis] >= 0 && at[axis] < shape.Size()[axis];
    }
    return at != centre && (isInRoom && shape.Contains(at)) != background;
  };
  std::set<Voxel>   reached{ InPiece(centre, pieces.sets[0]) };
  std::deque<Voxel> queue(reached.begin(), reached.end());
  for (; !queue.empty(); queue.pop_front())
  {
    const Voxel from = queue.front();
    for (std::int32_t i = 0; i < 27; ++i)
    {
      const Voxel step{ i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1 };
      const Voxel next{ from[0] + step[0], from[1] + step[1], from[2] + step[2] };
      const bool  touches = background || std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]) == 1;
      if (touches && isIn(next) && reached.insert(next).second)
      {
        queue.push_back(next);
      }
    }
  }
  return std::all_of(pieces.sets.begin(),
                     pieces.sets.begin() + static_cast<std::ptrdiff_t>(pieces.count),
                     [&](Neighbourhood piece) { return reached.count(InPiece(centre, piece)) != 0; });
}

TEST(MendingWindow, SaysWhatAFloodVoxelByVoxelSays)
{
  Random random(20251);
  // Of the shape, of the background: met in the small window, ended in it, met beyond it, not met beyond it.
  std::array<std::array<std::size_t, 4>, 2> cases{};
  for (const double share : { 0.08, 0.25, 0.35, 0.5, 0.65, 0.75, 0.85, 0.94 })
  {
    VoxelShape voxels(VoxelBox{ { 0, 0, 0 }, { 24, 26, 23 } });
    for (std::int32_t i = 0; i < 24 * 26 * 23; ++i)
    {
      if (random.Chance(share))
      {
        voxels.Insert(i % 24, i / 24 % 26, i / (24 * 26));
      }
    }
    const PaddedShape shape(voxels);
    for (std::size_t trial = 0; trial < 400; ++trial)
    {
      Voxel centre{};
      for (std::size_t axis = 0; axis < 3; ++axis)
      {

        centre[axis] = static_cast<std::int32_t>(random.Between(1, shape.Size()[axis] - 2));
      }
      const bool   background = trial % 2 != 0;
      const auto   around = shape.Around(centre);
      const Pieces pieces = background ? BackgroundPieces(around) : ShapePieces(around);
      if (pieces.count < 2)
      {
        continue;
      }
      const bool expected = HangTogetherByFlood(shape, centre, pieces, background);
      ASSERT_EQ(HangTogether(shape, centre, pieces, background), expected) << share << ", " << trial;
      const auto near = NearWindow(shape, centre, background).Connects(pieces);
      ++cases[background ? 1 : 0][(near ? 0 : 2) + (expected ? 0 : 1)];
    }
  }
  for (const auto & of : cases)
  {
    for (const std::size_t count : of)
    {
      EXPECT_GT(count, 0U);
    }
  }
}

} // namespace
} // namespace voxelcore::testing
