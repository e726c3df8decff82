#include "VirtualDisplay.h"

#include "voxelcore/Base/Error.h"

#include <X11/Xlib.h>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace voxelcore
{

namespace
{

/** What Xvfb writes to its -displayfd: the number it has chosen, and a line end. Empty when it ended or took too
 *  long. */
std::string
ReadDisplayNumber(int descriptor)
{
  constexpr int kPatienceMs = 20000;
  std::string   text;
  while (text.empty() || text.back() != '\n')
  {
    pollfd    one{ descriptor, POLLIN, 0 };
    const int ready = poll(&one, 1, kPatienceMs);
    if (ready < 0 && errno == EINTR)
    {
      continue;
    }
    char c = 0;
    if (ready <= 0 || read(descriptor, &c, 1) != 1)
    {
      return {};
    }
    text += c;
  }
  text.pop_back();
  return text;
}

/** In the child. It must not outlive us, however we end, nor hear the terminal's Ctrl-C before we have drawn. */
[[noreturn]] void
BecomeServer(int numberPipe, pid_t parent)
{
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent)
  {
    _exit(127);
  }
  setpgid(0, 0);
  for (const int signal : { SIGINT, SIGTERM, SIGHUP, SIGPIPE })
  {
    static_cast<void>(std::signal(signal, SIG_DFL));
  }
  const int nowhere = open("/dev/null", O_RDWR);
  dup2(nowhere, STDIN_FILENO);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  constexpr int kNumber = 3;
  if (numberPipe == kNumber)
  {
    fcntl(kNumber, F_SETFD, 0);
  }
  else
  {
    dup2(numberPipe, kNumber);
  }
  for (int other = kNumber + 1; other < 256; ++other)
  {
    close(other);
  }
  execlp("Xvfb", "Xvfb", "-displayfd", "3", "-screen", "0", "64x64x24", "-nolisten", "tcp", "-noreset", nullptr);
  _exit(127);
}

} // namespace

VirtualDisplay::VirtualDisplay()
{
  const char * given = std::getenv("DISPLAY");
  if (given != nullptr && *given != '\0')
  {
    m_Connection = XOpenDisplay(nullptr);
    if (m_Connection != nullptr)
    {
      return;
    }
  }
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
  {
    throw OutputError("cannot start Xvfb: out of file descriptors; raise the limit with ulimit -n");
  }
  const pid_t self = getpid();
  m_Server = fork();
  if (m_Server == 0)
  {
    BecomeServer(ends[1], self);
  }
  close(ends[1]);
  const std::string number = m_Server > 0 ? ReadDisplayNumber(ends[0]) : std::string();
  close(ends[0]);
  if (!number.empty())
  {
    m_Connection = XOpenDisplay((":" + number).c_str());
  }
  if (m_Connection == nullptr)
  {
    EndServer();
    throw OutputError(
      "cannot draw: there is no display, and Xvfb, which takes its place, does not run here; install it "
      "(Debian: apt-get install xvfb) or set DISPLAY");
  }
}

VirtualDisplay::~VirtualDisplay()
{
  if (m_Connection != nullptr)
  {
    XCloseDisplay(static_cast<Display *>(m_Connection));
  }
  EndServer();
}

void
VirtualDisplay::EndServer()
{
  if (m_Server > 0)
  {
    kill(m_Server, SIGTERM);
    while (waitpid(m_Server, nullptr, 0) < 0 && errno == EINTR)
    {}
    m_Server = -1;
  }
}

} // namespace voxelcore
