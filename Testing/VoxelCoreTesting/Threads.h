#pragma once
// How many threads OpenMP uses, for a while.

#include <omp.h>

namespace voxelcore::testing
{

/** So many threads until its end. */
class Threads
{
public:
  explicit Threads(int count)
  {
    omp_set_num_threads(count);
  }
  ~Threads()
  {
    omp_set_num_threads(m_Before);
  }
  Threads(const Threads &) = delete;
  Threads &
  operator=(const Threads &) = delete;

private:
  int m_Before = omp_get_max_threads();
};

} // namespace voxelcore::testing
