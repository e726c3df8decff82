#pragma once
// Two independent pieces of work at the same time.

#include <cstddef>
#include <exception>

namespace voxelcore
{

/** Calls both, in two threads when `worthIt` and OpenMP has a second one to give; otherwise one after the other. What
 *  either throws is thrown on, the first one's first. Only for use in files that are compiled with OpenMP. */
template <typename TFirst, typename TSecond>
void
RunBoth(bool worthIt, TFirst first, TSecond second)
{
  std::exception_ptr failures[2];
  const auto         guard = [&failures](std::size_t which, auto & work) {
    try
    {
      work();
    }
    catch (...)
    {
      failures[which] = std::current_exception();
    }
  };
#pragma omp parallel sections num_threads(2) if (worthIt)
  {
#pragma omp section
    guard(0, first);
#pragma omp section
    guard(1, second);
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
