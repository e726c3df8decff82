#include "Program.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace voxelcore::testing
{

namespace
{

void
Limit(decltype(RLIMIT_FSIZE) what, const std::optional<std::uint64_t> & bytes)
{
  if (bytes)
  {
    const rlimit limit{ *bytes, *bytes };
    setrlimit(what, &limit);
  }
}

[[noreturn]] void
BecomeProgram(std::vector<char *> &      words,
              const std::array<int, 2> & output,
              const std::array<int, 2> & error,
              const ProgramLimits &      limits)
{
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  dup2(limits.fullOutput ? open("/dev/full", O_WRONLY) : output[1], STDOUT_FILENO);
  dup2(error[1], STDERR_FILENO);
  for (const int signal : { SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ })
  {
    std::signal(signal, SIG_DFL); // whatever the test runner has set
  }
  Limit(RLIMIT_FSIZE, limits.fileBytes);
  Limit(RLIMIT_AS, limits.memoryBytes);
  Limit(RLIMIT_STACK, limits.stackBytes);
  execv(words[0], words.data());
  _exit(127);
}

/** Appends what can be read now; false at the end of the stream. */
bool
Drain(int descriptor, std::string & text)
{
  std::array<char, 65536> buffer;
  const ssize_t           count = read(descriptor, buffer.data(), buffer.size());
  if (count > 0)
  {
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  return count > 0;
}

} // namespace

ProgramResult
RunProgram(const std::vector<std::string> & arguments, const ProgramLimits & limits, const Watcher & watcher)
{
  std::vector<std::string> texts{ VOXELCORE_PROGRAM };
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  std::vector<char *> words;
  for (std::string & text : texts)
  {
    words.push_back(text.data());
  }
  words.push_back(nullptr);

  std::array<int, 2> output;
  std::array<int, 2> error;
  if (pipe2(output.data(), O_CLOEXEC) != 0 || pipe2(error.data(), O_CLOEXEC) != 0)
  {
    throw std::runtime_error("no pipe");
  }
  const auto  start = std::chrono::steady_clock::now();
  const pid_t process = fork();
  if (process < 0)
  {
    throw std::runtime_error("no process");
  }
  if (process == 0)
  {
    BecomeProgram(words, output, error, limits);
  }
  close(output[1]);
  close(error[1]);

  ProgramResult         result;
  std::array<pollfd, 2> streams{ { { output[0], POLLIN, 0 }, { error[0], POLLIN, 0 } } };
  while (streams[0].fd >= 0 || streams[1].fd >= 0)
  {
    poll(streams.data(), streams.size(), watcher ? 1 : 100);
    for (std::size_t i = 0; i < streams.size(); ++i)
    {
      if (streams[i].fd >= 0 && streams[i].revents != 0 && !Drain(streams[i].fd, i == 0 ? result.output : result.error))
      {
        close(streams[i].fd);
        streams[i].fd = -1; // poll passes over it
      }
    }
    if (watcher)
    {
      watcher(process, result.error);
    }
    if (std::chrono::steady_clock::now() - start > limits.time)
    {
      kill(process, SIGKILL);
    }
  }
  int status = 0;
  waitpid(process, &status, 0);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return result;
}

void
ExpectRefusal(const ProgramResult & result, int code, const std::vector<std::string> & words)
{
  EXPECT_EQ(result.code, code) << result.error;
  EXPECT_EQ(result.signal, 0);
  EXPECT_EQ(result.output, "");
  EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  EXPECT_EQ(result.error.find("voxelcore: "), 0U) << result.error;
  EXPECT_TRUE(result.error.ends_with('\n')) << result.error;
  for (const std::string & word : words)
  {
    EXPECT_NE(result.error.find(word), std::string::npos) << "no '" << word << "' in: " << result.error;
  }
}

} // namespace voxelcore::testing
