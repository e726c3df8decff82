#include "OwnThread.h"

#include <algorithm>
#include <chrono>
#include <omp.h>
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

bool
EndsWithin(Errand & errand, std::chrono::milliseconds time)
{
  const py::gil_scoped_release release;
  return errand.WaitFor(time);
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
  const py::gil_scoped_release release;
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
AwaitErrand(const std::shared_ptr<Errand> & errand,
            std::thread                     worker,
            const py::object &              listener,
            const py::object &              kept)
{
  std::erase_if(AllLeftBehind(), [](const LeftBehind & one) { return one.errand->WaitFor(0ms); });
  try
  {
    while (!EndsWithin(*errand, kBetweenLooks))
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
    if (EndsWithin(*errand, kTimeToStop))
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
ForgetLeftBehind()
{
  AllLeftBehind().clear();
}

int
ThreadsToUse(int threads)
{
  return threads > 0 ? threads : omp_get_max_threads();
}

} // namespace voxelcore
