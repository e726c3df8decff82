#include "Console.h"

#include "StandardStreams.h"
#include "voxelcore/Base/PlainText.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <unistd.h>

namespace voxelcore
{

namespace
{

/** \returns 0, or the number of the error that left some of it unwritten */
int
WriteAll(int descriptor, const std::string & text)
{
  for (std::size_t done = 0; done < text.size();)
  {
    const ssize_t written = write(descriptor, text.data() + done, text.size() - done);
    if (written <= 0)
    {
      return errno;
    }
    done += static_cast<std::size_t>(written);
  }
  return 0;
}

} // namespace

Console::Console()
  : m_Output(STDOUT_FILENO)
  , m_Error(STDERR_FILENO)
{
  if (std::getenv("VOXELCORE_LIBRARY_MESSAGES") == nullptr)
  {
    TakeStandardStreams(m_Output, m_Error);
  }
}

void
Console::Print(const std::string & text) const
{
  // What is read by a program comes through as it is, as names of files do.
  const int error = WriteAll(m_Output, isatty(m_Output) == 1 ? PlainText(text, true) : text);
  if (error != 0 && error != EPIPE && error != EBADF) // these two: nobody listens
  {
    m_OutputError = error;
  }
}

std::string
Console::OutputError() const
{
  return m_OutputError == 0 ? std::string() : std::system_category().message(m_OutputError);
}

void
Console::PrintError(const std::string & message) const
{
  std::string line = "voxelcore: " + message;
  for (char & c : line)
  {
    if (static_cast<unsigned char>(c) < 0x20U || c == 0x7F)
    {
      c = ' ';
    }
  }
  line.erase(line.find_last_not_of(' ') + 1);
  WriteAll(m_Error, PlainText(line) + "\n");
}

void
Console::PrintProgress(const std::string & text) const
{
  WriteAll(m_Error, text);
}

bool
Console::ErrorIsTerminal() const
{
  return isatty(m_Error) == 1;
}

} // namespace voxelcore
