#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Masks/ShapeEdits.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

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
            (std::vector<std::string>{ "1 cavity filled with 1 voxel", "1 component removed, with 1 voxel" }));
}

TEST(ShapeEdits, WhereNothingIsFilledOrRemovedThereIsNoNote)
{
  ShapeEditOptions options;
  options.fillCavities = true;
  options.minVoxels = 2;
  options.mend = true;
  options.close = ParseGapWidth("2vox");
  options.fillHollows = ParseGapWidth("2vox");
  options.fillSlices = SliceAxis::I;
  options.smooth = true;
  const auto         solid = ShapeWhere({ 5, 5, 5 }, [](int, int, int) { return true; });
  const EditedLabels edited = EditLabels({ Label(3, solid) }, kGeometry, options, true, "a.nrrd");
  EXPECT_TRUE(edited.notes.empty());
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
  EXPECT_EQ(edited.notes.size(), 2U) << "nothing was left for slices and cavities";
  EXPECT_NE(edited.notes[0].find("gaps up to 4vox closed with "), std::string::npos) << edited.notes[0];
  ImageGeometry inVoxels = kGeometry;
  inVoxels.unit = SpatialUnit::Voxels;
  options.close = ParseGapWidth("4mm");
  EXPECT_THROW(EditLabels({ Label(1, halves) }, inVoxels, options, true, "a.nrrd"), InputError);
}

TEST(ShapeEdits, ALumenThatTheBorderCutsIsClosedThereUnlessNothingIsCut)
{
  ImageGeometry tight;
  tight.size = { 9, 9, 9 };
  const auto cup =
    ShapeWhere({ 9, 9, 9 }, [](int x, int y, int z) { return !(x >= 2 && x < 7 && y >= 2 && y < 7 && z < 7); });
  ShapeEditOptions options;
  options.fillHollows = ParseGapWidth("2vox");
  const auto filled = [&](const ImageGeometry & geometry) {
    return EditLabels({ Label(1, cup) }, geometry, options, true, "a.nrrd").labels.at(0).label.voxels;
  };
  EXPECT_EQ(filled(tight), 729U);
  options.openAtBorder = true;
  EXPECT_EQ(filled(tight), cup.CountVoxels());
  EXPECT_EQ(filled(tight), filled(kGeometry)) << "as with room around";
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

constexpr std::array<std::int64_t, 3> kIsotropic{ 1, 1, 1 };

std::vector<std::string>
Diagnosed(const std::vector<VoxelShape> & shapes)
{
  std::vector<EditedLabel> labels;
  for (const VoxelShape & shape : shapes)
  {
    labels.push_back({ Label(static_cast<std::int64_t>(labels.size()) + 1, shape), 0, std::nullopt });
  }
  return DiagnoseLabels(labels, kIsotropic);
}

/** A block of side^3 with a rod of 5 voxels apart from it. */
VoxelShape
BlockWithDust(int side)
{
  return ShapeWhere({ side + 20, side, side }, [side](int x, int y, int z) {
    return x < side || (y == 3 && z == 3 && x >= side + 3 && x < side + 8);
  });
}

TEST(ShapeEdits, OfSeveralLabelsOneLineMendsAllAndTakesNoTruePiece)
{
  EXPECT_EQ(
    Diagnosed({ BlockWithDust(20), BlockWithDust(30) }),
    (std::vector<std::string>{
      "label 1 (label-1): 1 island of at most 5 voxels (0.062 % of the voxels); label 2 (label-2): 1 island of at "
      "most 5 voxels (0.019 % of the voxels); unless they are real, mend them with --min-voxels 6" }));
  const VoxelShape tiny = ShapeWhere({ 4, 1, 1 }, [](int, int, int) { return true; });
  EXPECT_EQ(Diagnosed({ BlockWithDust(20), tiny }),
            (std::vector<std::string>{
              "label 1 (label-1): 1 island of at most 5 voxels (0.062 % of the voxels); unless they are real, mend "
              "them one by one, such as --labels 1 --min-voxels 6" }))
    << "the second label would go";
}

TEST(ShapeEdits, AdviceThatTakesMuchSaysSo)
{
  // Beside a block of 10 x 10 x 10, ten rods of 5 voxels.
  const std::vector<std::string> told = Diagnosed({ ShapeWhere({ 50, 40, 10 }, [](int x, int y, int z) {
    return (x < 10 && y < 10) || (z == 5 && y % 4 == 3 && x >= 20 && x < 25);
  }) });
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("10 islands"), std::string::npos) << told[0];
  EXPECT_NE(told[0].find("--min-voxels 6, which removes 50 voxels (4.8 %)"), std::string::npos) << told[0];
}

TEST(ShapeEdits, PiecesThatTouchAreJoinedOrToldOf)
{
  // Two blocks of 3^3 that share one corner, and a third one that touches nothing.
  const VoxelShape blocks = ShapeWhere({ 12, 6, 6 }, [](int x, int y, int z) {
    return (x < 3 && y < 3 && z < 3) || (x >= 3 && x < 6 && y >= 3 && z >= 3) || (x >= 9 && y < 3 && z < 3);
  });
  EXPECT_EQ(Diagnosed({ blocks }),
            (std::vector<std::string>{ "label 1 (label-1): 1 piece touches others over edges or corners alone (33 % of "
                                       "the voxels); join them with --connectivity joined" }));
  ShapeEditOptions options;
  options.connectivity = Connectivity::Joined;
  const EditedLabels edited = EditLabels({ Label(1, blocks) }, kGeometry, options, true, "a.nrrd");
  ASSERT_EQ(edited.labels.size(), 1U);
  EXPECT_TRUE(edited.touched);
  EXPECT_EQ(ComputeShapeTopology(edited.labels[0].label.shape), (TopologyNumbers{ 2, { 2, 0, 0 } }));
  EXPECT_EQ(edited.labels[0].label.voxels, 81U + 2U);
  ASSERT_TRUE(edited.labels[0].edits && edited.labels[0].edits->touching);
  EXPECT_EQ(edited.labels[0].edits->touching->piecesJoined, 1U);
  EXPECT_EQ(edited.notes,
            (std::vector<std::string>{ "pieces that touch over edges and corners joined: 1 piece fewer, with 2 voxels; "
                                       "to keep them apart: --connectivity 6" }));
}

TEST(ShapeEdits, WhereNoPiecesTouchJoiningIsNoEdit)
{
  ShapeEditOptions options;
  options.connectivity = Connectivity::Joined;
  const EditedLabels edited = EditLabels({ Label(1, BlockAndSpeck()) }, kGeometry, options, true, "a.nrrd");
  ASSERT_EQ(edited.labels.size(), 1U);
  EXPECT_FALSE(edited.touched);
  EXPECT_FALSE(edited.labels[0].edits);
  EXPECT_TRUE(edited.notes.empty());
  EXPECT_EQ(edited.labels[0].label.voxels, 125U);
}

} // namespace
} // namespace voxelcore::testing
