#pragma once
// Work in a thread of its own, without the interpreter's lock.
//
// Ctrl-C ends the call at once, however long the work takes to notice: the thread is told to stop, and left behind if
// it does not stop in time. A new thread for each call also makes the module safe after a fork: OpenMP keeps its
// workers with the thread that started them, and these workers do not exist in the child.

#include "voxelcore/Base/Progress.h"

#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>

namespace voxelcore
{

/** What the two threads share. */
class Errand
{
public:
  /** For the work: reports where it is, and stops it once Stop() was called. */
  ProgressCallback
  Callback();

  void
  Run(int threads, const std::function<void()> & work);

  void
  Stop();

  /** True when the work has ended; waits for that at most this long. */
  bool
  WaitFor(std::chrono::milliseconds time);

  /** Stage and fraction; fractions never fall. */
  std::pair<std::string, double>
  Latest();

  /** After the end: throws what the work threw. */
  void
  Rethrow();

  /** The interpreter ends: nobody will come for what the work finds. */
  void
  Abandon();

  bool
  IsAbandoned();

private:
  std::mutex              m_Mutex;
  std::condition_variable m_Changed;
  std::string             m_Stage;
  double                  m_Fraction = 0;
  bool                    m_Stopped = false;
  bool                    m_Ended = false;
  bool                    m_Abandoned = false;
  std::exception_ptr      m_Failure;
};

/** Waits for the end of an errand. Several times a second it lets Python handle signals and tells `listener` (a
 *  function or None) how far the work is. What these raise ends the wait. `kept` lives as long as the work.
 *  To be called with the interpreter's lock. */
void
AwaitErrand(const std::shared_ptr<Errand> & errand,
            std::thread                     worker,
            const pybind11::object &        listener,
            const pybind11::object &        kept);

/** Waits for work that was left behind, which may still hold names of files. */
void
AwaitLeftBehind();

/** To be called when the interpreter is about to end: stops the work of all other threads, which are daemons, and waits
 *  for its end and for what was left behind, so that the process can end in order. These threads, and those that call
 *  later, wait for ever; the end of the process ends them. */
void
EndAll();

/** Never comes back in a thread other than the one that called EndAll(). */
void
WaitAtTheEnd();

/** In a child after a fork: threads that work, and those left behind, are the parent's. */
void
ForgetLeftBehind();

/** How many threads `threads` means; 0: as many as OpenMP would take here. */
int
ThreadsToUse(int threads);

/** Runs `work(progress)`, which must own all it uses but the memory of `kept`. */
template <typename TWork>
auto
RunInOwnThread(int threads, const pybind11::object & listener, const pybind11::object & kept, TWork work)
{
  using Result = std::invoke_result_t<TWork &, const ProgressCallback &>;
  struct Job : Errand
  {
    explicit Job(TWork && toDo)
      : work(std::move(toDo))
    {}
    TWork                 work;
    std::optional<Result> result;
  };
  WaitAtTheEnd();
  const auto  job = std::make_shared<Job>(std::move(work));
  std::thread worker(
    [job, count = ThreadsToUse(threads)] { job->Run(count, [&] { job->result = job->work(job->Callback()); }); });
  AwaitErrand(job, std::move(worker), listener, kept);
  return std::move(*job->result);
}

} // namespace voxelcore
