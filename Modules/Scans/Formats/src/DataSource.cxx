#include "DataSource.h"

#include "ResolvedPaths.h"
#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

namespace voxelcore
{
namespace
{

// More parts than any scan has; a header must not make us list files for hours.
constexpr std::int64_t kMostParts = 1 << 20;

/** Numbers as text, turned into the bytes of the pixel type. */
class AsciiStream : public ByteStream
{
public:
  AsciiStream(const std::filesystem::path & path, std::unique_ptr<ByteStream> text, PixelType type)
    : ByteStream(path)
    , m_Text(std::move(text))
    , m_Type(type)
    , m_Buffer(65536)
  {}

  std::size_t
  ReadSome(std::byte * to, std::size_t count) override
  {
    const std::size_t width = PixelBytes(m_Type);
    std::size_t       done = 0;
    while (done + width <= count)
    {
      const std::string word = NextWord();
      if (word.empty())
      {
        break;
      }
      Put(word, to + done);
      done += width;
    }
    return done;
  }

  bool
  Finish() override
  {
    return !NextWord().empty();
  }

private:
  std::string
  NextWord()
  {
    std::string word;
    for (;;)
    {
      if (m_At == m_End)
      {
        m_At = 0;
        m_End = m_Text->ReadSome(m_Buffer.data(), m_Buffer.size());
        if (m_End == 0)
        {
          return word;
        }
      }
      const char c = static_cast<char>(m_Buffer[m_At++]);
      if (std::strchr(" \t\r\n,", c) != nullptr && c != 0)
      {
        if (!word.empty())
        {
          return word;
        }
        continue;
      }
      if (word.size() > 64)
      {
        RefuseWord(word);
      }
      word += c;
    }
  }

  [[noreturn]] void
  RefuseWord(const std::string & word) const
  {
    RefuseInput(m_Path,
                Text("'", Printable(word, 20), "' among its voxel values is no number of type ", PixelName(m_Type)),
                "the file is damaged: fetch or write it anew");
  }

  template <typename T>
  void
  PutAs(const std::string & word, std::byte * to) const
  {
    T value{};
    if constexpr (std::is_floating_point_v<T>)
    {
      const auto real = ParseReal(word);
      if (!real)
      {
        RefuseWord(word);
      }
      value = static_cast<T>(*real);
    }
    else
    {
      const auto whole = ParseInteger(word);
      if (!whole || !std::in_range<T>(*whole))
      {
        RefuseWord(word);
      }
      value = static_cast<T>(*whole);
    }
    std::memcpy(to, &value, sizeof value);
  }

  void
  Put(const std::string & word, std::byte * to) const
  {
    switch (m_Type)
    {
      case PixelType::UInt8:
        return PutAs<std::uint8_t>(word, to);
      case PixelType::Int8:
        return PutAs<std::int8_t>(word, to);
      case PixelType::UInt16:
        return PutAs<std::uint16_t>(word, to);
      case PixelType::Int16:
        return PutAs<std::int16_t>(word, to);
      case PixelType::UInt32:
        return PutAs<std::uint32_t>(word, to);
      case PixelType::Int32:
        return PutAs<std::int32_t>(word, to);
      case PixelType::UInt64:
        return PutAs<std::uint64_t>(word, to);
      case PixelType::Int64:
        return PutAs<std::int64_t>(word, to);
      case PixelType::Float32:
        return PutAs<float>(word, to);
      case PixelType::Float64:
        break;
    }
    PutAs<double>(word, to);
  }

  std::unique_ptr<ByteStream> m_Text;
  PixelType                   m_Type;
  std::vector<std::byte>      m_Buffer;
  std::size_t                 m_At = 0;
  std::size_t                 m_End = 0;
};

/** Where the data begin after skipping whole lines of the file as it lies on disk. */
std::uint64_t
SkipLines(const std::filesystem::path & path, std::uint64_t offset, std::uint64_t lines)
{
  const auto                   file = OpenBytes(path, offset, Packing::Plain);
  std::array<std::byte, 65536> buffer;
  while (lines > 0)
  {
    const std::size_t got = file->ReadSome(buffer.data(), buffer.size());
    if (got == 0)
    {
      RefuseInput(path,
                  "it ends before the lines that its header skips",
                  "the file is truncated: fetch or write it anew");
    }
    for (std::size_t at = 0; at < got && lines > 0; ++at)
    {
      ++offset;
      lines -= buffer[at] == std::byte{ '\n' } ? 1 : 0;
    }
  }
  return offset;
}

/** One file of the source, which gives `bytes` of voxels. */
std::unique_ptr<ByteStream>
OpenOne(const std::filesystem::path & path, const DataSource & source, PixelType type, std::uint64_t bytes)
{
  const std::uint64_t size = FileSize(path);
  std::uint64_t       offset = source.offset;
  if (source.lineSkip > 0)
  {
    offset = SkipLines(path, offset, source.lineSkip);
  }
  std::int64_t skip = source.byteSkip;
  if (skip == -1)
  {
    std::uint64_t total = size;
    if (source.packing != Packing::Plain)
    {
      // Only unpacking tells how much there is: once to count, once to read.
      const auto             counter = OpenBytes(path, offset, source.packing);
      std::vector<std::byte> scratch(1U << 18);
      total = 0;
      for (std::size_t got = 1; got > 0; total += got)
      {
        got = counter->ReadSome(scratch.data(), scratch.size());
      }
      total += offset;
    }
    if (total < offset + bytes)
    {
      RefuseInput(path,
                  Text("it holds ", total - std::min(total, offset), " bytes of data, ", bytes, " are needed"),
                  "the file is truncated: fetch or write it anew");
    }
    skip = static_cast<std::int64_t>(total - offset - bytes);
  }
  if (source.packing == Packing::Plain && !source.ascii)
  {
    const std::uint64_t begin = offset + static_cast<std::uint64_t>(skip);
    if (begin > size || size - begin < bytes)
    {
      RefuseInput(path,
                  Text("it holds ", size - std::min(begin, size), " bytes of voxels where ", bytes, " are needed"),
                  "the file is truncated: fetch or write it anew");
    }
    return OpenBytes(path, begin, Packing::Plain);
  }
  auto stream = OpenBytes(path, offset, source.packing);
  stream->Skip(static_cast<std::uint64_t>(skip));
  if (source.ascii)
  {
    return std::make_unique<AsciiStream>(path, std::move(stream), type);
  }
  return stream;
}

std::filesystem::path
BesideHeader(const std::filesystem::path & headerPath, std::string_view name)
{
  const std::filesystem::path file(name);
  return file.is_absolute() ? file : headerPath.parent_path() / file;
}

/** The files that "name%03d.raw 1 20 1" stands for; nothing when the text is no such pattern. */
std::optional<std::vector<std::filesystem::path>>
FilesOfPattern(const std::filesystem::path & headerPath, std::string_view text)
{
  const auto words = Words(text);
  if (words.size() < 4 || words[0].find('%') == std::string_view::npos)
  {
    return std::nullopt;
  }
  const auto first = ParseInteger(words[1]);
  const auto last = ParseInteger(words[2]);
  const auto step = ParseInteger(words[3]);
  // The name is taken apart by hand: a format string from a file must never reach printf.
  const std::string_view name = words[0];
  const std::size_t      percent = name.find('%');
  std::size_t            d = percent + 1;
  std::size_t            width = 0;
  while (d < name.size() && name[d] >= '0' && name[d] <= '9' && width < 100)
  {
    width = width * 10 + static_cast<std::size_t>(name[d++] - '0');
  }
  const bool zeros = percent + 1 < name.size() && name[percent + 1] == '0';
  const bool known = d < name.size() && (name[d] == 'd' || name[d] == 'i' || name[d] == 'u') && width < 20;
  const auto fits = [](const std::optional<std::int64_t> & number) { // the least of all has no absolute value
    return number && *number >= -kMostParts && *number <= kMostParts;
  };
  if (!fits(first) || !fits(last) || !fits(step) || !known || *step == 0 || (*last - *first) / *step < 0)
  {
    RefuseInput(headerPath,
                Text("the pattern of its data files makes no sense ('", Printable(text), "')"),
                "write it as name%03d.raw FIRST LAST STEP");
  }
  std::vector<std::filesystem::path> files;
  for (std::int64_t number = *first; *step > 0 ? number <= *last : number >= *last; number += *step)
  {
    std::string digits = Text(number);
    if (digits.size() < width)
    {
      digits.insert(0, width - digits.size(), zeros ? '0' : ' ');
    }
    files.push_back(BesideHeader(headerPath, Text(name.substr(0, percent), digits, name.substr(d + 1))));
  }
  return files;
}

} // namespace

std::uint64_t
LargestData(const DataSource & source, PixelType type)
{
  std::uint64_t bytes = 0;
  for (const auto & file : source.files)
  {
    bytes += FileSize(file);
  }
  // A number as text takes two characters at least.
  return bytes * (source.ascii ? PixelBytes(type) : LargestExpansion(source.packing));
}

std::unique_ptr<ByteStream>
OpenData(const std::filesystem::path & headerPath, const DataSource & source, PixelType type, std::uint64_t bytes)
{
  if (source.files.size() == 1)
  {
    return OpenOne(source.files.front(), source, type, bytes);
  }
  const std::uint64_t each = bytes / source.files.size();
  if (each == 0 || each * source.files.size() != bytes)
  {
    RefuseInput(headerPath,
                Text("its ", source.files.size(), " data files cannot each hold an equal share of the voxels"),
                "mend the list of files");
  }
  return OpenParts(source.files, each, [source, type, each](const std::filesystem::path & file) {
    return OpenOne(file, source, type, each);
  });
}

std::vector<std::filesystem::path>
FilesNamed(const std::filesystem::path & headerPath, std::string_view text, const std::vector<std::string> & list)
{
  std::vector<std::filesystem::path> files;
  if (LowerCase(text.substr(0, 4)) == "list" && (text.size() == 4 || text[4] == ' '))
  {
    for (const auto & file : list)
    {
      files.push_back(BesideHeader(headerPath, file));
    }
  }
  else if (auto numbered = FilesOfPattern(headerPath, text))
  {
    files = std::move(*numbered);
  }
  else if (!text.empty())
  {
    files.push_back(BesideHeader(headerPath, text));
  }
  if (files.empty())
  {
    RefuseInput(headerPath, "it names no data file", "mend the header");
  }
  return files;
}

void
WarnOfFilesElsewhere(ScanFile & scan, const DataSource & source)
{
  // A link beside the header leads where it leads: where the bytes come from counts, not what the header calls it.
  const ResolvedFolder folder(scan.path.parent_path());
  for (const auto & file : source.files)
  {
    // A header that holds its voxels is the file that was asked for, through a link or not.
    if (file != scan.path && !folder.Holds(file))
    {
      scan.warnings.push_back(
        Text("its voxels are read from '", Printable(file.string(), 300), "', which is outside the header's folder"));
      return;
    }
  }
}

} // namespace voxelcore
