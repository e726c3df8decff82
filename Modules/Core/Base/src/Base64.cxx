#include "voxelcore/Base/Base64.h"

#include <algorithm>
#include <array>

namespace voxelcore
{
namespace
{

constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t     kNone = 255;

/** Each letter's six bits. */
constexpr auto kSixBits = [] {
  std::array<std::uint8_t, 256> bits{};
  bits.fill(kNone);
  for (std::size_t i = 0; i < kLetters.size(); ++i)
  {
    bits[static_cast<unsigned char>(kLetters[i])] = static_cast<std::uint8_t>(i);
  }
  return bits;
}();

} // namespace

std::string
ToBase64(std::span<const std::uint8_t> bytes)
{
  std::string text;
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
      text += k <= count ? kLetters[(three >> (18 - 6 * k)) & 63U] : '=';
    }
  }
  return text;
}

std::string
FromBase64(std::string_view & text, std::uint64_t most)
{
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(std::min<std::uint64_t>(most, text.size() / 4 * 3)));
  bool isAtEnd = false;
  while (bytes.size() < most && !isAtEnd)
  {
    text.remove_prefix(std::min(text.find_first_not_of(" \r\n\t"), text.size()));
    if (text.size() < 4)
    {
      break;
    }
    const std::size_t padded = text[3] != '=' ? 0 : text[2] != '=' ? 1 : 2;
    std::uint32_t     bits = 0;
    for (std::size_t i = 0; i < 4 && !isAtEnd; ++i)
    {
      const std::uint8_t six = i < 4 - padded ? kSixBits[static_cast<unsigned char>(text[i])] : std::uint8_t{ 0 };
      isAtEnd = six == kNone;
      bits = bits << 6U | six;
    }
    if (isAtEnd)
    {
      break;
    }
    text.remove_prefix(4);
    for (std::size_t i = 0; i < 3 - padded && bytes.size() < most; ++i)
    {
      bytes.push_back(static_cast<char>(bits >> (16 - 8 * i) & 255U));
    }
    isAtEnd = padded > 0;
  }
  return bytes;
}

} // namespace voxelcore
