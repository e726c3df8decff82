#pragma once
// What the rooms' halves for Windows share.

#include <cerrno>
#include <system_error>
#include <utility>

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

namespace voxelcore
{

/** Others may read, write, rename and remove a file while it is open, as elsewhere. */
constexpr DWORD kSharedByAll = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

/** What GetLastError() says, as errno would. */
inline int
LastErrorNumber()
{
  const std::error_code error(static_cast<int>(GetLastError()), std::system_category());
  const auto            condition = error.default_error_condition();
  return condition.category() == std::generic_category() ? condition.value() : EIO;
}

/** Closes what CreateFileW() and its like open. */
class WindowsHandle
{
public:
  explicit WindowsHandle(HANDLE handle)
    : m_Handle(handle == nullptr ? INVALID_HANDLE_VALUE : handle)
  {}
  WindowsHandle(const WindowsHandle &) = delete;
  WindowsHandle &
  operator=(const WindowsHandle &) = delete;
  ~WindowsHandle()
  {
    if (IsOpen())
    {
      CloseHandle(m_Handle);
    }
  }

  bool
  IsOpen() const
  {
    return m_Handle != INVALID_HANDLE_VALUE;
  }
  HANDLE
  Get() const
  {
    return m_Handle;
  }
  /** Leaves it to the caller to close it. */
  HANDLE
  Release()
  {
    return std::exchange(m_Handle, INVALID_HANDLE_VALUE);
  }

private:
  HANDLE m_Handle;
};

} // namespace voxelcore
