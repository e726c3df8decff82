#pragma once
// The bytes of a file as they lie on disk.

#include "voxelcore/Base/SystemCalls.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/ByteStream.h"
#include "voxelcore/Formats/ScanFile.h"

#include <cerrno>
#include <cstring>

namespace voxelcore
{

class PlainStream : public ByteStream
{
public:
  PlainStream(const std::filesystem::path & path, std::uint64_t offset)
    : ByteStream(path)
    , m_File(path)
  {
    if (!m_File.IsOpen())
    {
      RefuseInput(path, Text("cannot be opened (", std::strerror(errno), ")"), "check its name and permissions");
    }
    m_File.Skip(offset);
  }

  std::size_t
  ReadSome(std::byte * to, std::size_t count) override
  {
    const std::int64_t got = m_File.Read(to, count);
    if (got < 0)
    {
      RefuseInput(m_Path, Text("cannot be read (", std::strerror(errno), ")"), "check the file and its disk");
    }
    return static_cast<std::size_t>(got);
  }

  void
  Skip(std::uint64_t count) override
  {
    m_File.Skip(count);
  }

  void
  Announce(std::uint64_t from, std::uint64_t count) override
  {
    m_File.Announce(from, count);
  }

  bool
  Finish() override
  {
    std::byte more;
    return ReadSome(&more, 1) > 0;
  }

private:
  SystemFile m_File;
};

} // namespace voxelcore
