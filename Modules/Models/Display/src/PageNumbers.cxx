#include "PageNumbers.h"

#include <algorithm>

namespace voxelcore
{

std::string
Base64(const std::vector<std::uint8_t> & bytes)
{
  constexpr const char * letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string            text;
  text.reserve(bytes.size() / 3 * 4 + 8);
  for (std::size_t at = 0; at < bytes.size(); at += 3)
  {
    std::uint32_t     three = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
    for (std::size_t k = 0; k < 3; ++k)
    {
      three = (three << 8) | (k < count ? bytes[at + k] : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k)
    {
      text += k <= count ? letters[(three >> (18 - 6 * k)) & 63U] : '=';
    }
  }
  return text;
}

std::uint32_t
Adler32(const std::vector<std::uint8_t> & bytes)
{
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const std::uint8_t byte : bytes)
  {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

} // namespace voxelcore
