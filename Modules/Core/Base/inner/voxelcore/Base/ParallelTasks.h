#pragma once
// Independent work at the same time.

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>

namespace voxelcore
{

/** What pieces of work on several threads throw: an exception that leaves a thread of OpenMP ends the program, and lack
 *  of memory is one. Around the body of each parallel loop that may throw. */
class FirstFailure
{
public:
  /** Does a piece of work, unless one has failed. Thread-safe. */
  template <typename TWork>
  void
  Guard(std::size_t number, const TWork & work)
  {
    if (HasFailed())
    {
      return;
    }
    try
    {
      work();
    }
    catch (...)
    {
      Keep(number);
    }
  }

  bool
  HasFailed() const
  {
    return m_HasFailed.load(std::memory_order_relaxed);
  }

  /** Throws on what the piece with the lowest number threw, if any did. To be called when all threads are done. */
  void
  Rethrow() const;

private:
  void
  Keep(std::size_t number);

  std::atomic<bool>  m_HasFailed = false;
  std::mutex         m_Mutex;
  std::size_t        m_Number = 0;
  std::exception_ptr m_Exception;
};

/** Calls both, in two threads when it is worth it and OpenMP has a second one to give, the first in the calling thread;
 *  otherwise one after the other. What either throws is thrown on, the first one's first. */
void
RunBoth(bool worthIt, const std::function<void()> & first, const std::function<void()> & second);

/** Cuts 0 .. count - 1 into as many parts as OpenMP has threads to give, or into one when that is not worth it, and
 *  calls work(first, last) for items first to last - 1 of each part, side by side. For loops that look ahead at data
 *  which they change, or that hold a part of the results for themselves. What one throws is thrown on, that of the
 *  first part first. */
void
RunInParts(bool worthIt, std::size_t count, const std::function<void(std::size_t first, std::size_t last)> & work);

/** Calls work(0) to work(count - 1) on as many threads as OpenMP has to give, each taking the next item when it has
 *  done one: for items of different size. Calls done(n) when n are done, from one thread at a time; it may call this,
 *  too. Whatever one of these throws lets no further item begin and is thrown on, that of the first item first. */
void
RunEach(std::size_t                                     count,
        const std::function<void(std::size_t item)> &   work,
        const std::function<void(std::size_t number)> & done = {});

} // namespace voxelcore
