#pragma once
// The bytes of a file as they lie on disk.

#include "voxelcore/ByteStream.h"
#include "voxelcore/ScanFile.h"
#include "voxelcore/TextFields.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace voxelcore
{

class PlainStream : public ByteStream
{
public:
  PlainStream(const std::filesystem::path & path, std::uint64_t offset)
    : ByteStream(path)
    , m_File(::open(path.c_str(), O_RDONLY | O_CLOEXEC))
  {
    if (m_File < 0)
    {
      RefuseInput(path, Text("cannot be opened (", std::strerror(errno), ")"), "check its name and permissions");
    }
    ::lseek(m_File, static_cast<off_t>(offset), SEEK_SET);
    ::posix_fadvise(m_File, 0, 0, POSIX_FADV_SEQUENTIAL);
  }
  PlainStream(const PlainStream &) = delete;
  PlainStream &
  operator=(const PlainStream &) = delete;
  ~PlainStream() override
  {
    ::close(m_File);
  }

  std::size_t
  ReadSome(std::byte * to, std::size_t count) override
  {
    std::size_t done = 0;
    while (done < count)
    {
      const ::ssize_t got = ::read(m_File, to + done, std::min<std::size_t>(count - done, 1U << 30));
      if (got < 0 && errno == EINTR)
      {
        continue;
      }
      if (got < 0)
      {
        RefuseInput(m_Path, Text("cannot be read (", std::strerror(errno), ")"), "check the file and its disk");
      }
      if (got == 0)
      {
        break;
      }
      done += static_cast<std::size_t>(got);
    }
    return done;
  }

  void
  Skip(std::uint64_t count) override
  {
    ::lseek(m_File, static_cast<off_t>(count), SEEK_CUR);
  }

  bool
  Finish() override
  {
    std::byte more;
    return ReadSome(&more, 1) > 0;
  }

private:
  int m_File;
};

} // namespace voxelcore
