#include "voxelcore/Base/PlainText.h"

#include <cstddef>

namespace voxelcore
{

namespace
{

/** Bytes of the character at the beginning that is to be no more than text; 0 where it is harmless. */
std::size_t
BytesActedOn(std::string_view text)
{
  const auto byte = [&](std::size_t at) {
    return at < text.size() ? static_cast<unsigned char>(text[at]) : std::size_t{ 0 };
  };
  if (byte(0) < 0x20 || byte(0) == 0x7F)
  {
    return 1;
  }
  if ((byte(0) == 0xC2 && byte(1) >= 0x80 && byte(1) < 0xA0) || (byte(0) == 0xD8 && byte(1) == 0x9C))
  {
    return 2;
  }
  const bool isMark = byte(1) == 0x80 && (byte(2) == 0x8E || byte(2) == 0x8F || (byte(2) >= 0xA8 && byte(2) <= 0xAE));
  const bool isIsolate = byte(1) == 0x81 && byte(2) >= 0xA6 && byte(2) <= 0xA9;
  return byte(0) == 0xE2 && (isMark || isIsolate) ? 3 : 0;
}

} // namespace

std::string
PlainText(std::string_view text, bool keepsLines)
{
  std::string plain;
  for (std::size_t at = 0; at < text.size();)
  {
    const bool        isLine = keepsLines && (text[at] == '\n' || text[at] == '\t');
    const std::size_t bytes = isLine ? 0 : BytesActedOn(text.substr(at));
    plain += bytes > 0 ? '?' : text[at];
    at += bytes > 0 ? bytes : 1;
  }
  return plain;
}

} // namespace voxelcore
