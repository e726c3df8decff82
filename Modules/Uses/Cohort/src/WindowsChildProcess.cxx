// In the place of ChildProcess.cxx on Windows. A descriptor is a handle, whose upper half says nothing.

#include "ChildProcess.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/WindowsHandle.h"
#include "voxelcore/Cohort/Admission.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr DWORD kPoll = 20;             // milliseconds between looks at lines, which cannot be waited for
constexpr UINT  kKilled = 0xC000'0009U; // the exit code of who is killed from here; a crash has one like it
constexpr UINT  kCrashed = 0xC000'0000U;
constexpr int   kSegmentationFault = 11;

HANDLE
Of(std::int64_t descriptor)
{
  return reinterpret_cast<HANDLE>(static_cast<std::intptr_t>(descriptor));
}

int
Descriptor(HANDLE handle)
{
  return static_cast<int>(reinterpret_cast<std::intptr_t>(handle));
}

void
Close(int & descriptor)
{
  if (descriptor != -1)
  {
    CloseHandle(Of(descriptor));
    descriptor = -1;
  }
}

[[noreturn]] void
RefuseToStart()
{
  throw Error("cannot start a case: " + std::system_category().message(static_cast<int>(GetLastError())));
}

/** Its processes are killed when this one ends, however that ends. */
HANDLE
JobOfCases()
{
  static const HANDLE job = [] {
    const HANDLE                         made = CreateJobObjectW(nullptr, nullptr);
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
    SetInformationJobObject(made, JobObjectExtendedLimitInformation, &limits, sizeof(limits));
    return made;
  }();
  return job;
}

/** An argument as CommandLineToArgvW() takes it apart again. */
std::wstring
Quoted(const std::string & argument)
{
  std::wstring text = L"\"";
  std::size_t  backslashes = 0;
  for (const wchar_t c : std::filesystem::path(argument).wstring())
  {
    backslashes = c == L'\\' ? backslashes + 1 : 0;
    if (c == L'"')
    {
      text += L"\"\""; // two are one, within quotes
    }
    else
    {
      text += c;
    }
  }
  return text + std::wstring(backslashes, L'\\') + L"\"";
}

std::wstring
ThisProgram()
{
  std::wstring path(32768, L'\0');
  path.resize(GetModuleFileNameW(nullptr, path.data(), static_cast<DWORD>(path.size())));
  return path;
}

/** A file without a name for long: it goes when the last handle is closed. */
HANDLE
TemporaryFile(SECURITY_ATTRIBUTES & inherited)
{
  static std::atomic<unsigned> number{ 0 };
  const auto                   path = std::filesystem::temp_directory_path() /
                    ("voxelcore-" + std::to_string(GetCurrentProcessId()) + "-" + std::to_string(++number) + ".txt");
  return CreateFileW(path.c_str(),
                     GENERIC_READ | GENERIC_WRITE,
                     kSharedByAll,
                     &inherited,
                     CREATE_ALWAYS,
                     FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE,
                     nullptr);
}

bool
IsReadable(int descriptor)
{
  if (descriptor == -1)
  {
    return false;
  }
  if (GetFileType(Of(descriptor)) != FILE_TYPE_PIPE)
  {
    return WaitForSingleObject(Of(descriptor), 0) == WAIT_OBJECT_0;
  }
  DWORD waiting = 0;
  return PeekNamedPipe(Of(descriptor), nullptr, 0, nullptr, &waiting, nullptr)
           ? waiting > 0
           : GetLastError() == ERROR_BROKEN_PIPE; // the child is at its end; before it has come there is nothing
}

} // namespace

void
RequireChildProcesses()
{}

std::vector<bool>
WaitUntilReadable(const std::vector<int> & descriptors, int milliseconds)
{
  for (int waited = 0;; waited += kPoll)
  {
    std::vector<bool> readable;
    for (const int descriptor : descriptors)
    {
      readable.push_back(IsReadable(descriptor));
    }
    if (waited >= milliseconds || ranges::count(readable, true) > 0)
    {
      return readable;
    }
    Sleep(kPoll);
  }
}

ChildProcess::ChildProcess(const std::vector<std::string> & arguments, int /*lock: the child ends with this process*/)
{
  static std::atomic<unsigned> number{ 0 };
  const std::wstring           line =
    L"\\\\.\\pipe\\voxelcore-" + std::to_wstring(GetCurrentProcessId()) + L"-" + std::to_wstring(++number);
  SECURITY_ATTRIBUTES inherited{ sizeof(SECURITY_ATTRIBUTES), nullptr, TRUE };
  WindowsHandle       messages(TemporaryFile(inherited));
  WindowsHandle       channel(CreateNamedPipeW(line.c_str(),
                                         PIPE_ACCESS_DUPLEX | FILE_FLAG_FIRST_PIPE_INSTANCE,
                                         PIPE_TYPE_MESSAGE | PIPE_READMODE_MESSAGE | PIPE_NOWAIT,
                                         1,
                                         256,
                                         256,
                                         0,
                                         nullptr));
  WindowsHandle       nothing(
    CreateFileW(L"NUL", GENERIC_READ | GENERIC_WRITE, kSharedByAll, &inherited, OPEN_EXISTING, 0, nullptr));
  if (!messages.IsOpen() || !channel.IsOpen() || !nothing.IsOpen())
  {
    RefuseToStart();
  }
  std::wstring command;
  for (const std::string & argument : arguments)
  {
    command += (command.empty() ? L"" : L" ") + Quoted(argument);
  }
  // What it shall inherit is named, as others may start processes at the same time.
  std::array<HANDLE, 2> handles{ messages.Get(), nothing.Get() };
  SIZE_T                size = 0;
  InitializeProcThreadAttributeList(nullptr, 1, 0, &size);
  const auto memory = std::make_unique<char[]>(size);
  auto *     list = reinterpret_cast<LPPROC_THREAD_ATTRIBUTE_LIST>(memory.get());
  if (!InitializeProcThreadAttributeList(list, 1, 0, &size) ||
      !UpdateProcThreadAttribute(list,
                                 0,
                                 PROC_THREAD_ATTRIBUTE_HANDLE_LIST,
                                 handles.data(),
                                 sizeof(handles),
                                 nullptr,
                                 nullptr))
  {
    RefuseToStart();
  }
  STARTUPINFOEXW start{};
  start.StartupInfo.cb = sizeof(start);
  start.StartupInfo.dwFlags = STARTF_USESTDHANDLES;
  start.StartupInfo.hStdInput = nothing.Get();
  start.StartupInfo.hStdOutput = nothing.Get();
  start.StartupInfo.hStdError = messages.Get();
  start.lpAttributeList = list;
  PROCESS_INFORMATION made{};
  // Children get the variable with their start. Cases are started by one thread.
  SetEnvironmentVariableA(kAdmissionVariable, std::filesystem::path(line).string().c_str());
  const BOOL isStarted = CreateProcessW(ThisProgram().c_str(),
                                        command.data(),
                                        nullptr,
                                        nullptr,
                                        TRUE,
                                        CREATE_SUSPENDED | EXTENDED_STARTUPINFO_PRESENT,
                                        nullptr,
                                        nullptr,
                                        &start.StartupInfo,
                                        &made);
  SetEnvironmentVariableA(kAdmissionVariable, nullptr);
  DeleteProcThreadAttributeList(list);
  if (!isStarted)
  {
    RefuseToStart();
  }
  const WindowsHandle thread(made.hThread);
  if (!AssignProcessToJobObject(JobOfCases(), made.hProcess))
  {
    TerminateProcess(made.hProcess, kKilled);
    CloseHandle(made.hProcess);
    RefuseToStart();
  }
  m_End = Descriptor(made.hProcess);
  m_Process = m_End;
  m_Messages = Descriptor(messages.Release());
  m_Channel = Descriptor(channel.Release());
  ResumeThread(thread.Get());
}

ChildProcess::~ChildProcess()
{
  if (m_Process != -1)
  {
    Kill();
    WaitForSingleObject(Of(m_End), INFINITE);
  }
  Close(m_End);
  Close(m_Channel);
  Close(m_Messages);
}

std::optional<double>
ChildProcess::TakeRequest()
{
  std::array<char, 64> text{};
  DWORD                count = 0;
  double               megabytes = 0;
  if (m_Channel == -1)
  {
    return std::nullopt;
  }
  if (!ReadFile(Of(m_Channel), text.data(), text.size(), &count, nullptr) || count == 0)
  {
    if (GetLastError() == ERROR_BROKEN_PIPE)
    {
      Close(m_Channel); // the child is at its end
    }
    return std::nullopt;
  }
  from_chars(text.data(), text.data() + count, megabytes);
  return megabytes;
}

void
ChildProcess::Grant()
{
  DWORD written = 0;
  WriteFile(Of(m_Channel), "g", 1, &written, nullptr);
}

void
ChildProcess::Kill() const
{
  TerminateProcess(Of(m_End), kKilled);
}

ChildEnd
ChildProcess::Collect()
{
  ChildEnd end;
  DWORD    code = 0;
  WaitForSingleObject(Of(m_End), INFINITE);
  GetExitCodeProcess(Of(m_End), &code);
  m_Process = -1;
  end.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - m_Start).count();
  end.signal = code == kKilled ? 9 : code >= kCrashed ? kSegmentationFault : 0;
  end.code = end.signal != 0 ? -1 : static_cast<int>(code);
  constexpr std::int64_t kMost = 65536;
  LARGE_INTEGER          size{};
  LARGE_INTEGER          from{};
  GetFileSizeEx(Of(m_Messages), &size);
  from.QuadPart = std::max<std::int64_t>(0, size.QuadPart - kMost);
  SetFilePointerEx(Of(m_Messages), from, nullptr, FILE_BEGIN);
  end.messages.resize(static_cast<std::size_t>(size.QuadPart - from.QuadPart));
  DWORD got = 0;
  ReadFile(Of(m_Messages), end.messages.data(), static_cast<DWORD>(end.messages.size()), &got, nullptr);
  end.messages.resize(got);
  return end;
}

std::function<void(double)>
AdmissionFromEnvironment(std::function<bool()> stop)
{
  const char * line = std::getenv(kAdmissionVariable);
  if (line == nullptr)
  {
    return {};
  }
  // It stays open until the process ends, which tells the batch.
  const HANDLE channel = CreateFileA(line, GENERIC_READ | GENERIC_WRITE, 0, nullptr, OPEN_EXISTING, 0, nullptr);
  return [channel, stop = std::move(stop)](double megabytes) {
    const std::string request = std::to_string(megabytes);
    DWORD             count = 0;
    const auto        gone = [] { return Error("the batch that started this case is gone"); };
    if (!WriteFile(channel, request.data(), static_cast<DWORD>(request.size()), &count, nullptr))
    {
      throw gone();
    }
    for (;; Sleep(kPoll))
    {
      DWORD waiting = 0;
      if (!PeekNamedPipe(channel, nullptr, 0, nullptr, &waiting, nullptr))
      {
        throw gone();
      }
      char granted = 0;
      if (waiting > 0 && ReadFile(channel, &granted, 1, &count, nullptr))
      {
        return;
      }
      if (stop())
      {
        throw Cancelled();
      }
    }
  };
}

} // namespace voxelcore
