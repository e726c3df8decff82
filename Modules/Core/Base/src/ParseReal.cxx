#include "voxelcore/Base/ParseReal.h"

#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace voxelcore
{
namespace
{

/** Whether a number that a double cannot hold is too small for it, not too large. */
bool
IsTiny(std::string_view text)
{
  const std::size_t mark = text.find_first_of("eE");
  std::int64_t      exponent = 0;
  if (mark != std::string_view::npos)
  {
    std::string_view digits = text.substr(mark + 1);
    digits.remove_prefix(digits.starts_with('+') ? 1 : 0);
    const auto error = from_chars(digits.data(), digits.data() + digits.size(), exponent).ec;
    if (error != std::errc())
    {
      return digits.starts_with('-');
    }
  }
  // The place of its first digit: 0 is right before the point, less is behind it.
  const std::string_view mantissa = text.substr(0, mark);
  const std::size_t      point = std::min(mantissa.find('.'), mantissa.size());
  const std::size_t      first = mantissa.find_first_of("123456789");
  const auto             place = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first);
  return exponent < -place;
}

} // namespace

std::optional<double>
ParseReal(std::string_view text)
{
  // from_chars takes no leading plus.
  if (text.size() > 1 && text.front() == '+' && text[1] != '-' && text[1] != '+')
  {
    text.remove_prefix(1);
  }
  double value = 0;
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || text.empty())
  {
    return std::nullopt;
  }
  if (error == std::errc::result_out_of_range)
  {
    return IsTiny(text) ? std::optional(text.front() == '-' ? -0.0 : 0.0) : std::nullopt;
  }
  return error == std::errc() ? std::optional(value) : std::nullopt;
}

} // namespace voxelcore
