#pragma once
// One process at a time works on a case, whichever batch it belongs to.

#include "voxelcore/Jobs/SystemFiles.h"

#include <filesystem>
#include <optional>

namespace voxelcore
{

/** An flock on a file of its own. It dies with the last process that holds its descriptor, however that ends; a child
 *  that inherits it keeps it when the batch is killed first, so that nobody starts while the child may still write. */
class CaseLock
{
public:
  /** None when another process has it. \throws OutputError when the file cannot be made */
  static std::optional<CaseLock>
  Try(const std::filesystem::path & file);

  CaseLock(CaseLock && other) noexcept = default;
  CaseLock &
  operator=(CaseLock && other) = delete;
  ~CaseLock();

  int
  Descriptor() const
  {
    return m_Lock.Descriptor();
  }

private:
  CaseLock(std::filesystem::path file, LockedFile lock);

  std::filesystem::path m_File;
  LockedFile            m_Lock;
};

} // namespace voxelcore
