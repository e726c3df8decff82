#pragma once
// Runs the real program and looks at what it leaves.

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <sys/types.h>
#include <vector>

namespace voxelcore::testing
{

struct ProgramResult
{
  int         code = -1;  ///< exit code; -1 when a signal ended it
  int         signal = 0; ///< that signal
  std::string output;     ///< stdout
  std::string error;      ///< stderr
  double      seconds = 0;
};

/** What was said but for what the program sees in a mask: shells look hollow, and specks are islands. */
inline std::string
WithoutDiagnoses(const std::string & error)
{
  std::istringstream lines(error);
  std::string        rest;
  for (std::string line; std::getline(lines, line);)
  {
    bool isDiagnosis = false;
    for (const char * said :
         { " looks hollow: ", "; join them with --connectivity joined", "; unless they are real, " })
    {
      isDiagnosis = isDiagnosis || line.find(said) != std::string::npos;
    }
    rest += isDiagnosis ? "" : line + "\n";
  }
  return rest;
}

struct ProgramLimits
{
  std::optional<std::uint64_t> fileBytes;          ///< RLIMIT_FSIZE
  std::optional<std::uint64_t> memoryBytes;        ///< RLIMIT_AS
  std::optional<std::uint64_t> stackBytes;         ///< RLIMIT_STACK
  bool                         fullOutput = false; ///< its stdout is a file on a full disk
  std::chrono::seconds         time{ 300 };        ///< then it is killed
};

/** Called again and again while the program runs, with its process id and what it printed on stderr so far. */
using Watcher = std::function<void(pid_t, const std::string &)>;

ProgramResult
RunProgram(const std::vector<std::string> & arguments, const ProgramLimits & limits = {}, const Watcher & watcher = {});

/** Fails the test unless the program ended with `code`, said exactly one line on stderr, and nothing on stdout. The
 *  line must hold each of `words`. */
void
ExpectRefusal(const ProgramResult & result, int code, const std::vector<std::string> & words);

} // namespace voxelcore::testing
