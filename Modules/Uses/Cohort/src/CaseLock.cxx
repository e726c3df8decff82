#include "CaseLock.h"

#include "voxelcore/Base/Error.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace voxelcore
{

namespace fs = std::filesystem;

CaseLock::CaseLock(fs::path file, int descriptor)
  : m_File(std::move(file))
  , m_Descriptor(descriptor)
{}

CaseLock::CaseLock(CaseLock && other) noexcept
  : m_File(std::move(other.m_File))
  , m_Descriptor(std::exchange(other.m_Descriptor, -1))
{}

CaseLock &
CaseLock::operator=(CaseLock && other) noexcept
{
  Release();
  m_File = std::move(other.m_File);
  m_Descriptor = std::exchange(other.m_Descriptor, -1);
  return *this;
}

CaseLock::~CaseLock()
{
  Release();
}

void
CaseLock::Release()
{
  if (m_Descriptor >= 0)
  {
    // Removed while it is held: whoever waits for this file finds that it is no longer the one of this name.
    std::error_code ignored;
    fs::remove(m_File, ignored);
    fs::remove(m_File.parent_path(), ignored); // the last one; not when others are there
    close(m_Descriptor);
    m_Descriptor = -1;
  }
}

std::optional<CaseLock>
CaseLock::Try(const fs::path & file)
{
  for (;;)
  {
    const fs::path  folder = file.parent_path();
    std::error_code error;
    std::error_code ignored;
    fs::create_directory(folder, error);
    const auto there = fs::symlink_status(folder, ignored);
    // Others make this folder and remove it all the time; whatever else is wrong with it stays wrong.
    if (error && (error != std::errc::file_exists || (fs::exists(there) && !fs::is_directory(there))))
    {
      throw OutputError(folder.string() + ": cannot make this folder for locks: " + error.message());
    }
    const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor < 0 && errno == ENOENT)
    {
      continue; // another process has just removed the empty folder
    }
    if (descriptor < 0)
    {
      throw OutputError(file.string() + ": cannot make this lock: " + std::strerror(errno));
    }
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0)
    {
      const int reason = errno;
      close(descriptor);
      if (reason == EWOULDBLOCK)
      {
        return std::nullopt;
      }
      throw OutputError(file.string() + ": cannot lock: " + std::strerror(reason));
    }
    struct stat held = {};
    struct stat named = {};
    if (fstat(descriptor, &held) == 0 && stat(file.c_str(), &named) == 0 && held.st_ino == named.st_ino &&
        held.st_dev == named.st_dev)
    {
      return CaseLock(file, descriptor);
    }
    close(descriptor);
  }
}

} // namespace voxelcore
