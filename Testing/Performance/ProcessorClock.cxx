// Preloaded (LD_PRELOAD) into a program it makes steady clocks run with the processor time of the process: what the
// program says of its stages then is what they take of processors, whatever else the machine does. Of one thread that
// is what a stage takes on a machine with nothing else to do; of several it is their sum.

#include <ctime>

#include <sys/syscall.h>
#include <unistd.h>

extern "C" __attribute__((visibility("default"))) int
clock_gettime(clockid_t clock, timespec * time) noexcept
{
  return static_cast<int>(
    syscall(SYS_clock_gettime, clock == CLOCK_MONOTONIC ? CLOCK_PROCESS_CPUTIME_ID : clock, time));
}
