#pragma once
// What this process has used so far.

#include <cstdint>
#include <ctime>
#include <fstream>
#include <string>
#include <sys/resource.h>

namespace voxelcore::testing
{

/** The most memory at once. */
inline std::uint64_t
PeakBytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

inline long
PeakMegabytes()
{
  return static_cast<long>(PeakBytes() >> 20);
}

/** Of the processor: other work on the machine does not count. */
inline double
ProcessorSeconds()
{
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/** Bytes read, also by processes that it has waited for; 0 where the system does not say. */
inline std::uint64_t
BytesRead()
{
  std::ifstream file("/proc/self/io");
  std::string   name;
  std::uint64_t count = 0;
  file >> name >> count;
  return name == "rchar:" ? count : 0;
}

} // namespace voxelcore::testing
