#include "voxelcore/Base/FreeMemory.h"
#include "voxelcore/Base/SystemCalls.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <optional>
#include <sstream>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace voxelcore
{
namespace
{

namespace fs = std::filesystem;

std::string
FirstLine(const char * path)
{
  std::ifstream file(path);
  std::string   line;
  std::getline(file, line);
  return line;
}

struct ProcessState
{
  char          state = '?';
  std::uint64_t start = 0;
};

/** What /proc says of a process; none where it does not show it. */
std::optional<ProcessState>
StateOf(std::int64_t process)
{
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string   text;
  if (!std::getline(file, text) || text.rfind(')') == std::string::npos)
  {
    return std::nullopt;
  }
  // The name, which may hold anything, ends at the last bracket; the start is the 22nd field of all.
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  ProcessState       state;
  std::string        skipped;
  fields >> state.state;
  for (int field = 4; field < 22; ++field)
  {
    fields >> skipped;
  }
  fields >> state.start;
  return fields ? std::optional(state) : std::nullopt;
}

/** Removes what is in a directory, folders in it to a depth. What a signal handler may call, which readdir() is not. */
void
RemoveFilesIn(int parent, const char * path, int depth)
{
  // Of each linux_dirent64: where its length and its name stand.
  constexpr long lengthAt = 16;
  constexpr long nameAt = 19;
  const int      directory = openat(parent, path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (directory < 0)
  {
    return;
  }
  alignas(std::uint64_t) std::array<char, 4096> buffer;
  for (long size = 0; (size = syscall(SYS_getdents64, directory, buffer.data(), buffer.size())) > 0;)
  {
    std::uint16_t length = 0;
    for (long at = 0; at < size; at += length)
    {
      std::memcpy(&length, buffer.data() + at + lengthAt, sizeof(length));
      const char * name = buffer.data() + at + nameAt;
      const bool   itself = std::strcmp(name, ".") == 0 || std::strcmp(name, "..") == 0;
      if (!itself && unlinkat(directory, name, 0) != 0 && depth > 0)
      {
        RemoveFilesIn(directory, name, depth - 1);
        unlinkat(directory, name, AT_REMOVEDIR);
      }
    }
  }
  close(directory);
}

} // namespace

ProcessFacts
ThisProcess()
{
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  const std::string boot = FirstLine("/proc/sys/kernel/random/boot_id");
  std::string       machine = FirstLine("/etc/machine-id");
  machine = machine.empty() ? boot : machine; // containers have none: then each boot is a machine of its own
  std::error_code   ignored;
  const std::string space = fs::read_symlink("/proc/self/ns/pid", ignored).string();
  ProcessFacts      facts;
  facts.machine = host.data() + ("/" + machine);
  facts.space = boot + "/" + space;
  facts.process = getpid();
  const auto state = StateOf(facts.process);
  facts.start = state ? state->start : 0;
  return facts;
}

bool
HasProcessEnded(std::int64_t process, std::uint64_t start)
{
  if (kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH)
  {
    return true;
  }
  const auto state = StateOf(process);
  return state && (state->start != start || state->state == 'Z' || state->state == 'X');
}

bool
CanStartThreads()
{
  return true;
}

double
PeakMemoryMb()
{
  // VmHWM begins anew with the program; ru_maxrss would count what the starting process had.
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
  {
    if (line.starts_with("VmHWM:"))
    {
      return std::stod(line.substr(6)) / 1024;
    }
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

std::optional<double>
AvailableMemoryMb()
{
  std::ifstream file("/proc/meminfo");
  for (std::string line; std::getline(file, line);)
  {
    if (line.starts_with("MemAvailable:"))
    {
      return 0.9 * std::stod(line.substr(13)) * 1024 / 1e6;
    }
  }
  return std::nullopt;
}

void
RemoveNow(const char * path, bool withContents)
{
  if (unlink(path) != 0)
  {
    if (withContents)
    {
      RemoveFilesIn(AT_FDCWD, path, 6); // chunks of a Zarr store lie as deep
    }
    rmdir(path);
  }
}

void
GiveBackFreeMemory()
{
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

std::size_t
ReleaseMemory(void * memory, std::size_t size)
{
  // A part of a large page would stay where it is until the system finds time to take the page apart.
  constexpr std::uintptr_t insidePage = (std::uintptr_t{ 2 } << 20) - 1;
  const auto               begin = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t     first = (begin + insidePage) & ~insidePage;
  const std::uintptr_t     end = (begin + size) & ~insidePage;
  if (first >= end)
  {
    return 0;
  }
  // A wish: where it fails, memory stays.
  madvise(static_cast<char *>(memory) + (first - begin), end - first, MADV_DONTNEED);
  return end - begin;
}

struct SystemFile::Handle
{
  int  descriptor = -1;
  bool isInPieces = false;
};

SystemFile::SystemFile(const std::filesystem::path & path)
  : m_Handle(std::make_unique<Handle>())
{
  m_Handle->descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (IsOpen())
  {
    ::posix_fadvise(m_Handle->descriptor, 0, 0, POSIX_FADV_SEQUENTIAL);
  }
}

SystemFile::~SystemFile()
{
  if (IsOpen())
  {
    ::close(m_Handle->descriptor);
  }
}

bool
SystemFile::IsOpen() const
{
  return m_Handle->descriptor >= 0;
}

std::int64_t
SystemFile::Read(std::byte * to, std::size_t count)
{
  std::size_t done = 0;
  while (done < count)
  {
    const ::ssize_t got = ::read(m_Handle->descriptor, to + done, std::min<std::size_t>(count - done, 1U << 30));
    if (got < 0 && errno == EINTR)
    {
      continue;
    }
    if (got < 0)
    {
      return -1;
    }
    if (got == 0)
    {
      break;
    }
    done += static_cast<std::size_t>(got);
  }
  return static_cast<std::int64_t>(done);
}

void
SystemFile::Skip(std::uint64_t count)
{
  ::lseek(m_Handle->descriptor, static_cast<off_t>(count), SEEK_CUR);
}

void
SystemFile::MoveTo(std::uint64_t place)
{
  ::lseek(m_Handle->descriptor, static_cast<off_t>(place), SEEK_SET);
}

void
SystemFile::Announce(std::uint64_t from, std::uint64_t count)
{
  // Advice only: where it is not taken, all is read as before.
  if (!m_Handle->isInPieces)
  {
    ::posix_fadvise(m_Handle->descriptor, 0, 0, POSIX_FADV_RANDOM);
    m_Handle->isInPieces = true;
  }
  const off_t here = ::lseek(m_Handle->descriptor, 0, SEEK_CUR);
  if (here >= 0)
  {
    ::posix_fadvise(m_Handle->descriptor,
                    here + static_cast<off_t>(from),
                    static_cast<off_t>(count),
                    POSIX_FADV_WILLNEED);
  }
}

} // namespace voxelcore
