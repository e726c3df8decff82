#pragma once
// Small strict helpers for text that is read and for messages. Independent of the locale.

#include "voxelcore/Base/ParseReal.h"

#include <array>
#include <cstdint>
#include <filesystem>
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

/** "1 voxel", "2 voxels" */
std::string
Counted(std::uint64_t count, const std::string & one, const std::string & many);

/** \throws InputError with one line: "<file>: <what is wrong>; <what to do>" */
[[noreturn]] void
RefuseInput(const std::filesystem::path & file, std::string_view wrong, std::string_view remedy);

/** Millimetres in a unit of length ("um", "micron", "mm", ...); nothing when unknown. */
std::optional<double>
MillimetresIn(std::string_view unit);

/** A voxel size in mm along i, j, k: one number for all axes or three with commas, in mm or in the unit of length
 *  behind it; one without a unit has that of the next ("0.05", "50um", "0.5,0.5,2", "50,50,200um"). Nothing where it is
 *  none, or not above 0 and finite. */
std::optional<std::array<double, 3>>
ParseVoxelSize(std::string_view text);

/** Whether a unit of length is the voxel itself ("voxel", "pixel", "px", ...). */
bool
IsVoxelUnit(std::string_view unit);

} // namespace voxelcore
