#pragma once
// Names of files and folders that are being written. Each says which process writes it, so that a later run can remove
// what a killed one left, and nothing else.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace voxelcore
{

/** Which process writes a file. A process id alone would not do: another machine may share the folder, another
 *  container counts processes anew, and ids are used again. */
struct WriterIdentity
{
  std::uint32_t machine = 0; ///< digest of the host's name and its machine id
  std::uint32_t space = 0;   ///< digest of this boot and the space of process ids
  std::int64_t  process = 0;
  std::uint64_t start = 0; ///< when the process began, in clock ticks since the boot

  bool
  operator==(const WriterIdentity &) const = default;
};

/** This process. */
WriterIdentity
ThisWriter();

/** `<target>.part-<machine>-<space>-<process>-<start>`, in the same folder. A name too long for that is cut. */
std::filesystem::path
TemporaryName(const std::filesystem::path & target, const WriterIdentity & writer = ThisWriter());

/** Who writes the file of this name; none unless TemporaryName made the name. */
std::optional<WriterIdentity>
WriterOf(const std::filesystem::path & path);

/** `path` as its user knows it: the target of TemporaryName, where it is such a name or in a folder of such a name. */
std::filesystem::path
FinalName(const std::filesystem::path & path);

/** Whether the writer is certain to have ended. Of another machine, or another space of process ids, nothing is
 *  certain. */
bool
HasEnded(const WriterIdentity & writer);

/** Removes from a folder (not from those within it) what writers that have ended left. What cannot be removed stays. */
void
RemoveAbandoned(const std::filesystem::path & folder);

} // namespace voxelcore
