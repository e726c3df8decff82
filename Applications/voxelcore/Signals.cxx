#include "Ending.h"

#include "voxelcore/Base/EightLanes.h"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <initializer_list>
#include <sys/resource.h>
#include <unistd.h>

namespace voxelcore
{

namespace
{

// A handler gets nothing but the signal's number, so what it needs must lie here.
std::atomic<bool> onTerminal{ false };
std::atomic<int>  commitsWaitedFor{ 0 };
timer_t           deadline{};

constexpr int kInterrupted = 130;

void
SetDeadline(long milliseconds)
{
  const itimerspec when{ { 0, 0 }, { milliseconds / 1000, milliseconds % 1000 * 1000000 } };
  timer_settime(deadline, 0, &when, nullptr);
}

void
EndNow()
{
  if (temporaries.load()->IsCommitting() && commitsWaitedFor++ < kLooks)
  {
    SetDeadline(kToCommit);
    return;
  }
  RemoveTemporaries();
  Say(onTerminal.load() ? "\r\033[K" : ""); // where a progress bar stood
  SayWhatIsLeft("voxelcore: interrupted; ");
  _exit(kInterrupted);
}

void
OnInterrupt(int signal)
{
  const bool first = !interrupted.exchange(true);
  if (first && signal == SIGINT)
  {
    SetDeadline(kToStop);
  }
  else
  {
    EndNow();
  }
}

void
OnDeadline(int)
{
  EndNow();
}

[[maybe_unused]] void // a sanitizer tells of crashes itself
OnCrash(int)
{
  SayCrash();
  RemoveTemporaries();
  _exit(1);
}

// Libraries end a program, too: Xlib where its server is gone. Whatever code they give, even 0, the job has failed.
void
OnExit()
{
  if (!endsByItself.load())
  {
    SayWhatIsLeft("voxelcore: a library ended the program, as for lack of memory or because the X server is gone; ");
    RemoveTemporaries();
    _exit(1);
  }
}

// Before there is anything to remove or to wait for.
void
OnEarlyInterrupt(int)
{
  SayWhatIsLeft("voxelcore: interrupted; ");
  _exit(kInterrupted);
}

void
Install(int signal, void (*handler)(int), int flags)
{
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigemptyset(&action.sa_mask);
  for (const int other : { SIGINT, SIGTERM, SIGHUP, SIGALRM })
  {
    sigaddset(&action.sa_mask, other);
  }
  sigaction(signal, &action, nullptr);
}

/** nohup, or a script's background job, has a signal ignored. */
void
InstallUnlessIgnored(void (*handler)(int))
{
  for (const int signal : { SIGINT, SIGTERM, SIGHUP })
  {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN)
    {
      Install(signal, handler, SA_RESTART);
    }
  }
}

void
HandleEarlySignals(int, char **, char **)
{
  InstallUnlessIgnored(OnEarlyInterrupt);
}

// Libraries take most of the time before main() to set themselves up; the loader calls this before any of them.
[[gnu::section(".preinit_array"),
  gnu::used]] void (*const kBeforeLibraries)(int, char **, char **) = &HandleEarlySignals;

} // namespace

void
HandleSignals(const TemporaryRegistry & registry, int errorDescriptor)
{
  temporaries = &registry;
  errorStream = errorDescriptor;
  onTerminal = isatty(errorDescriptor) == 1;
  static_cast<void>(std::atexit(OnExit));            // there is room for 32
  timer_create(CLOCK_MONOTONIC, nullptr, &deadline); // sends SIGALRM
  Install(SIGALRM, OnDeadline, SA_RESTART);
  const rlimit noCore{ 0, 0 };
  setrlimit(RLIMIT_CORE, &noCore);
  InstallUnlessIgnored(OnInterrupt);
  Install(SIGPIPE, SIG_IGN, 0);
  Install(SIGXFSZ, SIG_IGN, 0);
#ifndef VOXELCORE_SANITIZED
  // A stack that ran over has no room for the handler.
  static char   room[65536];
  const stack_t stack{ room, 0, sizeof(room) };
  sigaltstack(&stack, nullptr);
  for (const int signal : { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT })
  {
    Install(signal, OnCrash, static_cast<int>(SA_RESETHAND) | SA_ONSTACK);
  }
#endif
}

bool
WasInterrupted()
{
  return interrupted.load();
}

void
CallOffDeadline()
{
  SetDeadline(0);
}

} // namespace voxelcore
