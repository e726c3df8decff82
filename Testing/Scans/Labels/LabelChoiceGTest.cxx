#include "LabelsInMemory.h"

#include <cmath>
#include <limits>

namespace voxelcore::testing
{
namespace
{

TEST(LabelChoice, TakesTheLabelsThatAreNamed)
{
  const std::vector<std::uint8_t> values{ 0, 1, 2, 3 };
  const ImageGeometry             row = SizedGeometry(4, 1, 1);
  LabelChoice                     choice;
  choice.labels = "3, label-1";
  auto labels = LabelsOf(values, row, choice);
  ASSERT_EQ(labels.size(), 2U);
  EXPECT_EQ(labels[0].value, 1);
  EXPECT_EQ(labels[1].value, 3);
  choice.binary = true;
  labels = LabelsOf(values, row, choice);
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].value, 1);
  EXPECT_EQ(labels[0].voxels, 2U);
  choice.labels = "4";
  EXPECT_EQ(MessageOf([&] { LabelsOf(values, row, choice); }), "the image: there is no label '4'; it has 1, 2, 3");
  choice.labels = "1,,2";
  MessageOf<UsageError>([&] { LabelsOf(values, row, choice); });
  choice = {};
  choice.crop = ParseCrop("2:,:,:");
  labels = LabelsOf(values, row, choice);
  ASSERT_EQ(labels.size(), 2U);
  EXPECT_EQ(labels[0].shape.Box().lower[0], 2); // places do not move
  EXPECT_EQ(
    MessageOf([&] { LabelsOf(std::vector<std::uint8_t>(4, 0), row); }).find("the image: nothing but background"),
    0U);
}

TEST(LabelChoice, AThresholdMakesOneShape)
{
  LabelChoice choice;
  choice.threshold = { -0.5, 2 };
  const ImageGeometry row = SizedGeometry(4, 1, 1);
  const auto          labels = LabelsOf(std::vector<float>{ -1, -0.5F, 2, 2.5F }, row, choice);
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].voxels, 2U);
  choice.labels = "1";
  MessageOf<UsageError>([&] { LabelsOf(std::vector<float>(4, 1), row, choice); });
  choice = {};
  choice.threshold = { 2, 1 };
  MessageOf<UsageError>([&] { LabelsOf(std::vector<float>(4, 1), row, choice); });
}

TEST(LabelChoice, BinaryMakesOneShapeOfAllLayersAndAThresholdOfNone)
{
  StoredVoxels scan;
  scan.path = "a.seg.nrrd";
  scan.geometry.size = { 3, 1, 1 };
  scan.interleaved = 2;
  const std::vector<std::uint8_t> values{ 1, 0, /* x = 1 */ 0, 4, /* x = 2 */ 0, 0 };
  LabelChoice                     choice;
  choice.binary = true;
  LabelAssembler assembler(scan, choice);
  assembler.AddRows(values.data(), 0, 1);
  const auto labels = assembler.TakeShapes();
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].value, 1);
  EXPECT_EQ(labels[0].voxels, 2U);
  choice = {};
  choice.threshold = { 1, 4 };
  EXPECT_EQ(MessageOf<UsageError>([&] { LabelAssembler(scan, choice); }),
            "--threshold makes one shape of a grey scan: it cannot be used with --labels or with layers");
  // One of the values of a voxel is no layer.
  scan.component = 1;
  LabelAssembler second(scan, choice);
  second.AddRows(values.data(), 0, 1);
  const auto ofSecond = second.TakeShapes();
  ASSERT_EQ(ofSecond.size(), 1U);
  EXPECT_EQ(ofSecond[0].shape.Box().lower[0], 1);
  EXPECT_EQ(ofSecond[0].voxels, 1U);
}

TEST(LabelChoice, AThresholdTakesItsEndsAndNothingThatIsNoNumber)
{
  constexpr double    infinity = std::numeric_limits<double>::infinity();
  constexpr float     none = std::numeric_limits<float>::quiet_NaN();
  const ImageGeometry row = SizedGeometry(5, 1, 1);
  const auto          voxels = [&](double low, double high) {
    LabelChoice choice;
    choice.threshold = { low, high };
    return LabelsOf(std::vector<float>{ -2, 0, none, 3, 1e30F }, row, choice).at(0).voxels;
  };
  EXPECT_EQ(voxels(0, 3), 2U);
  EXPECT_EQ(voxels(3, 3), 1U);
  EXPECT_EQ(voxels(-infinity, infinity), 4U);
  EXPECT_EQ(voxels(std::nextafter(0.0, 1.0), infinity), 2U);
  LabelChoice choice;
  choice.threshold = { none, 1 };
  MessageOf<UsageError>([&] { LabelsOf(std::vector<float>(5, 1), row, choice); });
  choice.threshold = { 4, 5 };
  MessageOf<InputError>([&] { LabelsOf(std::vector<float>{ -2, 0, none, 3, 1e30F }, row, choice); });
}

} // namespace
} // namespace voxelcore::testing
