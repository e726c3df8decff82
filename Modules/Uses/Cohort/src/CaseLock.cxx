#include "CaseLock.h"

#include "voxelcore/Base/Error.h"

#include <cerrno>
#include <cstring>
#include <utility>

namespace voxelcore
{

namespace fs = std::filesystem;

CaseLock::CaseLock(fs::path file, LockedFile lock)
  : m_File(std::move(file))
  , m_Lock(std::move(lock))
{}

CaseLock::~CaseLock()
{
  if (m_Lock.IsOpen())
  {
    // Removed while it is held: whoever waits for this file finds that it is no longer the one of this name.
    std::error_code ignored;
    fs::remove(m_File, ignored);
    fs::remove(m_File.parent_path(), ignored); // the last one; not when others are there
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
    LockedFile lock(file, true);
    if (lock.IsOpen() && lock.Is(file))
    {
      return CaseLock(file, std::move(lock));
    }
    if (!lock.IsOpen() && errno == EWOULDBLOCK)
    {
      return std::nullopt;
    }
    if (!lock.IsOpen() && errno != ENOENT) // else another process has just removed the empty folder
    {
      throw OutputError(file.string() + ": cannot make this lock: " + std::strerror(errno));
    }
  }
}

} // namespace voxelcore
