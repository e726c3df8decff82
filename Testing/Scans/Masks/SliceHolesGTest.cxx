// Holes of slices against flood fill in the plane.

#include "Core/Shape/FloodFill.h"

#include "voxelcore/Masks/SliceHoles.h"

#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

constexpr std::array<SliceAxis, 3> kAxes{ SliceAxis::I, SliceAxis::J, SliceAxis::K };

/** What steps over edges and corners of pixels from outside do not reach, slice by slice. */
VoxelShape
FilledByFlood(const VoxelShape & shape, std::size_t axis)
{
  const auto &      box = shape.Box();
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  VoxelShape        filled = shape;
  for (std::int32_t slice = 0; slice < box.size[axis]; ++slice)
  {
    const auto                      width = static_cast<std::size_t>(box.size[u]) + 2;
    const auto                      height = static_cast<std::size_t>(box.size[v]) + 2;
    std::vector<std::uint8_t>       seen(width * height, 0);
    std::vector<std::array<int, 2>> front{ { -1, -1 } };
    const auto                      at = [&](int a, int b) {
      std::array<std::int32_t, 3> voxel{};
      voxel[axis] = box.lower[axis] + slice;
      voxel[u] = box.lower[u] + a;
      voxel[v] = box.lower[v] + b;
      return voxel;
    };
    const auto place = [&](int a, int b) {
      return static_cast<std::size_t>(b + 1) * width + static_cast<std::size_t>(a + 1);
    };
    seen[place(-1, -1)] = 1;
    while (!front.empty())
    {
      const auto [a, b] = front.back();
      front.pop_back();
      for (int k = 0; k < 9; ++k)
      {
        const int na = a + k % 3 - 1;
        const int nb = b + k / 3 - 1;
        if (na < -1 || nb < -1 || na > box.size[u] || nb > box.size[v] || seen[place(na, nb)] != 0)
        {
          continue;
        }
        const auto voxel = at(na, nb);
        if (!shape.Contains(voxel[0], voxel[1], voxel[2]))
        {
          seen[place(na, nb)] = 1;
          front.push_back({ na, nb });
        }
      }
    }
    for (int b = 0; b < box.size[v]; ++b)
    {
      for (int a = 0; a < box.size[u]; ++a)
      {
        if (seen[place(a, b)] == 0)
        {
          const auto voxel = at(a, b);
          filled.Insert(voxel[0], voxel[1], voxel[2]);
        }
      }
    }
  }
  return filled;
}

void
ExpectAsByFlood(const VoxelShape & shape)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const VoxelShape  expected = FilledByFlood(shape, axis);
    const EditedShape filled = FillSlices(shape, kAxes[axis]);
    ExpectTight(filled.shape, VoxelsOf(expected));
    EXPECT_EQ(filled.voxelsAdded, expected.CountVoxels() - shape.CountVoxels());
    EXPECT_EQ(FillSlices(filled.shape, kAxes[axis]).cavitiesFilled, 0U) << "filled slices have no holes";
    std::uint64_t    count = 0;
    const VoxelShape holes = FindSliceHoles(shape, kAxes[axis], count);
    EXPECT_EQ(holes.Box().lower, shape.Box().lower);
    EXPECT_EQ(holes.CountVoxels(), filled.voxelsAdded);
    EXPECT_EQ(count, filled.cavitiesFilled);
  }
}

TEST(SliceHoles, AreWhatAFloodInThePlaneDoesNotReach)
{
  for (const RandomVolume & volume : RandomVolumes(7, 60))
  {
    SCOPED_TRACE(volume.Describe());
    ExpectAsByFlood(volume.shape);
  }
  Random random(3);
  ExpectAsByFlood(RandomShape(random, { 130, 67, 5 }, 0.7));
  ExpectAsByFlood(RandomShape(random, { 5, 67, 130 }, 0.7));
}

TEST(SliceHoles, ATubeIsSolidAcrossItsAxisAlone)
{
  const auto tube =
    ShapeWhere({ 20, 8, 8 }, [](int, int y, int z) { return y < 2 || y >= 6 || z < 2 || z >= 6; }, { 3, -4, 5 });
  EXPECT_EQ(FillSlices(tube, SliceAxis::I).voxelsAdded, 20U * 4 * 4);
  EXPECT_EQ(FillSlices(tube, SliceAxis::I).cavitiesFilled, 20U);
  EXPECT_EQ(FillSlices(tube, SliceAxis::J).voxelsAdded, 0U);
  EXPECT_EQ(FillSlices(tube, SliceAxis::K).voxelsAdded, 0U);
}

TEST(SliceHoles, PixelsThatTouchAtACornerEncloseNothing)
{
  // A ring of pixels that hang together at corners only: no wall to 6-connection.
  const auto ring = ShapeWhere({ 3, 3, 1 }, [](int x, int y, int) { return (x + y) % 2 == 1; });
  EXPECT_EQ(FillSlices(ring, SliceAxis::K).voxelsAdded, 0U);
}

TEST(SliceHoles, AxesHaveNames)
{
  for (const SliceAxis axis : kAxes)
  {
    EXPECT_EQ(SliceAxisNamed(SliceAxisName(axis)), axis);
  }
  EXPECT_FALSE(SliceAxisNamed("x"));
}

} // namespace
} // namespace voxelcore::testing
