#include "voxelcore/Base/Text.h"

#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace voxelcore
{

std::vector<std::string>
SplitText(std::string_view text, char separator)
{
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();)
  {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    parts.emplace_back(text.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

std::string
RoundTripText(double value)
{
  std::array<char, 64> digits{};
  return { digits.data(), to_chars(digits.data(), digits.data() + digits.size(), value).ptr };
}

std::string
DecimalText(double value, int decimals)
{
  char text[400];
  (void)std::snprintf(text, sizeof(text), "%.*f", decimals, value);
  return text;
}

std::string
FixedText(double value, int decimals)
{
  constexpr int kMostDecimals = 30;
  if (value != 0 && std::isfinite(value))
  {
    const int first = -static_cast<int>(std::floor(std::log10(std::abs(value)))); // the decimal that is not 0
    decimals = std::max(decimals, first > 0 ? first + 1 : 0);
  }
  if (decimals > kMostDecimals)
  {
    return ShortText(value, 2);
  }
  return DecimalText(value, decimals);
}

std::string
RoughText(double value)
{
  return FixedText(value, value < 10 ? 1 : 0);
}

std::string
ShortText(double value, int digits)
{
  char text[40];
  (void)std::snprintf(text, sizeof(text), "%.*g", digits, value);
  return text;
}

} // namespace voxelcore
