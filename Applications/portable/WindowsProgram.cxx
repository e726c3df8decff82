// What MainStack.cxx, Signals.cxx and StandardStreams.cxx do elsewhere, and texts in UTF-8, as they are there: of the
// command line, of the console, and of names of files.

#include "../voxelcore/Ending.h"
#include "../voxelcore/MainStack.h"
#include "../voxelcore/StandardStreams.h"
#include "voxelcore/Base/WindowsHandle.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <cwchar>
#include <fcntl.h>
#include <io.h>
#include <string>
#include <thread>
#include <vector>

#include <shellapi.h>

namespace
{

using namespace voxelcore; // NOLINT: a part of the program

std::atomic<bool> calledOff{ false };

constexpr UINT kInterrupted = 130;

[[noreturn]] void
End(UINT code)
{
  TerminateProcess(GetCurrentProcess(), code); // at once, whatever other threads hold
  std::abort();
}

[[noreturn]] void
EndInterrupted()
{
  const TemporaryRegistry * const registry = temporaries.load();
  for (int look = 0; look < kLooks && registry != nullptr && registry->IsCommitting(); ++look)
  {
    Sleep(kToCommit);
  }
  RemoveTemporaries();
  SayWhatIsLeft("\nvoxelcore: interrupted; ");
  End(kInterrupted);
}

/** In a thread of its own: Ctrl-C asks the job to stop; again, or a window that is closed, ends all at once. */
BOOL WINAPI
OnControl(DWORD event)
{
  if (interrupted.exchange(true) || event != CTRL_C_EVENT)
  {
    EndInterrupted();
  }
  std::thread([] {
    Sleep(kToStop);
    if (!calledOff.load())
    {
      EndInterrupted();
    }
  }).detach();
  return TRUE;
}

[[noreturn]] void
EndCrashed()
{
  SayCrash();
  RemoveTemporaries();
  End(1);
}

LONG WINAPI
OnCrash(EXCEPTION_POINTERS *)
{
  EndCrashed();
}

void
OnAbort(int)
{
  EndCrashed();
}

void
OnExit()
{
  if (!endsByItself.load())
  {
    SayWhatIsLeft("voxelcore: a library ended the program, as for lack of memory; ");
    RemoveTemporaries();
    End(1);
  }
}

std::string
Utf8(const wchar_t * text)
{
  std::string bytes(static_cast<std::size_t>(WideCharToMultiByte(CP_UTF8, 0, text, -1, nullptr, 0, nullptr, nullptr)),
                    '\0');
  WideCharToMultiByte(CP_UTF8, 0, text, -1, bytes.data(), static_cast<int>(bytes.size()), nullptr, nullptr);
  bytes.resize(std::strlen(bytes.c_str()));
  return bytes;
}

} // namespace

extern "C"
{
  int
  __real_main(int argc, char ** argv); // NOLINT: the linker's name for main()

  int
  __wrap_main(int, char **) // NOLINT
  {
    int                      count = 0;
    wchar_t ** const         words = CommandLineToArgvW(GetCommandLineW(), &count);
    std::vector<std::string> texts;
    std::vector<char *>      pointers;
    for (int i = 0; i < count; ++i)
    {
      texts.push_back(Utf8(words[i]));
    }
    LocalFree(words);
    for (std::string & text : texts)
    {
      pointers.push_back(text.data());
    }
    pointers.push_back(nullptr);
    return __real_main(count, pointers.data());
  }

  // By this std::filesystem makes a name of bytes, which it takes for those of the system's old code pages. Of four
  // bytes come two units: with the first three the first, with the last the other, which waits in `state`.
  std::size_t
  __wrap_mbrtowc(wchar_t * unit, const char * bytes, std::size_t count, std::mbstate_t * state)
  {
    static thread_local std::mbstate_t own;
    std::mbstate_t &                   waiting = state != nullptr ? *state : own;
    constexpr std::size_t              wrong = static_cast<std::size_t>(-1);
    if (bytes == nullptr || count == 0)
    {
      return bytes == nullptr ? 0 : static_cast<std::size_t>(-2);
    }
    if (waiting != 0)
    {
      *unit = static_cast<wchar_t>(waiting);
      waiting = 0;
      return 1;
    }
    const auto        first = static_cast<unsigned char>(*bytes);
    const int         length = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    wchar_t           units[2];
    const std::size_t had = static_cast<std::size_t>(length);
    if (had > count)
    {
      return static_cast<std::size_t>(-2);
    }
    const int made = MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, bytes, length, units, 2);
    if (made == 0)
    {
      errno = EILSEQ;
      return wrong;
    }
    if (unit != nullptr)
    {
      *unit = units[0];
    }
    if (made == 2)
    {
      waiting = units[1];
      return 3;
    }
    return units[0] == 0 ? 0 : had;
  }
}

namespace voxelcore
{

void
TakeStandardStreams(int & output, int & error)
{
  SetConsoleOutputCP(CP_UTF8);
  for (const DWORD stream : { STD_OUTPUT_HANDLE, STD_ERROR_HANDLE })
  {
    DWORD mode = 0;
    if (GetConsoleMode(GetStdHandle(stream), &mode))
    {
      SetConsoleMode(GetStdHandle(stream), mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
    }
  }
  const int nowhere = _open("NUL", _O_WRONLY | _O_NOINHERIT);
  if (nowhere < 0)
  {
    return;
  }
  output = _dup(1);
  error = _dup(2);
  for (const int copy : { output, error })
  {
    if (copy >= 0)
    {
      _setmode(copy, _O_BINARY);
    }
  }
  _dup2(nowhere, 1);
  _dup2(nowhere, 2);
  if (nowhere > 2)
  {
    _close(nowhere);
  }
}

void
ReserveMainStack()
{} // the linker has given it its size

int
RunWithStack(const std::function<int()> & work)
{
  return work();
}

void
HandleSignals(const TemporaryRegistry & registry, int errorDescriptor)
{
  temporaries = &registry;
  errorStream = errorDescriptor;
  static_cast<void>(std::atexit(OnExit));
  SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX | SEM_NOOPENFILEERRORBOX);
  SetConsoleCtrlHandler(OnControl, TRUE);
  SetUnhandledExceptionFilter(OnCrash);
  std::signal(SIGABRT, OnAbort);
  ULONG room = 65536; // a stack that ran over has none for the handler
  SetThreadStackGuarantee(&room);
}

bool
WasInterrupted()
{
  return interrupted.load();
}

void
CallOffDeadline()
{
  calledOff = true;
}

} // namespace voxelcore
