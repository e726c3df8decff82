#include "voxelcore/Jobs/OutputTransaction.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TemporaryNames.h"
#include "voxelcore/Jobs/SystemFiles.h"

#include <cerrno>
#include <cstring>
#include <exception>
#include <string>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

/** Says in the registry that files are getting their names. */
class CommitMark
{
public:
  explicit CommitMark(TemporaryRegistry * registry)
    : m_Registry(registry)
  {
    if (m_Registry != nullptr)
    {
      m_Registry->BeginCommit();
    }
  }
  CommitMark(const CommitMark &) = delete;
  CommitMark &
  operator=(const CommitMark &) = delete;
  ~CommitMark()
  {
    if (m_Registry != nullptr)
    {
      m_Registry->EndCommit(std::uncaught_exceptions() == m_Exceptions);
    }
  }

private:
  TemporaryRegistry * m_Registry;
  int                 m_Exceptions = std::uncaught_exceptions();
};

/** Whether nothing else is wrong with a path that names no file. */
bool
IsNotThere(const std::error_code & error)
{
  return !error || error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory;
}

/** Folders that may be replaced as files are: a Zarr store, and the dataset that a batch writes. */
bool
IsStore(const fs::path & path)
{
  std::error_code ignored;
  return path.extension() == ".zarr"
           ? fs::exists(path / "zarr.json", ignored) || fs::exists(path / ".zgroup", ignored)
           : path.filename() == "bids" && fs::exists(path / "dataset_description.json", ignored);
}

[[noreturn]] void
ThrowOutputError(const fs::path & path, const std::string & why)
{
  throw OutputError(path.string() + ": " + why);
}

fs::path
DirectoryOf(const fs::path & target)
{
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

} // namespace

OutputTransaction::OutputTransaction(bool force, TemporaryRegistry * registry)
  : m_Force(force)
  , m_Registry(registry)
{}

OutputTransaction::~OutputTransaction()
{
  std::error_code ignored;
  for (const Item & item : m_Items)
  {
    fs::remove_all(item.temporary, ignored);
    Forget(item.temporary);
  }
  for (auto directory = m_Directories.rbegin(); directory != m_Directories.rend(); ++directory)
  {
    fs::remove(*directory, ignored); // only when empty
    Forget(*directory);
  }
}

void
OutputTransaction::Remember(const fs::path & path, bool withContents)
{
  if (m_Registry != nullptr)
  {
    m_Registry->Add(path, withContents);
  }
}

void
OutputTransaction::Forget(const fs::path & path)
{
  if (m_Registry != nullptr)
  {
    m_Registry->Forget(path);
  }
}

void
OutputTransaction::Protect(const fs::path & input)
{
  m_Protected.push_back(input);
}

void
OutputTransaction::MakeDirectory(const fs::path & directory)
{
  const fs::path  clean = directory.has_filename() ? directory : directory.parent_path();
  std::error_code error;
  if (clean.empty() || fs::is_directory(clean, error))
  {
    return;
  }
  MakeDirectory(DirectoryOf(clean));
  if (!fs::create_directory(clean, error))
  {
    ThrowOutputError(clean, "cannot make this folder: " + (error ? error.message() : std::string("it is a file")));
  }
  m_Directories.push_back(clean);
  Remember(clean);
}

void
OutputTransaction::CheckTarget(const fs::path & target) const
{
  const fs::path  directory = DirectoryOf(target);
  std::error_code error;
  if (!fs::is_directory(directory, error) && IsNotThere(error))
  {
    ThrowOutputError(target, "cannot write: the folder " + directory.string() + " does not exist; make it first");
  }
  if (error || !MayWriteInto(directory))
  {
    ThrowOutputError(target,
                     "cannot write into the folder " + directory.string() + ": " +
                       (error ? error.message() : std::strerror(errno)));
  }
  if (fs::is_directory(target, error) && !IsStore(target))
  {
    ThrowOutputError(target, "cannot write: this is a folder; give a file name");
  }
  if (!IsNotThere(error))
  {
    ThrowOutputError(target, "cannot write: " + error.message());
  }
  for (const fs::path & input : m_Protected)
  {
    std::error_code notThere;
    if (fs::equivalent(input, target, notThere))
    {
      ThrowOutputError(target, "is the input; give another name for the output");
    }
  }
  if (!m_Force && fs::exists(fs::symlink_status(target)))
  {
    ThrowOutputError(target, "exists already; give --force to replace it, or another name");
  }
}

void
OutputTransaction::RefuseSecondUse(const fs::path & target) const
{
  for (const Item & item : m_Items)
  {
    if (item.target == target)
    {
      throw UsageError(target.string() + ": two results would be written under this name");
    }
  }
}

void
OutputTransaction::ClearAbandoned(const fs::path & directory)
{
  if (m_Cleared.insert(directory).second)
  {
    RemoveAbandoned(directory);
  }
}

fs::path
OutputTransaction::Stage(const fs::path & target)
{
  const fs::path clean = target.lexically_normal();
  RefuseSecondUse(clean);
  CheckTarget(clean);
  ClearAbandoned(DirectoryOf(clean));
  fs::path temporary = TemporaryName(clean);
  Remember(temporary); // before the file exists, so that no moment is left in which a signal would miss it
  m_Items.push_back({ temporary, clean, false });
  return temporary;
}

fs::path
OutputTransaction::StageWithCompanions(const fs::path & target)
{
  const fs::path clean = target.lexically_normal();
  RefuseSecondUse(clean);
  CheckTarget(clean);
  ClearAbandoned(DirectoryOf(clean));
  const fs::path  directory = TemporaryName(clean);
  std::error_code error;
  Remember(directory, true);
  m_Items.push_back({ directory, clean, true });
  if (!fs::create_directory(directory, error))
  {
    ThrowOutputError(clean,
                     "cannot write: " +
                       (error ? error.message() : std::string("the temporary name is taken; remove that file")));
  }
  return directory / clean.filename();
}

std::vector<OutputTransaction::StagedFile>
OutputTransaction::StagedFiles() const
{
  std::vector<StagedFile> files;
  for (const Item & item : m_Items)
  {
    if (!item.isDirectory)
    {
      files.push_back({ item.temporary, item.target });
    }
  }
  return files;
}

void
OutputTransaction::AddCompanions()
{
  const std::size_t count = m_Items.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    if (!m_Items[i].isDirectory)
    {
      continue;
    }
    const fs::path parent = DirectoryOf(m_Items[i].target);
    for (const auto & entry : fs::directory_iterator(m_Items[i].temporary))
    {
      const fs::path target = (parent / entry.path().filename()).lexically_normal();
      CheckTarget(target);
      m_Items.push_back({ entry.path(), target, false });
    }
  }
}

void
OutputTransaction::Commit()
{
  const CommitMark mark(m_Registry);
  AddCompanions();
  std::vector<fs::path>                      fresh;
  std::vector<std::pair<fs::path, fs::path>> former; ///< stores that were replaced, and their names until the end
  const auto                                 undo = [&] {
    std::error_code ignored;
    for (const fs::path & path : fresh)
    {
      fs::remove_all(path, ignored);
    }
    for (const auto & [target, aside] : former)
    {
      fs::remove_all(target, ignored);
      fs::rename(aside, target, ignored);
    }
  };
  for (const Item & item : m_Items)
  {
    if (item.isDirectory)
    {
      continue;
    }
    const bool      replaces = fs::exists(fs::symlink_status(item.target));
    std::error_code error;
    if (replaces && !m_Force)
    {
      undo();
      ThrowOutputError(item.target, "appeared while the job ran; give --force to replace it, or another name");
    }
    if (replaces && IsStore(item.target)) // no folder takes the name of one that holds something
    {
      former.emplace_back(item.target, TemporaryName(item.target.string() + ".former"));
      fs::rename(item.target, former.back().second, error);
    }
    if (!error)
    {
      fs::rename(item.temporary, item.target, error);
    }
    if (error)
    {
      undo();
      ThrowOutputError(item.target, "cannot give the finished file its name: " + error.message());
    }
    if (!replaces)
    {
      fresh.push_back(item.target);
    }
  }
  std::error_code ignored;
  for (const Item & item : m_Items)
  {
    if (item.isDirectory)
    {
      // Empty by now, so that nobody need be able to open it.
      if (!fs::remove(item.temporary, ignored))
      {
        fs::remove_all(item.temporary, ignored);
      }
    }
    else
    {
      m_Written.push_back(item.target);
    }
    Forget(item.temporary);
  }
  for (const auto & [target, aside] : former)
  {
    fs::remove_all(aside, ignored);
  }
  for (const fs::path & directory : m_Directories)
  {
    Forget(directory);
  }
  m_Items.clear();
  m_Directories.clear();
}

} // namespace voxelcore
