#pragma once
// Runs cases side by side within limits of memory and time.

#include "CaseJob.h"
#include "CaseLock.h"
#include "ChildProcess.h"
#include "voxelcore/Cohort/BatchJob.h"

#include <chrono>
#include <deque>
#include <list>
#include <string>
#include <vector>

namespace voxelcore
{

class Scheduler
{
public:
  /** `cases` must outlive it. What a case's process gets is made when its turn comes: it is several times as long. */
  Scheduler(const BatchOptions & options, const std::vector<CohortCase> & cases, const JobContext & context);

  /** Works until every case is done or has failed. \throws Cancelled, OutputError */
  BatchResult
  Run();

private:
  using Clock = std::chrono::steady_clock;

  struct Running
  {
    std::size_t       job;
    CaseLock          lock;
    std::string       key;
    ChildProcess      process;
    Clock::time_point start = Clock::now();
    double            seconds = 0; ///< it has worked before `start`
    double            wanted = 0;  ///< MB it asks for
    double            granted = 0; ///< MB it got
    std::string       killed = {}; ///< why it was
  };

  CaseJob
  JobOf(std::size_t number) const
  {
    return MakeCaseJob(m_Cases[number], m_Options);
  }
  void
  StartWhatCan();
  /** False when another process has the case. */
  bool
  Begin(std::size_t job);
  void
  Wait();
  void
  GrantMemory();
  void
  KillLateOnes();
  void
  Finish(Running & running);
  /** Makes the record of a case whose process has done its work. Returns why it cannot; empty when it is made. */
  std::string
  Record(const Running & running, const ChildEnd & end);
  void
  Fail(std::size_t job, const std::string & key, const std::string & reason, double seconds);
  /** How long a case has worked, without waiting for memory. */
  static double
  WorkedSeconds(const Running & running);
  void
  Report();

  const BatchOptions & m_Options;

  const std::vector<CohortCase> & m_Cases;

  ProgressCallback        m_Progress;
  TemporaryRegistry *     m_Temporaries;
  std::deque<std::size_t> m_Waiting;
  std::deque<std::size_t> m_Elsewhere; ///< another process works on them
  std::list<Running>      m_Running;
  BatchResult             m_Result;
  std::size_t             m_Finished = 0; ///< done or failed
  std::vector<double>     m_Seconds;      ///< of the cases our processes have done
  Clock::time_point       m_Start = Clock::now();
};

} // namespace voxelcore
