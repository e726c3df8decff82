#pragma once
// Runs a program and says what it cost. Peak memory is a number of a process, so each task gets one of its own.

#include <string>
#include <vector>

namespace voxelcore::performance
{

struct ChildResult
{
  double      seconds = 0;       ///< wall clock, from start to end
  double      cpuSeconds = 0;    ///< processor time of all threads, user and system
  double      peakMegabytes = 0; ///< 10^6 bytes; never less than what the caller itself uses (Linux counts it in)
  std::string output;            ///< standard output
};

/** Runs command[0], a path, with its arguments; `preloaded`, where given, is a library that takes functions over in it.
 *  \throws std::runtime_error when it cannot be started or does not end with 0. */
ChildResult
RunChild(const std::vector<std::string> & command, const std::string & preloaded = "");

} // namespace voxelcore::performance
