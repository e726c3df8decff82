#ifndef VOXELCORE_OWN_PART_H
#define VOXELCORE_OWN_PART_H

#include <omp.h>

#include <cstddef>

namespace voxelcore
{

// Items [begin, end) of a loop that fall to one thread of the team.
struct OwnPart
{
  std::size_t begin;
  std::size_t end;
};

// For loops that look ahead at data which they change: a thread may look ahead within its own part only.
inline OwnPart
PartOfThisThread(std::size_t count)
{
  const auto threads = static_cast<std::size_t>(omp_get_num_threads());
  const auto thread = static_cast<std::size_t>(omp_get_thread_num());
  return { count * thread / threads, count * (thread + 1) / threads };
}

} // namespace voxelcore

#endif
