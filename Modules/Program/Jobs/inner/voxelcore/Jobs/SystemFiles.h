#pragma once
// What jobs ask of a file system beyond the C++ standard library: src/PosixFiles.cxx, on Windows src/WindowsFiles.cxx.

#include <cstdint>
#include <ctime>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace voxelcore
{

/** Whether files can be made in this folder; else errno says why not. */
bool
MayWriteInto(const std::filesystem::path & folder);

/** When a file was last changed; 0 where nobody knows. */
std::time_t
LastChanged(const std::filesystem::path & path);

/** The files whose names match a pattern of * and ?, in order; on Windows these stand in the last part alone. */
std::vector<std::string>
MatchesOf(const std::filesystem::path & pattern);

/** A file that one process at a time has open in this way. The lock dies with the last process that holds it, however
 *  that ends. */
class LockedFile
{
public:
  LockedFile() = default;
  /** Opens it, no link, `create` also where it is not there, and locks it. Where that fails errno says why: EWOULDBLOCK
   *  when another process has it. */
  LockedFile(const std::filesystem::path & path, bool create);
  LockedFile(LockedFile && other) noexcept
    : m_Handle(std::exchange(other.m_Handle, -1))
  {}
  LockedFile &
  operator=(LockedFile && other) noexcept
  {
    std::swap(m_Handle, other.m_Handle);
    return *this;
  }
  ~LockedFile();

  bool
  IsOpen() const
  {
    return m_Handle != -1;
  }

  /** Whether the file that has this name now is this one. */
  bool
  Is(const std::filesystem::path & path) const;

  /** Writes behind its end; false, and the reason in errno, when some of it is missing. */
  bool
  Append(std::string_view text);

  /** For a child that shall hold the lock, too. */
  int
  Descriptor() const
  {
    return static_cast<int>(m_Handle);
  }

private:
  std::intptr_t m_Handle = -1;
};

} // namespace voxelcore
