// NumPy's .npy, versions 1 to 3 of its format (numpy.lib.format): a magic, the length of a header, a Python dictionary
// of three entries as text, padded, and the values. Which index is which axis no file says: the one that changes
// fastest is i, so that an array [z, y, x] in C's order and one [x, y, z] in Fortran's are the same scan.

#include "HeaderFields.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/FormatOpeners.h"
#include "voxelcore/Formats/StatedSpacing.h"

#include <algorithm>
#include <map>
#include <optional>

namespace voxelcore
{
namespace
{

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t      kLongestDictionary = 65536; ///< numpy.save pads to 64 or 128 bytes

struct NumpyHeader
{
  std::string               type;
  bool                      isFortran = false;
  std::vector<std::int64_t> shape;
};

/** Reads a dictionary such as {'descr': '<u2', 'fortran_order': False, 'shape': (3, 4, 5), } and no other Python. */
class NumpyDictionary
{
public:
  explicit NumpyDictionary(std::string_view text)
    : m_Text(text)
  {}

  std::optional<NumpyHeader>
  Read()
  {
    NumpyHeader header;
    int         found = 0;
    if (!Take('{'))
    {
      return std::nullopt;
    }
    while (!Take('}'))
    {
      const auto name = Quoted();
      if (!name || !Take(':'))
      {
        return std::nullopt;
      }
      if (*name == "descr")
      {
        const auto type = Quoted();
        header.type = type.value_or("a list"); // of the fields of a record
        if (!type)
        {
          return header;
        }
        found |= 1;
      }
      else if (*name == "fortran_order")
      {
        header.isFortran = TakeWord("True");
        if (!header.isFortran && !TakeWord("False"))
        {
          return std::nullopt;
        }
        found |= 2;
      }
      else if (*name != "shape" || !ReadShape(header.shape))
      {
        return std::nullopt;
      }
      else
      {
        found |= 4;
      }
      Take(',');
    }
    return found == 7 && Trim(m_Text).empty() ? std::optional(header) : std::nullopt;
  }

private:
  bool
  TakeWord(std::string_view word)
  {
    m_Text = Trim(m_Text);
    const bool isThere = m_Text.starts_with(word);
    m_Text.remove_prefix(isThere ? word.size() : 0);
    return isThere;
  }
  bool
  Take(char c)
  {
    return TakeWord({ &c, 1 });
  }
  std::optional<std::string>
  Quoted()
  {
    for (const char quote : { '\'', '"' })
    {
      if (Take(quote))
      {
        const std::size_t end = m_Text.find(quote);
        if (end == std::string_view::npos)
        {
          return std::nullopt;
        }
        std::string text(m_Text.substr(0, end));
        m_Text.remove_prefix(end + 1);
        return text;
      }
    }
    return std::nullopt;
  }
  bool
  ReadShape(std::vector<std::int64_t> & shape)
  {
    if (!Take('('))
    {
      return false;
    }
    while (!Take(')'))
    {
      m_Text = Trim(m_Text);
      const std::size_t end = std::min(m_Text.find_first_not_of("0123456789"), m_Text.size());
      const auto        side = ParseInteger(m_Text.substr(0, end));
      if (!side || shape.size() == 32) // NumPy's most
      {
        return false;
      }
      shape.push_back(*side);
      m_Text.remove_prefix(end);
      Take('L'); // Python 2 wrote long integers so
      Take(',');
    }
    return true;
  }

  std::string_view m_Text;
};

PixelType
NumpyTypeOf(const std::filesystem::path & path, const std::string & descr)
{
  static const std::map<std::string, PixelType> known{
    { "b1", PixelType::UInt8 }, { "u1", PixelType::UInt8 },   { "i1", PixelType::Int8 },    { "u2", PixelType::UInt16 },
    { "i2", PixelType::Int16 }, { "u4", PixelType::UInt32 },  { "i4", PixelType::Int32 },   { "u8", PixelType::UInt64 },
    { "i8", PixelType::Int64 }, { "f4", PixelType::Float32 }, { "f8", PixelType::Float64 },
  };
  const bool hasOrder = !descr.empty() && std::string_view("<>|=").find(descr.front()) != std::string_view::npos;
  const auto found = known.find(hasOrder ? descr.substr(1) : "");
  if (found == known.end())
  {
    RefuseInput(path,
                Text("values of NumPy's type '", Printable(descr, 30), "'"),
                "save whole numbers: numpy.save(file, array.astype('uint16'))");
  }
  return found->second;
}

} // namespace

ScanFile
OpenNumpy(const std::filesystem::path & path, const ReadOptions & options)
{
  ScanFile scan;
  scan.path = path;
  scan.format = "NumPy";
  scan.voxels = OpenBytes(path, 0, Packing::Plain);
  const auto read = [&](std::size_t count) {
    std::string text(count, '\0');
    text.resize(scan.voxels->ReadSome(reinterpret_cast<std::byte *>(text.data()), count));
    return text;
  };
  const std::string begin = read(8);
  if (!begin.starts_with(kMagic) || begin.size() < 8)
  {
    RefuseInput(path, "no NumPy array (its first bytes are others)", "write it with numpy.save");
  }
  const int         version = static_cast<unsigned char>(begin[6]);
  const std::size_t digits = version == 1 ? 2 : 4;
  const std::string length = read(digits);
  std::size_t       headerBytes = 0;
  for (std::size_t i = length.size(); i-- > 0;)
  {
    headerBytes = headerBytes << 8 | static_cast<unsigned char>(length[i]);
  }
  if (version < 1 || version > 3 || length.size() < digits || headerBytes > kLongestDictionary)
  {
    RefuseInput(path, "its header makes no sense", "the file is damaged: write it anew with numpy.save");
  }
  const std::string text = read(headerBytes);
  const auto        header = NumpyDictionary(text).Read();
  if (text.size() < headerBytes || !header)
  {
    RefuseInput(path,
                Text("its header makes no sense ('", Printable(text, 60), "')"),
                "the file is damaged: write it anew with numpy.save");
  }
  scan.type = NumpyTypeOf(path, header->type);
  scan.swapBytes = header->type.front() == (std::endian::native == std::endian::little ? '>' : '<');
  if (header->shape.size() != 2 && header->shape.size() != 3)
  {
    RefuseInput(path,
                Text("an array of ", Counted(header->shape.size(), "axis", "axes")),
                "save one volume of it, such as numpy.save(file, array[0])");
  }
  // The fastest axis first.
  std::vector<std::int64_t> sides = header->shape;
  if (!header->isFortran)
  {
    std::reverse(sides.begin(), sides.end());
  }
  sides.resize(3, 1);
  std::copy(sides.begin(), sides.end(), scan.geometry.size.begin());
  const std::uint64_t offset = 8 + digits + headerBytes;
  const std::uint64_t stored = FileSize(path) - std::min(FileSize(path), offset);
  const std::uint64_t each = PixelBytes(scan.type);
  CheckSize(path, scan.geometry.size, each, stored);
  ChooseVolume(path, 1, options);
  ChooseComponent(path, 1, "array of vectors", options);
  scan.notes.push_back(header->isFortran ? "NumPy array in Fortran's order: its indices are i, j, k"
                                         : "NumPy array in C's order: its indices are k, j, i");
  SetGeometry(scan,
              { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } },
              CompleteSpacing({}, options, scan),
              { 0, 0, 0 },
              options);
  return scan;
}

} // namespace voxelcore
