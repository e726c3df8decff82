#include "voxelcore/RunBoth.h"

#include <omp.h>

#include <algorithm>
#include <array>
#include <exception>

namespace voxelcore
{

void
RunBoth(bool worthIt, const std::function<void()> & first, const std::function<void()> & second)
{
  std::array<std::exception_ptr, 2> failures;
  const auto                        guard = [&failures](std::size_t which, const std::function<void()> & work) {
    try
    {
      work();
    }
    catch (...)
    {
      failures[which] = std::current_exception();
    }
  };
  const int wanted = worthIt ? std::min(2, omp_get_max_threads()) : 1;
#pragma omp parallel num_threads(wanted)
  {
    if (omp_get_thread_num() == 0)
    {
      guard(0, first);
    }
    if (omp_get_thread_num() == omp_get_num_threads() - 1)
    {
      guard(1, second);
    }
  }
  for (const std::exception_ptr & failure : failures)
  {
    if (failure)
    {
      std::rethrow_exception(failure);
    }
  }
}

} // namespace voxelcore
