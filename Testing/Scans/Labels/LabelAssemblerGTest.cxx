#include "LabelsInMemory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace voxelcore::testing
{
namespace
{

template <typename T>
class LabelAssemblerOf : public ::testing::Test
{};
using PixelTypes = ::testing::Types<std::uint8_t,
                                    std::int8_t,
                                    std::uint16_t,
                                    std::int16_t,
                                    std::uint32_t,
                                    std::int32_t,
                                    std::uint64_t,
                                    std::int64_t,
                                    float,
                                    double>;
TYPED_TEST_SUITE(LabelAssemblerOf, PixelTypes);

TYPED_TEST(LabelAssemblerOf, EachValueHasItsShapeInItsTightBox)
{
  const std::vector<TypeParam> values{ 0, 7, 7, 0, 0, 7, 3, 0, /* z = 1 */ 0, 0, 0, 0, 0, 0, 3, 3 };
  const auto                   labels = LabelsOf(values, SizedGeometry(4, 2, 2));
  ASSERT_EQ(labels.size(), 2U);
  EXPECT_EQ(labels[0].value, 3);
  EXPECT_EQ(labels[0].name, "label-3");
  EXPECT_EQ(labels[0].voxels, 3U);
  EXPECT_EQ(labels[0].shape.Box().lower, (std::array<std::int32_t, 3>{ 2, 1, 0 }));
  EXPECT_EQ(labels[0].shape.Box().size, (std::array<std::int32_t, 3>{ 2, 1, 2 }));
  EXPECT_TRUE(labels[0].shape.Contains(2, 1, 0));
  EXPECT_FALSE(labels[0].shape.Contains(3, 1, 0));
  EXPECT_EQ(labels[1].value, 7);
  EXPECT_EQ(labels[1].voxels, 3U);
  if constexpr (std::is_signed_v<TypeParam>)
  {
    const std::vector<TypeParam> negative{ 0, TypeParam(-1) };
    EXPECT_EQ(MessageOf([&] { LabelsOf(negative, SizedGeometry(2, 1, 1)); }),
              "the image: value -1 at voxel (1,0,0) is negative; labels are whole numbers from 0 up; name those to "
              "take, such as --labels 1; for a grey scan give --threshold LO:HI");
    LabelChoice one;
    one.labels = "1";
    LabelAssembler assembler("the image", SizedGeometry(3, 1, 1), LabelAssembler::Pixel::Of<TypeParam>(), one);
    const std::vector<TypeParam> ignored{ 1, TypeParam(-1), 0 };
    assembler.AddRows(ignored.data(), 0, 1);
    EXPECT_EQ(assembler.PassedOver(), std::vector<double>{ -1 });
    EXPECT_EQ(assembler.TakeShapes().at(0).voxels, 1U);
  }
  if constexpr (std::is_floating_point_v<TypeParam>)
  {
    for (const auto & refused : std::vector<std::pair<TypeParam, const char *>>{
           { TypeParam(0.9999999), "is a fraction" },
           { std::numeric_limits<TypeParam>::quiet_NaN(), "is no number" },
           { TypeParam(1e17), "is too large" } })
    {
      EXPECT_NE(MessageOf([&] {
                  LabelsOf(std::vector<TypeParam>{ 1, refused.first }, SizedGeometry(2, 1, 1));
                }).find(refused.second),
                std::string::npos);
    }
    // What lies outside of a scan may be no number; labels that are named need no guess.
    LabelChoice one;
    one.labels = "1";
    LabelAssembler assembler("the image", SizedGeometry(3, 1, 1), LabelAssembler::Pixel::Of<TypeParam>(), one);
    const std::vector<TypeParam> outside{ 1, std::numeric_limits<TypeParam>::quiet_NaN(), 0 };
    assembler.AddRows(outside.data(), 0, 1);
    ASSERT_EQ(assembler.PassedOver().size(), 1U);
    EXPECT_TRUE(std::isnan(assembler.PassedOver()[0]));
    EXPECT_EQ(assembler.TakeShapes().at(0).voxels, 1U);
  }
}

TYPED_TEST(LabelAssemblerOf, AThresholdTakesTheVoxelsBetweenItsEnds)
{
  // More than a word of bits a row, so that whole words and the rest of one are looked at.
  std::vector<TypeParam> values;
  for (int n = 0; n < 150 * 3; ++n)
  {
    values.push_back(TypeParam(n * 7 % 101));
  }
  for (const auto & [lowest, highest] : { std::pair(40.0, 80.0), std::pair(39.5, 80.5), std::pair(100.0, 1e300) })
  {
    LabelChoice choice;
    choice.threshold = std::pair(lowest, highest);
    const auto labels = LabelsOf(values, SizedGeometry(150, 3, 1), choice);
    ASSERT_EQ(labels.size(), 1U);
    std::uint64_t count = 0;
    for (int n = 0; n < 150 * 3; ++n)
    {
      const bool isIn = n * 7 % 101 >= lowest && n * 7 % 101 <= highest;
      count += isIn ? 1 : 0;
      EXPECT_EQ(labels[0].shape.Contains(n % 150, n / 150, 0), isIn) << n;
    }
    EXPECT_EQ(labels[0].voxels, count);
  }
}

TEST(LabelAssembler, LayersKeepTheirNumbersUnderACrop)
{
  // Two layers, which both use 1: segments are numbered anew.
  StoredVoxels scan;
  scan.path = "a.seg.nrrd";
  scan.geometry.size = { 2, 2, 1 };
  scan.interleaved = 2;
  scan.segments = { { "bone", 0, 1, Color{ 1, 0, 0 } }, { "skin", 1, 1, {} } };
  const std::vector<std::uint8_t> values{ 1, 1, 0, 1, /* y = 1 */ 0, 2, 1, 0 };
  for (const char * crop : { ":,:,:", ":,1:,:" })
  {
    LabelChoice choice;
    choice.crop = ParseCrop(crop);
    LabelAssembler assembler(scan, choice);
    EXPECT_TRUE(assembler.NeedsAllRows());
    assembler.AddRows(values.data(), 0, 2);
    const auto labels = assembler.TakeShapes();
    EXPECT_TRUE(assembler.IsRenumbered());
    const bool whole = choice.crop->first[1] == 0;
    ASSERT_EQ(labels.size(), whole ? 3U : 2U);
    EXPECT_EQ(labels[0].name, "bone");
    EXPECT_EQ(labels[0].voxels, whole ? 2U : 1U);
    EXPECT_EQ(labels[0].color, (Color{ 1, 0, 0 }));
    EXPECT_EQ(labels.back().value, 3); // the value 2, which no segment names
  }
}

TEST(LabelAssembler, RowsMayComeInAnyPortions)
{
  std::mt19937               random(20261122);
  const ImageGeometry        geometry = SizedGeometry(301, 97, 83);
  std::vector<std::uint16_t> values(301 * 97 * 83);
  std::uint16_t              value = 0;
  for (auto & one : values)
  {
    value = random() % 20 == 0 ? static_cast<std::uint16_t>(random() % 4) : value;
    one = value;
  }
  const auto     whole = LabelsOf(values, geometry);
  LabelAssembler assembler("the image", geometry, LabelAssembler::Pixel::Of<std::uint16_t>(), {});
  for (std::size_t row = 0; row < 97 * 83;)
  {
    const std::size_t count = std::min<std::size_t>(1 + random() % 500, 97 * 83 - row);
    assembler.AddRows(values.data() + 301 * row, row, count);
    row += count;
  }
  const auto parts = assembler.TakeShapes();
  ASSERT_EQ(parts.size(), whole.size());
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    EXPECT_EQ(parts[i].value, whole[i].value);
    EXPECT_EQ(parts[i].shape.Box().lower, whole[i].shape.Box().lower);
    ASSERT_EQ(parts[i].shape.Box().size, whole[i].shape.Box().size);
    for (std::int32_t z = 0; z < whole[i].shape.Box().size[2]; ++z)
    {
      for (std::int32_t y = 0; y < whole[i].shape.Box().size[1]; ++y)
      {
        ASSERT_TRUE(std::ranges::equal(parts[i].shape.Row(y, z), whole[i].shape.Row(y, z)));
      }
    }
  }
}

} // namespace
} // namespace voxelcore::testing
