#include "XmlArrays.h"

#include "XmlUnpacking.h"

namespace voxelcore
{
namespace
{

int
SixBits(char c)
{
  return c >= 'A' && c <= 'Z'   ? c - 'A'
         : c >= 'a' && c <= 'z' ? c - 'a' + 26
         : c >= '0' && c <= '9' ? c - '0' + 52
         : c == '+'             ? 62
         : c == '/'             ? 63
                                : -1;
}

/** Where an array's bytes come from; each Take goes on where the one before ended. */
class ByteSource
{
public:
  ByteSource(std::string_view encoded, bool isBase64)
    : m_Encoded(encoded)
    , m_IsBase64(isBase64)
  {}

  /** The next bytes. In base64 they are a run of their own: the next Take begins with the next four letters. */
  std::string
  Take(std::uint64_t count)
  {
    if (!m_IsBase64)
    {
      RequireFit(count <= m_Encoded.size(), "an array lies beyond its end");
      std::string bytes(m_Encoded.substr(0, count));
      m_Encoded.remove_prefix(count);
      return bytes;
    }
    RequireFit(count <= m_Encoded.size() / 4 * 3, "an array lies beyond its end");
    std::string bytes;
    bytes.reserve(count + 2);
    for (; bytes.size() < count; m_Encoded.remove_prefix(4))
    {
      RequireFit(m_Encoded.size() >= 4, "an array lies beyond its end");
      const std::uint64_t left = count - bytes.size();
      unsigned            bits = 0;
      for (std::size_t i = 0; i < 4; ++i)
      {
        const int six = SixBits(m_Encoded[i]);
        RequireFit(six >= 0 || (m_Encoded[i] == '=' && i > left), "its base64 is damaged");
        bits = (bits << 6U) | static_cast<unsigned>(std::max(six, 0));
      }
      for (unsigned i = 0; i < 3 && i < left; ++i)
      {
        bytes.push_back(static_cast<char>((bits >> (16 - 8 * i)) & 255U));
      }
    }
    return bytes;
  }

private:
  std::string_view m_Encoded;
  bool             m_IsBase64;
};

/** Blocks of equal size but the last; each size, and each compressed size, stands before them. */
std::string
Uncompress(ByteSource & source, const XmlEncoding & encoding, std::string_view start)
{
  const std::size_t width = encoding.header.bytes;
  const auto        number = [&](std::string_view bytes, std::uint64_t index) {
    return static_cast<std::uint64_t>(
      LoadNumber<std::int64_t>(bytes.data() + index * width, encoding.header, encoding.isBigEndian));
  };
  const std::uint64_t blocks = number(start, 0);
  const std::uint64_t blockSize = number(start, 1);
  const std::uint64_t lastSize = number(start, 2);
  RequireFit(blocks <= std::numeric_limits<std::int64_t>::max() / width - 3, "its compressed blocks are damaged");
  // Read again as a whole: in base64 all of the header is one run.
  const std::string   header = source.Take((3 + blocks) * width);
  const std::uint64_t mostGain = MostGain(encoding.compressor);
  std::uint64_t       compressed = 0;
  constexpr auto      most = std::uint64_t{ std::numeric_limits<int>::max() };
  for (std::uint64_t block = 0; block < blocks; ++block)
  {
    const std::uint64_t size = number(header, 3 + block);
    RequireFit(size <= most, "its compressed blocks are damaged");
    compressed += size;
  }
  const std::string packed = source.Take(compressed);
  std::string       bytes;
  std::uint64_t     at = 0;
  for (std::uint64_t block = 0; block < blocks; ++block)
  {
    const std::uint64_t from = number(header, 3 + block);
    const std::uint64_t size = block + 1 == blocks && lastSize != 0 ? lastSize : blockSize;
    RequireFit(size <= most && size <= from * mostGain, "its compressed blocks are damaged");
    bytes.resize(bytes.size() + size);
    const auto * const begin = reinterpret_cast<const unsigned char *>(packed.data()) + at;
    auto * const       end = reinterpret_cast<unsigned char *>(bytes.data() + (bytes.size() - size));
    RequireFit(size == 0 || Unpack(encoding.compressor, begin, from, end, size), "its compressed blocks are damaged");
    at += from;
  }
  return bytes;
}

std::string
ReadBytes(const XmlArray & array, const XmlEncoding & encoding)
{
  std::string_view where;
  bool             isBase64 = true;
  if (array.format == "appended")
  {
    RequireFit(array.offset <= encoding.appended.size(), "an array lies beyond its end");
    where = encoding.appended.substr(array.offset);
    isBase64 = !encoding.isAppendedRaw;
  }
  else
  {
    RequireFit(array.format == "binary", "an array has an unknown format");
    where = array.text;
    where.remove_prefix(std::min(where.find_first_not_of(" \t\r\n"), where.size()));
  }
  const std::size_t width = encoding.header.bytes;
  const bool        isPlain = encoding.compressor.empty();
  ByteSource        source(where, isBase64);
  const std::string start = ByteSource(where, isBase64).Take(isPlain ? width : 3 * width);
  if (!isPlain)
  {
    return Uncompress(source, encoding, start);
  }
  const auto size = LoadNumber<std::int64_t>(start.data(), encoding.header, encoding.isBigEndian);
  RequireFit(static_cast<std::uint64_t>(size) <= where.size(), "an array lies beyond its end");
  return source.Take(width + static_cast<std::uint64_t>(size)).substr(width);
}

} // namespace

NumberType
XmlNumberType(std::string_view name)
{
  static constexpr std::array<std::pair<std::string_view, NumberType>, 10> types{ { { "Int8", { 'i', 1 } },
                                                                                    { "UInt8", { 'u', 1 } },
                                                                                    { "Int16", { 'i', 2 } },
                                                                                    { "UInt16", { 'u', 2 } },
                                                                                    { "Int32", { 'i', 4 } },
                                                                                    { "UInt32", { 'u', 4 } },
                                                                                    { "Int64", { 'i', 8 } },
                                                                                    { "UInt64", { 'u', 8 } },
                                                                                    { "Float32", { 'f', 4 } },
                                                                                    { "Float64", { 'f', 8 } } } };
  const auto * const found = std::find_if(types.begin(), types.end(), [&](const auto & t) { return t.first == name; });
  return found == types.end() ? NumberType{} : found->second;
}

template <typename Value>
std::vector<Value>
ReadXmlArray(const XmlArray & array, const XmlEncoding & encoding, bool finite)
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
  const std::string bytes = ReadBytes(array, encoding);
  RequireFit(bytes.size() % array.type.bytes == 0, "an array ends in the middle of a number");
  numbers.reserve(bytes.size() / array.type.bytes);
  for (std::size_t at = 0; at < bytes.size(); at += array.type.bytes)
  {
    numbers.push_back(LoadNumber<Value>(bytes.data() + at, array.type, encoding.isBigEndian, finite));
  }
  return numbers;
}

template std::vector<double>
ReadXmlArray<double>(const XmlArray &, const XmlEncoding &, bool);
template std::vector<std::int64_t>
ReadXmlArray<std::int64_t>(const XmlArray &, const XmlEncoding &, bool);

} // namespace voxelcore
