#include "voxelcore/Jobs/SystemFiles.h"

#include <cerrno>
#include <fcntl.h>
#include <glob.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace voxelcore
{

namespace fs = std::filesystem;

bool
MayWriteInto(const fs::path & folder)
{
  return access(folder.c_str(), W_OK | X_OK) == 0;
}

std::time_t
LastChanged(const fs::path & path)
{
  struct stat status = {};
  return stat(path.c_str(), &status) == 0 ? status.st_mtime : 0;
}

std::vector<std::string>
MatchesOf(const fs::path & pattern)
{
  glob_t                   matches{};
  std::vector<std::string> paths;
  if (glob(pattern.c_str(), 0, nullptr, &matches) == 0)
  {
    paths.assign(matches.gl_pathv, matches.gl_pathv + matches.gl_pathc);
  }
  globfree(&matches);
  return paths;
}

LockedFile::LockedFile(const fs::path & path, bool create)
{
  const int descriptor = open(path.c_str(), O_RDWR | O_APPEND | O_CLOEXEC | O_NOFOLLOW | (create ? O_CREAT : 0), 0666);
  if (descriptor >= 0 && flock(descriptor, LOCK_EX | LOCK_NB) != 0)
  {
    const int reason = errno;
    close(descriptor);
    errno = reason;
    return;
  }
  m_Handle = descriptor;
}

LockedFile::~LockedFile()
{
  if (IsOpen())
  {
    close(Descriptor());
  }
}

bool
LockedFile::Is(const fs::path & path) const
{
  struct stat held = {};
  struct stat named = {};
  return fstat(Descriptor(), &held) == 0 && stat(path.c_str(), &named) == 0 && held.st_ino == named.st_ino &&
         held.st_dev == named.st_dev;
}

bool
LockedFile::Append(std::string_view text)
{
  while (!text.empty())
  {
    // A network folder, or a signal, may take a part of it.
    const ssize_t written = write(Descriptor(), text.data(), text.size());
    if (written < 0 && errno != EINTR)
    {
      return false;
    }
    text.remove_prefix(written > 0 ? static_cast<std::size_t>(written) : 0);
  }
  return true;
}

} // namespace voxelcore
