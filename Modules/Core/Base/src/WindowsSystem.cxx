#include "voxelcore/Base/FreeMemory.h"
#include "voxelcore/Base/SystemCalls.h"
#include "voxelcore/Base/WindowsHandle.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <io.h>
#include <psapi.h>

namespace voxelcore
{
namespace
{

namespace fs = std::filesystem;

std::uint64_t
Ticks(const FILETIME & time)
{
  return std::uint64_t{ time.dwHighDateTime } << 32U | time.dwLowDateTime;
}

struct ProcessTimes
{
  std::uint64_t start = 0;
  std::uint64_t end = 0; ///< 0: it runs
};

/** None where the system does not tell. */
std::optional<ProcessTimes>
TimesOf(HANDLE process)
{
  FILETIME start{};
  FILETIME end{};
  FILETIME system{};
  FILETIME user{};
  if (!GetProcessTimes(process, &start, &end, &system, &user))
  {
    return std::nullopt;
  }
  return ProcessTimes{ Ticks(start), Ticks(end) };
}

} // namespace

ProcessFacts
ThisProcess()
{
  ProcessFacts           facts;
  std::array<char, 64>   machine{};
  std::array<char, 1024> name{};
  DWORD                  size = machine.size() - 1;
  DWORD                  length = name.size() - 1;
  RegGetValueA(HKEY_LOCAL_MACHINE,
               "SOFTWARE\\Microsoft\\Cryptography",
               "MachineGuid",
               RRF_RT_REG_SZ,
               nullptr,
               machine.data(),
               &size);
  GetComputerNameExA(ComputerNameDnsHostname, name.data(), &length);
  facts.machine = name.data() + ("/" + std::string(machine.data()));
  facts.space = "windows"; // a process is known by when it started, of all time
  facts.process = GetCurrentProcessId();
  const auto times = TimesOf(GetCurrentProcess());
  facts.start = times ? times->start : 0;
  return facts;
}

bool
HasProcessEnded(std::int64_t process, std::uint64_t start)
{
  const WindowsHandle handle(OpenProcess(PROCESS_QUERY_LIMITED_INFORMATION, FALSE, static_cast<DWORD>(process)));
  if (!handle.IsOpen())
  {
    return GetLastError() == ERROR_INVALID_PARAMETER; // there is none of that number
  }
  const auto times = TimesOf(handle.Get());
  return times && (times->start != start || times->end != 0);
}

bool
CanStartThreads()
{
  return true;
}

double
PeakMemoryMb()
{
  PROCESS_MEMORY_COUNTERS counters{};
  counters.cb = sizeof(counters);
  GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof(counters));
  return static_cast<double>(counters.PeakWorkingSetSize) / (1U << 20U);
}

std::optional<double>
AvailableMemoryMb()
{
  MEMORYSTATUSEX status{};
  status.dwLength = sizeof(status);
  return GlobalMemoryStatusEx(&status) ? std::optional(0.9 * static_cast<double>(status.ullAvailPhys) / 1e6)
                                       : std::nullopt;
}

void
RemoveNow(const wchar_t * path, bool withContents)
{
  if (!DeleteFileW(path))
  {
    std::error_code ignored;
    withContents ? fs::remove_all(path, ignored) : fs::remove(path, ignored);
  }
}

std::FILE *
OpenToWrite(const fs::path & path, bool isNew, bool readsToo)
{
  WindowsHandle handle(CreateFileW(path.c_str(),
                                   GENERIC_WRITE | (readsToo ? GENERIC_READ : 0),
                                   kSharedByAll,
                                   nullptr,
                                   isNew ? CREATE_NEW : CREATE_ALWAYS,
                                   FILE_ATTRIBUTE_NORMAL,
                                   nullptr));
  if (!handle.IsOpen())
  {
    errno = LastErrorNumber();
    return nullptr;
  }
  const int descriptor = _open_osfhandle(reinterpret_cast<std::intptr_t>(handle.Get()), _O_BINARY);
  if (descriptor < 0)
  {
    return nullptr;
  }
  handle.Release();
  std::FILE * const file = _fdopen(descriptor, readsToo ? "w+b" : "wb");
  if (file == nullptr)
  {
    _close(descriptor);
  }
  return file;
}

void
GiveBackFreeMemory()
{
  static_cast<void>(_heapmin());
}

std::size_t
ReleaseMemory(void *, std::size_t size)
{
  return size; // it goes with the array
}

struct SystemFile::Handle
{
  WindowsHandle file;
};

SystemFile::SystemFile(const fs::path & path)
  : m_Handle(new Handle{ WindowsHandle(CreateFileW(path.c_str(),
                                                   GENERIC_READ,
                                                   kSharedByAll,
                                                   nullptr,
                                                   OPEN_EXISTING,
                                                   FILE_FLAG_SEQUENTIAL_SCAN,
                                                   nullptr)) })
{
  if (!IsOpen())
  {
    errno = LastErrorNumber();
  }
}

SystemFile::~SystemFile() = default;

bool
SystemFile::IsOpen() const
{
  return m_Handle->file.IsOpen();
}

std::int64_t
SystemFile::Read(std::byte * to, std::size_t count)
{
  std::size_t done = 0;
  while (done < count)
  {
    DWORD       got = 0;
    const DWORD wanted = static_cast<DWORD>(std::min<std::size_t>(count - done, 1U << 30));
    if (!ReadFile(m_Handle->file.Get(), to + done, wanted, &got, nullptr))
    {
      if (GetLastError() == ERROR_BROKEN_PIPE || GetLastError() == ERROR_HANDLE_EOF) // the end of a pipe
      {
        break;
      }
      errno = LastErrorNumber();
      return -1;
    }
    if (got == 0)
    {
      break;
    }
    done += got;
  }
  return static_cast<std::int64_t>(done);
}

void
SystemFile::Skip(std::uint64_t count)
{
  LARGE_INTEGER way{};
  way.QuadPart = static_cast<LONGLONG>(count);
  SetFilePointerEx(m_Handle->file.Get(), way, nullptr, FILE_CURRENT);
}

void
SystemFile::MoveTo(std::uint64_t place)
{
  LARGE_INTEGER way{};
  way.QuadPart = static_cast<LONGLONG>(place);
  SetFilePointerEx(m_Handle->file.Get(), way, nullptr, FILE_BEGIN);
}

void
SystemFile::Announce(std::uint64_t, std::uint64_t)
{}

} // namespace voxelcore
