#pragma once
// Comma-separated values (RFC 4180), read and written.

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace voxelcore
{

struct CsvRow
{
  std::size_t              line = 0; ///< where it begins, from 1
  std::vector<std::string> fields;
};

/** Fields may be quoted, then "" is a quote and line ends belong to the field. Lines end in LF, CRLF or CR; a byte
 *  order mark of UTF-8 and empty lines are passed over. `where` names the file in errors.
 *  \throws InputError for UTF-16, NUL bytes, a quote that is never closed or stands inside a field. */
std::vector<CsvRow>
ParseCsv(std::string_view text, const std::string & where, char separator = ',');

/** What separates the fields of a table: of comma, semicolon and tab the one that its first line that is not empty has
 *  most of, not counting what is quoted; a comma where there is none. */
char
FindSeparator(std::string_view text);

/** Where each column stands, by its name: of "length [mm]" without the unit. The first of one name. */
std::map<std::string, std::size_t>
ColumnPlaces(const CsvRow & head);

/** A number or a word of our own as a field, quoted where it must be. For text of others see CsvField. */
std::string
CsvPlainField(std::string_view text);

} // namespace voxelcore
