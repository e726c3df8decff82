#pragma once
// Results appear under their final names all at once and complete, or not at all.

#include "voxelcore/Base/OutputFile.h"

#include <atomic>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace voxelcore
{

/** The temporary files of running jobs, in a form that a signal handler may read. Entries live as long as the
 *  registry; adding is safe from any thread. */
class TemporaryRegistry
{
public:
  TemporaryRegistry() = default;
  TemporaryRegistry(const TemporaryRegistry &) = delete;
  TemporaryRegistry &
  operator=(const TemporaryRegistry &) = delete;
  ~TemporaryRegistry();

  /** Remembers `path` until Forget(): a file, or a directory that will be empty by its turn. Of a directory
   *  `withContents` the files in it go, too. */
  void
  Add(const std::filesystem::path & path, bool withContents = false);

  void
  Forget(const std::filesystem::path & path);

  /** Removes every remembered file, youngest first. Async-signal-safe. */
  void
  RemoveAllNow() const;

  /** Around the moment in which finished files get their names: whoever ends the program waits for its end. */
  void
  BeginCommit();
  void
  EndCommit(bool complete);

  bool
  IsCommitting() const;

  /** Whether results have got their names already. */
  bool
  HasCommitted() const;

private:
  struct Entry;
  std::atomic<Entry *> m_Head{ nullptr };
  std::atomic<int>     m_Committing{ 0 };
  std::atomic<bool>    m_HasCommitted{ false };
};

/** Writes go to temporary names beside the final ones; Commit() renames them all. Whatever was not committed is
 *  removed by the destructor, directories it made included. */
class OutputTransaction
{
public:
  /** `force`: existing files may be replaced. */
  explicit OutputTransaction(bool force, TemporaryRegistry * registry = nullptr);
  OutputTransaction(const OutputTransaction &) = delete;
  OutputTransaction &
  operator=(const OutputTransaction &) = delete;
  ~OutputTransaction();

  /** Names a file that no result may replace: the input. */
  void
  Protect(const std::filesystem::path & input);

  /** Makes the directory, parents included, when it is not there.
   *  \throws OutputError */
  void
  MakeDirectory(const std::filesystem::path & directory);

  /** Refuses, before hours of work, what could not be written in the end.
   *  \throws OutputError when the directory is missing or not writable, or the file exists and may not be replaced. */
  void
  CheckTarget(const std::filesystem::path & target) const;

  /** The temporary name to write `target` under (TemporaryName). What killed runs left in its folder is removed.
   *  \throws OutputError as CheckTarget; UsageError when two results would get one name. */
  std::filesystem::path
  Stage(const std::filesystem::path & target);

  /** For writers that name companion files after their own (.mhd and its data): the file's own name in a temporary
   *  directory beside; Commit() moves whatever lies there. */
  std::filesystem::path
  StageWithCompanions(const std::filesystem::path & target);

  struct StagedFile
  {
    std::filesystem::path temporary;
    std::filesystem::path target;
  };

  /** Those of Stage() that wait for their names. */
  std::vector<StagedFile>
  StagedFiles() const;

  /** Gives every staged file its final name; others may be staged afterwards. On failure those that got theirs are
   *  removed again. \throws OutputError */
  void
  Commit();

  /** The files that Commit() gave their names, in that order. */
  const std::vector<std::filesystem::path> &
  Written() const
  {
    return m_Written;
  }

private:
  struct Item
  {
    std::filesystem::path temporary;
    std::filesystem::path target;
    bool                  isDirectory = false;
  };
  void
  RefuseSecondUse(const std::filesystem::path & target) const;
  void
  AddCompanions();
  void
  ClearAbandoned(const std::filesystem::path & directory);
  void
  Remember(const std::filesystem::path & path, bool withContents = false);
  void
  Forget(const std::filesystem::path & path);

  bool                               m_Force;
  TemporaryRegistry *                m_Registry;
  std::vector<Item>                  m_Items;
  std::vector<std::filesystem::path> m_Written;
  std::vector<std::filesystem::path> m_Protected;
  std::vector<std::filesystem::path> m_Directories; ///< made here, outermost first
  std::set<std::filesystem::path>    m_Cleared;     ///< folders already looked through for what killed runs left
};

} // namespace voxelcore
