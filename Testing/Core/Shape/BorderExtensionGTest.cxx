#include "voxelcore/Shape/BorderExtension.h"

#include "voxelcore/Shape/ShapeOperations.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <iostream>
#include <random>

namespace voxelcore::testing
{
namespace
{

VoxelShape
Where(const VoxelBox & box, const std::function<bool(double x, double y, double z)> & isIn)
{
  VoxelShape shape(box);
  for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
  {
    for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
    {
      for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
      {
        if (isIn(x + 0.5, y + 0.5, z + 0.5))
        {
          shape.Insert(x, y, z);
        }
      }
    }
  }
  shape.Compact();
  return CropToVoxels(shape);
}

VoxelShape
Noise(const VoxelBox & box, double share, std::mt19937_64 & random)
{
  std::bernoulli_distribution in(share);
  return Where(box, [&](double, double, double) { return in(random); });
}

TEST(BorderExtension, OfAnEvenSquareTheCentreIsACornerOfVoxels)
{
  const VoxelBox box{ { 0, 0, 0 }, { 20, 20, 20 } };
  const auto     rod = Where(box, [](double x, double y, double) { return x > 5 && x < 9 && y > 7 && y < 11; });
  const auto     sections = FindBorderSections(rod, box, { 1, 1, 1 });
  ASSERT_EQ(sections.size(), 2U);
  for (const BorderSection & section : sections)
  {
    EXPECT_EQ(section.axis, 2U);
    EXPECT_EQ(section.voxels, 16U);
    EXPECT_EQ(section.centre, (Vector3{ 7, 9, section.isUpper ? 19.5 : 0.5 }));
    EXPECT_DOUBLE_EQ(section.radius, 2);
    EXPECT_DOUBLE_EQ(section.reach, std::sqrt(8.0));
    EXPECT_TRUE(section.isCut);
  }
  EXPECT_FALSE(sections[0].isUpper);
  EXPECT_TRUE(sections[1].isUpper);
}

TEST(BorderExtension, LengthsOfASectionAreMillimetres)
{
  const VoxelBox box{ { 0, 0, 0 }, { 20, 20, 20 } };
  const auto     rod = Where(box, [](double x, double y, double) { return x > 5 && x < 10 && y > 7 && y < 10; });
  const auto     sections = FindBorderSections(rod, box, { 0.5, 2, 1 });
  ASSERT_EQ(sections.size(), 2U);
  // 2.5 mm along x, 6 mm along y: the disc is as wide as x allows.
  EXPECT_EQ(sections[0].centre, (Vector3{ 7.5, 8.5, 0.5 }));
  EXPECT_DOUBLE_EQ(sections[0].radius, 1.25);
  EXPECT_DOUBLE_EQ(sections[0].reach, std::hypot(1.25, 3.0));
}

TEST(BorderExtension, ABallInItsTightBoxOnlyTouchesIt)
{
  for (const Vector3 & spacing : { Vector3{ 1, 1, 1 }, Vector3{ 1, 1, 2.5 } })
  {
    // Of fewer layers than these nobody can tell.
    for (double radius = 3 * spacing[2]; radius < 18; radius += 0.25)
    {
      const auto ball = Where({ { -20, -20, -20 }, { 40, 40, 40 } }, [&](double x, double y, double z) {
        return std::hypot(x * spacing[0], y * spacing[1], z * spacing[2]) <= radius;
      });
      for (const BorderSection & section : FindBorderSections(ball, ball.Box(), spacing))
      {
        EXPECT_FALSE(section.isCut) << radius << ", along " << section.axis;
      }
    }
  }
}

TEST(BorderExtension, TubesThatLeaveTheScanAreCut)
{
  const VoxelBox box{ { 0, 0, 0 }, { 110, 40, 40 } };
  for (const double degrees : { 0.0, 15.0, 30.0, 45.0, 60.0 })
  {
    for (const double radius : { 1.5, 3.0, 6.0, 10.0 })
    {
      const double angle = degrees * 3.14159265358979 / 180;
      const auto   tube = Where(box, [&](double x, double y, double z) {
        const double across = (x - 55) * std::cos(angle) - (z - 20) * std::sin(angle);
        return std::hypot(across, y - 20) <= radius;
      });
      const auto   sections = FindBorderSections(tube, box, { 1, 1, 1 });
      ASSERT_EQ(sections.size(), 2U) << degrees << ", " << radius;
      EXPECT_TRUE(sections[0].isCut && sections[1].isCut) << degrees << ", " << radius;
    }
  }
}

TEST(BorderExtension, ATubeAlongTheBorderIsNotCutThere)
{
  const VoxelBox box{ { 0, 0, 0 }, { 80, 40, 40 } };
  for (const double depth : { 1.0, 3.0, 5.0, 7.0 }) // of the axis
  {
    const auto tube =
      Where(box, [&](double x, double y, double z) { return std::hypot(y - 20, z - depth) <= 8 && x > 10 && x < 70; });
    for (const BorderSection & section : FindBorderSections(tube, box, { 1, 1, 1 }))
    {
      EXPECT_FALSE(section.isCut) << depth;
    }
  }
}

TEST(BorderExtension, AScanOfOneSliceHasNoBorderAcrossIt)
{
  const VoxelBox box{ { 0, 0, 0 }, { 30, 30, 1 } };
  const auto     disc = Where(box, [](double x, double y, double) { return std::hypot(x - 15, y - 15) < 8; });
  EXPECT_TRUE(FindBorderSections(disc, box, { 1, 1, 1 }).empty());
}

/** What lies within the scan is the shape, and what was added changes no topology. */
void
ExpectExtended(const VoxelShape & shape, const VoxelBox & scan, const Vector3 & spacing, BorderEnds ends)
{
  const ExtendedShape extended = ExtendBeyondBorder(shape, scan, spacing, { ends, 4 });
  EXPECT_EQ(ComputeShapeTopology(extended.shape), ComputeShapeTopology(shape));
  const EditedShape within = CropToBox(extended.shape, scan);
  EXPECT_EQ(within.shape.CountVoxels(), shape.CountVoxels());
  const VoxelBox & box = shape.Box();
  for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
  {
    for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
    {
      for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
      {
        ASSERT_EQ(extended.shape.Contains(x, y, z), shape.Contains(x, y, z));
      }
    }
  }
}

TEST(BorderExtension, KeepsTheTopologyOfRandomVolumes)
{
  const std::uint64_t seed = std::random_device()();
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  for (int round = 0; round < 120; ++round)
  {
    std::uniform_int_distribution<std::int32_t> side(2, 12);
    const VoxelBox box{ { side(random), -side(random), side(random) }, { side(random), side(random), side(random) } };
    const auto     shape = Noise(box, 0.1 + 0.8 * (round % 9) / 8, random);
    const Vector3  spacing{ 1, 1, round % 3 == 0 ? 2.5 : 1 };
    for (const BorderEnds ends : { BorderEnds::Closed, BorderEnds::Open, BorderEnds::Overlap })
    {
      ExpectExtended(shape, box, spacing, ends);
    }
  }
}

TEST(BorderExtension, ReachesBeyondTheEdgesOfTheScan)
{
  const VoxelBox box{ { 0, 0, 0 }, { 30, 30, 30 } };
  // It leaves through an edge of the box.
  const auto rod =
    Where(box, [](double x, double y, double z) { return std::hypot((x - y) / std::sqrt(2.0), z - 15) <= 5; });
  ExpectExtended(rod, box, { 1, 1, 1 }, BorderEnds::Open);
  const auto extended = ExtendBeyondBorder(rod, box, { 1, 1, 1 }, { BorderEnds::Open, 4 });
  EXPECT_TRUE(extended.shape.Contains(-3, -3, 15));
  EXPECT_TRUE(extended.shape.Contains(33, 33, 15));
}

TEST(BorderExtension, PartsThatShareALayerHaveTheSameSectionsInIt)
{
  const std::uint64_t seed = std::random_device()();
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  const VoxelBox  box{ { 0, 0, 0 }, { 20, 16, 24 } };
  for (int round = 0; round < 60; ++round)
  {
    const auto         shape = Noise(box, 0.2 + 0.6 * (round % 7) / 6, random);
    const auto         axis = static_cast<std::size_t>(round % 3);
    const std::int32_t cut = 3 + round % 10; // the layer that both have
    VoxelBox           lower = box;
    VoxelBox           upper = box;
    lower.size[axis] = cut + 1;
    upper.lower[axis] = cut;
    upper.size[axis] -= cut;
    const auto at = [&](const VoxelBox & part, bool isUpper) {
      auto sections = FindBorderSections(VoxelsWithin(shape, part), part, { 1, 1, 2.5 });
      std::erase_if(sections, [&](const BorderSection & one) { return one.axis != axis || one.isUpper != isUpper; });
      return sections;
    };
    const auto below = at(lower, true);
    const auto above = at(upper, false);
    ASSERT_EQ(below.size(), above.size());
    for (std::size_t i = 0; i < below.size(); ++i)
    {
      EXPECT_EQ(below[i].centre, above[i].centre);
      EXPECT_EQ(below[i].radius, above[i].radius);
      EXPECT_EQ(below[i].voxels, above[i].voxels);
    }
  }
}

} // namespace
} // namespace voxelcore::testing
