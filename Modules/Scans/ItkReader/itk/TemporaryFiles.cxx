#include "TemporaryFiles.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TextFields.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <string>
#include <unistd.h>

namespace voxelcore::itkreader
{
namespace
{

namespace fs = std::filesystem;

[[noreturn]] void
Refuse(const fs::path & folder)
{
  throw Error(Text("no temporary folder can be made in ", folder.string(), " (", std::strerror(errno), ")"));
}

/** Waits until nobody holds the other end of `pipe`. */
void
WaitForEnd(int pipe)
{
  char none = 0;
  while (::read(pipe, &none, 1) < 0 && errno == EINTR)
  {}
}

} // namespace

void
KeepTemporaryFilesApart()
{
  std::error_code    error;
  const fs::path     all = fs::temp_directory_path(error);
  std::array<int, 2> ends{};
  std::string        folder = (all / "voxelcore-XXXXXX").string();
  if (error || ::pipe2(ends.data(), O_CLOEXEC) != 0 || ::mkdtemp(folder.data()) == nullptr)
  {
    Refuse(all);
  }
  const pid_t remover = ::fork();
  if (remover == 0)
  {
    ::setsid(); // what ends the group of this process lets the remover do its work
    for (const int other : { STDIN_FILENO, STDOUT_FILENO, ends[1] })
    {
      ::close(other);
    }
    WaitForEnd(ends[0]);
    fs::remove_all(folder, error);
    ::_exit(0);
  }
  ::close(ends[0]);
  if (remover < 0)
  {
    fs::remove(folder, error);
    Refuse(all);
  }
  ::setenv("TMPDIR", folder.c_str(), 1);
}

} // namespace voxelcore::itkreader
