#include "PlainStream.h"
#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <array>
#include <system_error>

namespace voxelcore
{
namespace
{

class PartsStream : public ByteStream
{
public:
  PartsStream(std::vector<std::filesystem::path> paths, std::uint64_t bytesEach, StreamOpener opener)
    : ByteStream(paths.front())
    , m_Paths(std::move(paths))
    , m_BytesEach(bytesEach)
    , m_Opener(std::move(opener))
  {}

  std::size_t
  ReadSome(std::byte * to, std::size_t count) override
  {
    std::size_t done = 0;
    while (done < count)
    {
      if (m_Left == 0)
      {
        if (m_Current)
        {
          m_Surplus = m_Current->Finish() || m_Surplus;
        }
        if (m_Next == m_Paths.size())
        {
          break;
        }
        m_Current = m_Opener(m_Paths[m_Next++]);
        m_Left = m_BytesEach;
      }
      const auto now = static_cast<std::size_t>(std::min<std::uint64_t>(count - done, m_Left));
      m_Current->Read(to + done, now); // names the file that is too short
      done += now;
      m_Left -= now;
    }
    return done;
  }

  void
  Skip(std::uint64_t count) override
  {
    const std::uint64_t here = std::min(count, m_Left);
    if (here > 0)
    {
      m_Current->Skip(here);
      m_Left -= here;
      count -= here;
    }
    if (count > 0 && m_Current)
    {
      m_Surplus = m_Current->Finish() || m_Surplus;
      m_Current.reset();
    }
    // Files that are passed over as a whole are not even opened.
    for (; count >= m_BytesEach && m_Next < m_Paths.size(); count -= m_BytesEach)
    {
      ++m_Next;
    }
    ByteStream::Skip(count);
  }

  void
  Announce(std::uint64_t from, std::uint64_t count) override
  {
    if (from < m_Left) // of the file that is open
    {
      m_Current->Announce(from, std::min(count, m_Left - from));
    }
  }

  bool
  Finish() override
  {
    return (m_Current && m_Left == 0 && m_Current->Finish()) || m_Surplus;
  }

private:
  std::vector<std::filesystem::path> m_Paths;
  std::uint64_t                      m_BytesEach;
  StreamOpener                       m_Opener;
  std::unique_ptr<ByteStream>        m_Current;
  std::size_t                        m_Next = 0;
  std::uint64_t                      m_Left = 0;
  bool                               m_Surplus = false;
};

} // namespace

void
ByteStream::Read(std::byte * to, std::size_t count)
{
  if (ReadSome(to, count) != count)
  {
    RefuseInput(m_Path, "the data end too early: the file is truncated or its header wrong", "fetch or write it anew");
  }
}

void
ByteStream::Skip(std::uint64_t count)
{
  std::vector<std::byte> scratch(static_cast<std::size_t>(std::min<std::uint64_t>(count, std::size_t{ 256 * 1024 })));
  while (count > 0)
  {
    const auto now = static_cast<std::size_t>(std::min<std::uint64_t>(count, scratch.size()));
    Read(scratch.data(), now);
    count -= now;
  }
}

std::uint64_t
LargestExpansion(Packing packing)
{
  switch (packing)
  {
    case Packing::Deflate:
      return 1032; // 258 bytes in 2 bits
    case Packing::Bzip2:
      return 1U << 21; // a 900 kB block of run-length coded runs of 255 in some 40 bytes
    case Packing::Plain:
    case Packing::Hex:
      break;
  }
  return 1;
}

std::uint64_t
FileSize(const std::filesystem::path & path)
{
  std::error_code error;
  const auto      status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
  {
    RefuseInput(path, "no such file", "check the name");
  }
  if (!error && !std::filesystem::is_regular_file(status))
  {
    RefuseInput(path, "not a regular file", "name a file that holds a scan");
  }
  const auto size = error ? 0 : std::filesystem::file_size(path, error);
  if (error)
  {
    RefuseInput(path, Text("cannot be opened (", error.message(), ")"), "check its name and permissions");
  }
  return size;
}

Packing
DetectGzip(const std::filesystem::path & path)
{
  std::array<std::byte, 2> magic{};
  PlainStream(path, 0).ReadSome(magic.data(), magic.size());
  return magic[0] == std::byte{ 0x1F } && magic[1] == std::byte{ 0x8B } ? Packing::Deflate : Packing::Plain;
}

std::unique_ptr<ByteStream>
OpenParts(std::vector<std::filesystem::path> paths, std::uint64_t bytesEach, StreamOpener opener)
{
  return std::make_unique<PartsStream>(std::move(paths), bytesEach, std::move(opener));
}

} // namespace voxelcore
