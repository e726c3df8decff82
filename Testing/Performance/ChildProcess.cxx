#include "ChildProcess.h"

#include <chrono>
#include <cstdlib>
#include <stdexcept>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace voxelcore::performance
{

ChildResult
RunChild(const std::vector<std::string> & command, const std::string & preloaded)
{
  std::vector<char *> arguments;
  for (const std::string & argument : command)
  {
    arguments.push_back(const_cast<char *>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  int ends[2];
  if (pipe(ends) != 0)
  {
    throw std::runtime_error("no pipe for " + command[0]);
  }
  ChildResult result;
  const auto  start = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child < 0)
  {
    throw std::runtime_error("cannot start " + command[0]);
  }
  if (child == 0)
  {
    dup2(ends[1], STDOUT_FILENO);
    close(ends[0]);
    close(ends[1]);
    if (!preloaded.empty())
    {
      setenv("LD_PRELOAD", preloaded.c_str(), 1);
    }
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  close(ends[1]);
  char buffer[4096];
  for (ssize_t count = 0; (count = read(ends[0], buffer, sizeof buffer)) > 0;)
  {
    result.output.append(buffer, static_cast<std::size_t>(count));
  }
  close(ends[0]);
  int    status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto inSeconds = [](const timeval & time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  result.cpuSeconds = inSeconds(usage.ru_utime) + inSeconds(usage.ru_stime);
  result.peakMegabytes = static_cast<double>(usage.ru_maxrss) * 1024e-6;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
  {
    std::string line;
    for (const std::string & argument : command)
    {
      line += argument + ' ';
    }
    throw std::runtime_error("failed: " + line);
  }
  return result;
}

} // namespace voxelcore::performance
