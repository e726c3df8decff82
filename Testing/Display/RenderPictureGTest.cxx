// What needs no display. That pictures are right is tested through the program
// (Testing/Applications/RenderCommandGTest).

#include "VoxelCoreTesting/Random.h"
#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Error.h"
#include "voxelcore/RenderPicture.h"

#include <gtest/gtest.h>
#include <png.h>

namespace voxelcore::testing
{
namespace
{

Picture
RandomPicture(std::uint64_t seed, int width, int height)
{
  Random  random(seed);
  Picture picture{ width, height, {} };
  for (int i = 0; i < 3 * width * height; ++i)
  {
    picture.pixels.push_back(static_cast<std::uint8_t>(random.Between(0, 255)));
  }
  return picture;
}

TEST(RenderPicture, APngHoldsThePixelsRowsFromTheTop)
{
  const TemporaryFolder folder;
  for (const auto & [width, height] : std::vector<std::pair<int, int>>{ { 1, 1 }, { 7, 3 }, { 64, 65 } })
  {
    const Picture picture = RandomPicture(20261122, width, height);
    WritePng(folder / "a.png", picture);
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_file(&image, (folder / "a.png").c_str()), 0) << image.message;
    image.format = PNG_FORMAT_RGB;
    EXPECT_EQ(image.width, static_cast<png_uint_32>(width));
    EXPECT_EQ(image.height, static_cast<png_uint_32>(height));
    std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
    ASSERT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0);
    EXPECT_EQ(pixels, picture.pixels);
  }
}

TEST(RenderPicture, WhatCannotBeWrittenLeavesNothing)
{
  const TemporaryFolder folder;
  EXPECT_THROW(WritePng(folder / "none/a.png", RandomPicture(1, 4, 4)), OutputError);
  EXPECT_THROW(WritePng(folder / "a.png", Picture{}), OutputError) << "a picture of no pixels";
  EXPECT_TRUE(folder.Names().empty());
}

TEST(RenderPicture, NothingToBeShownIsAMistakeOfTheUser)
{
  const auto never = [](int, const Picture &) { ADD_FAILURE() << "a picture was drawn"; };
  EXPECT_THROW(RenderPictures({}, {}, never), UsageError);
  DisplayContent empty;
  empty.labels.resize(2);
  EXPECT_THROW(RenderPictures(empty, {}, never), UsageError);
  EXPECT_THROW(RenderPictures(empty, {}, never, [](std::string_view, double) { return false; }), Cancelled);
}

} // namespace
} // namespace voxelcore::testing
