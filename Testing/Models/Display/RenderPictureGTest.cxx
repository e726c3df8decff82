// Files, what is refused, and tiles. That pictures are right is tested through the program
// (Testing/Applications/RenderCommandGTest).

#include "VoxelCoreTesting/Random.h"
#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Display/RenderPicture.h"

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>

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

/** A lens of glass around a sheet and a curve, oblique to all axes. */
DisplayContent
Lens()
{
  DisplayContent content;
  content.labels.resize(1);
  DisplayLabel & label = content.labels.front();
  label.label = 1;
  label.name = "lens";
  label.color = { 0.9, 0.3, 0.2 };
  constexpr std::uint32_t kAround = 40;
  constexpr std::uint32_t kUp = 20;
  for (std::uint32_t v = 0; v <= kUp; ++v)
  {
    for (std::uint32_t u = 0; u < kAround; ++u)
    {
      const double a = 2 * 3.14159265358979 * u / kAround;
      const double b = 3.14159265358979 * v / kUp;
      label.surface.points.push_back({ static_cast<float>(9 * std::sin(b) * std::cos(a) + 2 * std::cos(b)),
                                       static_cast<float>(7 * std::sin(b) * std::sin(a)),
                                       static_cast<float>(4 * std::cos(b)) });
      if (v < kUp)
      {
        const std::uint32_t next = (u + 1) % kAround;
        const std::uint32_t at = v * kAround;
        label.surface.triangles.push_back({ at + u, at + next, at + kAround + u });
        label.surface.triangles.push_back({ at + next, at + kAround + next, at + kAround + u });
      }
    }
  }
  label.curves.positions = { { -6, -2, 0.3 }, { 0, 1, 0.5 }, { 5, 3, -0.2 } };
  label.curves.radius = { 2, 3, 1.5 };
  label.curves.sectionRadius = label.curves.radius;
  label.curves.erosionThickness = { 0, 0, 0 };
  SortBranches(label.curves, { { 0, 1, 2 } }, false);
  return content;
}

TEST(RenderPicture, TilesMakeThePictureThatIsDrawnAtOnce)
{
  for (const bool panels : { false, true })
  {
    PictureOptions options;
    options.width = 240;
    options.height = 200;
    options.panels = panels;
    const auto draw = [&](int tile) {
      options.tile = tile;
      Picture drawn;
      RenderPictures(Lens(), options, [&](int, const Picture & picture) { drawn = picture; });
      return drawn;
    };
    const Picture whole = draw(2048);
    const Picture tiled = draw(130);
    ASSERT_EQ(whole.pixels.size(), 3U * 240 * 200);
    ASSERT_EQ(tiled.pixels.size(), whole.pixels.size());
    std::size_t unlike = 0;
    int         most = 0;
    for (std::size_t i = 0; i < whole.pixels.size(); ++i)
    {
      const int apart = std::abs(int{ whole.pixels[i] } - int{ tiled.pixels[i] });
      most = std::max(most, apart);
      unlike += apart > 0 ? 1 : 0;
    }
    // Each tile has a projection of its own: single precision puts an edge now and then on the other side of the
    // middle of one of a pixel's four parts.
    std::cout << unlike << " of " << whole.pixels.size() << " bytes differ, by " << most << " at most\n";
    EXPECT_LE(unlike, whole.pixels.size() / 1000);
  }
}

} // namespace
} // namespace voxelcore::testing
