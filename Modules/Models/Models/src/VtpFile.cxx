#include "VtpFile.h"

#include "VtpPacking.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <array>
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

void
RequireForm(bool condition, const char * reason)
{
  if (!condition)
  {
    throw OtherForm{ { reason } };
  }
}

std::uint64_t
Number(std::string_view text)
{
  std::uint64_t number = 0;
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), number);
  RequireFit(error == std::errc() && end == text.data() + text.size(), "a number in its header is damaged");
  return number;
}

/** Whether every ampersand begins one of the five entities that XML knows, and no tag begins. */
bool
IsText(std::string_view text)
{
  for (std::size_t at = 0; at < text.size(); ++at)
  {
    const auto c = static_cast<unsigned char>(text[at]);
    if (c == '<' || c == 0x7F || (c < ' ' && c != '\n' && c != '\t' && c != '\r'))
    {
      return false;
    }
    if (c == '&')
    {
      constexpr std::array<std::string_view, 5> entities{ "&amp;", "&lt;", "&gt;", "&quot;", "&apos;" };
      const std::string_view                    rest = text.substr(at);
      if (std::none_of(entities.begin(), entities.end(), [&](std::string_view one) { return rest.starts_with(one); }))
      {
        return false;
      }
    }
  }
  return true;
}

struct Tag
{
  std::string                        name;
  std::map<std::string, std::string> attributes;
  bool                               closes = false;  ///< </name>
  bool                               isEmpty = false; ///< <name/>
};

/** The tag that begins at `at`, which moves behind it. */
Tag
ParseTag(std::string_view xml, std::size_t & at)
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
    RequireFit(at > begin && !(xml[begin] >= '0' && xml[begin] <= '9'), "its header is damaged");
    return std::string(xml.substr(begin, at - begin));
  };
  const auto skipBlanks = [&] {
    const std::size_t begin = at;
    while (at < xml.size() && (xml[at] == ' ' || xml[at] == '\n'))
    {
      ++at;
    }
    return at > begin;
  };
  Tag tag;
  ++at; // the bracket
  tag.closes = xml.substr(at, 1) == "/";
  at += tag.closes ? 1 : 0;
  tag.name = word();
  while (skipBlanks() && at < xml.size() && isNamePart(xml[at]))
  {
    const std::string key = word();
    RequireFit(!tag.closes && xml.substr(at, 2) == "=\"", "its header is damaged");
    const std::size_t begin = at + 2;
    const std::size_t end = xml.find('"', begin);
    RequireFit(end != std::string_view::npos && IsText(xml.substr(begin, end - begin)), "its header is damaged");
    RequireFit(tag.attributes.emplace(key, xml.substr(begin, end - begin)).second, "its header is damaged");
    at = end + 1;
  }
  tag.isEmpty = !tag.closes && xml.substr(at, 1) == "/";
  at += tag.isEmpty ? 1 : 0;
  RequireFit(xml.substr(at, 1) == ">", "its header is damaged");
  ++at;
  return tag;
}

/** Which elements stand in which; the file's own stands in none. */
bool
MayStandIn(const std::string & name, const std::string & parent)
{
  constexpr std::array<std::string_view, 6> ofPiece{ "PointData", "CellData", "Verts", "Lines", "Strips", "Polys" };
  const bool isPart = name == "Points" || std::count(ofPiece.begin(), ofPiece.end(), name) > 0;
  const bool isHolder =
    parent == "Points" || parent == "FieldData" || std::count(ofPiece.begin(), ofPiece.end(), parent) > 0;
  return (name == "VTKFile" && parent.empty()) || (name == "PolyData" && parent == "VTKFile") ||
         (name == "FieldData" && parent == "PolyData") || (name == "Piece" && parent == "PolyData") ||
         (isPart && parent == "Piece") || ((name == "DataArray" || name == "Array") && isHolder) ||
         (name == "InformationKey" && (parent == "DataArray" || parent == "Array")) ||
         (name == "Value" && parent == "InformationKey");
}

/** Bytes of a value; 1 for the letters of strings, 0 for what VTK does not know. */
std::uint64_t
BytesOf(const std::string & type)
{
  static const std::map<std::string, std::uint64_t> bytes{ { "Int8", 1 },    { "UInt8", 1 },  { "Int16", 2 },
                                                           { "UInt16", 2 },  { "Int32", 4 },  { "UInt32", 4 },
                                                           { "Int64", 8 },   { "UInt64", 8 }, { "Float32", 4 },
                                                           { "Float64", 8 }, { "String", 1 } };
  const auto                                        found = bytes.find(type);
  return found == bytes.end() ? 0 : found->second;
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
  RequireForm(tag != std::string::npos, "it holds no raw appended data, so it was not written by VoxelCore");
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
  CheckArrays();
}

void
VtpFile::ParseHeader(const std::string & xml)
{
  const auto isBlank = [&xml](std::size_t from, std::size_t to) {
    return xml.find_first_not_of(" \n", from) >= std::min(to, xml.size());
  };
  std::vector<std::string> open;
  std::size_t              at = xml.starts_with("<?xml") ? xml.find("?>") : 0;
  RequireFit(at != std::string::npos, "its header is damaged");
  at += at > 0 ? 2 : 0;
  while (true)
  {
    const std::size_t begin = std::min(xml.find('<', at), xml.size());
    const std::string around = open.empty() ? "" : open.back();
    RequireFit(isBlank(at, begin) || (around == "Value" && IsText(std::string_view(xml).substr(at, begin - at))),
               "its header is damaged");
    if (begin == xml.size())
    {
      break;
    }
    at = begin;
    Tag tag = ParseTag(xml, at);
    if (tag.closes)
    {
      RequireFit(around == tag.name, "its header is damaged");
      open.pop_back();
      continue;
    }
    if (tag.name == "VTKFile")
    {
      RequireFit(tag.attributes["type"] == "PolyData", "it is VTK data of another kind than polydata");
      const auto compressor = tag.attributes.find("compressor");
      m_IsPacked = compressor != tag.attributes.end();
      RequireForm(tag.attributes["byte_order"] == "LittleEndian" && tag.attributes["header_type"] == "UInt64" &&
                    (!m_IsPacked || compressor->second == kCompressor),
                  "it was written by another program than VoxelCore");
    }
    RequireFit(MayStandIn(tag.name, around), "its header is damaged");
    if (tag.name == "Piece")
    {
      RequireFit(m_Piece.empty(), "it has several pieces");
      m_Piece = tag.attributes;
    }
    else if (tag.name == "DataArray" || tag.name == "Array")
    {
      AddArray(around, tag.attributes);
    }
    if (!tag.isEmpty)
    {
      open.push_back(tag.name);
    }
  }
  // What is still open holds the appended data, which are the rest of the file.
  RequireFit(open == std::vector<std::string>{ "VTKFile" } && !m_Piece.empty(), "its header is damaged");
}

void
VtpFile::AddArray(const std::string & section, std::map<std::string, std::string> & attributes)
{
  RequireForm(attributes["format"] == "appended", "an array is not in the appended data");
  const auto number = [&](const char * name, std::uint64_t otherwise) {
    const auto found = attributes.find(name);
    return found == attributes.end() ? otherwise : Number(found->second);
  };
  const Array array{ attributes["type"],
                     number("NumberOfComponents", 1),
                     number("NumberOfTuples", 0),
                     Number(attributes["offset"]) };
  RequireFit(array.components > 0, "an array has no components");
  RequireFit(m_Arrays.emplace(std::pair(section, attributes["Name"]), array).second, "an array is there twice");
}

// Also those that nobody here asks for: a program that trusts them would read beyond them.
void
VtpFile::CheckArrays()
{
  const std::uint64_t points = PieceCount("NumberOfPoints");
  std::uint64_t       cells = 0;
  for (const char * kind : { "NumberOfVerts", "NumberOfLines", "NumberOfStrips", "NumberOfPolys" })
  {
    const std::uint64_t count = PieceCount(kind);
    RequireFit(count <= m_DataEnd - m_DataBegin, "its numbers of cells do not add up");
    cells += count;
  }
  for (const auto & [key, array] : m_Arrays)
  {
    const auto & [section, name] = key;
    const std::uint64_t size = BytesOf(array.type);
    RequireForm(size != 0, "an array has a type that VTK does not know");
    const std::uint64_t bytes = OpenBlock(array);
    RequireFit(bytes % size == 0 && bytes / size % array.components == 0, "an array is cut off");
    std::uint64_t tuples = bytes / size / array.components;
    if (array.type == "String")
    {
      const std::string text = ReadOpenedText(bytes);
      tuples = static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\0'));
      RequireFit(text.empty() || text.back() == '\0', "a text is damaged");
      RequireFit(tuples % array.components == 0, "an array is cut off");
      tuples /= array.components;
    }
    const bool isCells =
      section != "FieldData" && section != "PointData" && section != "CellData" && section != "Points";
    const bool fits = section == "FieldData"                          ? tuples == array.tuples
                      : section == "PointData" || section == "Points" ? tuples == points
                      : section == "CellData"                         ? tuples == cells
                      : name == "offsets"                             ? tuples == PieceCount("NumberOf" + section)
                                                                      : name == "connectivity";
    if (!fits || (isCells && array.components != 1))
    {
      throw UnfitFile{ "its array " + section + "/" + Printable(name) + " has the wrong length" };
    }
  }
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

void
VtpFile::ReadAt(std::uint64_t offset, char * to, std::uint64_t bytes)
{
  const std::uint64_t available = m_DataEnd - m_DataBegin;
  RequireFit(offset <= available && bytes <= available - offset, "an array lies beyond its end");
  m_File.seekg(static_cast<std::streamoff>(m_DataBegin + offset));
  RequireFit(bool(m_File.read(to, static_cast<std::streamsize>(bytes))), "it cannot be read");
}

std::uint64_t
VtpFile::OpenBlock(const Array & array)
{
  const auto number = [&](std::uint64_t index) {
    RequireFit(array.offset <= m_DataEnd - m_DataBegin, "an array lies beyond its end");
    std::array<char, 8> bytes;
    ReadAt(array.offset + bytes.size() * index, bytes.data(), bytes.size());
    std::uint64_t value = 0;
    for (std::size_t byte = bytes.size(); byte-- > 0;)
    {
      value = value << 8U | static_cast<unsigned char>(bytes[byte]);
    }
    return value;
  };
  const std::uint64_t available = m_DataEnd - m_DataBegin;
  const std::uint64_t first = number(0);
  m_Stretches.clear();
  if (!m_IsPacked)
  {
    RequireFit(first <= available, "an array lies beyond its end");
    m_Stretches.push_back({ first, first });
    m_Opened = array.offset + 8;
  }
  else
  {
    const std::uint64_t size = number(1);
    const std::uint64_t last = number(2);
    RequireFit(first <= available / 8, "its compressed blocks are damaged");
    std::uint64_t packed = 0;
    for (std::uint64_t block = 0; block < first; ++block)
    {
      const Stretch stretch{ number(3 + block), block + 1 == first && last > 0 ? last : size };
      // No more memory is asked for than the file can fill.
      RequireFit(stretch.packed <= available && stretch.bytes / kMostInflated <= stretch.packed,
                 "its compressed blocks are damaged");
      packed += stretch.packed;
      RequireFit(packed <= available, "an array lies beyond its end");
      m_Stretches.push_back(stretch);
    }
    m_Opened = array.offset + 8 * (3 + first);
  }
  std::uint64_t packed = 0;
  std::uint64_t bytes = 0;
  for (const Stretch & stretch : m_Stretches)
  {
    packed += stretch.packed;
    bytes += stretch.bytes;
  }
  RequireFit(m_Opened <= available && packed <= available - m_Opened, "an array lies beyond its end");
  return bytes;
}

void
VtpFile::ReadOpened(char * to)
{
  std::string   packed;
  std::uint64_t at = m_Opened;
  for (const Stretch & stretch : m_Stretches)
  {
    if (m_IsPacked)
    {
      packed.resize(stretch.packed);
      ReadAt(at, packed.data(), packed.size());
      RequireFit(Inflate(packed, to, stretch.bytes), "its compressed blocks are damaged");
    }
    else
    {
      ReadAt(at, to, stretch.bytes);
    }
    at += stretch.packed;
    to += stretch.bytes;
  }
}

std::string
VtpFile::ReadOpenedText(std::uint64_t bytes)
{
  std::string text(bytes, '\0');
  ReadOpened(text.data());
  return text;
}

template <typename Value>
std::vector<Value>
VtpFile::ReadBlock(const Array & array)
{
  const std::uint64_t bytes = OpenBlock(array);
  RequireFit(bytes % sizeof(Value) == 0, "an array is cut off");
  std::vector<Value> values(bytes / sizeof(Value));
  ReadOpened(reinterpret_cast<char *>(values.data()));
  if constexpr (std::endian::native == std::endian::big)
  {
    for (Value & value : values)
    {
      auto * raw = reinterpret_cast<char *>(&value);
      std::reverse(raw, raw + sizeof(value));
    }
  }
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
    throw OtherForm{ { "its array " + section + "/" + name + " has the wrong type" } };
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
  std::string text = ReadOpenedText(OpenBlock(array));
  RequireFit(!text.empty() && text.find('\0') == text.size() - 1, "a text is damaged");
  text.pop_back();
  return text;
}

} // namespace voxelcore
