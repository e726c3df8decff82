#pragma once

// Included before every source of a build with faults (faults.py): one program holds all of them, and VOXELCORE_FAULT=N
// switches on the N-th. VOXELCORE_FAULTS_REACHED=FILE adds to the file the numbers of the faults that a run came past.

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace voxelcore_faults
{
inline constexpr int Count = 4096;

inline const int Chosen = [] {
  const char * number = std::getenv("VOXELCORE_FAULT");
  return number == nullptr ? -1 : std::atoi(number);
}();

struct Reached
{
  std::atomic<bool> Place[Count]{};

  ~Reached()
  {
    const char * name = std::getenv("VOXELCORE_FAULTS_REACHED");
    std::FILE *  file = name == nullptr ? nullptr : std::fopen(name, "a");
    for (int number = 0; file != nullptr && number < Count; ++number)
    {
      if (Place[number].load(std::memory_order_relaxed))
      {
        std::fprintf(file, "%d\n", number);
      }
    }
    if (file != nullptr)
    {
      std::fclose(file);
    }
  }
};
inline Reached Places;

inline bool
On(int number)
{
  // A load first: places in inner loops of several threads must not fight over a cache line.
  if (!Places.Place[number].load(std::memory_order_relaxed))
  {
    Places.Place[number].store(true, std::memory_order_relaxed);
  }
  return Chosen == number;
}
} // namespace voxelcore_faults
