#pragma once
// Small strict helpers for text headers and messages. Independent of the locale.

#include "voxelcore/ParseReal.h"

#include <cstdint>
#include <locale>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace voxelcore
{

/** The arguments put together as text. */
template <typename... T>
std::string
Text(const T &... parts)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  (out << ... << parts);
  return out.str();
}

/** Without blanks, tabs and line ends at both ends. */
std::string_view
Trim(std::string_view text);

std::string
LowerCase(std::string_view text);

/** Words between blanks and tabs. */
std::vector<std::string_view>
Words(std::string_view text);

/** The whole word as a number; nothing when any character is left over. */
std::optional<std::int64_t>
ParseInteger(std::string_view word);

/** All words as numbers; nothing when one of them is none. */
std::optional<std::vector<double>>
ParseReals(std::string_view text);

/** Safe to print on one line and not too long: text taken from a file may hold anything. */
std::string
Printable(std::string_view text, std::size_t longest = 60);

/** A number as a person would write it. */
std::string
Number(double value);

/** Millimetres in a unit of length ("um", "micron", "mm", ...); nothing when unknown. */
std::optional<double>
MillimetresIn(std::string_view unit);

} // namespace voxelcore
