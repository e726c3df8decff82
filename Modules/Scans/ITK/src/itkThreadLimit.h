#pragma once
// How many threads work for a filter.

#include "itkMultiThreaderBase.h"
#include "itkProcessObject.h"

#include <algorithm>
#include <omp.h>

namespace itk
{

/** How many threads OpenMP gives this thread: as many as the filter's multi-threader may have, and not more than its
 *  work units. What it was comes back in the end. */
class ThreadLimit
{
public:
  explicit ThreadLimit(const ProcessObject & filter)
    : m_Before(omp_get_max_threads())
  {
    omp_set_num_threads(static_cast<int>(
      std::min(filter.GetNumberOfWorkUnits(), filter.GetMultiThreader()->GetMaximumNumberOfThreads())));
  }
  ThreadLimit(const ThreadLimit &) = delete;
  ThreadLimit &
  operator=(const ThreadLimit &) = delete;
  ~ThreadLimit()
  {
    omp_set_num_threads(m_Before);
  }

private:
  int m_Before;
};

} // namespace itk
