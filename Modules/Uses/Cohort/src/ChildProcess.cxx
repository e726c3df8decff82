#include "ChildProcess.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Cohort/Admission.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace voxelcore
{

namespace
{

void
KeepOpen(int descriptor)
{
  fcntl(descriptor, F_SETFD, 0);
}

/** Between fork and exec: async-signal-safe calls alone. */
[[noreturn]] void
Become(char * const * words, char * const * environment, pid_t parent, const std::array<int, 3> & kept)
{
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent)
  {
    _exit(1);
  }
  const int score = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (score >= 0)
  {
    static_cast<void>(!write(score, "900", 3));
  }
  for (const int descriptor : kept)
  {
    KeepOpen(descriptor);
  }
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
  dup2(kept[0], STDERR_FILENO);
  execve("/proc/self/exe", words, environment);
  _exit(127);
}

std::vector<char *>
Pointers(std::vector<std::string> & texts)
{
  std::vector<char *> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string & text : texts)
  {
    pointers.push_back(text.data());
  }
  pointers.push_back(nullptr);
  return pointers;
}

void
Close(int & descriptor)
{
  if (descriptor >= 0)
  {
    close(descriptor);
    descriptor = -1;
  }
}

} // namespace

void
RequireChildProcesses()
{}

std::vector<bool>
WaitUntilReadable(const std::vector<int> & descriptors, int milliseconds)
{
  std::vector<pollfd> watched;
  for (const int descriptor : descriptors)
  {
    watched.push_back({ descriptor, POLLIN, 0 });
  }
  poll(watched.data(), watched.size(), milliseconds);
  std::vector<bool> readable;
  for (const pollfd & one : watched)
  {
    readable.push_back(one.revents != 0);
  }
  return readable;
}

ChildProcess::ChildProcess(const std::vector<std::string> & arguments, int lock)
{
  std::array<int, 2> channel{ -1, -1 };
  m_Messages = memfd_create("voxelcore-case", MFD_CLOEXEC);
  if (m_Messages < 0 || socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, channel.data()) != 0)
  {
    Close(m_Messages);
    throw Error(std::string("cannot start a case: ") + std::strerror(errno));
  }
  m_Channel = channel[0];
  std::vector<std::string> words = arguments;
  std::vector<std::string> environment;
  for (char ** variable = environ; *variable != nullptr; ++variable)
  {
    environment.emplace_back(*variable);
  }
  environment.push_back(std::string(kAdmissionVariable) + "=" + std::to_string(channel[1]));
  const auto  wordPointers = Pointers(words);
  const auto  variablePointers = Pointers(environment);
  const pid_t parent = getpid();
  m_Process = fork();
  if (m_Process == 0)
  {
    Become(wordPointers.data(), variablePointers.data(), parent, { m_Messages, channel[1], lock });
  }
  const int reason = errno;
  close(channel[1]);
  m_End = m_Process > 0 ? static_cast<int>(syscall(SYS_pidfd_open, m_Process, 0)) : -1;
  if (m_End < 0)
  {
    const int why = m_Process > 0 ? errno : reason;
    if (m_Process > 0)
    {
      kill(m_Process, SIGKILL);
      waitpid(m_Process, nullptr, 0);
    }
    Close(m_Messages);
    Close(m_Channel);
    throw Error(std::string("cannot start a case: ") + std::strerror(why));
  }
}

ChildProcess::~ChildProcess()
{
  if (m_Process > 0)
  {
    kill(m_Process, SIGKILL);
    waitpid(m_Process, nullptr, 0);
  }
  Close(m_End);
  Close(m_Channel);
  Close(m_Messages);
}

std::optional<double>
ChildProcess::TakeRequest()
{
  std::array<char, 64> text;
  const ssize_t        count = recv(m_Channel, text.data(), text.size(), MSG_DONTWAIT);
  double               megabytes = 0;
  if (count <= 0)
  {
    if (count == 0 || (errno != EAGAIN && errno != EINTR))
    {
      Close(m_Channel); // the child is at its end
    }
    return std::nullopt;
  }
  from_chars(text.data(), text.data() + count, megabytes);
  return megabytes;
}

void
ChildProcess::Grant()
{
  static_cast<void>(!send(m_Channel, "g", 1, MSG_NOSIGNAL));
}

void
ChildProcess::Kill() const
{
  kill(m_Process, SIGKILL);
}

ChildEnd
ChildProcess::Collect()
{
  ChildEnd end;
  int      status = 0;
  waitpid(m_Process, &status, 0);
  m_Process = -1;
  end.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - m_Start).count();
  end.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  constexpr off_t kMost = 65536;
  const off_t     size = lseek(m_Messages, 0, SEEK_END);
  end.messages.resize(static_cast<std::size_t>(std::min(size, kMost)));
  const ssize_t got = pread(m_Messages, end.messages.data(), end.messages.size(), std::max<off_t>(0, size - kMost));
  end.messages.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  return end;
}

std::function<void(double)>
AdmissionFromEnvironment(std::function<bool()> stop)
{
  const char * text = std::getenv(kAdmissionVariable);
  int          channel = -1;
  if (text == nullptr)
  {
    return {};
  }
  const char * end = text + std::strlen(text);
  const auto   read = from_chars(text, end, channel);
  if (read.ec != std::errc() || read.ptr != end)
  {
    return {};
  }
  fcntl(channel, F_SETFD, FD_CLOEXEC);
  return [channel, stop = std::move(stop)](double megabytes) {
    const std::string request = std::to_string(megabytes);
    if (send(channel, request.data(), request.size(), MSG_NOSIGNAL) < 0)
    {
      throw Error("the batch that started this case is gone");
    }
    pollfd answer{ channel, POLLIN, 0 };
    while (poll(&answer, 1, 100) <= 0)
    {
      if (stop())
      {
        throw Cancelled();
      }
    }
    char granted = 0;
    if (recv(channel, &granted, 1, 0) != 1)
    {
      throw Error("the batch that started this case is gone");
    }
  };
}

} // namespace voxelcore
