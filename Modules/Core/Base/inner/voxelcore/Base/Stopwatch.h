#pragma once

#include <chrono>

namespace voxelcore
{

/** Wall-clock seconds since it was made or last asked. */
class Stopwatch
{
public:
  double
  Lap()
  {
    const auto   now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - m_Start).count();
    m_Start = now;
    return seconds;
  }

private:
  std::chrono::steady_clock::time_point m_Start = std::chrono::steady_clock::now();
};

} // namespace voxelcore
