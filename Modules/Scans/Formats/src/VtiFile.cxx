// VTK's image data in XML, .vti: values of points or of cells, as text, base64 or raw, plain or packed by zlib. VTK's
// own reader allocates what the header says, and comes whole; here every count is held against what the file has.

#include "PieceStream.h"
#include "voxelcore/Base/Base64.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Base/XmlWalk.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Formats/FormatOpeners.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <optional>

namespace voxelcore
{
namespace
{

using Bytes = std::vector<std::byte>;

[[noreturn]] void
RefuseVti(const std::filesystem::path & path, const std::string & what)
{
  RefuseInput(path, what, "the file is damaged or cut off: write it anew");
}

struct VtiArray
{
  XmlAttributes attributes;
  bool          ofCells = false;
  std::string   text; ///< between its tags
};

/** What stands before the appended data. */
struct VtiHeader
{
  XmlAttributes         file;
  XmlAttributes         image;
  XmlAttributes         piece;
  std::size_t           pieces = 0;
  XmlAttributes         scalars[2]; ///< of point data and cell data: the attributes of their tags
  std::vector<VtiArray> arrays;
  std::string           appendedEncoding;
  std::uint64_t         appendedAt = 0; ///< behind the underscore; 0: there are none
};

/** Reads the header out of the tags. */
class VtiWalk : private XmlWalk
{
public:
  explicit VtiWalk(const std::filesystem::path & path)
  {
    const auto        stream = OpenBytes(path, 0, Packing::Plain);
    const std::string trouble =
      Walk([&](char * to, std::size_t most) { return stream->ReadSome(reinterpret_cast<std::byte *>(to), most); });
    if (!trouble.empty())
    {
      RefuseVti(path, trouble);
    }
    if (EndedAt() > 0)
    {
      FindUnderscore(path);
    }
  }

  VtiHeader header;

private:
  void
  Begin(const std::string & name, const XmlAttributes & attributes, const std::string & within) override
  {
    m_IsInArray = false;
    if (name == "VTKFile")
    {
      header.file = attributes;
    }
    else if (name == "ImageData")
    {
      header.image = attributes;
    }
    else if (name == "Piece")
    {
      ++header.pieces;
      header.piece = attributes;
    }
    else if (name == "PointData" || name == "CellData")
    {
      header.scalars[name == "CellData" ? 1 : 0] = attributes;
    }
    else if (name == "DataArray" && (within == "PointData" || within == "CellData"))
    {
      m_IsInArray = true;
      header.arrays.push_back({ attributes, within == "CellData", "" });
    }
    else if (name == "AppendedData")
    {
      header.appendedEncoding = AttributeOf(attributes, "encoding");
      EndHere();
    }
  }

  void
  End(const std::string &, const std::string &) override
  {
    m_IsInArray = false;
  }

  void
  Text(std::string_view text, const std::string & tag) override
  {
    if (m_IsInArray && tag == "DataArray")
    {
      header.arrays.back().text.append(text);
    }
  }

  void
  FindUnderscore(const std::filesystem::path & path)
  {
    if (header.appendedEncoding != "raw" && header.appendedEncoding != "base64")
    {
      RefuseVti(path, "its appended data are neither raw nor base64");
    }
    std::string begin(256, ' ');
    begin.resize(
      OpenBytes(path, EndedAt(), Packing::Plain)->ReadSome(reinterpret_cast<std::byte *>(begin.data()), begin.size()));
    const std::size_t mark = begin.find_first_not_of(" \r\n\t");
    if (mark == std::string::npos || begin[mark] != '_')
    {
      RefuseVti(path, "its appended data do not begin with '_'");
    }
    header.appendedAt = EndedAt() + mark + 1;
  }

  bool m_IsInArray = false;
};

/** Bytes in memory. */
class VtiMemoryStream : public ByteStream
{
public:
  VtiMemoryStream(const std::filesystem::path & path, Bytes bytes)
    : ByteStream(path)
    , m_Bytes(std::move(bytes))
  {}

  std::size_t
  ReadSome(std::byte * to, std::size_t count) override
  {
    const std::size_t now = std::min(count, m_Bytes.size() - m_At);
    std::memcpy(to, m_Bytes.data() + m_At, now);
    m_At += now;
    return now;
  }
  bool
  Finish() override
  {
    return m_At < m_Bytes.size();
  }

private:
  Bytes       m_Bytes;
  std::size_t m_At = 0;
};

/** A number of `width` bytes, as they stand before arrays. */
std::uint64_t
HeadNumber(std::span<const std::byte> bytes, std::size_t width, bool isBig)
{
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < width; ++i)
  {
    number = number << 8U | std::to_integer<std::uint64_t>(bytes[isBig ? i : width - 1 - i]);
  }
  return number;
}

/** Blocks packed by zlib, of equal size but the last; their sizes stand before them. */
class BlockStream : public PieceStream
{
public:
  BlockStream(const std::filesystem::path & path, std::unique_ptr<ByteStream> packed, std::size_t width, bool isBig)
    : PieceStream(path)
    , m_Packed(std::move(packed))
    , m_Width(width)
    , m_IsBig(isBig)
  {
    m_Blocks = Number();
    m_BlockSize = Number();
    m_LastSize = Number();
    constexpr std::uint64_t most = std::uint64_t{ 1 } << 30;
    if (m_BlockSize > most || m_LastSize > most || m_Blocks > FileSize(path))
    {
      RefuseVti(path, "its packed blocks have sizes that cannot be");
    }
    for (std::uint64_t block = 0; block < m_Blocks; ++block)
    {
      m_Sizes.push_back(Number());
    }
  }

  bool
  Finish() override
  {
    return !IsBetweenPieces() || m_Next < m_Blocks;
  }

private:
  std::span<const std::byte>
  NextPiece() override
  {
    m_Block.clear();
    while (m_Block.empty() && m_Next < m_Blocks)
    {
      Unpack();
    }
    return m_Block;
  }

  std::uint64_t
  Number()
  {
    std::array<std::byte, 8> bytes{};
    m_Packed->Read(bytes.data(), m_Width);
    return HeadNumber(bytes, m_Width, m_IsBig);
  }

  void
  Unpack()
  {
    const std::uint64_t size = m_Next + 1 == m_Blocks && m_LastSize != 0 ? m_LastSize : m_BlockSize;
    const std::uint64_t packed = m_Sizes[static_cast<std::size_t>(m_Next)];
    if (packed > FileSize(m_Path) || size > packed * LargestExpansion(Packing::Deflate))
    {
      RefuseVti(m_Path, Text("its packed block ", m_Next, " has a size that cannot be"));
    }
    Bytes from(static_cast<std::size_t>(packed));
    m_Packed->Read(from.data(), from.size());
    m_Block.resize(static_cast<std::size_t>(size));
    auto got = static_cast<uLongf>(size);
    if (uncompress(reinterpret_cast<Bytef *>(m_Block.data()),
                   &got,
                   reinterpret_cast<const Bytef *>(from.data()),
                   static_cast<uLong>(packed)) != Z_OK ||
        got != size)
    {
      RefuseVti(m_Path, Text("its packed block ", m_Next, " does not unpack to its size"));
    }
    ++m_Next;
  }

  std::unique_ptr<ByteStream> m_Packed;
  std::size_t                 m_Width;
  bool                        m_IsBig;
  std::uint64_t               m_Blocks = 0;
  std::uint64_t               m_BlockSize = 0;
  std::uint64_t               m_LastSize = 0;
  std::vector<std::uint64_t>  m_Sizes;
  std::uint64_t               m_Next = 0;
  Bytes                       m_Block;
};

/** The next bytes of a run of base64, `count` or as many as there are. */
Bytes
NextOfBase64(const std::filesystem::path & path, std::string_view & text, std::optional<std::uint64_t> count)
{
  const std::string decoded = FromBase64(text, count.value_or(std::numeric_limits<std::uint64_t>::max()));
  if (count && decoded.size() < *count)
  {
    RefuseVti(path, "its base64 ends too early");
  }
  const auto * const from = reinterpret_cast<const std::byte *>(decoded.data());
  return { from, from + decoded.size() };
}

PixelType
VtkTypeOf(const std::filesystem::path & path, const std::string & name)
{
  static const std::map<std::string, PixelType> known{
    { "UInt8", PixelType::UInt8 },    { "Int8", PixelType::Int8 },     { "UInt16", PixelType::UInt16 },
    { "Int16", PixelType::Int16 },    { "UInt32", PixelType::UInt32 }, { "Int32", PixelType::Int32 },
    { "UInt64", PixelType::UInt64 },  { "Int64", PixelType::Int64 },   { "Float32", PixelType::Float32 },
    { "Float64", PixelType::Float64 }
  };
  const auto found = known.find(name);
  if (found == known.end())
  {
    RefuseInput(path, Text("an array of type '", Printable(name, 30), "'"), "save it with one whole number a voxel");
  }
  return found->second;
}

template <std::size_t Count>
std::array<double, Count>
VtiNumbers(const std::filesystem::path & path,
           const XmlAttributes &         attributes,
           const char *                  name,
           const char *                  otherwise)
{
  std::array<double, Count> numbers{};
  const std::string         text = AttributeOf(attributes, name, otherwise);
  const auto                words = Words(text);
  for (std::size_t i = 0; i < Count; ++i)
  {
    const auto value = words.size() == Count ? ParseReal(words[i]) : std::nullopt;
    if (!value || !std::isfinite(*value))
    {
      RefuseVti(path, Text("its ", name, " is not ", Count, " numbers"));
    }
    numbers[i] = *value;
  }
  return numbers;
}

/** The array that is meant: by name, the active scalars, or the only one. */
const VtiArray &
ChooseArray(const std::filesystem::path & path, const VtiHeader & header, const ReadOptions & options)
{
  std::string names;
  for (const VtiArray & array : header.arrays)
  {
    names += (names.empty() ? "" : ", ") + Printable(AttributeOf(array.attributes, "Name"), 60);
  }
  const auto named = [&](const std::string & name, bool any, bool ofCells) -> const VtiArray * {
    const auto found = ranges::find_if(header.arrays, [&](const VtiArray & array) {
      return AttributeOf(array.attributes, "Name") == name && (any || array.ofCells == ofCells);
    });
    return found == header.arrays.end() ? nullptr : &*found;
  };
  if (options.dataset)
  {
    if (const VtiArray * array = named(*options.dataset, true, false))
    {
      return *array;
    }
    RefuseInput(path, Text("there is no array '", Printable(*options.dataset, 60), "'"), Text("give one of ", names));
  }
  if (header.arrays.empty())
  {
    RefuseInput(path, "image data without an array", "save it with the array of labels");
  }
  if (header.arrays.size() == 1)
  {
    return header.arrays.front();
  }
  for (const bool ofCells : { false, true })
  {
    const std::string active = AttributeOf(header.scalars[ofCells ? 1 : 0], "Scalars");
    if (const VtiArray * array = active.empty() ? nullptr : named(active, false, ofCells))
    {
      return *array;
    }
  }
  RefuseInput(path, Text("several arrays (", names, ")"), "choose one with --dataset NAME");
}

/** Numbers as text, as 64 bits each. */
Bytes
ValuesFromText(const std::filesystem::path & path, std::string_view text, bool isReal)
{
  Bytes bytes;
  for (const std::string_view word : Words(text))
  {
    const auto put = [&](auto value) {
      const auto * const from = reinterpret_cast<const std::byte *>(&value);
      bytes.insert(bytes.end(), from, from + sizeof(value));
    };
    const auto whole = ParseInteger(word);
    const auto real = ParseReal(word);
    if (isReal ? !real : !whole)
    {
      RefuseVti(path, Text("'", Printable(word, 30), "' among its numbers"));
    }
    if (isReal)
    {
      put(*real);
    }
    else
    {
      put(*whole);
    }
  }
  return bytes;
}

/** The values of an array, as a stream. */
std::unique_ptr<ByteStream>
OpenArray(const std::filesystem::path & path, const VtiHeader & header, const VtiArray & array, std::uint64_t expected)
{
  const bool        isBig = AttributeOf(header.file, "byte_order", "LittleEndian") == "BigEndian";
  const std::size_t width = AttributeOf(header.file, "header_type", "UInt32") == "UInt64" ? 8 : 4;
  const std::string compressor = AttributeOf(header.file, "compressor");
  const std::string format = AttributeOf(array.attributes, "format", "ascii");
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
  {
    RefuseInput(path, Text("packed by ", Printable(compressor, 40)), "save it packed by zlib, or not packed");
  }
  std::unique_ptr<ByteStream> stored;
  const auto                  offset = ParseInteger(AttributeOf(array.attributes, "offset", "0"));
  if (format == "appended" && (header.appendedAt == 0 || !offset || *offset < 0))
  {
    RefuseVti(path, "its appended data are not there");
  }
  const std::uint64_t from = format == "appended" ? header.appendedAt + static_cast<std::uint64_t>(*offset) : 0;
  if (from > FileSize(path))
  {
    RefuseVti(path, "an array lies beyond its end");
  }
  if (format == "appended" && header.appendedEncoding == "raw")
  {
    stored = OpenBytes(path, from, Packing::Plain);
  }
  else
  {
    std::string      appended;
    std::string_view text = array.text;
    if (format == "appended")
    {
      appended.resize(static_cast<std::size_t>(FileSize(path) - from));
      OpenBytes(path, from, Packing::Plain)->Read(reinterpret_cast<std::byte *>(appended.data()), appended.size());
      text = appended;
    }
    // Packed, the sizes of blocks are a run of their own; else there is one run.
    Bytes bytes;
    if (compressor.empty())
    {
      bytes = NextOfBase64(path, text, width + expected);
    }
    else
    {
      std::string_view    again = text;
      const Bytes         first = NextOfBase64(path, again, 3 * width);
      const std::uint64_t blocks = HeadNumber(first, width, isBig);
      if (blocks > FileSize(path))
      {
        RefuseVti(path, "its packed blocks have sizes that cannot be");
      }
      bytes = NextOfBase64(path, text, (3 + blocks) * width);
      const Bytes packed = NextOfBase64(path, text, std::nullopt);
      bytes.insert(bytes.end(), packed.begin(), packed.end());
    }
    stored = std::make_unique<VtiMemoryStream>(path, std::move(bytes));
  }
  if (!compressor.empty())
  {
    return std::make_unique<BlockStream>(path, std::move(stored), width, isBig);
  }
  std::array<std::byte, 8> bytes{};
  stored->Read(bytes.data(), width);
  const std::uint64_t size = HeadNumber(bytes, width, isBig);
  // 32 bits hold the size of arrays above 4 GB no longer.
  if (size != (width == 4 ? expected & 0xFFFFFFFFU : expected))
  {
    RefuseVti(path, Text("an array of ", size, " bytes, where ", expected, " belong"));
  }
  return stored;
}

} // namespace

ScanFile
OpenVti(const std::filesystem::path & path, const ReadOptions & options)
{
  const VtiHeader header = VtiWalk(path).header;
  if (AttributeOf(header.file, "type") != "ImageData" || header.image.empty())
  {
    RefuseInput(path, "a VTK file that is no image data", "save it as image data (vtkXMLImageDataWriter)");
  }
  if (header.pieces != 1)
  {
    RefuseInput(path, Text("image data in ", header.pieces, " pieces"), "save it as one piece");
  }
  const VtiArray & array = ChooseArray(path, header, options);
  ScanFile         scan;
  scan.path = path;
  scan.format = "VTK image data";
  const auto extent = VtiNumbers<6>(path, header.piece, "Extent", AttributeOf(header.image, "WholeExtent").c_str());
  const auto spacing = VtiNumbers<3>(path, header.image, "Spacing", "1 1 1");
  const auto direction = VtiNumbers<9>(path, header.image, "Direction", "1 0 0 0 1 0 0 0 1");
  const auto origin = VtiNumbers<3>(path, header.image, "Origin", "0 0 0");
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double first = extent[2 * axis];
    const double last = extent[2 * axis + 1];
    if (std::abs(first) > 0x1p31 || std::abs(last) > 0x1p31 || first != std::floor(first) || last != std::floor(last) ||
        last < first)
    {
      RefuseVti(path, "its extent makes no sense");
    }
    scan.geometry.size[axis] = static_cast<std::int64_t>(last - first) + (array.ofCells ? 0 : 1);
  }
  std::array<Vector3, 3> axes{};
  Vector3                place = origin;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // Cells lie between points; their place is their middle.
    const double steps = extent[2 * axis] + (array.ofCells ? 0.5 : 0);
    for (std::size_t row = 0; row < 3; ++row)
    {
      axes[axis][row] = direction[3 * row + axis];
      place[row] += direction[3 * row + axis] * spacing[axis] * steps;
    }
  }
  const std::string name = AttributeOf(array.attributes, "type");
  scan.type = VtkTypeOf(path, name);
  const auto components = ParseInteger(AttributeOf(array.attributes, "NumberOfComponents", "1"));
  if (!components || *components < 1 || *components > 1 << 16)
  {
    RefuseVti(path, "its array has a number of components that cannot be");
  }
  const std::uint64_t component =
    ChooseComponent(path, static_cast<std::uint64_t>(*components), "array of vectors", options);
  ChooseVolume(path, 1, options);
  scan.interleaved = static_cast<std::size_t>(*components);
  scan.component = scan.interleaved > 1 ? static_cast<std::ptrdiff_t>(component) : scan.component;
  const bool          isText = AttributeOf(array.attributes, "format", "ascii") == "ascii";
  const std::uint64_t possible = FileSize(path) * (isText ? 8 : LargestExpansion(Packing::Deflate));
  const bool          isReal = scan.type == PixelType::Float32 || scan.type == PixelType::Float64;
  if (isText)
  {
    scan.storedType = LowerCase(name);
    scan.type = isReal ? PixelType::Float64 : PixelType::Int64;
  }
  const std::uint64_t bytesPerVoxel = PixelBytes(scan.type) * scan.interleaved;
  const std::uint64_t expected = CheckSize(path, scan.geometry.size, bytesPerVoxel, possible) * bytesPerVoxel;
  scan.swapBytes = !isText && (AttributeOf(header.file, "byte_order", "LittleEndian") == "BigEndian") !=
                                (std::endian::native == std::endian::big);
  if (isText)
  {
    Bytes bytes = ValuesFromText(path, array.text, isReal);
    if (bytes.size() != expected)
    {
      RefuseVti(path, Text(bytes.size() / 8, " numbers, where ", expected / 8, " belong"));
    }
    scan.voxels = std::make_unique<VtiMemoryStream>(path, std::move(bytes));
  }
  else
  {
    scan.voxels = OpenArray(path, header, array, expected);
    scan.hasMore = true; // other arrays
  }
  if (array.ofCells)
  {
    scan.notes.push_back("values of cells: a cell is a voxel");
  }
  SetGeometry(scan, axes, { spacing[0], spacing[1], spacing[2] }, place, options);
  return scan;
}

} // namespace voxelcore
