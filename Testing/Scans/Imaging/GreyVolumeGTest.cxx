#include "voxelcore/Imaging/GreyVolume.h"
#include "NrrdFixtures.h"

#include <limits>
#include <random>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

constexpr int kX = 9;
constexpr int kY = 8;
constexpr int kZ = 7;

std::vector<float>
RandomValues(unsigned seed)
{
  std::mt19937       random(seed);
  std::vector<float> values(kX * kY * kZ);
  for (float & value : values)
  {
    value = static_cast<float>(random() % 100000) / 64 - 700;
  }
  return values;
}

} // namespace

TEST(GreyVolume, HoldsTheValuesOfAnyBox)
{
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937     random(seed);
  const auto       values = RandomValues(seed);
  const TempFolder folder;
  const auto       path = folder.Write("a.nrrd", Nrrd(NrrdLines("float", { kX, kY, kZ }), RawAll<float>(values)));
  for (int n = 0; n < 50; ++n)
  {
    VoxelBox box;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int size = std::array<int, 3>{ kX, kY, kZ }[axis];
      box.lower[axis] = static_cast<std::int32_t>(random() % static_cast<unsigned>(size));
      box.size[axis] = 1 + static_cast<std::int32_t>(random() % static_cast<unsigned>(size - box.lower[axis]));
    }
    const GreyVolume grey = ReadGreyVolume(path, box);
    EXPECT_EQ(grey.geometry.size, (std::array<std::int64_t, 3>{ kX, kY, kZ }));
    for (int z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
    {
      for (int y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
      {
        for (int x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
        {
          ASSERT_EQ(*grey.Row(x, y, z), values[static_cast<std::size_t>((z * kY + y) * kX + x)]);
        }
      }
    }
  }
}

TEST(GreyVolume, HasSlopeAndInterceptApplied)
{
  const TempFolder folder;
  NiftiFields      fields{ .dim = { 3, 2, 2 }, .slope = 0.5, .intercept = -10 };
  const auto       path = folder.Write("a.nii", Nifti(fields, RawAll<std::uint8_t>(nrrd::kValues)));
  const GreyVolume grey = ReadGreyVolume(path, { { 0, 0, 0 }, { 3, 2, 2 } });
  for (std::size_t i = 0; i < nrrd::kValues.size(); ++i)
  {
    EXPECT_EQ(grey.values[i], static_cast<float>(0.5 * nrrd::kValues[i] - 10));
  }
}

TEST(GreyVolume, ABoxBeyondTheScanIsRefused)
{
  const TempFolder folder;
  const auto       path = folder.Write("a.nrrd", Nrrd(nrrd::Lines(), RawAll<std::uint8_t>(nrrd::kValues)));
  for (const VoxelBox & box : { VoxelBox{ { -1, 0, 0 }, { 2, 2, 2 } },
                                VoxelBox{ { 0, 0, 0 }, { 4, 2, 2 } },
                                VoxelBox{ { 0, 0, 1 }, { 3, 2, 2 } } })
  {
    EXPECT_THROW(ReadGreyVolume(path, box), InputError);
  }
}

TEST(GreyVolume, WhatIsNoFiniteNumberIsRefusedWhereItIsAskedFor)
{
  auto values = RandomValues(3);
  values.back() = std::numeric_limits<float>::quiet_NaN();
  const TempFolder folder;
  const auto       path = folder.Write("a.nrrd", Nrrd(NrrdLines("float", { kX, kY, kZ }), RawAll<float>(values)));
  EXPECT_THROW(ReadGreyVolume(path, { { 0, 0, 0 }, { kX, kY, kZ } }), InputError);
  EXPECT_NO_THROW(ReadGreyVolume(path, { { 0, 0, 0 }, { kX - 1, kY, kZ } }));
}
