#include "VtpFile.h"

#include "VtpPacking.h"
#include "XmlUnpacking.h"
#include "voxelcore/Base/Base64.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Base/XmlWalk.h"

#include <algorithm>
#include <array>
#include <bit>
#include <type_traits>

namespace voxelcore
{
namespace
{

constexpr std::string_view kBlanks = " \r\n\t";
/** As VTK's writer ends a file with appended data. */
constexpr std::string_view kEnding = "\n  </AppendedData>\n</VTKFile>\n";

std::uint64_t
NumberOf(const XmlAttributes & attributes, const std::string & name, std::int64_t otherwise)
{
  const auto found = attributes.find(name);
  const auto number =
    found == attributes.end() ? otherwise : ParseNumber<std::int64_t>(found->second, { 'i', sizeof(std::int64_t) });
  RequireFit(number >= 0, "counts that cannot be");
  return static_cast<std::uint64_t>(number);
}

/** The type of that name; 0 bytes where it is none. */
NumberType
TypeNamed(std::string_view name)
{
  static constexpr std::array<std::pair<std::string_view, NumberType>, 11> types{ { { "Int8", { 'i', 1 } },
                                                                                    { "UInt8", { 'u', 1 } },
                                                                                    { "Int16", { 'i', 2 } },
                                                                                    { "UInt16", { 'u', 2 } },
                                                                                    { "Int32", { 'i', 4 } },
                                                                                    { "UInt32", { 'u', 4 } },
                                                                                    { "Int64", { 'i', 8 } },
                                                                                    { "UInt64", { 'u', 8 } },
                                                                                    { "Float32", { 'f', 4 } },
                                                                                    { "Float64", { 'f', 8 } },
                                                                                    { "String", { 'u', 1 } } } };
  const auto * const found = std::find_if(types.begin(), types.end(), [&](const auto & t) { return t.first == name; });
  return found == types.end() ? NumberType{} : found->second;
}

bool
IsArray(std::string_view tag)
{
  return tag == "DataArray" || tag == "Array";
}

/** Which tags VTK's writer puts into which; the file's own stands in none. */
bool
MayStandIn(const std::string & name, const std::string & parent)
{
  constexpr std::array<std::string_view, 6> ofPiece{ "PointData", "CellData", "Verts", "Lines", "Strips", "Polys" };
  const bool isPart = name == "Points" || std::count(ofPiece.begin(), ofPiece.end(), name) > 0;
  const bool isHolder =
    parent == "Points" || parent == "FieldData" || std::count(ofPiece.begin(), ofPiece.end(), parent) > 0;
  return (name == "VTKFile" && parent.empty()) || (name == "PolyData" && parent == "VTKFile") ||
         (name == "AppendedData" && parent == "VTKFile") || (name == "FieldData" && parent == "PolyData") ||
         (name == "Piece" && parent == "PolyData") || (isPart && parent == "Piece") || (IsArray(name) && isHolder) ||
         (name == "InformationKey" && IsArray(parent)) || (name == "Value" && parent == "InformationKey");
}

} // namespace

std::uint64_t
VtpPiece::Count(const std::string & name) const
{
  return NumberOf(counts, name, 0);
}

/** Fills a file's fields from its tags. */
class VtpFile::Header : private XmlWalk
{
public:
  Header(VtpFile & file, bool withData)
    : m_File(file)
    , m_WithData(withData)
  {
    const std::string trouble = Walk([&](char * to, std::size_t most) {
      file.m_File.read(to, static_cast<std::streamsize>(most));
      return static_cast<std::size_t>(file.m_File.gcount());
    });
    file.m_File.clear();
    if (!trouble.empty())
    {
      throw UnfitFile{ trouble };
    }
    RequireFit(m_IsPolyData, "it holds no polydata");
  }
  using XmlWalk::EndedAt;

private:
  void
  Begin(const std::string & name, const XmlAttributes & attributes, const std::string & within) override
  {
    m_File.m_IsOrderly = m_File.m_IsOrderly && MayStandIn(name, within);
    if (name == "VTKFile")
    {
      ReadEncoding(attributes, within);
    }
    else if (name == "Piece")
    {
      RequireFit(within == "PolyData", "a piece is out of place");
      m_File.pieces.push_back({ attributes, {} });
    }
    else if (name == "AppendedData")
    {
      const std::string encoding = AttributeOf(attributes, "encoding");
      RequireFit(encoding == "raw" || encoding == "base64", "its appended data are neither raw nor base64");
      m_File.m_IsAppendedRaw = encoding == "raw";
      EndHere();
    }
    else if (IsArray(name))
    {
      AddArray(within, attributes);
    }
  }

  void
  End(const std::string & name, const std::string &) override
  {
    m_Array = IsArray(name) ? nullptr : m_Array;
  }

  void
  Text(std::string_view text, const std::string & tag) override
  {
    if (m_Array != nullptr && IsArray(tag)) // not what keys within it say
    {
      m_Array->text.append(text);
    }
    else if (tag != "Value" && text.find_first_not_of(kBlanks) != std::string_view::npos)
    {
      m_File.m_IsOrderly = false;
    }
  }

  void
  ReadEncoding(const XmlAttributes & attributes, const std::string & within)
  {
    const std::string order = AttributeOf(attributes, "byte_order", "LittleEndian");
    const std::string head = AttributeOf(attributes, "header_type", "UInt32");
    RequireFit(within.empty() && AttributeOf(attributes, "type") == "PolyData", "it holds no polydata");
    RequireFit(order == "LittleEndian" || order == "BigEndian", "an unknown order of bytes");
    RequireFit(head == "UInt32" || head == "UInt64", "headers of an unknown type");
    m_IsPolyData = true;
    m_File.m_IsBigEndian = order == "BigEndian";
    m_File.m_Head = TypeNamed(head);
    m_File.m_Compressor = AttributeOf(attributes, "compressor");
  }

  void
  AddArray(const std::string & section, const XmlAttributes & attributes)
  {
    const bool arePoints = section == "Points";
    const bool areCells = section == "Polys" || section == "Strips" || section == "Verts" || section == "Lines";
    const bool areValues = section == "PointData" || section == "CellData" || section == "FieldData";
    const bool isOfMesh = arePoints || section == "Polys" || section == "Strips";
    if (!isOfMesh && (!m_WithData || !(areCells || areValues)))
    {
      return;
    }
    RequireFit(section == "FieldData" || !m_File.pieces.empty(), "an array is out of place");
    const std::string type = AttributeOf(attributes, "type");
    VtpArray          array{ AttributeOf(attributes, "format", "ascii"),
                    TypeNamed(type),
                    NumberOf(attributes, "offset", 0),
                    NumberOf(attributes, "NumberOfComponents", 1),
                    NumberOf(attributes, "NumberOfTuples", 0),
                    type == "String",
                    {} };
    RequireFit(areValues || array.components == (arePoints ? 3 : 1), "an array has the wrong number of components");
    VtpArrays &       arrays = section == "FieldData" ? m_File.fields : m_File.pieces.back().arrays;
    const std::string name = arePoints ? "" : AttributeOf(attributes, "Name");
    const auto [place, isNew] = arrays.emplace(std::pair(section, name), std::move(array));
    RequireFit(isNew || areValues, "an array is there twice");
    m_Array = isNew ? &place->second : nullptr; // as VTK, which finds the first of a name
    m_File.m_IsOrderly = m_File.m_IsOrderly && isNew;
  }

  VtpFile &  m_File;
  bool       m_WithData;
  bool       m_IsPolyData = false;
  VtpArray * m_Array = nullptr;
};

/** Where an array's bytes come from, run by run. */
class VtpFile::Source
{
public:
  Source(VtpFile & file, const VtpArray & array)
    : m_File(file)
    , m_IsAppended(array.format == "appended")
    , m_IsBase64(!m_IsAppended || !file.m_IsAppendedRaw)
  {
    if (m_IsAppended)
    {
      const std::uint64_t available = file.m_DataEnd - file.m_DataBegin;
      RequireFit(array.offset <= available, "an array lies beyond its end");
      m_At = file.m_DataBegin + array.offset;
      m_Stored = available - array.offset;
      return;
    }
    RequireFit(array.format == "binary", "an array has an unknown format");
    m_Text = array.text;
    m_Stored = m_Text.size();
  }

  /** How many bytes are there at most. */
  std::uint64_t
  Left() const
  {
    return m_IsBase64 ? m_Stored / 4 * 3 : m_Stored;
  }

  /** The next bytes are one run, which in base64 begins with the next four letters. */
  void
  BeginRun(std::uint64_t bytes)
  {
    RequireFit(bytes <= Left(), "an array lies beyond its end");
    if (!m_IsBase64)
    {
      return;
    }
    std::string      appended(m_IsAppended ? (bytes + 2) / 3 * 4 : 0, '\0');
    std::string_view text = m_Text;
    if (m_IsAppended)
    {
      ReadFile(appended.data(), appended.size());
      text = appended;
    }
    m_Run = FromBase64(text, bytes);
    m_RunAt = 0;
    RequireFit(m_Run.size() == bytes, "its base64 is damaged");
    if (!m_IsAppended)
    {
      m_Text = text;
      m_Stored = text.size();
    }
  }

  /** The next bytes of the run. */
  void
  Take(char * to, std::uint64_t count)
  {
    if (!m_IsBase64)
    {
      ReadFile(to, count);
      return;
    }
    m_Run.copy(to, count, m_RunAt);
    m_RunAt += count;
  }

  std::string
  Take(std::uint64_t count)
  {
    std::string bytes(count, '\0');
    Take(bytes.data(), count);
    return bytes;
  }

private:
  void
  ReadFile(char * to, std::uint64_t count)
  {
    RequireFit(count <= m_Stored, "an array lies beyond its end");
    m_File.m_File.seekg(static_cast<std::streamoff>(m_At));
    RequireFit(bool(m_File.m_File.read(to, static_cast<std::streamsize>(count))), "it cannot be read");
    m_At += count;
    m_Stored -= count;
  }

  VtpFile &        m_File;
  bool             m_IsAppended;
  bool             m_IsBase64;
  std::string_view m_Text;       ///< the rest of an array that is not appended
  std::uint64_t    m_At = 0;     ///< in the file, of one that is
  std::uint64_t    m_Stored = 0; ///< bytes or letters from there on
  std::string      m_Run;        ///< of base64
  std::size_t      m_RunAt = 0;
};

struct VtpFile::Blocks
{
  struct Block
  {
    std::uint64_t stored;
    std::uint64_t bytes;
  };

  Source             source; ///< before the first
  std::vector<Block> blocks;
  std::uint64_t      bytes = 0; ///< of all, unpacked
};

VtpFile::VtpFile(const std::filesystem::path & path, Content content)
  : m_File(path, std::ios::binary)
{
  RequireFit(m_File.is_open(), "it cannot be opened");
  std::string begin(8, '\0');
  m_File.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  RequireFit(m_File.gcount() > 0, "it is empty");
  RequireFit(begin.starts_with("<VTKFile") || begin.starts_with("<?xml"), "it is no VTK file in XML");
  m_File.seekg(0, std::ios::end);
  const auto size = static_cast<std::uint64_t>(m_File.tellg());
  m_File.seekg(0);
  const bool          withData = content == Content::All;
  const std::uint64_t dataTag = Header(*this, withData).EndedAt();
  if (dataTag > 0)
  {
    const auto part = [&](std::uint64_t from, std::uint64_t to) {
      std::string text(to - from, '\0');
      m_File.seekg(static_cast<std::streamoff>(from));
      RequireFit(bool(m_File.read(text.data(), static_cast<std::streamsize>(text.size()))), "it cannot be read");
      return text;
    };
    constexpr std::uint64_t room = 256; // what stands around the data, blanks included
    const std::string       first = part(dataTag, std::min(size, dataTag + room));
    const std::size_t       mark = first.find_first_not_of(kBlanks);
    RequireFit(mark != std::string::npos && first[mark] == '_', "its appended data are damaged");
    m_DataBegin = dataTag + mark + 1;
    const std::uint64_t lastAt = std::max(m_DataBegin, std::max(size, room) - room);
    const std::string   lastText = part(lastAt, size);
    std::string_view    last = lastText;
    for (const std::string_view ending : { "</VTKFile>", "</AppendedData>" })
    {
      last = last.substr(0, last.find_last_not_of(kBlanks) + 1);
      RequireFit(last.ends_with(ending), "it ends too early");
      last.remove_suffix(ending.size());
    }
    m_DataEnd = lastAt + last.size();
    m_IsOrderly = m_IsOrderly && lastText.ends_with(kEnding);
  }
  if (withData && IsOurs())
  {
    CheckOurs();
  }
}

bool
VtpFile::IsOurs() const
{
  const auto areOurs = [](const VtpArrays & arrays) {
    return std::all_of(arrays.begin(), arrays.end(), [](const auto & entry) {
      return entry.second.format == "appended" && entry.second.type.bytes > 0;
    });
  };
  return m_DataBegin > 0 && m_IsAppendedRaw && !m_IsBigEndian && m_Head.bytes == sizeof(std::uint64_t) &&
         (m_Compressor.empty() || m_Compressor == kCompressor) && areOurs(fields) &&
         std::all_of(pieces.begin(), pieces.end(), [&](const VtpPiece & piece) { return areOurs(piece.arrays); });
}

std::uint64_t
VtpFile::MostAppended() const
{
  const std::uint64_t stored = m_DataEnd - m_DataBegin;
  return stored > 0 && !m_Compressor.empty() ? stored * MostGain(m_Compressor) : stored;
}

// Also of arrays that nobody here asks for: a program that trusts their counts would read beyond them.
void
VtpFile::CheckOurs()
{
  RequireFit(pieces.size() == 1, "it has several pieces, or none");
  RequireFit(m_IsOrderly, "its header or its end is damaged");
  const VtpPiece &    piece = pieces.front();
  const std::uint64_t points = piece.Count("NumberOfPoints");
  std::uint64_t       cells = 0;
  for (const char * kind : { "NumberOfPoints", "NumberOfVerts", "NumberOfLines", "NumberOfStrips", "NumberOfPolys" })
  {
    RequireFit(piece.counts.contains(kind), "its header is damaged");
    const std::uint64_t count = piece.Count(kind);
    RequireFit(count <= MostAppended(), "its numbers of cells do not add up");
    cells += kind == std::string_view("NumberOfPoints") ? 0 : count;
  }
  const auto check = [&](const std::string & section, const std::string & name, const VtpArray & array) {
    RequireFit(array.text.find_first_not_of(kBlanks) == std::string::npos, "its header is damaged");
    RequireFit(array.components > 0, "an array has no components");
    std::uint64_t values = Open(array).bytes;
    RequireFit(values % array.type.bytes == 0, "an array is cut off");
    values /= array.type.bytes;
    if (array.isText)
    {
      const std::string text = ReadTexts(array);
      RequireFit(text.empty() || text.back() == '\0', "a text is damaged");
      values = static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\0'));
    }
    RequireFit(values % array.components == 0, "an array is cut off");
    const std::uint64_t tuples = values / array.components;
    const bool          fits = section == "FieldData"                          ? tuples == array.tuples
                               : section == "PointData" || section == "Points" ? tuples == points
                               : section == "CellData"                         ? tuples == cells
                               : name == "offsets" ? tuples == piece.Count("NumberOf" + section)
                                                   : name == "connectivity";
    if (!fits)
    {
      throw UnfitFile{ "its array " + section + "/" + (section == "Points" ? section : Printable(name)) +
                       " has the wrong length" };
    }
  };
  for (const VtpArrays * const arrays : { &std::as_const(fields), &piece.arrays })
  {
    for (const auto & [key, array] : *arrays)
    {
      check(key.first, key.second, array);
    }
  }
}

VtpFile::Blocks
VtpFile::Open(const VtpArray & array)
{
  Blocks     opened{ Source(*this, array), {}, 0 };
  Source &   source = opened.source;
  Source     ahead(*this, array);
  const auto number = [&](const std::string & head, std::uint64_t index) {
    const char * const at = head.data() + index * m_Head.bytes;
    return static_cast<std::uint64_t>(LoadNumber<std::int64_t>(at, m_Head, m_IsBigEndian));
  };
  if (m_Compressor.empty())
  {
    ahead.BeginRun(m_Head.bytes);
    const std::uint64_t bytes = number(ahead.Take(m_Head.bytes), 0);
    RequireFit(bytes <= source.Left() - m_Head.bytes, "an array lies beyond its end");
    source.BeginRun(m_Head.bytes + bytes);
    (void)source.Take(m_Head.bytes);
    opened.blocks.push_back({ bytes, bytes });
    opened.bytes = bytes;
    return opened;
  }
  // Blocks of equal size but the last; each size, and each packed size, stands before them.
  ahead.BeginRun(3 * m_Head.bytes);
  const std::string   sizes = ahead.Take(3 * m_Head.bytes);
  const std::uint64_t count = number(sizes, 0);
  RequireFit(count <= source.Left() / m_Head.bytes, "its compressed blocks are damaged");
  source.BeginRun((3 + count) * m_Head.bytes);
  const std::string   head = source.Take((3 + count) * m_Head.bytes);
  const std::uint64_t mostGain = MostGain(m_Compressor);
  std::uint64_t       stored = 0;
  for (std::uint64_t i = 0; i < count; ++i)
  {
    const bool          isShort = i + 1 == count && number(sizes, 2) != 0;
    const Blocks::Block block{ number(head, 3 + i), number(sizes, isShort ? 2 : 1) };
    // No more memory is asked for than the file can fill.
    RequireFit(block.stored <= source.Left() && block.bytes <= block.stored * mostGain,
               "its compressed blocks are damaged");
    stored += block.stored;
    RequireFit(stored <= source.Left(), "an array lies beyond its end");
    opened.bytes += block.bytes;
    opened.blocks.push_back(block);
  }
  source.BeginRun(stored);
  return opened;
}

void
VtpFile::Unpack(Blocks & opened, char * to)
{
  for (const Blocks::Block & block : opened.blocks)
  {
    if (m_Compressor.empty())
    {
      opened.source.Take(to, block.bytes);
    }
    else
    {
      const std::string packed = opened.source.Take(block.stored);
      RequireFit(UnpackBlock(m_Compressor, packed, to, block.bytes), "its compressed blocks are damaged");
    }
    to += block.bytes;
  }
}

template <typename Value>
std::vector<Value>
VtpFile::Read(const VtpArray & array, bool finite)
{
  RequireFit(array.type.bytes > 0, "an array is of an unknown type");
  std::vector<Value> numbers;
  if (array.format == "ascii")
  {
    MeshText text(array.text);
    while (text.NextLine('\0'))
    {
      for (std::string_view word = text.Word(); !word.empty(); word = text.Word())
      {
        numbers.push_back(ParseNumber<Value>(word, array.type, finite));
      }
    }
    return numbers;
  }
  Blocks opened = Open(array);
  RequireFit(opened.bytes % array.type.bytes == 0, "an array ends in the middle of a number");
  constexpr bool isReal = std::is_same_v<Value, double>;
  if (array.type.kind == (isReal ? 'f' : 'i') && array.type.bytes == sizeof(Value) &&
      m_IsBigEndian == (std::endian::native == std::endian::big))
  {
    numbers.resize(opened.bytes / sizeof(Value));
    Unpack(opened, reinterpret_cast<char *>(numbers.data()));
    if constexpr (isReal)
    {
      RequireFit(!finite || std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); }),
                 "a coordinate is not a finite number");
    }
    return numbers;
  }
  std::string bytes(opened.bytes, '\0');
  Unpack(opened, bytes.data());
  numbers.reserve(bytes.size() / array.type.bytes);
  for (std::size_t at = 0; at < bytes.size(); at += array.type.bytes)
  {
    numbers.push_back(LoadNumber<Value>(bytes.data() + at, array.type, m_IsBigEndian, finite));
  }
  return numbers;
}

template std::vector<double>
VtpFile::Read<double>(const VtpArray &, bool);
template std::vector<std::int64_t>
VtpFile::Read<std::int64_t>(const VtpArray &, bool);

std::string
VtpFile::ReadTexts(const VtpArray & array)
{
  RequireFit(array.isText, "an array is not one text");
  if (array.format != "ascii")
  {
    Blocks      opened = Open(array);
    std::string text(opened.bytes, '\0');
    Unpack(opened, text.data());
    return text;
  }
  std::string text;
  for (const std::int64_t letter : Read<std::int64_t>(array))
  {
    RequireFit(letter >= 0 && letter < 256, "a text is damaged");
    text.push_back(static_cast<char>(letter));
  }
  return text;
}

} // namespace voxelcore
