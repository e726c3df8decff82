#include "voxelcore/Base/ParallelTasks.h"

#include <omp.h>

#include <algorithm>
#include <vector>

// Where there is nothing to share out no parallel region is entered, not even one of a single thread: for each region
// within one GNU's OpenMP starts threads anew.

namespace voxelcore
{

namespace
{

// What pieces of work throw that are all done, whichever of them fails: FirstFailure leaves out those that follow.
class Failures
{
public:
  explicit Failures(std::size_t count)
    : m_Failures(count)
  {}

  template <typename TWork>
  void
  Guard(std::size_t which, TWork work)
  {
    try
    {
      work();
    }
    catch (...)
    {
      m_Failures[which] = std::current_exception();
    }
  }

  void
  Rethrow() const
  {
    for (const std::exception_ptr & failure : m_Failures)
    {
      if (failure)
      {
        std::rethrow_exception(failure);
      }
    }
  }

private:
  std::vector<std::exception_ptr> m_Failures;
};

} // namespace

void
RunBoth(bool worthIt, const std::function<void()> & first, const std::function<void()> & second)
{
  Failures failures(2);
  if (!worthIt || omp_get_max_threads() == 1)
  {
    failures.Guard(0, first);
    failures.Guard(1, second);
    failures.Rethrow();
    return;
  }
#pragma omp parallel num_threads(2)
  {
    if (omp_get_thread_num() == 0)
    {
      failures.Guard(0, first);
    }
    if (omp_get_thread_num() == omp_get_num_threads() - 1)
    {
      failures.Guard(1, second);
    }
  }
  failures.Rethrow();
}

void
RunInParts(bool worthIt, std::size_t count, const std::function<void(std::size_t first, std::size_t last)> & work)
{
  const int wanted = worthIt ? omp_get_max_threads() : 1;
  if (wanted == 1)
  {
    work(0, count);
    return;
  }
  Failures failures(static_cast<std::size_t>(wanted));
#pragma omp parallel num_threads(wanted)
  {
    const auto parts = static_cast<std::size_t>(omp_get_num_threads());
    const auto part = static_cast<std::size_t>(omp_get_thread_num());
    failures.Guard(part, [&] { work(count * part / parts, count * (part + 1) / parts); });
  }
  failures.Rethrow();
}

void
FirstFailure::Keep(std::size_t number)
{
  const std::scoped_lock lock(m_Mutex);
  if (!m_Exception || number < m_Number)
  {
    m_Exception = std::current_exception();
    m_Number = number;
  }
  m_HasFailed = true;
}

void
FirstFailure::Rethrow() const
{
  if (m_Exception)
  {
    std::rethrow_exception(m_Exception);
  }
}

void
RunEach(std::size_t                                     count,
        const std::function<void(std::size_t item)> &   work,
        const std::function<void(std::size_t number)> & done)
{
  FirstFailure failure;
  std::mutex   oneAtATime; // its own: other work that runs beside this, or within done(), does not wait for it
  std::size_t  number = 0;
  const auto   run = [&](std::size_t item) {
    failure.Guard(item, [&] {
      work(item);
      if (done)
      {
        const std::scoped_lock lock(oneAtATime);
        if (!failure.HasFailed())
        {
          done(++number);
        }
      }
    });
  };
  if (omp_get_max_threads() == 1)
  {
    for (std::size_t item = 0; item < count; ++item)
    {
      run(item);
    }
  }
  else
  {
#pragma omp parallel for schedule(dynamic, 1)
    for (std::size_t item = 0; item < count; ++item)
    {
      run(item);
    }
  }
  failure.Rethrow();
}

} // namespace voxelcore
