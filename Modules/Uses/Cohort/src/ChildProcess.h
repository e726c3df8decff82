#pragma once
// A case as a process of its own: this program once more.

#include <chrono>
#include <optional>
#include <string>
#include <sys/types.h>
#include <utility>
#include <vector>

namespace voxelcore
{

struct ChildEnd
{
  int         code = -1;  ///< exit code; -1 when a signal ended it
  int         signal = 0; ///< that signal
  std::string messages;   ///< its stderr, the last 64 KiB
  double      seconds = 0;
};

/** \throws UsageError where no processes can be started at all */
void
RequireChildProcesses();

/** Waits so long for one of these descriptors to become readable. \returns which are; a negative one never is */
std::vector<bool>
WaitUntilReadable(const std::vector<int> & descriptors, int milliseconds);

class ChildProcess
{
public:
  /** Starts this program with `arguments` (the first is its name). The child is killed when the calling thread's
   *  process ends; it is the first that a kernel short of memory takes; it inherits `lock`.
   *  \throws Error when no process can be started */
  ChildProcess(const std::vector<std::string> & arguments, int lock);
  ChildProcess(ChildProcess && other) noexcept
    : m_Process(std::exchange(other.m_Process, -1))
    , m_End(std::exchange(other.m_End, -1))
    , m_Channel(std::exchange(other.m_Channel, -1))
    , m_Messages(std::exchange(other.m_Messages, -1))
    , m_Start(other.m_Start)
  {}
  ChildProcess &
  operator=(ChildProcess && other) = delete;
  /** Kills it when it still runs. */
  ~ChildProcess();

  /** Becomes readable when the process has ended. */
  int
  EndDescriptor() const
  {
    return m_End;
  }
  /** Becomes readable when the child asks for memory. */
  int
  RequestDescriptor() const
  {
    return m_Channel;
  }

  /** The memory asked for, in MB; none when nothing is asked (any more). Does not wait. */
  std::optional<double>
  TakeRequest();

  /** Lets a child go on that asked. */
  void
  Grant();

  void
  Kill() const;

  /** After EndDescriptor() has become readable. */
  ChildEnd
  Collect();

private:
  pid_t                                 m_Process = -1;
  int                                   m_End = -1;
  int                                   m_Channel = -1;
  int                                   m_Messages = -1;
  std::chrono::steady_clock::time_point m_Start = std::chrono::steady_clock::now();
};

} // namespace voxelcore
