#include "voxelcore/Base/FreeMemory.h"
#include "voxelcore/Base/SystemCalls.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <random>

#ifdef __EMSCRIPTEN__
#  include <emscripten/heap.h>
#endif

namespace voxelcore
{

ProcessFacts
ThisProcess()
{
  static const ProcessFacts facts = [] {
    std::random_device source;
    ProcessFacts       drawn;
    drawn.machine = "machine " + std::to_string(source());
    drawn.space = "space " + std::to_string(source());
    drawn.process = 1 + static_cast<std::int64_t>(source() & 0x3fffffffU);
    drawn.start = source();
    return drawn;
  }();
  return facts;
}

bool
HasProcessEnded(std::int64_t, std::uint64_t)
{
  return false;
}

bool
CanStartThreads()
{
#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
  return false;
#else
  return true;
#endif
}

double
PeakMemoryMb()
{
#ifdef __EMSCRIPTEN__
  return static_cast<double>(emscripten_get_heap_size()) / (1U << 20U); // it only grows
#else
  return 0;
#endif
}

std::optional<double>
AvailableMemoryMb()
{
#ifdef __EMSCRIPTEN__
  return 0.9 * static_cast<double>(emscripten_get_heap_max() - emscripten_get_heap_size()) / 1e6;
#else
  return std::nullopt;
#endif
}

void
RemoveNow(const char * path, bool withContents)
{
  std::error_code ignored;
  withContents ? std::filesystem::remove_all(path, ignored) : std::filesystem::remove(path, ignored);
}

void
GiveBackFreeMemory()
{}

std::size_t
ReleaseMemory(void *, std::size_t size)
{
  return size;
}

struct SystemFile::Handle
{
  std::filebuf buffer;
};

SystemFile::SystemFile(const std::filesystem::path & path)
  : m_Handle(std::make_unique<Handle>())
{
  errno = 0;
  m_Handle->buffer.open(path, std::ios::in | std::ios::binary);
  if (!IsOpen() && errno == 0)
  {
    errno = EIO; // the standard does not say that open() tells why
  }
}

SystemFile::~SystemFile() = default;

bool
SystemFile::IsOpen() const
{
  return m_Handle->buffer.is_open();
}

std::int64_t
SystemFile::Read(std::byte * to, std::size_t count)
{
  errno = 0;
  std::size_t done = 0;
  try
  {
    while (done < count)
    {
      const auto now = static_cast<std::streamsize>(std::min<std::size_t>(count - done, 1U << 30));
      const auto got = m_Handle->buffer.sgetn(reinterpret_cast<char *>(to) + done, now);
      if (got <= 0)
      {
        break;
      }
      done += static_cast<std::size_t>(got);
    }
  }
  catch (const std::exception &) // how libstdc++ says that reading failed
  {
    errno = errno == 0 ? EIO : errno;
    return -1;
  }
  // After a signal libstdc++ reads on, and leaves errno as it is.
  return done < count && errno != 0 && errno != EINTR ? -1 : static_cast<std::int64_t>(done);
}

void
SystemFile::Skip(std::uint64_t count)
{
  m_Handle->buffer.pubseekoff(static_cast<std::streamoff>(count), std::ios::cur, std::ios::in);
}

void
SystemFile::MoveTo(std::uint64_t place)
{
  m_Handle->buffer.pubseekpos(static_cast<std::streamoff>(place), std::ios::in);
}

void
SystemFile::Announce(std::uint64_t, std::uint64_t)
{}

} // namespace voxelcore
