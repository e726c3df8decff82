#pragma once
// A display to draw on, where there may be none.

#include <sys/types.h>

namespace voxelcore
{

/** A connection to the X server of the environment or, where that cannot be reached, to an Xvfb of our own, which lives
 *  as long as this object and never longer than the process. */
class VirtualDisplay
{
public:
  /** \throws OutputError with one line when there is neither. */
  VirtualDisplay();
  VirtualDisplay(const VirtualDisplay &) = delete;
  VirtualDisplay &
  operator=(const VirtualDisplay &) = delete;
  ~VirtualDisplay();

  /** Xlib's Display. */
  void *
  Connection() const
  {
    return m_Connection;
  }

private:
  void
  EndServer();

  void * m_Connection = nullptr;
  pid_t  m_Server = -1;
};

} // namespace voxelcore
