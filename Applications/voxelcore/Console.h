#pragma once
// The program's own voice. Libraries print to stdout and stderr as they like; users of VoxelCore read one line that
// matters. So the two streams go to nowhere, and the program speaks through copies of them.

#include <string>

namespace voxelcore
{

class Console
{
public:
  /** Takes over both streams, unless the environment has VOXELCORE_LIBRARY_MESSAGES (to look into a library's
   *  faults). */
  Console();
  Console(const Console &) = delete;
  Console &
  operator=(const Console &) = delete;

  void
  Print(const std::string & text) const;

  /** Why some of what was printed is lost, such as a full disk; empty where all was taken, or nobody listens. */
  std::string
  OutputError() const;

  /** "voxelcore: <message>" on stderr, as one line whatever the message holds. */
  void
  PrintError(const std::string & message) const;

  /** As it stands, on stderr. */
  void
  PrintProgress(const std::string & text) const;

  bool
  ErrorIsTerminal() const;

  /** For a signal handler. */
  int
  ErrorDescriptor() const
  {
    return m_Error;
  }

private:
  int         m_Output;
  int         m_Error;
  mutable int m_OutputError = 0;
};

} // namespace voxelcore
