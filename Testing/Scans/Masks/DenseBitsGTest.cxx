// Bits without bricks against what bricks give.

#include "Core/Shape/FloodFill.h"

#include "DenseBits.h"

#include "voxelcore/Masks/SliceHoles.h"

#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

/** Both in the same box, and the same voxels. */
void
ExpectSame(const VoxelShape & shape, const VoxelShape & expected)
{
  ASSERT_EQ(shape.Box().lower, expected.Box().lower);
  ASSERT_EQ(shape.Box().size, expected.Box().size);
  EXPECT_EQ(VoxelsOf(shape), VoxelsOf(expected));
}

void
ExpectTheHolesOfAllSlices(const VoxelShape & shape)
{
  VoxelShape expected(shape.Box());
  for (const SliceAxis axis : { SliceAxis::I, SliceAxis::J, SliceAxis::K })
  {
    std::uint64_t    count = 0;
    const VoxelShape holes = FindSliceHoles(shape, axis, count);
    for (std::int32_t z = 0; z < shape.Box().size[2]; ++z)
    {
      for (std::int32_t y = 0; y < shape.Box().size[1]; ++y)
      {
        for (std::size_t word = 0; word < shape.WordsPerRow(); ++word)
        {
          expected.Row(y, z)[word] |= holes.Row(y, z)[word];
        }
      }
    }
  }
  const DenseBits holes = HolesOfAllSlices(DenseBits(shape, { 0, 0, 0 }));
  ExpectSame(holes.ToShape(), expected);
  EXPECT_EQ(holes.Count(), expected.CountVoxels());
}

TEST(DenseBits, HaveTheHolesThatSlicesHave)
{
  for (const RandomVolume & volume : RandomVolumes(11, 30))
  {
    SCOPED_TRACE(volume.Describe());
    ExpectTheHolesOfAllSlices(volume.shape);
  }
  Random random(5);
  for (const std::array<std::int32_t, 3> & size :
       { std::array{ 130, 67, 9 }, std::array{ 9, 67, 130 }, std::array{ 64, 20, 20 }, std::array{ 128, 30, 30 } })
  {
    for (const double density : { 0.3, 0.55, 0.7 })
    {
      ExpectTheHolesOfAllSlices(RandomShape(random, size, density));
    }
  }
}

TEST(DenseBits, FollowASpiralToItsEnd)
{
  // A wall that winds inwards: the background reaches the middle only by all of its turns.
  const auto spiral = [](std::int32_t closed) {
    return ShapeWhere({ 66, 66, 3 }, [closed](int x, int y, int) {
      const int  u = x - 33;
      const int  v = y - 33;
      const int  ring = std::max(std::abs(u), std::abs(v));
      const bool gate = u == ring && v == ring - 1; // lets through to the next ring
      return ring % 2 == 0 && (!gate || ring == closed);
    });
  };
  ExpectTheHolesOfAllSlices(spiral(-1));
  ExpectTheHolesOfAllSlices(spiral(30));
}

TEST(DenseBits, AreDilatedByBalls)
{
  for (const RandomVolume & volume : RandomVolumes(12, 40))
  {
    SCOPED_TRACE(volume.Describe());
    for (const LatticeBall & ball : { LatticeBall{ { 1, 1, 1 }, 0 },
                                      LatticeBall{ { 1, 1, 1 }, 4 },
                                      LatticeBall{ { 1, 2, 3 }, 30 },
                                      LatticeBall{ { 3, 1, 2 }, 17 } })
    {
      const BallRows  rows(ball);
      const DenseBits bits = DilatedBits(volume.shape, rows);
      const auto &    box = bits.Box();
      std::size_t     missed = 0;
      const auto      isNear = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
        for (std::int32_t k = -rows.reach[2]; k <= rows.reach[2]; ++k)
        {
          for (std::int32_t j = -rows.reach[1]; j <= rows.reach[1]; ++j)
          {
            for (std::int32_t i = -rows.reach[0]; i <= rows.reach[0]; ++i)
            {
              const auto squared = ball.weight[0] * ball.weight[0] * i * i + ball.weight[1] * ball.weight[1] * j * j +
                                   ball.weight[2] * ball.weight[2] * k * k;
              if (squared <= ball.squaredRadius && volume.shape.Contains(x + i, y + j, z + k))
              {
                return true;
              }
            }
          }
        }
        return false;
      };
      for (std::int32_t z = 0; z < box.size[2]; ++z)
      {
        for (std::int32_t y = 0; y < box.size[1]; ++y)
        {
          for (std::int32_t x = 0; x < box.size[0]; ++x)
          {
            const bool isIn = (bits.Row(y, z)[x / 64] >> (x % 64) & 1U) != 0;
            missed += isIn != isNear(box.lower[0] + x, box.lower[1] + y, box.lower[2] + z) ? 1 : 0;
          }
        }
      }
      EXPECT_EQ(missed, 0U);
    }
  }
}

} // namespace
} // namespace voxelcore::testing
