#include "Scheduler.h"

#include "TimeLeft.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Cohort/CaseRecord.h"
#include "voxelcore/Jobs/CostModel.h"
#include "voxelcore/Report/Sha256.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

std::uint64_t
Bytes(double megabytes)
{
  return static_cast<std::uint64_t>(std::llround(megabytes * 1e6));
}

constexpr int kInterrupted = 130;
constexpr int kKill = 9;       // SIGKILL, and
constexpr int kTerminate = 15; // SIGTERM, wherever there are signals
constexpr int kPollMilliseconds = 200;

std::string
ClockText(double seconds)
{
  char       text[32];
  const auto whole = static_cast<long>(std::ceil(seconds));
  if (whole < 3600)
  {
    (void)std::snprintf(text, sizeof(text), "%ld:%02ld", whole / 60, whole % 60);
  }
  else
  {
    (void)std::snprintf(text, sizeof(text), "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  }
  return text;
}

std::vector<std::string>
LinesOf(const std::string & messages)
{
  constexpr std::string_view name = "voxelcore: ";
  std::vector<std::string>   lines;
  for (std::size_t at = 0; at < messages.size();)
  {
    const std::size_t end = std::min(messages.find('\n', at), messages.size());
    std::string       line = messages.substr(at, end - at);
    line.erase(0, line.starts_with(name) ? name.size() : 0);
    if (!line.empty())
    {
      lines.push_back(std::move(line));
    }
    at = end + 1;
  }
  return lines;
}

/** Empty when the process did its work. */
std::string
ReasonOf(const ChildEnd & end, const std::string & killed)
{
  if (!killed.empty())
  {
    return killed;
  }
  if (end.signal == kKill)
  {
    return "killed from outside (signal 9), most likely for want of memory; run fewer --jobs, or on a larger machine";
  }
  if (end.code == kInterrupted || end.signal == kTerminate)
  {
    return "interrupted from outside, as some systems do for want of memory; run the batch again, with fewer --jobs";
  }
  if (end.signal != 0)
  {
    return "crashed with signal " + std::to_string(end.signal);
  }
  if (end.code == 0)
  {
    return "";
  }
  const auto lines = LinesOf(end.messages);
  return lines.empty() ? "ended with exit code " + std::to_string(end.code) : lines.back();
}

} // namespace

Scheduler::Scheduler(const BatchOptions & options, const std::vector<CohortCase> & cases, const JobContext & context)
  : m_Options(options)
  , m_Cases(cases)
  , m_Progress(context.progress)
  , m_Temporaries(context.temporaries)
{
  for (std::size_t job = 0; job < m_Cases.size(); ++job)
  {
    m_Waiting.push_back(job);
  }
  m_Result.cases = m_Cases.size();
}

BatchResult
Scheduler::Run()
{
  Report();
  while (m_Finished < m_Cases.size())
  {
    StartWhatCan();
    Wait();
    KillLateOnes();
    GrantMemory();
    Report();
  }
  m_Result.seconds = std::chrono::duration<double>(Clock::now() - m_Start).count();
  return std::move(m_Result);
}

void
Scheduler::StartWhatCan()
{
  while (m_Running.size() < static_cast<std::size_t>(m_Options.jobs) && !m_Waiting.empty())
  {
    const std::size_t job = m_Waiting.front();
    m_Waiting.pop_front();
    if (!Begin(job))
    {
      m_Elsewhere.push_back(job);
    }
    Report();
  }
}

bool
Scheduler::Begin(std::size_t job)
{
  const CaseJob one = JobOf(job);
  auto          lock = CaseLock::Try(m_Options.output / ".voxelcore" / (one.one.folder + ".lock"));
  if (!lock)
  {
    return false;
  }
  std::string key;
  try
  {
    key = KeyOf(one, ScanSha256(one.one.scan, one.reading));
  }
  catch (const std::exception &)
  {
    key.clear(); // the case itself will say what is wrong with its scan
  }
  if (TroubleWith(one.folder).empty() && !m_Options.force && !key.empty() && IsDone(one.folder, key))
  {
    ++m_Finished;
    ++m_Result.kept;
    return true;
  }
  if (const std::string trouble = TroubleWritingInto(one.folder); !trouble.empty())
  {
    Fail(job, key, trouble, 0);
    return true;
  }
  try
  {
    ClearCase(one.folder);
  }
  catch (const OutputError & error)
  {
    Fail(job, key, error.what(), 0);
    return true;
  }
  const int descriptor = lock->Descriptor();
  m_Running.push_back({ job, std::move(*lock), std::move(key), ChildProcess(one.arguments, descriptor) });
  return true;
}

void
Scheduler::Wait()
{
  std::vector<int> watched;
  for (const Running & running : m_Running)
  {
    watched.push_back(running.process.EndDescriptor());
    watched.push_back(running.process.RequestDescriptor());
  }
  if (m_Running.empty() && m_Elsewhere.empty())
  {
    return;
  }
  const std::vector<bool> readable = WaitUntilReadable(watched, kPollMilliseconds);
  auto                    watch = readable.begin();
  for (auto running = m_Running.begin(); running != m_Running.end();)
  {
    const bool ended = *watch++;
    const bool asks = *watch++;
    if (asks)
    {
      if (const auto wanted = running->process.TakeRequest())
      {
        running->wanted = std::max(*wanted, 1.0);
        running->seconds = std::chrono::duration<double>(Clock::now() - running->start).count();
      }
    }
    if (ended)
    {
      Finish(*running);
    }
    running = ended ? m_Running.erase(running) : std::next(running);
  }
  // Those of others are looked at again when there is room, so that ours do not wait for them.
  if (m_Waiting.empty() && m_Running.size() < static_cast<std::size_t>(m_Options.jobs))
  {
    m_Waiting.swap(m_Elsewhere);
  }
}

void
Scheduler::GrantMemory()
{
  double used = 0;
  for (const Running & running : m_Running)
  {
    used += running.granted;
  }
  for (Running & running : m_Running)
  {
    if (running.wanted == 0 || !running.killed.empty())
    {
      continue;
    }
    if (running.wanted > m_Options.memoryMb)
    {
      running.killed = "needs about " + MemoryText(Bytes(running.wanted)) + " of memory, more than the " +
                       MemoryText(Bytes(m_Options.memoryMb)) +
                       " there are; give more --memory, single --labels, or a --crop";
      running.process.Kill();
    }
    else if (used + running.wanted <= m_Options.memoryMb)
    {
      running.granted = std::exchange(running.wanted, 0);
      used += running.granted;
      running.start = Clock::now();
      running.process.Grant();
    }
  }
}

void
Scheduler::KillLateOnes()
{
  for (Running & running : m_Running)
  {
    if (m_Options.timeout > 0 && WorkedSeconds(running) > m_Options.timeout && running.killed.empty())
    {
      running.killed = "took longer than --timeout " + ClockText(m_Options.timeout);
      running.process.Kill();
    }
  }
}

void
Scheduler::Finish(Running & running)
{
  const ChildEnd end = running.process.Collect();
  std::string    reason = ReasonOf(end, running.killed);
  if (end.code == kInterrupted)
  {
    Report(); // throws where the batch was interrupted, too: a terminal's interrupt reaches both
  }
  reason = reason.empty() ? Record(running, end) : reason;
  if (!reason.empty())
  {
    Fail(running.job, running.key, reason, end.seconds);
    return;
  }
  m_Seconds.push_back(WorkedSeconds(running));
  ++m_Finished;
}

std::string
Scheduler::Record(const Running & running, const ChildEnd & end)
{
  const CaseJob job = JobOf(running.job);
  CaseRecord    record;
  record.id = job.one.id;
  record.scan = job.one.scan;
  record.done = true;
  record.seconds = end.seconds;
  record.warnings = LinesOf(end.messages);
  record.key = running.key;
  try
  {
    record.outputs = ListOutputs(job.folder);
    const std::string seen = ScanDigestOfResults(job.folder);
    if (seen.empty())
    {
      return "ended well but left no report";
    }
    const std::string digest = ScanSha256(job.one.scan, job.reading);
    if (seen != digest || running.key != KeyOf(job, digest))
    {
      return job.one.scan + ": changed while the case ran; run the batch again";
    }
  }
  catch (const InputError & error)
  {
    return std::string(error.what()) + "; was it removed while the case ran?";
  }
  catch (const fs::filesystem_error & error)
  {
    return error.path1().string() + ": " + error.code().message() + "; was it removed while the case ran?";
  }
  return WriteRecordIfThere(job.folder, record, m_Temporaries)
           ? ""
           : job.folder.string() + ": was removed while the case ran";
}

void
Scheduler::Fail(std::size_t job, const std::string & key, const std::string & reason, double seconds)
{
  const CaseJob one = JobOf(job);
  CaseRecord    record;
  record.id = one.one.id;
  record.scan = one.one.scan;
  record.key = key;
  record.reason = reason;
  record.seconds = seconds;
  bool canRecord = TroubleWritingInto(one.folder).empty();
  if (canRecord)
  {
    try
    {
      ClearCase(one.folder); // a case killed in its last moment may have given some files their names
    }
    catch (const OutputError &)
    {
      // They stay, and the record says that they are no results.
    }
    canRecord = WriteRecordIfThere(one.folder, record, m_Temporaries);
  }
  m_Result.failed.push_back({ one.one.id, reason, canRecord });
  ++m_Finished;
}

double
Scheduler::WorkedSeconds(const Running & running)
{
  const double now = std::chrono::duration<double>(Clock::now() - running.start).count();
  return running.wanted > 0 ? running.seconds : running.seconds + now;
}

void
Scheduler::Report()
{
  std::string text = std::to_string(m_Finished - m_Result.failed.size()) + " of " + std::to_string(m_Cases.size()) +
                     " done, " + std::to_string(m_Running.size()) + " running, " +
                     std::to_string(m_Result.failed.size()) + " failed";
  std::vector<double> running;
  for (const Running & one : m_Running)
  {
    running.push_back(WorkedSeconds(one));
  }
  const std::size_t waiting = m_Cases.size() - m_Finished - running.size();
  const auto        left = SecondsLeft(m_Seconds, running, waiting, static_cast<std::size_t>(m_Options.jobs));
  if (left && *left > 0)
  {
    text += ", " + ClockText(*left) + " left";
  }
  ReportProgress(m_Progress, text, static_cast<double>(m_Finished) / static_cast<double>(m_Cases.size()));
}

} // namespace voxelcore
