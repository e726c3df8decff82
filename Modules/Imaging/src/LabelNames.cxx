#include "LabelNames.h"
#include "TextFields.h"

#include <algorithm>
#include <fstream>

namespace voxelcore
{
namespace
{

constexpr std::uintmax_t kLargestList = 16U << 20;

/** The part of a line behind the value. */
struct NamedLine
{
  std::int64_t value = 0;
  bool         tab = false; ///< a tab ends the value: the name runs to the next tab
  std::string  rest;
  std::size_t  numbers = 0; ///< words at the end that are numbers, not counting the first word
};

std::vector<NamedLine>
ReadLines(const std::filesystem::path & path)
{
  std::vector<NamedLine> lines;
  std::ifstream          file(path);
  for (std::string line; std::getline(file, line);)
  {
    const std::string_view text = Trim(line);
    const std::size_t      end = text.find_first_of(" \t");
    const auto             value = ParseInteger(text.substr(0, end));
    if (!value || end == std::string_view::npos)
    {
      continue;
    }
    NamedLine named;
    named.value = *value;
    named.tab = text[end] == '\t';
    named.rest = Trim(text.substr(end));
    const auto words = Words(named.rest);
    while (named.numbers + 1 < words.size() && ParseReal(words[words.size() - 1 - named.numbers]))
    {
      ++named.numbers;
    }
    lines.push_back(std::move(named));
  }
  return lines;
}

bool
IsMeant(const std::string & wish, const LabelBook::Label & label)
{
  return ParseInteger(wish) == label.value || wish == label.name;
}

} // namespace

std::map<std::int64_t, std::string>
ReadLabelNames(const std::filesystem::path & scan)
{
  std::string whole = scan.filename().string();
  if (whole.empty()) // a folder given with a slash at its end
  {
    whole = scan.parent_path().filename().string();
  }
  if (LowerCase(whole).ends_with(".gz"))
  {
    whole.resize(whole.size() - 3);
  }
  const auto        folder = scan.has_filename() ? scan.parent_path() : scan.parent_path().parent_path();
  const std::string stem = std::filesystem::path(whole).stem().string();
  for (const std::string & name : { whole + ".txt", stem + ".txt" })
  {
    const auto      path = folder / name;
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error) || std::filesystem::file_size(path, error) > kLargestList)
    {
      continue;
    }
    const auto                          lines = ReadLines(path);
    std::map<std::int64_t, std::string> names;
    std::size_t                         columns = lines.empty() ? 0 : lines.front().numbers;
    for (const NamedLine & line : lines)
    {
      columns = std::min(columns, line.numbers);
    }
    for (const NamedLine & line : lines)
    {
      std::string_view text = line.rest;
      if (line.tab)
      {
        text = text.substr(0, text.find('\t'));
      }
      else
      {
        const auto words = Words(line.rest);
        const auto last = words[words.size() - 1 - columns];
        text = text.substr(0, static_cast<std::size_t>(last.data() + last.size() - text.data()));
      }
      if (text.size() > 1 && text.front() == '"' && text.back() == '"')
      {
        text = text.substr(1, text.size() - 2);
      }
      names.emplace(line.value, Printable(Trim(text), 200));
    }
    if (!names.empty())
    {
      return names;
    }
  }
  return {};
}

LabelBook::LabelBook(const ScanFile & scan, const ReadOptions & options)
  : m_All(options.labels == "all")
{
  std::set<std::int64_t> values;
  for (const Segment & segment : scan.segments)
  {
    m_Renumbered = !values.insert(segment.value).second || m_Renumbered;
  }
  for (const Segment & segment : scan.segments)
  {
    const std::int64_t value = m_Renumbered ? m_Largest + 1 : segment.value;
    m_Segments.emplace(std::pair(segment.layer, segment.value),
                       Label{ value, segment.name.empty() ? Text("label-", value) : segment.name, segment.color });
    m_Given.insert(value);
    m_Largest = std::max(m_Largest, value);
  }
  if (scan.segments.empty() && scan.voxels) // else nothing lies beside it: its voxels come from memory
  {
    m_Names = ReadLabelNames(scan.path);
  }
  for (std::size_t at = 0; !m_All && at <= options.labels.size();)
  {
    const std::size_t comma = std::min(options.labels.find(',', at), options.labels.size());
    std::string       wish(Trim(std::string_view(options.labels).substr(at, comma - at)));
    const auto        number = ParseInteger(wish);
    if (wish.empty() || (number && *number <= 0))
    {
      throw UsageError(
        Text("--labels '", Printable(options.labels), "': give all, or values above 0 or names (0 is background)"));
    }
    m_Wishes.push_back(std::move(wish));
    at = comma + 1;
  }
}

LabelBook::Label
LabelBook::Identify(std::size_t layer, std::int64_t value)
{
  const auto segment = m_Segments.find({ layer, value });
  if (segment != m_Segments.end())
  {
    return segment->second;
  }
  std::int64_t number = value;
  if (!m_Given.insert(number).second)
  {
    number = m_Largest + 1;
    m_Given.insert(number);
    m_Renumbered = true;
  }
  m_Largest = std::max(m_Largest, number);
  const auto name = m_Names.find(number);
  return { number, name == m_Names.end() ? Text("label-", number) : name->second };
}

bool
LabelBook::IsWanted(const Label & label) const
{
  return m_All ||
         std::any_of(m_Wishes.begin(), m_Wishes.end(), [&](const std::string & wish) { return IsMeant(wish, label); });
}

void
LabelBook::RefuseMissing(const std::filesystem::path & path,
                         const std::vector<Label> &    present,
                         const std::string &           where) const
{
  for (const std::string & wish : m_Wishes)
  {
    if (std::any_of(present.begin(), present.end(), [&](const Label & label) { return IsMeant(wish, label); }))
    {
      continue;
    }
    constexpr std::size_t shown = 12;
    std::string           list;
    for (std::size_t i = 0; i < std::min(shown, present.size()); ++i)
    {
      list += Text(i == 0 ? "" : ", ", present[i].value);
      if (present[i].name != Text("label-", present[i].value))
      {
        list += Text(" ", Printable(present[i].name, 40));
      }
    }
    Refuse(path,
           Text("there is no label '", Printable(wish), "'", where),
           Text("it has ", list, present.size() > shown ? Text(" and ", present.size() - shown, " more") : ""));
  }
}

} // namespace voxelcore
