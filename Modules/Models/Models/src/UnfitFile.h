#pragma once
// How readers of files say that a file is damaged.

#include <filesystem>
#include <string>

namespace voxelcore
{

/** Ends reading: the file is damaged or not one of ours; the reason begins in the middle of a sentence. */
struct UnfitFile
{
  std::string reason;
};

/** Throws UnfitFile when the condition does not hold. */
inline void
RequireFit(bool condition, const char * reason)
{
  if (!condition)
  {
    throw UnfitFile{ reason };
  }
}

/** All bytes of a file. \throws UnfitFile */
std::string
WholeFile(const std::filesystem::path & path);

} // namespace voxelcore
