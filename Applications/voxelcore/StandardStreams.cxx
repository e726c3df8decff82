#include "StandardStreams.h"

#include <fcntl.h>
#include <unistd.h>

namespace voxelcore
{

void
TakeStandardStreams(int & output, int & error)
{
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0)
  {
    return;
  }
  // Above 2, so that a library that opens a file never gets a descriptor it takes for a standard stream. A stream that
  // was closed from the start stays closed: then the copy fails and writes to it do, too.
  output = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  error = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  if (nowhere > STDERR_FILENO)
  {
    close(nowhere);
  }
}

} // namespace voxelcore
