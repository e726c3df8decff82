#include "RunReader.h"

#include "ScanSource.h"
#include "TemporaryFiles.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TextFields.h"

#include <itkMacro.h>

#include <gdcmTrace.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iostream>
#include <sys/resource.h>
#include <unistd.h>

namespace voxelcore::itkreader
{
namespace
{

constexpr std::uint64_t kWorkingMemory = 256U << 20; // besides what is mapped when this begins

/** Nothing a file says makes this process take more, or go on for longer, than a file of its size may need. */
void
Limit(int what, std::uint64_t most)
{
  rlimit limit{};
  getrlimit(static_cast<__rlimit_resource>(what), &limit);
  limit.rlim_cur = std::min<rlim_t>(most, limit.rlim_max);
  setrlimit(static_cast<__rlimit_resource>(what), &limit);
}

std::uint64_t
BytesOf(const std::filesystem::path & path)
{
  std::error_code ignored;
  std::uint64_t   bytes = 0;
  if (!std::filesystem::is_directory(path, ignored))
  {
    bytes = std::filesystem::file_size(path, ignored);
    return ignored ? 0 : bytes;
  }
  for (const auto & entry : std::filesystem::directory_iterator(path, ignored))
  {
    const auto size = entry.is_regular_file(ignored) ? entry.file_size(ignored) : 0;
    bytes += ignored ? 0 : size;
  }
  return bytes;
}

/** What this process has mapped: libraries, for the most part. */
std::uint64_t
MappedBytes()
{
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void
LimitTo(std::uint64_t fileBytes, std::uint64_t volumeBytes)
{
  static const std::uint64_t atFirst = MappedBytes();
#ifdef __SANITIZE_ADDRESS__ // which maps terabytes
  static_cast<void>(atFirst);
#else
  Limit(RLIMIT_AS, atFirst + kWorkingMemory + 4 * fileBytes + 3 * volumeBytes);
#endif
  Limit(RLIMIT_CPU, 5 + (fileBytes + volumeBytes) / (4U << 20));
}

/** All of it, or the end: whoever asked wants no more. */
void
WriteAll(const char * bytes, std::size_t count)
{
  while (count > 0)
  {
    const ::ssize_t done = ::write(STDOUT_FILENO, bytes, std::min<std::size_t>(count, 1U << 30));
    if (done < 0 && errno == EINTR)
    {
      continue;
    }
    if (done <= 0)
    {
      std::_Exit(0);
    }
    bytes += done;
    count -= static_cast<std::size_t>(done);
  }
}

ItkFormat
FormatNamed(std::string_view name)
{
  for (const ItkFormat format :
       { ItkFormat::Dicom, ItkFormat::Mrc, ItkFormat::Minc, ItkFormat::Gipl, ItkFormat::Vtk, ItkFormat::Hdf5 })
  {
    if (name == ItkFormatName(format))
    {
      return format;
    }
  }
  return ItkFormat::None;
}

/** Sizes that are none, or more than files of this size can hold whatever packs them, are refused before they are
 *  made room for. Returns the bytes of the volume. */
std::uint64_t
CheckedBytes(const std::filesystem::path & path, const ItkScan & scan, std::uint64_t fileBytes)
{
  constexpr std::uint64_t mostTimes = 1100; // deflate at its best
  const std::uint64_t     bytesPerVoxel = PixelBytes(scan.type) * scan.components;
  std::uint64_t           bytes = bytesPerVoxel * scan.volumes;
  for (const std::int64_t side : scan.size)
  {
    if (side < 1 || side > (std::int64_t{ 1 } << 30) ||
        bytes > (std::uint64_t{ 1 } << 50) / static_cast<std::uint64_t>(side))
    {
      RefuseInput(path, "its header gives a size that makes no sense", "the file is damaged: write it anew");
    }
    bytes *= static_cast<std::uint64_t>(side);
  }
  if (bytes / mostTimes > fileBytes)
  {
    RefuseInput(path, "its header gives more voxels than its data can hold", "the file is truncated: fetch it anew");
  }
  return bytes;
}

void
Run(ItkFormat format, const std::filesystem::path & path, const std::string & dataset)
{
  // A file of a series stands for its folder.
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const auto fileBytes = BytesOf(format == ItkFormat::Dicom && !std::filesystem::is_directory(path) ? folder : path);
  LimitTo(fileBytes, 0);
  const std::unique_ptr<ScanSource> source =
    format == ItkFormat::Dicom ? OpenDicom(path) : OpenByImageIO(path, format, dataset);
  const std::uint64_t bytes = CheckedBytes(path, source->scan, fileBytes);
  const std::string   text = ItkScanText(source->scan);
  WriteAll(text.data(), text.size());
  std::uint64_t volume = 0;
  std::uint64_t component = 0;
  if (!(std::cin >> volume >> component)) // enough was learned
  {
    return;
  }
  if (volume >= source->scan.volumes || component >= source->scan.components)
  {
    RefuseInput(path, "a volume was asked for that is not there", "please report this as a fault");
  }
  LimitTo(fileBytes, bytes);
  source->Send(volume, component, WriteAll);
}

/** One line without the name and address that ITK puts before it. */
std::string
OneLine(std::string text)
{
  if (const std::size_t address = text.find("(0x"); address != std::string::npos)
  {
    text.erase(0, std::min(text.find("): ", address), text.size() - 3) + 3);
  }
  for (char & c : text)
  {
    c = c == '\n' || c == '\r' || c == '\t' ? ' ' : c;
  }
  return Printable(Trim(text), 200);
}

} // namespace

int
RunReader(int argc, char ** argv)
{
  if (argc < 3 || argc > 4 || FormatNamed(argv[1]) == ItkFormat::None)
  {
    std::cerr << "usage: voxelcore-itk-reader dicom|mrc|minc|gipl|vtk|hdf5 PATH [DATASET]; VoxelCore calls it\n";
    return 2;
  }
  const std::filesystem::path path(argv[2]);
  std::signal(SIGINT, SIG_IGN); // whoever asked ends this
  Limit(RLIMIT_CORE, 0);
  // What libraries print belongs nowhere.
  const int refusals = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDERR_FILENO);
  gdcm::Trace::DebugOff();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  std::string refusal;
  try
  {
    if (FormatNamed(argv[1]) == ItkFormat::Minc)
    {
      KeepTemporaryFilesApart();
    }
    Run(FormatNamed(argv[1]), path, argc > 3 ? argv[3] : "");
    return 0;
  }
  catch (const Error & error)
  {
    refusal = error.what();
  }
  catch (const itk::ExceptionObject & error)
  {
    refusal = Text(path.string(),
                   ": ITK cannot read it (",
                   OneLine(error.GetDescription()),
                   "); the file is damaged, or "
                   "of a kind ITK does not know");
  }
  catch (const std::bad_alloc &)
  {
    refusal = path.string() + ": it asks for more memory than a file of its size needs; the file is damaged";
  }
  catch (const std::exception & error)
  {
    refusal = Text(path.string(), ": cannot be read (", OneLine(error.what()), "); the file is damaged");
  }
  catch (...) // HDF5's exceptions have no common base with others
  {
    refusal = path.string() + ": cannot be read; the file is damaged";
  }
  static_cast<void>(!::write(refusals, refusal.data(), refusal.size()));
  return 3;
}

} // namespace voxelcore::itkreader
