#include "LabelsInMemory.h"

#include "VoxelCoreTesting/Random.h"

#include "voxelcore/Labels/LabelMap.h"

#include <algorithm>
#include <iostream>
#include <map>

namespace voxelcore::testing
{
namespace
{

TEST(LabelMap, LabelsStandByValueEachInItsTightBoxAndShareTheVoxels)
{
  constexpr std::uint64_t firstSeed = 20261122;
  std::cout << "seeds from " << firstSeed << '\n';
  for (std::uint64_t seed = firstSeed; seed < firstSeed + 20; ++seed)
  {
    Random     random(seed);
    const auto side = [&] { return static_cast<std::int32_t>(random.Between(1, 90)); };
    // Long along x, for words of bits and their edges.
    const std::array<std::int32_t, 3> size{ side(), side() / 9 + 1, side() / 9 + 1 };
    std::vector<std::uint64_t>        values(static_cast<std::size_t>(size[0]) * size[1] * size[2]);
    for (auto & value : values)
    {
      // Far apart, and beyond what a double holds.
      value = random.Chance(0.6) ? 0 : (std::uint64_t{ 1 } << random.Between(0, 62)) + random.Next() % 2;
    }
    values.back() = 1;
    struct Expected
    {
      std::uint64_t               voxels = 0;
      std::array<std::int32_t, 3> low{ INT32_MAX, INT32_MAX, INT32_MAX };
      std::array<std::int32_t, 3> high{ INT32_MIN, INT32_MIN, INT32_MIN };
    };
    std::map<std::uint64_t, Expected> expected;
    const auto                        each = [&](const auto & call) {
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        const auto x = static_cast<std::int32_t>(i % static_cast<std::size_t>(size[0]));
        const auto row = static_cast<std::int32_t>(i / static_cast<std::size_t>(size[0]));
        call(values[i], std::array<std::int32_t, 3>{ x, row % size[1], row / size[1] });
      }
    };
    each([&](std::uint64_t value, const std::array<std::int32_t, 3> & at) {
      Expected & of = expected[value];
      ++of.voxels;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        of.low[axis] = std::min(of.low[axis], at[axis]);
        of.high[axis] = std::max(of.high[axis], at[axis]);
      }
    });
    expected.erase(0);
    const auto labels = LabelsOf(values, SizedGeometry(size[0], size[1], size[2]));
    ASSERT_EQ(labels.size(), expected.size()) << "seed " << seed;
    auto next = expected.begin();
    for (const LabelShape & label : labels)
    {
      ASSERT_EQ(label.value, static_cast<std::int64_t>(next->first)) << "seed " << seed;
      EXPECT_EQ(label.name, "label-" + std::to_string(next->first));
      EXPECT_EQ(label.voxels, next->second.voxels);
      EXPECT_EQ(label.shape.CountVoxels(), next->second.voxels);
      EXPECT_EQ(label.shape.Box().lower, next->second.low);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        EXPECT_EQ(label.shape.Box().size[axis], next->second.high[axis] - next->second.low[axis] + 1);
      }
      each([&](std::uint64_t value, const std::array<std::int32_t, 3> & at) {
        ASSERT_EQ(label.shape.Contains(at[0], at[1], at[2]), value == next->first) << "seed " << seed;
      });
      ++next;
    }
  }
}

} // namespace
} // namespace voxelcore::testing
