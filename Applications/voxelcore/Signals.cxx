#include "Signals.h"

#include <atomic>
#include <csignal>
#include <cstring>
#include <initializer_list>
#include <sys/resource.h>
#include <unistd.h>

namespace voxelcore
{

namespace
{

// A handler gets nothing but the signal's number, so what it needs must lie here.
std::atomic<bool>                      interrupted{ false };
std::atomic<const TemporaryRegistry *> temporaries{ nullptr };
std::atomic<int>                       errorStream{ STDERR_FILENO };

constexpr int kInterrupted = 130;

void
OnInterrupt(int)
{
  if (interrupted.exchange(true))
  {
    temporaries.load()->RemoveAllNow();
    _exit(kInterrupted);
  }
}

void
OnCrash(int)
{
  static constexpr char message[] =
    "voxelcore: internal error: the program crashed; nothing was written; please report this with the scan\n";
  static_cast<void>(!write(errorStream.load(), message, sizeof(message) - 1));
  temporaries.load()->RemoveAllNow();
  _exit(1);
}

void
Install(int signal, void (*handler)(int), int flags)
{
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

} // namespace

void
HandleSignals(const TemporaryRegistry & registry, int errorDescriptor)
{
  temporaries = &registry;
  errorStream = errorDescriptor;
  const rlimit noCore{ 0, 0 };
  setrlimit(RLIMIT_CORE, &noCore);
  for (const int signal : { SIGINT, SIGTERM, SIGHUP })
  {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) // nohup, or a script's background job
    {
      Install(signal, OnInterrupt, SA_RESTART);
    }
  }
  Install(SIGPIPE, SIG_IGN, 0);
  Install(SIGXFSZ, SIG_IGN, 0);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
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

} // namespace voxelcore
