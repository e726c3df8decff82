#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Shape/LabelContacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace voxelcore::testing
{
namespace
{

using Voxel = std::array<std::int32_t, 3>;

LabelShape
Box(std::int64_t value, const Voxel & lower, const Voxel & size)
{
  LabelShape label{ value, "label", 0, VoxelShape(VoxelBox{ lower, size }) };
  for (std::int32_t z = lower[2]; z < lower[2] + size[2]; ++z)
  {
    for (std::int32_t y = lower[1]; y < lower[1] + size[1]; ++y)
    {
      for (std::int32_t x = lower[0]; x < lower[0] + size[0]; ++x)
      {
        label.shape.Insert(x, y, z);
      }
    }
  }
  label.voxels = label.shape.CountVoxels();
  return label;
}

TEST(LabelContacts, TwoBoxesSideBySideTouchAtTheirFaces)
{
  ImageGeometry geometry;
  geometry.spacing = { 0.5, 1, 2 };
  geometry.origin = { 10, 20, 30 };
  const auto contacts =
    FindLabelContacts({ Box(4, { 0, 0, 0 }, { 3, 4, 5 }), Box(7, { 3, 1, 0 }, { 3, 4, 5 }) }, geometry);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].labels, (std::array<std::size_t, 2>{ 0, 1 }));
  EXPECT_EQ(contacts[0].faces, 15U);
  EXPECT_DOUBLE_EQ(contacts[0].areaMm2, 15 * 1 * 2);
  EXPECT_EQ(contacts[0].voxels.size(), 40U); // rows 0 to 3 of one, 1 to 4 of the other, edges included
  EXPECT_NEAR(contacts[0].centre[0], 10 + 0.5 * 2.5, 1e-12);
  EXPECT_NEAR(contacts[0].centre[1], 20 + 2, 1e-12);
  EXPECT_NEAR(contacts[0].centre[2], 30 + 2 * 2, 1e-12);
}

TEST(LabelContacts, CornersTouchWithoutArea)
{
  const auto contacts = FindLabelContacts({ Box(1, { 0, 0, 0 }, { 2, 2, 2 }), Box(2, { 2, 2, 2 }, { 2, 2, 2 }) }, {});
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].faces, 0U);
  EXPECT_EQ(contacts[0].voxels.size(), 2U);
  EXPECT_TRUE(FindLabelContacts({ Box(1, { 0, 0, 0 }, { 2, 2, 2 }), Box(2, { 3, 2, 2 }, { 2, 2, 2 }) }, {}).empty());
}

TEST(LabelContacts, PlacesApartAreContactsOfTheirOwn)
{
  // Two bars joined at both ends by bars of another label.
  std::vector<LabelShape> labels{ Box(1, { 0, 0, 0 }, { 20, 3, 3 }), Box(2, { 0, 3, 0 }, { 3, 6, 3 }) };
  LabelShape              other = Box(2, { 17, 3, 0 }, { 3, 6, 3 });
  labels[1].shape = UnionOfLabels({ labels[1], other });
  EXPECT_EQ(labels[1].shape.CountVoxels(), 108U);
  EXPECT_EQ(FindLabelContacts(labels, {}).size(), 2U);
}

TEST(LabelContacts, AreThoseOfAFloodOverTouchingPairs)
{
  constexpr std::uint64_t firstSeed = 6000;
  std::cout << "seeds from " << firstSeed << '\n';
  std::size_t found = 0;
  for (std::uint64_t seed = firstSeed; seed < firstSeed + 60; ++seed)
  {
    Random                       random(seed);
    const std::int32_t           side = 6;
    std::map<Voxel, std::size_t> owner;
    std::vector<LabelShape>      labels;
    const double                 density = 0.1 * static_cast<double>(random.Between(1, 9));
    for (std::int64_t value = 1; value <= 3; ++value)
    {
      labels.push_back({ value, "label", 0, VoxelShape(VoxelBox{ { -2, 3, 60 }, { side, side, side } }) });
    }
    for (std::int32_t i = 0; i < side * side * side; ++i)
    {
      const Voxel voxel{ i % side - 2, i / side % side + 3, i / side / side + 60 };
      if (random.Chance(density))
      {
        const auto label = static_cast<std::size_t>(random.Between(0, 2));
        owner[voxel] = label;
        labels[label].shape.Insert(voxel[0], voxel[1], voxel[2]);
      }
    }
    // Pairs of touching voxels hang together where two of their voxels are equal or touch.
    using Pair = std::array<Voxel, 2>; // the smaller label's first
    std::map<std::array<std::size_t, 2>, std::set<Pair>> open;
    const auto                                           touch = [](const Voxel & a, const Voxel & b) {
      return std::abs(a[0] - b[0]) <= 1 && std::abs(a[1] - b[1]) <= 1 && std::abs(a[2] - b[2]) <= 1;
    };
    for (const auto & [a, of] : owner)
    {
      for (const auto & [b, to] : owner)
      {
        if (of < to && touch(a, b))
        {
          open[{ of, to }].insert({ a, b });
        }
      }
    }
    std::vector<std::tuple<std::array<std::size_t, 2>, std::size_t, std::uint64_t>> expected;
    for (auto & [labelPair, pairs] : open)
    {
      while (!pairs.empty())
      {
        std::vector<Pair> stack{ *pairs.begin() };
        pairs.erase(pairs.begin());
        std::set<Voxel> voxels;
        std::uint64_t   faces = 0;
        while (!stack.empty())
        {
          const Pair pair = stack.back();
          stack.pop_back();
          voxels.insert(pair.begin(), pair.end());
          int steps = 0;
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            steps += pair[0][axis] != pair[1][axis] ? 1 : 0;
          }
          faces += steps == 1 ? 1 : 0;
          for (auto next = pairs.begin(); next != pairs.end();)
          {
            if (touch((*next)[0], pair[0]) || touch((*next)[1], pair[1]) || touch((*next)[0], pair[1]) ||
                touch((*next)[1], pair[0]))
            {
              stack.push_back(*next);
              next = pairs.erase(next);
            }
            else
            {
              ++next;
            }
          }
        }
        expected.emplace_back(labelPair, voxels.size(), faces);
      }
    }
    std::vector<std::tuple<std::array<std::size_t, 2>, std::size_t, std::uint64_t>> contacts;
    for (const LabelContact & contact : FindLabelContacts(labels, {}))
    {
      contacts.emplace_back(contact.labels, contact.voxels.size(), contact.faces);
    }
    std::sort(expected.begin(), expected.end());
    std::sort(contacts.begin(), contacts.end());
    ASSERT_EQ(contacts, expected) << "seed " << seed;
    found += contacts.size();
  }
  EXPECT_GT(found, 200U); // or the bodies drawn say little
}

TEST(LabelContacts, AVoxelOfSeveralLabelsBecomesTheFirstOnes)
{
  auto labels = WithoutSharedVoxels(
    { Box(1, { 0, 0, 0 }, { 4, 4, 4 }), Box(2, { 2, 0, 0 }, { 4, 4, 4 }), Box(3, { 1, 1, 1 }, { 2, 2, 2 }) });
  ASSERT_EQ(labels.size(), 2U); // nothing of the third is left
  EXPECT_EQ(labels[0].voxels, 64U);
  EXPECT_EQ(labels[1].voxels, 32U);
  EXPECT_FALSE(labels[1].shape.Contains(3, 0, 0));
  EXPECT_TRUE(labels[1].shape.Contains(4, 0, 0));
  EXPECT_EQ(UnionOfLabels(labels).CountVoxels(), 96U);
  labels = LabelsWithin(std::move(labels), Box(9, { 5, 0, 0 }, { 9, 1, 1 }).shape);
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].value, 2);
  EXPECT_EQ(labels[0].voxels, 1U);
}

} // namespace
} // namespace voxelcore::testing
