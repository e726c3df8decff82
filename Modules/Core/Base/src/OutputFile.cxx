#include "voxelcore/Base/OutputFile.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/SystemCalls.h"
#include "voxelcore/Base/TemporaryNames.h"

#include <cerrno>
#include <cstring>
#include <string>

namespace voxelcore
{
namespace
{

void
RemoveRegularFile(const std::filesystem::path & path)
{
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) // never a device or a pipe
  {
    std::filesystem::remove(path, ignored);
  }
}

std::FILE *
OpenForWriting(const std::filesystem::path & path, bool readsToo)
{
  std::error_code ignored;
  const auto      status = std::filesystem::status(path, ignored);
  if (!WriterOf(path) && std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
  {
    throw OutputError("cannot write '" + FinalName(path).string() +
                      "': it exists and is not a regular file; choose another name");
  }
  errno = 0;
  // Others can guess a temporary name, and in a folder they may write to put a link there: it must be new.
  std::FILE * const file = OpenToWrite(path, WriterOf(path).has_value(), readsToo);
  if (!file)
  {
    FailOutput(path, errno);
  }
  return file;
}

} // namespace

void
FailOutput(const std::filesystem::path & path, int errorNumber)
{
  if (errorNumber == EEXIST) // not ours to remove
  {
    throw OutputError("cannot write '" + FinalName(path).string() + "': the temporary name " +
                      path.filename().string() + " is taken; remove that file");
  }
  RemoveRegularFile(path);
  std::string message = "cannot write '" + FinalName(path).string() + "'";
  if (errorNumber != 0)
  {
    message += std::string(": ") + std::strerror(errorNumber);
  }
  switch (errorNumber)
  {
    case ENOENT:
    case ENOTDIR:
      message += "; create the folder first";
      break;
    case EACCES:
    case EPERM:
    case EROFS:
      message += "; choose a folder you may write to";
      break;
    case ENOSPC:
    case EFBIG:
#ifdef EDQUOT // Windows has none
    case EDQUOT:
#endif
      message += "; free some space or write elsewhere";
      break;
    default:
      message += "; check the disk or write elsewhere";
  }
  throw OutputError(message);
}

OutputFile::OutputFile(const std::filesystem::path & path, bool readsToo)
  : m_Path(path)
  , m_File(OpenForWriting(path, readsToo))
{
  (void)std::setvbuf(m_File, nullptr, _IOFBF, std::size_t{ 1 } << 20);
}

OutputFile::~OutputFile()
{
  if (m_File)
  {
    (void)std::fclose(m_File);
    RemoveRegularFile(m_Path);
  }
}

void
OutputFile::Fail(int errorNumber)
{
  if (std::FILE * file = m_File)
  {
    m_File = nullptr;
    (void)std::fclose(file);
  }
  FailOutput(m_Path, errorNumber);
}

void
OutputFile::Write(const void * data, std::size_t bytes)
{
  if (bytes != 0 && std::fwrite(data, 1, bytes, m_File) != bytes)
  {
    Fail(errno);
  }
}

std::size_t
OutputFile::Read(void * data, std::size_t bytes)
{
  const std::size_t count = std::fread(data, 1, bytes, m_File);
  if (count != bytes && std::ferror(m_File) != 0)
  {
    Fail(errno);
  }
  return count;
}

std::uint64_t
OutputFile::Place() const
{
  return static_cast<std::uint64_t>(ftello(m_File));
}

void
OutputFile::MoveTo(std::uint64_t place)
{
  if (fseeko(m_File, static_cast<off_t>(place), SEEK_SET) != 0)
  {
    Fail(errno);
  }
}

void
OutputFile::Finish()
{
  // What is still buffered is written here: a full disk may show only now.
  if (std::fflush(m_File) != 0)
  {
    Fail(errno);
  }
  std::FILE * const file = m_File;
  m_File = nullptr;
  if (std::fclose(file) != 0)
  {
    Fail(errno);
  }
}

void
WriteTextFile(const std::filesystem::path & path, std::string_view text)
{
  OutputFile file(path);
  file.Write(text);
  file.Finish();
}

} // namespace voxelcore
