#include "OwnThread.h"

#include <algorithm>
#include <chrono>
#include <cxxabi.h>
#include <omp.h>
#include <unistd.h>
#include <vector>

namespace py = pybind11;

namespace voxelcore
{

namespace
{

using namespace std::chrono_literals;

constexpr auto kBetweenLooks = 50ms;
constexpr auto kTimeToStop = 300ms; ///< before work is left behind

struct LeftBehind
{
  std::shared_ptr<Errand> errand;
  py::object              kept;
};

/** Guarded by the interpreter's lock. Never destroyed: at the end there is no interpreter left to release objects. */
std::vector<LeftBehind> &
AllLeftBehind()
{
  static auto * all = new std::vector<LeftBehind>;
  return *all;
}

/** Work that a call waits for, by the thread that waits. */
struct Running
{
  Errand *        errand;
  std::thread::id caller;
};

/** Guarded by the interpreter's lock. */
std::vector<Running> &
AllRunning()
{
  static auto * all = new std::vector<Running>;
  return *all;
}

/** Whoever ends the interpreter; guarded by its lock. */
std::optional<std::thread::id> g_Ender; // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

[[noreturn]] void
WaitForEver()
{
  for (;;)
  {
    pause();
  }
}

/** Lets other Python threads run. Once the interpreter ends, Python (before 3.14) does not give its lock to a daemon
 *  again but ends the thread by unwinding its stack, which no destructor survives and which would release objects
 *  without the lock. Such a thread waits here instead, as from Python 3.14 on, until the process is gone. */
class WithoutLock
{
public:
  WithoutLock()
    : m_State(PyEval_SaveThread())
  {}
  WithoutLock(const WithoutLock &) = delete;
  WithoutLock &
  operator=(const WithoutLock &) = delete;
  ~WithoutLock()
  {
    try
    {
      PyEval_RestoreThread(m_State);
    }
    catch (abi::__forced_unwind &) // NOLINT(bugprone-empty-catch): it is not left
    {
      WaitForEver();
    }
  }

private:
  PyThreadState * m_State;
};

bool
EndsWithin(Errand & errand, std::chrono::milliseconds time)
{
  const WithoutLock others;
  return errand.WaitFor(time);
}

/** Called with the lock. */
void
WaitWhileAbandoned(Errand & errand)
{
  if (errand.IsAbandoned())
  {
    const WithoutLock others;
    WaitForEver();
  }
}

/** The same for the thread that waits for an errand. */
bool
EndsForCaller(Errand & errand, std::chrono::milliseconds time)
{
  const bool ends = EndsWithin(errand, time);
  WaitWhileAbandoned(errand);
  return ends;
}

void
HandlePythonSignals()
{
  if (PyErr_CheckSignals() != 0)
  {
    throw py::error_already_set();
  }
}

void
Join(std::thread & worker)
{
  const WithoutLock others;
  worker.join();
}

} // namespace

ProgressCallback
Errand::Callback()
{
  return [this](std::string_view stage, double fraction) {
    const std::scoped_lock lock(m_Mutex);
    m_Stage = stage;
    m_Fraction = std::max(m_Fraction, std::clamp(fraction, 0.0, 1.0));
    return !m_Stopped;
  };
}

void
Errand::Run(int threads, const std::function<void()> & work)
{
  omp_set_num_threads(threads);
  std::exception_ptr failure;
  try
  {
    work();
  }
  catch (...)
  {
    failure = std::current_exception();
  }
  const std::scoped_lock lock(m_Mutex);
  m_Failure = failure;
  m_Ended = true;
  m_Changed.notify_all();
}

void
Errand::Stop()
{
  const std::scoped_lock lock(m_Mutex);
  m_Stopped = true;
}

bool
Errand::WaitFor(std::chrono::milliseconds time)
{
  std::unique_lock lock(m_Mutex);
  return m_Changed.wait_for(lock, time, [this] { return m_Ended; });
}

std::pair<std::string, double>
Errand::Latest()
{
  const std::scoped_lock lock(m_Mutex);
  return { m_Stage, m_Fraction };
}

void
Errand::Rethrow()
{
  if (m_Failure)
  {
    std::rethrow_exception(m_Failure);
  }
}

void
Errand::Abandon()
{
  const std::scoped_lock lock(m_Mutex);
  m_Abandoned = true;
}

bool
Errand::IsAbandoned()
{
  const std::scoped_lock lock(m_Mutex);
  return m_Abandoned;
}

void
AwaitErrand(const std::shared_ptr<Errand> & errand,
            std::thread                     worker,
            const py::object &              listener,
            const py::object &              kept)
{
  std::erase_if(AllLeftBehind(), [](const LeftBehind & one) { return one.errand->WaitFor(0ms); });
  AllRunning().push_back({ errand.get(), std::this_thread::get_id() });
  const auto noteEnd = [&] {
    std::erase_if(AllRunning(), [&](const Running & one) { return one.errand == errand.get(); });
  };
  try
  {
    while (!EndsForCaller(*errand, kBetweenLooks))
    {
      HandlePythonSignals();
      if (!listener.is_none())
      {
        const auto [stage, fraction] = errand->Latest();
        if (fraction < 1) // the end is told once, below
        {
          listener(stage, fraction);
        }
      }
    }
  }
  catch (...)
  {
    errand->Stop();
    const bool ends = EndsForCaller(*errand, kTimeToStop);
    noteEnd();
    if (ends)
    {
      Join(worker);
    }
    else
    {
      worker.detach();
      AllLeftBehind().push_back({ errand, kept });
    }
    throw;
  }
  noteEnd();
  Join(worker);
  errand->Rethrow();
  if (!listener.is_none())
  {
    listener("done", 1.0);
  }
}

void
AwaitLeftBehind()
{
  for (const LeftBehind & one : AllLeftBehind())
  {
    while (!EndsWithin(*one.errand, kBetweenLooks))
    {
      HandlePythonSignals();
    }
  }
}

void
EndAll()
{
  g_Ender = std::this_thread::get_id();
  std::vector<Running> others = AllRunning(); // their callers go on no more, and so keep what these point to
  std::erase_if(others, [](const Running & one) { return one.caller == g_Ender; });
  for (const Running & one : others)
  {
    one.errand->Abandon();
    one.errand->Stop();
  }
  for (const Running & one : others)
  {
    while (!EndsWithin(*one.errand, kBetweenLooks))
    {
      HandlePythonSignals();
    }
  }
  AwaitLeftBehind();
}

void
WaitAtTheEnd()
{
  if (g_Ender && g_Ender != std::this_thread::get_id())
  {
    const WithoutLock others;
    WaitForEver();
  }
}

void
ForgetLeftBehind()
{
  AllLeftBehind().clear();
  AllRunning().clear();
  g_Ender.reset();
}

int
ThreadsToUse(int threads)
{
  return threads > 0 ? threads : omp_get_max_threads();
}

} // namespace voxelcore
