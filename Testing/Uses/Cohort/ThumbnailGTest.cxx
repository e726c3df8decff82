#include "voxelcore/Cohort/Thumbnail.h"

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "voxelcore/Models/DisplayColors.h"

#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

/** A square in the coronal plane, which the viewer sees from its front. */
MedialModel
Square(double at)
{
  ModelPart part;
  part.label = 1;
  part.core.positions = { { at, 0, 0 }, { at + 9, 0, 0 }, { at + 9, 0, 9 }, { at, 0, 9 } };
  part.core.radius.assign(4, 1);
  part.core.cells.vertexCount = 4;
  part.core.cells.edges = { { 0, 1 }, { 0, 3 }, { 1, 2 }, { 2, 3 } };
  part.core.cells.faceOffsets = { 0, 4 };
  part.core.cells.faceVertices = { 0, 1, 2, 3 };
  part.core.cells.faceEdges = { 0, 2, 3, 1 };
  return { { part }, "" };
}

TEST(Thumbnail, AModelFillsThePictureWhereverItLies)
{
  const Thumbnail picture = PaintModel(Square(0), 64);
  ASSERT_EQ(picture.rgb.size(), 64U * 64U * 3U);
  std::size_t painted = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
  {
    painted += picture.rgb[i] != 255 || picture.rgb[i + 1] != 255 || picture.rgb[i + 2] != 255 ? 1 : 0;
  }
  // 9 x 0.788 wide, 9 x 0.94 and 9 x 0.788 x 0.267 high: two thirds of a square whose side is 0.92 of the picture's.
  EXPECT_GT(painted, 64U * 64U / 3);
  EXPECT_LT(painted, 64U * 64U * 4 / 5);
  EXPECT_EQ(PaintModel(Square(100), 64).rgb, picture.rgb);
}

/** The hue of the pixel in the middle, from blue (-) to red (+). */
double
RedOverBlue(const Thumbnail & picture)
{
  const std::size_t at = 3 * static_cast<std::size_t>(picture.height / 2 * picture.width + picture.width / 2);
  return static_cast<double>(picture.rgb[at]) - static_cast<double>(picture.rgb[at + 2]);
}

TEST(Thumbnail, ColorsAreThoseOfLengthsAsOnTheCasesPage)
{
  // In front of a small square of another radius, which widens the range, a great one.
  const auto paint = [](double radius, double other) {
    MedialModel model = Square(0);
    model.parts.push_back(model.parts.front());
    model.parts[0].core.radius.assign(4, radius);
    model.parts[1].core.radius.assign(4, other);
    for (auto & position : model.parts[1].core.positions)
    {
      position = { position[0] / 3, position[1] + 5, position[2] / 3 };
    }
    return RedOverBlue(PaintModel(model, 64));
  };
  const Color small = LengthColor(0);
  const Color large = LengthColor(1);
  ASSERT_GT(large[0] - large[2], small[0] - small[2] + 0.5);
  EXPECT_GT(paint(9, 1), paint(1, 9) + 80);
  // The label has no say in it.
  MedialModel other = Square(0);
  other.parts[0].label = 7;
  EXPECT_EQ(PaintModel(other, 64).rgb, PaintModel(Square(0), 64).rgb);
}

TEST(Thumbnail, EmptyAndFlatModelsArePictures)
{
  EXPECT_EQ(PaintModel({}, 32).rgb, std::vector<std::uint8_t>(32 * 32 * 3, 255));
  ModelPart point;
  point.label = 3;
  point.core.positions = { { 1, 2, 3 } };
  point.core.radius = { 1 };
  point.core.cells.vertexCount = 1;
  const Thumbnail picture = PaintModel({ { point }, "" }, 32);
  EXPECT_NE(picture.rgb, std::vector<std::uint8_t>(32 * 32 * 3, 255));
  const TemporaryFolder folder;
  WriteThumbnail(folder / "a.png", picture);
  EXPECT_EQ(ReadAll(folder / "a.png").substr(1, 3), "PNG");
}

} // namespace
} // namespace voxelcore::testing
