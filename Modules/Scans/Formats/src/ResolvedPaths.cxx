#include "ResolvedPaths.h"

namespace voxelcore
{

namespace
{

std::filesystem::path
Resolved(const std::filesystem::path & path)
{
  std::error_code             error;
  const std::filesystem::path absolute = std::filesystem::absolute(path.empty() ? "." : path);
  const std::filesystem::path resolved = std::filesystem::weakly_canonical(absolute, error);
  return error ? absolute.lexically_normal() : resolved; // links in a circle lead nowhere: opening says so
}

} // namespace

ResolvedFolder::ResolvedFolder(const std::filesystem::path & folder)
  : m_Folder(Resolved(folder))
{}

bool
ResolvedFolder::Holds(const std::filesystem::path & file) const
{
  const std::filesystem::path from = Resolved(file).lexically_relative(m_Folder);
  return !from.empty() && *from.begin() != "..";
}

} // namespace voxelcore
