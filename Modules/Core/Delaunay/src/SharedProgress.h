#pragma once
// One progress callback for several threads.

#include "voxelcore/Base/Progress.h"

#include <omp.h>

#include <atomic>
#include <string_view>

namespace voxelcore
{

/** A ProgressCallback for the threads of a team: only the first one's calls are passed on, the others see its
 *  answer. */
class SharedProgress
{
public:
  /** `progress` must outlive this. */
  explicit SharedProgress(const ProgressCallback & progress)
    : m_Progress(progress)
  {}

  bool
  operator()(std::string_view stage, double fraction)
  {
    if (omp_get_thread_num() == 0 && m_Progress && !m_Progress(stage, fraction))
    {
      Stop();
    }
    return !m_Stop;
  }

  /** From now on the answer is no. */
  void
  Stop()
  {
    m_Stop = true;
  }

private:
  const ProgressCallback & m_Progress;
  std::atomic<bool>        m_Stop = false;
};

} // namespace voxelcore
