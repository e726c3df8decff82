#include "voxelcore/RenderPicture.h"

#include "voxelcore/Error.h"

#include <cstdio>
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
  std::FILE * const file = std::fopen(path.c_str(), "wb");
  const bool        written =
    file != nullptr && png_image_write_to_stdio(&image, file, 0, picture.pixels.data(), 0, nullptr) != 0;
  const bool closed = file != nullptr && std::fclose(file) == 0;
  if (!written || !closed)
  {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    throw OutputError("cannot write '" + path.string() + "': the disk is full, or the folder cannot be written to");
  }
}

} // namespace voxelcore
