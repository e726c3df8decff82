#pragma once
// PNG images written byte by byte, as https://www.w3.org/TR/png defines them.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace voxelcore::testing
{

struct PngImage
{
  std::uint32_t         width = 0;
  std::uint32_t         height = 0;
  int                   bits = 8;
  int                   colour = 0;         ///< colour type: 0 grey, 2 RGB, 3 palette, 4 grey + alpha, 6 RGBA
  bool                  interlaced = false; ///< Adam7
  int                   filter = 0;         ///< of every row: 0 none, 1 sub, 2 up
  std::vector<unsigned> values;             ///< row after row, the values of a pixel side by side
};

/** Length, name, data, checksum. */
std::string
PngChunk(std::string_view name, std::string_view data);

/** The image data before they are packed: a filter byte and the row, of each pass. */
std::string
PngRows(const PngImage & image);

/** The whole file; `packed` replaces the image data, `more` are chunks that come before them. */
std::string
Png(const PngImage & image, const std::string & packed = {}, const std::string & more = {});

} // namespace voxelcore::testing
