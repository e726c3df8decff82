#include "voxelcore/ItkReader/ItkProcess.h"

#include "ItkScan.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/StatedSpacing.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <optional>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace voxelcore
{
namespace
{

namespace fs = std::filesystem;

#ifdef VOXELCORE_LIBEXEC
/** The program or library that this code is linked into. */
fs::path
OwnFile()
{
  Dl_info         info{};
  std::error_code error;
  if (dladdr(reinterpret_cast<const void *>(&HasItkReader), &info) != 0 && info.dli_fname != nullptr)
  {
    const fs::path file = fs::canonical(info.dli_fname, error);
    if (!error && std::string_view(info.dli_fname).find('/') != std::string_view::npos)
    {
      return file;
    }
  }
  return fs::canonical("/proc/self/exe", error);
}
#endif

fs::path
FindHelper()
{
#ifdef VOXELCORE_LIBEXEC
  for (fs::path folder = OwnFile().parent_path(); !folder.empty(); folder = folder.parent_path())
  {
    fs::path file = folder / VOXELCORE_LIBEXEC / "voxelcore" / "voxelcore-itk-reader";
    if (::access(file.c_str(), X_OK) == 0)
    {
      return file;
    }
    if (folder == folder.root_path())
    {
      break;
    }
  }
#endif
  return {};
}

/** The helper at work on one file, with pipes to its three streams. It ends with this object. */
class ItkProcess
{
public:
  ItkProcess(const fs::path & path, ItkFormat format, const ReadOptions & options)
    : m_Path(path)
  {
    const fs::path helper = FindHelper();
    if (helper.empty())
    {
      RefuseInput(path,
                  "it is read through ITK, by voxelcore-itk-reader, which is not there",
                  "install the package voxelcore, or build with -DVOXELCORE_ITK=ON");
    }
    std::array<Pipe, 3> pipes;
    pipes[0].OpenSocket();
    pipes[1].Open();
    pipes[2].Open();
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pipes[0].ends[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, pipes[1].ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, pipes[2].ends[1], STDERR_FILENO);
    std::string                 name = helper.string();
    std::string                 word = ItkFormatName(format);
    std::string                 file = fs::absolute(path).string();
    std::string                 array = options.dataset.value_or("");
    const std::array<char *, 5> words{ name.data(),
                                       word.data(),
                                       file.data(),
                                       array.empty() ? nullptr : array.data(),
                                       nullptr };
    const int                   error = posix_spawn(&m_Process, name.c_str(), &actions, nullptr, words.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
    {
      m_Process = -1;
      RefuseInput(path, Text("voxelcore-itk-reader cannot be started (", std::strerror(error), ")"), "try again");
    }
    m_Orders = pipes[0].Take(1);
    m_Data = pipes[1].Take(0);
    m_Refusal = pipes[2].Take(0);
  }
  ItkProcess(const ItkProcess &) = delete;
  ItkProcess &
  operator=(const ItkProcess &) = delete;
  ~ItkProcess()
  {
    Close(m_Orders);
    Close(m_Data);
    Close(m_Refusal);
    if (m_Process > 0)
    {
      kill(m_Process, SIGKILL);
      while (waitpid(m_Process, nullptr, 0) < 0 && errno == EINTR)
      {}
    }
  }

  /** What it says of the scan. */
  ItkScan
  TakeScan()
  {
    constexpr std::size_t   longest = 256U << 20;
    std::string             text;
    std::array<char, 65536> part{};
    while (!text.ends_with("\n\n")) // it sends nothing more until it is asked
    {
      const ::ssize_t got = ::read(m_Data, part.data(), part.size());
      if (got < 0 && errno == EINTR)
      {
        continue;
      }
      if (got <= 0 || text.size() > longest)
      {
        Fail();
      }
      text.append(part.data(), static_cast<std::size_t>(got));
    }
    return ParseItkScan(m_Path, text);
  }

  /** Asks for voxels. */
  void
  Order(std::uint64_t volume, std::uint64_t component)
  {
    const std::string order = Text(volume, " ", component, "\n");
    // It may have ended already, which its silence then says.
    static_cast<void>(!::send(m_Orders, order.data(), order.size(), MSG_NOSIGNAL));
    Close(m_Orders);
  }

  std::size_t
  ReadSome(std::byte * to, std::size_t count)
  {
    std::size_t done = 0;
    while (done < count)
    {
      const ::ssize_t got = ::read(m_Data, to + done, std::min<std::size_t>(count - done, 1U << 30));
      if (got < 0 && errno == EINTR)
      {
        continue;
      }
      if (got <= 0)
      {
        break;
      }
      done += static_cast<std::size_t>(got);
    }
    return done;
  }

  /** At the end of its data: \throws InputError with its refusal, where it did not end well. */
  void
  CheckEnd()
  {
    std::string            refusal;
    std::array<char, 4096> part{};
    for (::ssize_t got = 1; got > 0 && refusal.size() < 65536;)
    {
      got = ::read(m_Refusal, part.data(), part.size());
      refusal.append(part.data(), static_cast<std::size_t>(std::max<::ssize_t>(0, got)));
      got = got < 0 && errno == EINTR ? 1 : got;
    }
    int status = 0;
    while (waitpid(m_Process, &status, 0) < 0 && errno == EINTR)
    {}
    m_Process = -1;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
    {
      return;
    }
    if (!refusal.empty())
    {
      const std::string file = fs::absolute(m_Path).string();
      if (refusal.starts_with(file)) // as it was named
      {
        refusal.replace(0, file.size(), m_Path.string());
      }
      throw InputError(refusal);
    }
    const bool slow = WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
    RefuseInput(m_Path,
                slow ? "reading it through ITK takes longer than a file of its size may"
                     : "it makes ITK's reader crash",
                "the file is damaged: fetch or write it anew");
  }

  /** It ended before all was said. */
  [[noreturn]] void
  Fail()
  {
    CheckEnd();
    RefuseInput(m_Path, "its reader ended too early", "fetch or write it anew");
  }

private:
  struct Pipe
  {
    std::array<int, 2> ends{ -1, -1 };

    Pipe() = default;
    Pipe(const Pipe &) = delete;
    Pipe &
    operator=(const Pipe &) = delete;
    ~Pipe()
    {
      Close(ends[0]);
      Close(ends[1]);
    }
    void
    Open()
    {
      if (pipe2(ends.data(), O_CLOEXEC) != 0)
      {
        throw Error(Text("no pipe can be made (", std::strerror(errno), ")"));
      }
    }
    /** Writing to one whose other end is gone is no signal. */
    void
    OpenSocket()
    {
      if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
      {
        throw Error(Text("no socket can be made (", std::strerror(errno), ")"));
      }
    }
    int
    Take(std::size_t end)
    {
      return std::exchange(ends[end], -1);
    }
  };

  static void
  Close(int & descriptor)
  {
    if (descriptor >= 0)
    {
      ::close(std::exchange(descriptor, -1));
    }
  }

  fs::path m_Path;
  pid_t    m_Process = -1;
  int      m_Orders = -1;
  int      m_Data = -1;
  int      m_Refusal = -1;
};

class ItkStream : public ByteStream
{
public:
  ItkStream(const fs::path & path, std::unique_ptr<ItkProcess> process)
    : ByteStream(path)
    , m_Process(std::move(process))
  {}

  std::size_t
  ReadSome(std::byte * to, std::size_t count) override
  {
    const std::size_t done = m_Process ? m_Process->ReadSome(to, count) : 0;
    if (done < count && m_Process)
    {
      const auto process = std::move(m_Process);
      process->CheckEnd();
    }
    return done;
  }

  bool
  Finish() override
  {
    std::byte more{};
    return ReadSome(&more, 1) > 0;
  }

private:
  std::unique_ptr<ItkProcess> m_Process; ///< null once it has ended
};

} // namespace

bool
HasItkReader()
{
  return !FindHelper().empty();
}

ItkFormat
FormatByItk(const fs::path & path)
{
#ifdef VOXELCORE_LIBEXEC
  std::error_code ignored;
  return !fs::is_directory(path, ignored) ? ItkFormatOf(path)
         : IsDicomFolder(path)            ? ItkFormat::Dicom
                                          : ItkFormat::None;
#else
  static_cast<void>(path);
  return ItkFormat::None;
#endif
}

ScanFile
OpenByItk(const fs::path & path, ItkFormat format, const ReadOptions & options)
{
  auto     process = std::make_unique<ItkProcess>(path, format, options);
  ItkScan  found = process->TakeScan();
  ScanFile scan;
  scan.path = path;
  scan.format = found.format;
  scan.storedType = found.storedType;
  scan.type = found.type;
  scan.geometry.size = found.size;
  scan.slope = found.slope;
  scan.intercept = found.intercept;
  scan.segments = std::move(found.segments);
  scan.notes = std::move(found.notes);
  scan.warnings = std::move(found.warnings);
  if (found.size[2] == 1 && format != ItkFormat::Dicom)
  {
    scan.notes.push_back("one slice");
  }
  const std::uint64_t volume = ChooseVolume(path, found.volumes, options);
  std::uint64_t       component = 0;
  if (!scan.segments.empty())
  {
    if (options.component)
    {
      throw UsageError("--component: of a segmentation choose with --labels");
    }
    scan.interleaved = static_cast<std::size_t>(found.components);
    scan.component = scan.interleaved > 1 ? -1 : 0;
  }
  else
  {
    component = ChooseComponent(path,
                                found.components,
                                found.separate ? "fractional segmentation" : "colour image or vectors",
                                options);
    if (found.components > 1 && !found.separate)
    {
      scan.interleaved = static_cast<std::size_t>(found.components);
      scan.component = static_cast<std::ptrdiff_t>(component);
      component = 0;
    }
  }
  CheckSize(path, scan.geometry.size, PixelBytes(scan.type) * scan.interleaved, std::uint64_t{ 1 } << 50);
  Vector3 spacing = found.spacing;
  if (spacing[0] == 0 || spacing[1] == 0 || spacing[2] == 0)
  {
    StatedSpacing stated;
    stated.source = found.format;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (spacing[axis] != 0)
      {
        stated.mm[axis] = spacing[axis];
      }
    }
    spacing = CompleteSpacing(stated, options, scan);
  }
  SetGeometry(scan, found.axes, spacing, found.origin, options);
  process->Order(volume, component);
  scan.voxels = std::make_unique<ItkStream>(path, std::move(process));
  return scan;
}

std::vector<fs::path>
ItkScanFiles(const fs::path & path, ItkFormat format)
{
  return ItkProcess(path, format, {}).TakeScan().files;
}

} // namespace voxelcore
