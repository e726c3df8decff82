// NRRD headers as http://teem.sourceforge.net/nrrd/format.html defines them.

#include "NrrdHeader.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/ScanFile.h"

#include <algorithm>

namespace voxelcore
{
namespace
{

// Segmentations carry long keys (terminologies of each segment), but no header is longer than this.
constexpr std::size_t kLongestHeader = 64U << 20;

/** Text up to the blank line, or all of it. `end` receives where the data begin. */
std::string
HeaderText(const std::filesystem::path & path, std::size_t & end, bool & ended)
{
  const auto  stream = OpenBytes(path, 0, Packing::Plain);
  std::string text;
  std::size_t line = 0; // start of the line whose end is looked for
  std::size_t seen = 0; // no line ends between `line` and here
  for (;;)
  {
    const std::size_t before = text.size();
    text.resize(before + 65536);
    text.resize(before + stream->ReadSome(reinterpret_cast<std::byte *>(text.data() + before), 65536));
    if (before == 0 && !text.starts_with("NRRD"))
    {
      RefuseInput(path, "not an NRRD file (it does not begin with NRRD)", "check what kind of file it is");
    }
    for (std::size_t newline; (newline = text.find('\n', std::max(line, seen))) != std::string::npos;
         line = newline + 1)
    {
      if (newline == line || (newline == line + 1 && text[line] == '\r'))
      {
        end = newline + 1;
        ended = true;
        text.resize(line);
        return text;
      }
    }
    seen = text.size();
    if (text.size() == before)
    {
      end = text.size();
      ended = false;
      return text;
    }
    if (text.size() > kLongestHeader)
    {
      RefuseInput(path, "its header has no end", "the file is damaged: fetch or write it anew");
    }
  }
}

std::string
FieldName(std::string_view text)
{
  std::string name = LowerCase(text);
  name.erase(std::remove_if(name.begin(), name.end(), [](char c) { return c == ' ' || c == '\t'; }), name.end());
  return name;
}

std::string
Unescape(std::string_view text)
{
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    if (text[i] == '\\' && i + 1 < text.size())
    {
      ++i;
      out += text[i] == 'n' ? '\n' : text[i];
    }
    else
    {
      out += text[i];
    }
  }
  return out;
}

} // namespace

std::string_view
NrrdHeader::Field(std::string_view name) const
{
  const auto found = fields.find(std::string(name));
  return found == fields.end() ? std::string_view() : std::string_view(found->second);
}

NrrdHeader
ReadNrrdHeader(const std::filesystem::path & path)
{
  NrrdHeader        header;
  std::size_t       offset = 0;
  const std::string text = HeaderText(path, offset, header.ended);
  header.dataOffset = offset;
  bool inList = false;
  bool first = true;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t newline = std::min(text.find('\n', at), text.size());
    std::string_view  line = std::string_view(text).substr(at, newline - at);
    at = newline + 1;
    if (line.ends_with('\r'))
    {
      line.remove_suffix(1);
    }
    if (first)
    {
      first = false;
      if (line.size() != 8 || line.substr(0, 7) != "NRRD000" || line[7] < '1' || line[7] > '5')
      {
        RefuseInput(path,
                    Text("not an NRRD file of a known version ('", Printable(line, 16), "')"),
                    "save it as NRRD0004");
      }
      continue;
    }
    if (inList)
    {
      if (!Trim(line).empty())
      {
        header.dataFiles.emplace_back(Trim(line));
      }
      continue;
    }
    if (line.starts_with('#'))
    {
      continue;
    }
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos)
    {
      RefuseInput(path,
                  Text("a header line without meaning ('", Printable(line), "')"),
                  "the file is damaged: write it anew");
    }
    if (line.substr(colon + 1).starts_with('='))
    {
      header.keys[Unescape(line.substr(0, colon))] = Unescape(line.substr(colon + 2));
      continue;
    }
    std::string name = FieldName(line.substr(0, colon));
    // The two spellings the format allows.
    name = name == "centerings" ? "centers" : name;
    const std::string value(Trim(line.substr(colon + 1)));
    if (!header.fields.emplace(name, value).second)
    {
      RefuseInput(path, Text("the header field '", Printable(name), "' stands there twice"), "mend the header");
    }
    inList = name == "datafile" && LowerCase(value).starts_with("list");
  }
  return header;
}

std::vector<std::optional<std::vector<double>>>
ParseNrrdVectors(const std::filesystem::path & path, std::string_view field, std::string_view text)
{
  const auto refuse = [&]() {
    RefuseInput(path,
                Text("the header field '", field, "' makes no sense ('", Printable(text), "')"),
                "mend the header");
  };
  std::vector<std::optional<std::vector<double>>> vectors;
  for (std::size_t at = 0;;)
  {
    at = text.find_first_not_of(" \t", at);
    if (at == std::string_view::npos)
    {
      return vectors;
    }
    if (text[at] != '(')
    {
      const std::size_t end = std::min(text.find_first_of(" \t", at), text.size());
      if (LowerCase(text.substr(at, end - at)) != "none")
      {
        refuse();
      }
      vectors.emplace_back(std::nullopt);
      at = end;
      continue;
    }
    const std::size_t close = text.find(')', at);
    if (close == std::string_view::npos)
    {
      refuse();
    }
    std::vector<double> vector;
    for (std::size_t from = at + 1; from <= close;)
    {
      const std::size_t comma = std::min(text.find(',', from), close);
      const auto        value = ParseReal(Trim(text.substr(from, comma - from)));
      if (!value)
      {
        refuse();
      }
      vector.push_back(*value);
      from = comma + 1;
    }
    vectors.emplace_back(std::move(vector));
    at = close + 1;
  }
}

std::vector<std::string>
ParseNrrdQuoted(std::string_view text)
{
  std::vector<std::string> words;
  for (std::size_t at = text.find('"'); at != std::string_view::npos;)
  {
    const std::size_t end = text.find('"', at + 1);
    if (end == std::string_view::npos)
    {
      break;
    }
    words.emplace_back(text.substr(at + 1, end - at - 1));
    at = text.find('"', end + 1);
  }
  return words;
}

} // namespace voxelcore
