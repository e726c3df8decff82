#pragma once
// What the running process has used so far.

#include <ctime>
#include <fstream>
#include <stdexcept>
#include <string>

namespace voxelcore::performance
{

/** Processor time of all threads. */
inline double
ProcessorSeconds()
{
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/** A line of /proc/self/status such as "VmHWM:", in bytes. \throws std::runtime_error when there is none. */
inline double
StatusBytes(const std::string & name)
{
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
  {
    if (line.starts_with(name))
    {
      return std::stod(line.substr(name.size())) * 1024;
    }
  }
  throw std::runtime_error("no " + name + " in /proc/self/status");
}

} // namespace voxelcore::performance
