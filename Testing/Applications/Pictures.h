#pragma once
// What is to be seen in a picture that `voxelcore render` drew.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <png.h>
#include <vector>

namespace voxelcore::testing
{

struct Image
{
  int                       width = 0;
  int                       height = 0;
  std::vector<std::uint8_t> pixels;

  std::array<int, 3>
  At(int x, int y) const
  {
    const auto place = 3 * static_cast<std::size_t>(y * width + x);
    return { pixels[place], pixels[place + 1], pixels[place + 2] };
  }
};

inline Image
ReadPng(const std::filesystem::path & path)
{
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  Image result;
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0)
  {
    ADD_FAILURE() << path << ": " << image.message;
    return result;
  }
  image.format = PNG_FORMAT_RGB;
  result.width = static_cast<int>(image.width);
  result.height = static_cast<int>(image.height);
  result.pixels.resize(PNG_IMAGE_SIZE(image));
  png_image_finish_read(&image, nullptr, result.pixels.data(), 0, nullptr);
  return result;
}

/** Mean place and number of the pixels for which `is` holds, in the part of the picture where objects are. */
struct Spot
{
  double x = 0;
  double y = 0;
  int    count = 0;
  int    left = 1 << 20;
  int    right = -1;
  int    top = 1 << 20;
  int    bottom = -1;
};

/** In rows from `top` on, up to `bottom`; left of what is written beside the content. */
template <typename TPredicate>
Spot
Find(const Image & image, TPredicate is, int top = 0, int bottom = 1 << 20, int percent = 84)
{
  Spot spot;
  for (int y = top; y < std::min(bottom, image.height); ++y)
  {
    for (int x = 0; x < image.width * percent / 100; ++x)
    {
      if (is(image.At(x, y)))
      {
        spot.x += x;
        spot.y += y;
        ++spot.count;
        spot.left = std::min(spot.left, x);
        spot.right = std::max(spot.right, x);
        spot.top = std::min(spot.top, y);
        spot.bottom = std::max(spot.bottom, y);
      }
    }
  }
  spot.x /= std::max(spot.count, 1);
  spot.y /= std::max(spot.count, 1);
  return spot;
}

inline bool
IsOrange(const std::array<int, 3> & c)
{
  return c[0] > 110 && c[1] > 100 && c[2] < 90 && c[0] > c[2] + 60;
}
inline bool
IsViolet(const std::array<int, 3> & c)
{
  return c[2] > c[1] + 25 && c[0] > c[1] && c[0] < 140;
}
inline bool
IsDrawn(const std::array<int, 3> & c)
{
  return c[0] < 245 || c[1] < 245 || c[2] < 245;
}

} // namespace voxelcore::testing
