// Reads one scan after the other as voxelcore-itk-reader does, each in a process of its own that is forked once ITK's
// and GDCM's libraries are loaded: thousands of damaged files are read in minutes, and none outlives its process.
//
// usage: VoxelCoreReadForked      for each line "FORMAT<TAB>PATH" of standard input it prints one line
//                                 "EXIT SIGNAL MILLISECONDS": how the process ended, and its processor time

#include "RunReader.h"

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <iostream>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{

constexpr unsigned int kSeconds = 10; // by the clock, after which it counts as hanging: SIGALRM ends it

[[noreturn]] void
Read(std::string format, std::string path)
{
  ::alarm(kSeconds);
  int order[2];
  if (::pipe(order) != 0 || ::write(order[1], "0 0\n", 4) != 4)
  {
    std::_Exit(2);
  }
  ::dup2(order[0], STDIN_FILENO);
  ::close(order[1]);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  std::string name = "voxelcore-itk-reader";
  char *      words[] = { name.data(), format.data(), path.data(), nullptr };
  std::_Exit(voxelcore::itkreader::RunReader(3, words));
}

} // namespace

int
main()
{
  std::ios::sync_with_stdio(false); // the lines that were read ahead are nobody else's: children have their own input
  for (std::string line; std::getline(std::cin, line);)
  {
    const std::size_t tab = line.find('\t');
    const pid_t       process = tab == std::string::npos ? -1 : ::fork();
    if (process == 0)
    {
      std::cin.clear();
      Read(line.substr(0, tab), line.substr(tab + 1));
    }
    int    status = 0;
    rusage usage{};
    if (process < 0 || ::wait4(process, &status, 0, &usage) != process)
    {
      return 2;
    }
    const auto time =
      (usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) * 1000 + (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec) / 1000;
    std::cout << (WIFEXITED(status) ? WEXITSTATUS(status) : -1) << " " << (WIFSIGNALED(status) ? WTERMSIG(status) : 0)
              << " " << time << std::endl;
  }
  return 0;
}
