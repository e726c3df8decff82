#include "VtpFile.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <string_view>

namespace voxelcore
{
namespace
{

constexpr std::string_view kDataTag = "<AppendedData encoding=\"raw\">";
constexpr std::string_view kEnding = "\n  </AppendedData>\n</VTKFile>\n";
constexpr std::uint64_t    kLongestHeader = std::uint64_t{ 1 } << 20; // ours takes 4 KB

std::uint64_t
Number(std::string_view text)
{
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  RequireFit(error == std::errc() && end == text.data() + text.size(), "a number in its header is damaged");
  return number;
}

/** The attributes of the tag that begins at `at`, which moves behind the tag. */
std::map<std::string, std::string>
ParseTag(std::string_view xml, std::size_t & at, std::string & name)
{
  const auto isNamePart = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  const auto word = [&] {
    const std::size_t begin = at;
    while (at < xml.size() && isNamePart(xml[at]))
    {
      ++at;
    }
    return std::string(xml.substr(begin, at - begin));
  };
  const auto skipBlanks = [&] {
    while (at < xml.size() && (xml[at] == ' ' || xml[at] == '\n'))
    {
      ++at;
    }
  };
  std::map<std::string, std::string> attributes;
  ++at; // the bracket
  const bool closes = at < xml.size() && xml[at] == '/';
  at += closes ? 1 : 0;
  name = word();
  name.insert(0, closes ? 1 : 0, '/');
  for (skipBlanks(); at < xml.size() && isNamePart(xml[at]); skipBlanks())
  {
    const std::string key = word();
    RequireFit(xml.substr(at, 2) == "=\"", "its header is damaged");
    const std::size_t begin = at + 2;
    const std::size_t end = xml.find('"', begin);
    RequireFit(end != std::string_view::npos, "its header is damaged");
    RequireFit(attributes.emplace(key, xml.substr(begin, end - begin)).second, "its header is damaged");
    at = end + 1;
  }
  at += xml.substr(at, 1) == "/" ? 1 : 0;
  RequireFit(xml.substr(at, 1) == ">", "its header is damaged");
  ++at;
  return attributes;
}

} // namespace

VtpFile::VtpFile(const std::filesystem::path & path)
  : m_File(path, std::ios::binary)
{
  RequireFit(m_File.is_open(), "it cannot be opened");
  m_File.seekg(0, std::ios::end);
  const auto  size = static_cast<std::uint64_t>(m_File.tellg());
  std::string header(std::min(size, kLongestHeader), '\0');
  m_File.seekg(0);
  RequireFit(bool(m_File.read(header.data(), static_cast<std::streamsize>(header.size()))), "it cannot be read");
  RequireFit(header.rfind("<VTKFile", 0) == 0 || header.rfind("<?xml", 0) == 0, "it is no VTK file in XML");

  const std::size_t tag = header.find(kDataTag);
  RequireFit(tag != std::string::npos, "it holds no raw appended data, so it was not written by VoxelCore");
  const std::size_t mark = header.find_first_not_of(" \n", tag + kDataTag.size());
  RequireFit(mark != std::string::npos && header[mark] == '_', "its appended data are damaged");
  m_DataBegin = mark + 1;
  std::string ending(kEnding.size(), '\0');
  RequireFit(size >= m_DataBegin + kEnding.size(), "it ends too early");
  m_DataEnd = size - kEnding.size();
  m_File.seekg(static_cast<std::streamoff>(m_DataEnd));
  RequireFit(m_File.read(ending.data(), static_cast<std::streamsize>(ending.size())) && ending == kEnding,
             "it ends too early");
  ParseHeader(header.substr(0, tag));
}

void
VtpFile::ParseHeader(const std::string & xml)
{
  std::string section;
  std::string name;
  bool        isPolyData = false;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at))
  {
    if (xml.compare(at, 2, "<?") == 0)
    {
      at += 2;
      continue;
    }
    auto attributes = ParseTag(xml, at, name);
    if (name == "VTKFile")
    {
      isPolyData = attributes["type"] == "PolyData";
      RequireFit(isPolyData, "it is VTK data of another kind than polydata");
      RequireFit(attributes["byte_order"] == "LittleEndian" && attributes["header_type"] == "UInt64" &&
                   !attributes.contains("compressor"),
                 "it was written by another program than VoxelCore");
    }
    else if (name == "Piece")
    {
      RequireFit(m_Piece.empty(), "it has several pieces");
      m_Piece = attributes;
    }
    else if (name == "DataArray" || name == "Array")
    {
      RequireFit(attributes["format"] == "appended", "an array is not in the appended data");
      const std::uint64_t components =
        attributes.contains("NumberOfComponents") ? Number(attributes["NumberOfComponents"]) : 1;
      RequireFit(components > 0, "an array has no components");
      const Array array{ attributes["type"], components, Number(attributes["offset"]) };
      RequireFit(m_Arrays.emplace(std::pair(section, attributes["Name"]), array).second, "an array is there twice");
    }
    else if (!name.empty() && name[0] != '/')
    {
      section = name;
    }
  }
  RequireFit(isPolyData && !m_Piece.empty(), "its header is damaged");
}

std::uint64_t
VtpFile::PieceCount(const std::string & attribute) const
{
  const auto found = m_Piece.find(attribute);
  RequireFit(found != m_Piece.end(), "its header is damaged");
  // VTK leaves room behind a number it fills in later, but outside the quotes.
  return Number(found->second);
}

const VtpFile::Array &
VtpFile::Find(const std::string & section, const std::string & name) const
{
  const auto found = m_Arrays.find({ section, name });
  if (found == m_Arrays.end())
  {
    throw UnfitFile{ "its array " + section + "/" + name + " is missing" };
  }
  return found->second;
}

template <typename Value>
std::vector<Value>
VtpFile::ReadBlock(const Array & array)
{
  const std::uint64_t available = m_DataEnd - m_DataBegin;
  std::uint64_t       bytes = 0;
  RequireFit(available >= sizeof(bytes) && array.offset <= available - sizeof(bytes), "an array lies beyond its end");
  m_File.seekg(static_cast<std::streamoff>(m_DataBegin + array.offset));
  const auto read = [&](void * to, std::uint64_t size) {
    RequireFit(bool(m_File.read(static_cast<char *>(to), static_cast<std::streamsize>(size))), "it cannot be read");
  };
  const auto order = [](auto & value) {
    if constexpr (std::endian::native == std::endian::big)
    {
      auto * raw = reinterpret_cast<char *>(&value);
      std::reverse(raw, raw + sizeof(value));
    }
  };
  read(&bytes, sizeof(bytes));
  order(bytes);
  RequireFit(bytes <= available - sizeof(bytes) - array.offset && bytes % sizeof(Value) == 0,
             "an array lies beyond its end");
  std::vector<Value> values(bytes / sizeof(Value));
  read(values.data(), bytes);
  std::for_each(values.begin(), values.end(), order);
  return values;
}

template <typename Value>
std::vector<Value>
VtpFile::Read(const std::string & section, const std::string & name, int components)
{
  const Array & array = Find(section, name);
  const char *  type = std::is_same_v<Value, double> ? "Float64" : "Int64";
  if (array.type != type || array.components != static_cast<std::uint64_t>(components))
  {
    throw UnfitFile{ "its array " + section + "/" + name + " has the wrong type" };
  }
  std::vector<Value> values = ReadBlock<Value>(array);
  RequireFit(values.size() % array.components == 0, "an array is cut off");
  return values;
}

template std::vector<double>
VtpFile::Read<double>(const std::string &, const std::string &, int);
template std::vector<std::int64_t>
VtpFile::Read<std::int64_t>(const std::string &, const std::string &, int);

std::vector<std::int64_t>
VtpFile::ReadIndices(const std::string & section, const std::string & name)
{
  const Array & array = Find(section, name);
  if (array.type == "Int32" && array.components == 1)
  {
    const std::vector<std::int32_t> values = ReadBlock<std::int32_t>(array);
    return { values.begin(), values.end() };
  }
  return Read<std::int64_t>(section, name);
}

std::string
VtpFile::ReadText(const std::string & section, const std::string & name)
{
  const Array & array = Find(section, name);
  if (array.type != "String")
  {
    throw UnfitFile{ "its array " + section + "/" + name + " has the wrong type" };
  }
  const std::vector<char> text = ReadBlock<char>(array);
  RequireFit(!text.empty() && std::find(text.begin(), text.end(), '\0') == text.end() - 1, "a text is damaged");
  return { text.begin(), text.end() - 1 };
}

} // namespace voxelcore
