#pragma once
// Where a name leads once all links on the way are followed.

#include <filesystem>

namespace voxelcore
{

/** Whether a file lies in a folder or below, both resolved. What is not there lies where its name says. */
class ResolvedFolder
{
public:
  explicit ResolvedFolder(const std::filesystem::path & folder);

  bool
  Holds(const std::filesystem::path & file) const;

private:
  std::filesystem::path m_Folder;
};

} // namespace voxelcore
