#include "PictureFile.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/OutputFile.h"
#include "voxelcore/Base/TemporaryNames.h"

#include <algorithm>
#include <png.h>

namespace voxelcore
{

void
WritePng(const std::filesystem::path & path, const Picture & picture)
{
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  std::string      bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.pixels.data(), 0, nullptr) == 0)
  {
    throw OutputError("cannot make '" + FinalName(path).string() + "': " + image.message);
  }
  bytes.resize(size);
  WriteTextFile(path, bytes);
}

Picture
BlankPicture(int width, int height)
{
  Picture picture{ width, height, {} };
  picture.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  return picture;
}

void
SetMeans(Picture & picture, const unsigned char * drawn, int left, int bottom, int width, int height, int part)
{
  const std::size_t rowBytes = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(part);
  const int         count = part * part;
  for (int y = 0; y < height; ++y)
  {
    const auto     above = static_cast<std::size_t>(picture.height - 1 - (bottom + y));
    std::uint8_t * to =
      picture.pixels.data() + 3 * (above * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(left));
    for (int x = 0; x < width; ++x)
    {
      for (int c = 0; c < 3; ++c, ++to)
      {
        int sum = 0;
        for (int k = 0; k < count; ++k)
        {
          const auto row = static_cast<std::size_t>(y * part + k / part);
          const auto column = static_cast<std::size_t>(x * part + k % part);
          sum += drawn[row * rowBytes + 3 * column + static_cast<std::size_t>(c)];
        }
        *to = static_cast<std::uint8_t>((sum + count / 2) / count);
      }
    }
  }
}

void
RequireDrawn(const Picture & picture)
{
  const auto isFirst = [&](std::uint8_t value) { return value == picture.pixels.front(); };
  if (std::all_of(picture.pixels.begin(), picture.pixels.end(), isFirst))
  {
    throw OutputError("cannot draw: the picture came out empty; does OpenGL 3.2 work on this display?");
  }
}

} // namespace voxelcore
