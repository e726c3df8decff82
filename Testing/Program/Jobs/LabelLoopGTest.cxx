#include "voxelcore/Jobs/LabelLoop.h"

#include "VoxelCoreTesting/Threads.h"
#include "voxelcore/Jobs/OutputNames.h"

#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

/** Boxes of several sizes, small ones among them. */
std::vector<EditedLabel>
Boxes()
{
  std::vector<EditedLabel> labels;
  for (std::int32_t i = 1; i <= 9; ++i)
  {
    const std::int32_t side = 3 + 5 * i % 11;
    VoxelShape         shape(VoxelBox{ { 20 * i, 0, 0 }, { side, side, 4 } });
    for (std::int32_t at = 0; at < side * side * 4; ++at)
    {
      shape.Insert(20 * i + at % side, at / side % side, at / (side * side));
    }
    EditedLabel one;
    one.label.value = i;
    one.label.name = "box " + std::to_string(i);
    one.label.voxels = shape.CountVoxels();
    one.label.shape = std::move(shape);
    labels.push_back(std::move(one));
  }
  return labels;
}

std::vector<LabelOutcome>
Outcomes(int threads)
{
  const Threads             running(threads);
  std::vector<EditedLabel>  labels = Boxes();
  std::vector<LabelOutcome> outcomes;
  StageSeconds              seconds;
  CoreOptions               options;
  ImageGeometry             geometry;
  geometry.size = { 220, 20, 20 };
  options.lambdas = { ParseLambda("1.5vox") };
  ProcessLabels(
    labels,
    options,
    geometry,
    {},
    {},
    {},
    [&](LabelOutcome outcome) { outcomes.push_back(std::move(outcome)); },
    seconds);
  return outcomes;
}

TEST(LabelLoop, OutcomesComeInTheLabelsOrderAndAreTheSameForEveryNumberOfThreads)
{
  const auto one = Outcomes(1);
  const auto four = Outcomes(4);
  ASSERT_EQ(one.size(), 9U);
  ASSERT_EQ(four.size(), 9U);
  for (std::size_t i = 0; i < one.size(); ++i)
  {
    EXPECT_EQ(one[i].record.label, static_cast<std::int64_t>(i + 1));
    EXPECT_EQ(four[i].record.label, one[i].record.label);
    EXPECT_EQ(four[i].parts.front().core.positions, one[i].parts.front().core.positions);
    EXPECT_EQ(four[i].parts.front().core.radius, one[i].parts.front().core.radius);
    EXPECT_EQ(four[i].parts.front().core.cells.edges, one[i].parts.front().core.cells.edges);
  }
}

} // namespace
} // namespace voxelcore::testing
