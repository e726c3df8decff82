#include "voxelcore/Jobs/SystemFiles.h"

#include "voxelcore/Base/WindowsHandle.h"

#include <algorithm>
#include <cerrno>
#include <chrono>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

HANDLE
Of(std::intptr_t handle)
{
  return reinterpret_cast<HANDLE>(handle);
}

} // namespace

bool
MayWriteInto(const fs::path & folder)
{
  // To know, a folder is opened as one who adds files to it would.
  const WindowsHandle handle(CreateFileW(folder.c_str(),
                                         FILE_ADD_FILE,
                                         kSharedByAll,
                                         nullptr,
                                         OPEN_EXISTING,
                                         FILE_FLAG_BACKUP_SEMANTICS,
                                         nullptr));
  if (!handle.IsOpen())
  {
    errno = LastErrorNumber();
  }
  return handle.IsOpen();
}

std::time_t
LastChanged(const fs::path & path)
{
  std::error_code error;
  const auto      time = fs::last_write_time(path, error);
  return error
           ? 0
           : std::chrono::floor<std::chrono::seconds>(std::chrono::file_clock::to_sys(time)).time_since_epoch().count();
}

std::vector<std::string>
MatchesOf(const fs::path & pattern)
{
  std::vector<std::string> paths;
  WIN32_FIND_DATAW         found{};
  const HANDLE             search = FindFirstFileW(pattern.c_str(), &found);
  if (search != INVALID_HANDLE_VALUE)
  {
    do
    {
      paths.push_back((pattern.parent_path() / found.cFileName).string());
    } while (FindNextFileW(search, &found));
    FindClose(search);
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

LockedFile::LockedFile(const fs::path & path, bool create)
{
  WindowsHandle handle(CreateFileW(path.c_str(),
                                   GENERIC_READ | GENERIC_WRITE,
                                   kSharedByAll,
                                   nullptr,
                                   create ? OPEN_ALWAYS : OPEN_EXISTING,
                                   FILE_ATTRIBUTE_NORMAL | FILE_FLAG_OPEN_REPARSE_POINT,
                                   nullptr));
  if (!handle.IsOpen())
  {
    errno = LastErrorNumber();
    return;
  }
  // Whoever has locked a byte keeps others from reading it: one far beyond the end.
  OVERLAPPED beyond{};
  beyond.OffsetHigh = 0x40000000;
  if (!LockFileEx(handle.Get(), LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0, &beyond))
  {
    const DWORD reason = GetLastError();
    errno = reason == ERROR_LOCK_VIOLATION || reason == ERROR_IO_PENDING ? EWOULDBLOCK : LastErrorNumber();
    return;
  }
  m_Handle = reinterpret_cast<std::intptr_t>(handle.Release());
}

LockedFile::~LockedFile()
{
  if (IsOpen())
  {
    CloseHandle(Of(m_Handle));
  }
}

bool
LockedFile::Is(const fs::path & path) const
{
  const WindowsHandle        named(CreateFileW(path.c_str(), 0, kSharedByAll, nullptr, OPEN_EXISTING, 0, nullptr));
  BY_HANDLE_FILE_INFORMATION one{};
  BY_HANDLE_FILE_INFORMATION other{};
  return named.IsOpen() && GetFileInformationByHandle(Of(m_Handle), &one) &&
         GetFileInformationByHandle(named.Get(), &other) && one.nFileIndexLow == other.nFileIndexLow &&
         one.nFileIndexHigh == other.nFileIndexHigh && one.dwVolumeSerialNumber == other.dwVolumeSerialNumber;
}

bool
LockedFile::Append(std::string_view text)
{
  LARGE_INTEGER none{};
  SetFilePointerEx(Of(m_Handle), none, nullptr, FILE_END);
  while (!text.empty())
  {
    DWORD       written = 0;
    const DWORD wanted = static_cast<DWORD>(std::min<std::size_t>(text.size(), 1U << 30));
    if (!WriteFile(Of(m_Handle), text.data(), wanted, &written, nullptr))
    {
      errno = LastErrorNumber();
      return false;
    }
    text.remove_prefix(written);
  }
  return true;
}

} // namespace voxelcore
