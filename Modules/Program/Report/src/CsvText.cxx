#include "voxelcore/Report/CsvText.h"

#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <array>

namespace voxelcore
{

namespace
{

[[noreturn]] void
ThrowInputError(const std::string & where, std::size_t line, const std::string & why)
{
  throw InputError(where + ": line " + std::to_string(line) + ": " + why);
}

} // namespace

std::vector<CsvRow>
ParseCsv(std::string_view text, const std::string & where, char separator)
{
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
  {
    throw InputError(where + ": is UTF-16; save it as CSV in UTF-8");
  }
  text.remove_prefix(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
  std::vector<CsvRow> rows;
  CsvRow              row;
  std::string         field;
  std::size_t         line = 1;
  bool                quoted = false;    // inside quotes
  bool                wasQuoted = false; // this field had quotes
  const bool          isOfOldMacs = text.find('\n') == std::string_view::npos;
  row.line = 1;
  const auto endField = [&] {
    row.fields.push_back(std::move(field));
    field.clear();
    wasQuoted = false;
  };
  const auto endRow = [&] {
    const bool empty = row.fields.empty() && field.empty() && !wasQuoted;
    endField();
    if (!empty)
    {
      rows.push_back(std::move(row));
    }
    row = CsvRow();
  };
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const char c = text[i];
    const bool crlf = c == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
    if (c == '\0')
    {
      ThrowInputError(where, line, "holds a NUL byte; save it as CSV in UTF-8");
    }
    if (quoted)
    {
      line += c == '\n' ? 1 : 0;
      if (c != '"')
      {
        field += c;
      }
      else if (i + 1 < text.size() && text[i + 1] == '"')
      {
        field += text[++i];
      }
      else
      {
        quoted = false;
      }
    }
    else if (c == separator)
    {
      endField();
    }
    else if (c == '\n' || c == '\r')
    {
      i += crlf ? 1 : 0;
      endRow();
      line += c == '\n' || crlf || isOfOldMacs ? 1 : 0; // CR CR LF: a line end that was converted twice
      row.line = line;
    }
    else if (wasQuoted)
    {
      ThrowInputError(where, line, "text follows a closing quote; write a quote inside a quoted field twice");
    }
    else if (c == '"')
    {
      if (!field.empty())
      {
        ThrowInputError(where, line, "a quote inside a field; quote the whole field and write the quote twice");
      }
      quoted = wasQuoted = true;
    }
    else
    {
      field += c;
    }
  }
  if (quoted)
  {
    ThrowInputError(where, row.line, "a quote is opened and never closed; close it");
  }
  endRow();
  return rows;
}

char
FindSeparator(std::string_view text)
{
  constexpr std::string_view separators = ",;\t";
  std::array<int, 3>         counts{};
  bool                       quoted = false;
  bool                       begun = false;
  for (const char c : text)
  {
    if (begun && !quoted && (c == '\n' || c == '\r'))
    {
      break;
    }
    begun = begun || (c != '\n' && c != '\r');
    quoted = quoted != (c == '"');
    const std::size_t which = quoted ? std::string_view::npos : separators.find(c);
    if (which != std::string_view::npos)
    {
      ++counts[which];
    }
  }
  const auto most = std::max_element(counts.begin(), counts.end()); // the first of several: a comma where there is none
  return separators[static_cast<std::size_t>(most - counts.begin())];
}

std::map<std::string, std::size_t>
ColumnPlaces(const CsvRow & head)
{
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < head.fields.size(); ++i)
  {
    const std::string & field = head.fields[i];
    places.emplace(field.ends_with(']') ? field.substr(0, field.rfind(" [")) : field, i);
  }
  return places;
}

std::string
CsvPlainField(std::string_view text)
{
  if (text.find_first_of(",\"\r\n") == std::string_view::npos)
  {
    return std::string(text);
  }
  std::string field = "\"";
  for (const char c : text)
  {
    field += c == '"' ? std::string("\"\"") : std::string(1, c);
  }
  return field + "\"";
}

} // namespace voxelcore
