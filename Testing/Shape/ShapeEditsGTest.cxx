#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Error.h"
#include "voxelcore/ShapeEdits.h"

#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

LabelShape
Label(std::int64_t value, const VoxelShape & shape)
{
  return { value, "label-" + std::to_string(value), shape.CountVoxels(), shape };
}

const ImageGeometry kGeometry = [] {
  ImageGeometry geometry;
  geometry.size = { 20, 20, 20 };
  return geometry;
}();

/** A block of 5^3 with a cavity of one voxel, and a speck of one voxel beside it. */
VoxelShape
BlockAndSpeck()
{
  return ShapeWhere({ 8, 5, 5 }, [](int x, int y, int z) {
    return x < 5 ? x != 2 || y != 2 || z != 2 : x == 7 && y == 0 && z == 0;
  });
}

TEST(ShapeEdits, WithoutOptionsLabelsStayAsTheyAre)
{
  const EditedLabels edited = EditLabels({ Label(3, BlockAndSpeck()) }, kGeometry, {}, true, "a.nrrd");
  ASSERT_EQ(edited.labels.size(), 1U);
  EXPECT_EQ(edited.labels[0].label.voxels, 125U);
  EXPECT_EQ(edited.labels[0].component, 0);
  EXPECT_FALSE(edited.labels[0].edits);
  EXPECT_TRUE(edited.notes.empty());
}

TEST(ShapeEdits, CavitiesAreFilledBeforeSmallComponentsGo)
{
  ShapeEditOptions options;
  options.fillCavities = true;
  options.minVoxels = 2;
  const EditedLabels edited = EditLabels({ Label(3, BlockAndSpeck()) }, kGeometry, options, true, "a.nrrd");
  ASSERT_EQ(edited.labels.size(), 1U);
  EXPECT_EQ(edited.labels[0].label.voxels, 125U);
  EXPECT_EQ(edited.labels[0].label.shape.Box().size, (std::array<std::int32_t, 3>{ 5, 5, 5 }));
  EXPECT_EQ(edited.labels[0].edits->cavitiesFilled, 1U);
  EXPECT_EQ(edited.labels[0].edits->componentsRemoved, 1U);
  EXPECT_EQ(edited.notes,
            (std::vector<std::string>{ "1 cavity filled with 1 voxel, 0 components in them joined to what is around",
                                       "1 component removed, with 1 voxel" }));
}

TEST(ShapeEdits, GapsCloseBeforeHollowsSlicesAndCavitiesAreFilled)
{
  // Two halves of a hollow block, two voxels apart: only once closed it has a cavity.
  const auto       halves = ShapeWhere({ 14, 9, 9 }, [](int x, int y, int z) {
    const bool isGap = x == 6 || x == 7;
    const bool isLumen = x >= 2 && x < 12 && y >= 2 && y < 7 && z >= 2 && z < 7;
    return !isGap && !isLumen;
  });
  ShapeEditOptions options;
  options.close = ParseGapWidth("4vox");
  options.fillHollows = ParseGapWidth("2vox");
  options.fillSlices = SliceAxis::I;
  options.fillCavities = true;
  const EditedLabels edited = EditLabels({ Label(1, halves) }, kGeometry, options, true, "a.nrrd");
  const EditRecord & record = *edited.labels.at(0).edits;
  EXPECT_EQ(record.closed->componentsJoined, 1U);
  EXPECT_GT(record.closed->voxelsAdded, 0U);
  EXPECT_EQ(edited.labels[0].label.voxels,
            halves.CountVoxels() + record.closed->voxelsAdded + record.hollows->voxelsAdded +
              record.slices->voxelsAdded + record.voxelsAdded);
  EXPECT_EQ(edited.notes.size(), 4U);
  EXPECT_NE(edited.notes[0].find("gaps up to 4vox closed with "), std::string::npos) << edited.notes[0];
  ImageGeometry inVoxels = kGeometry;
  inVoxels.unit = SpatialUnit::Voxels;
  options.close = ParseGapWidth("4mm");
  EXPECT_THROW(EditLabels({ Label(1, halves) }, inVoxels, options, true, "a.nrrd"), InputError);
}

TEST(ShapeEdits, ComponentsAreNumberedBySize)
{
  ShapeEditOptions options;
  options.splitComponents = true;
  const EditedLabels edited = EditLabels({ Label(3, BlockAndSpeck()) }, kGeometry, options, true, "a.nrrd");
  ASSERT_EQ(edited.labels.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i)
  {
    EXPECT_EQ(edited.labels[i].label.value, 3);
    EXPECT_EQ(edited.labels[i].component, static_cast<std::int64_t>(i) + 1);
    EXPECT_EQ(edited.labels[i].label.name, "label-3#" + std::to_string(i + 1));
    EXPECT_EQ(edited.labels[i].label.voxels, i == 0 ? 124U : 1U);
  }
}

TEST(ShapeEdits, ALabelOfWhichNothingIsLeftIsNamedOrRefused)
{
  ShapeEditOptions options;
  options.minVoxels = 10;
  const std::vector<LabelShape> labels{ Label(3, BlockAndSpeck()), Label(7, Box({ 1, 2, 1 })) };
  const EditedLabels            edited = EditLabels(labels, kGeometry, options, false, "a.nrrd");
  ASSERT_EQ(edited.labels.size(), 1U);
  EXPECT_EQ(edited.notes.back(), "nothing is left of label 7 (label-7)");
  EXPECT_THROW(EditLabels(labels, kGeometry, options, true, "a.nrrd"), InputError);
  options.minVoxels = 1000;
  EXPECT_THROW(EditLabels(labels, kGeometry, options, false, "a.nrrd"), InputError);
}

} // namespace
} // namespace voxelcore::testing
