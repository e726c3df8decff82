#include "LabelList.h"

#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/FormatOpeners.h"
#include "voxelcore/Imaging/LabelVolume.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>

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

/** Three words that are whole numbers from 0 to 255, as a colour. */
std::optional<Color>
ColorFrom(const std::vector<std::string_view> & words, std::size_t first)
{
  Color color{};
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto value = first + k < words.size() ? ParseInteger(words[first + k]) : std::nullopt;
    if (!value || *value < 0 || *value > 255)
    {
      return std::nullopt;
    }
    color[k] = static_cast<double>(*value) / 255;
  }
  return color;
}

/** One of ITK-SNAP's lines: six numbers, then the name in quotes. */
std::optional<ListedLabel>
SnapLine(const NamedLine & line)
{
  const auto quote = line.rest.find('"');
  if (quote == std::string::npos || line.rest.size() < quote + 2 || line.rest.back() != '"')
  {
    return std::nullopt;
  }
  const auto words = Words(std::string_view(line.rest).substr(0, quote));
  const auto color = ColorFrom({ words.begin(), words.end() }, 0);
  if (words.size() != 6 || !color ||
      !std::all_of(words.begin(), words.end(), [](const auto & word) { return ParseReal(word).has_value(); }))
  {
    return std::nullopt;
  }
  return ListedLabel{ Printable(Trim(std::string_view(line.rest).substr(quote + 1, line.rest.size() - quote - 2)), 200),
                      color };
}

/** A line of which the last `columns` words are numbers. */
ListedLabel
PlainLine(const NamedLine & line, std::size_t columns)
{
  ListedLabel      label;
  std::string_view text = line.rest;
  const auto       words = Words(line.rest);
  if (columns == 4) // red, green, blue and transparency
  {
    label.color = ColorFrom({ words.begin(), words.end() }, words.size() - columns);
  }
  if (line.tab)
  {
    text = text.substr(0, text.find('\t'));
  }
  else
  {
    const auto last = words[words.size() - 1 - columns];
    text = text.substr(0, static_cast<std::size_t>(last.data() + last.size() - text.data()));
  }
  if (text.size() > 1 && text.front() == '"' && text.back() == '"')
  {
    text = text.substr(1, text.size() - 2);
  }
  label.name = Printable(Trim(text), 200);
  return label;
}

std::map<std::int64_t, ListedLabel>
ReadTextList(const std::filesystem::path & path)
{
  const auto                          lines = ReadLines(path);
  std::map<std::int64_t, ListedLabel> labels;
  std::size_t                         columns = lines.empty() ? 0 : lines.front().numbers;
  for (const NamedLine & line : lines)
  {
    columns = std::min(columns, line.numbers);
  }
  for (const NamedLine & line : lines)
  {
    const auto snap = SnapLine(line);
    labels.emplace(line.value, snap ? *snap : PlainLine(line, columns));
  }
  return labels;
}

/** MRIcron's table: all reds, all greens, all blues. Black is what stands there where nobody chose a colour. */
std::map<std::int64_t, ListedLabel>
ReadByteTable(const std::filesystem::path & path)
{
  constexpr std::size_t               kColors = 256;
  std::string                         bytes(3 * kColors, '\0');
  std::map<std::int64_t, ListedLabel> labels;
  std::ifstream                       file(path, std::ios::binary);
  if (file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
  {
    for (std::size_t i = 1; i < kColors; ++i)
    {
      Color color{};
      for (std::size_t k = 0; k < 3; ++k)
      {
        color[k] = static_cast<unsigned char>(bytes[k * kColors + i]) / 255.0;
      }
      if (color != Color{})
      {
        labels[static_cast<std::int64_t>(i)].color = color;
      }
    }
  }
  return labels;
}

bool
MayBeList(const std::filesystem::path & path)
{
  std::error_code error;
  return std::filesystem::is_regular_file(path, error) && std::filesystem::file_size(path, error) <= kLargestList &&
         !error;
}

std::filesystem::path
FolderOf(const std::filesystem::path & scan)
{
  return scan.has_filename() ? scan.parent_path() : scan.parent_path().parent_path();
}

/** The table that FreeSurfer comes with, copied beside a scan or where it is installed. */
std::optional<std::filesystem::path>
FreeSurferTable(const std::filesystem::path & folder)
{
  const char * const home = std::getenv("FREESURFER_HOME");
  for (const auto & place : { folder, std::filesystem::path(home != nullptr ? home : "") })
  {
    const auto path = place / "FreeSurferColorLUT.txt";
    if ((place == folder || !place.empty()) && MayBeList(path))
    {
      return path;
    }
  }
  return std::nullopt;
}

/** Those of the scan's own name, the first to say something first. */
std::vector<std::filesystem::path>
ListsNamedAs(const std::filesystem::path & scan)
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
  const std::string                  stem = std::filesystem::path(whole).stem().string();
  std::vector<std::filesystem::path> lists;
  for (const char * extension : { ".txt", ".label", ".ctab", ".lut" })
  {
    for (const std::string & name : { whole + extension, stem + extension })
    {
      if (MayBeList(FolderOf(scan) / name))
      {
        lists.push_back(FolderOf(scan) / name);
      }
    }
  }
  return lists;
}

} // namespace

std::vector<std::filesystem::path>
LabelListFiles(const std::filesystem::path & scan)
{
  auto files = ListsNamedAs(scan);
  if (ScanKindOf(scan) == ScanKind::Mgh)
  {
    if (auto table = FreeSurferTable(FolderOf(scan)))
    {
      files.push_back(std::move(*table));
    }
  }
  return files;
}

std::map<std::int64_t, ListedLabel>
ReadLabelList(const std::filesystem::path & scan)
{
  std::map<std::int64_t, ListedLabel> labels;
  bool                                hasNames = false;
  bool                                hasColors = false;
  for (const std::filesystem::path & path : ListsNamedAs(scan))
  {
    std::error_code error;
    const bool      bytes = path.extension() == ".lut" && std::filesystem::file_size(path, error) == 768;
    const auto      list = bytes ? ReadByteTable(path) : ReadTextList(path);
    const auto      some = [&list](auto has) {
      return std::any_of(list.begin(), list.end(), [&](const auto & entry) { return has(entry.second); });
    };
    const bool takeNames = !hasNames && some([](const ListedLabel & one) { return !one.name.empty(); });
    const bool takeColors = !hasColors && some([](const ListedLabel & one) { return one.color.has_value(); });
    for (const auto & [value, one] : list)
    {
      if (takeNames)
      {
        labels[value].name = one.name;
      }
      if (takeColors)
      {
        labels[value].color = one.color;
      }
    }
    hasNames = hasNames || takeNames;
    hasColors = hasColors || takeColors;
  }
  if (labels.empty() && ScanKindOf(scan) == ScanKind::Mgh)
  {
    const auto table = FreeSurferTable(FolderOf(scan));
    return table ? ReadTextList(*table) : labels;
  }
  return labels;
}

} // namespace voxelcore
