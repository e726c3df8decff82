#include "voxelcore/OutputTransaction.h"

#include "voxelcore/Error.h"
#include "voxelcore/TemporaryNames.h"

#include <cerrno>
#include <cstring>
#include <memory>
#include <string>
#include <unistd.h>

namespace voxelcore
{

namespace fs = std::filesystem;

struct TemporaryRegistry::Entry
{
  std::string       path;
  std::atomic<bool> live{ true };
  Entry *           next = nullptr;
};

TemporaryRegistry::~TemporaryRegistry()
{
  for (Entry * entry = m_Head.load(); entry != nullptr;)
  {
    std::unique_ptr<Entry> owned(entry);
    entry = owned->next;
  }
}

void
TemporaryRegistry::Add(const fs::path & path)
{
  auto entry = std::make_unique<Entry>();
  // The handler may run after the working directory is gone from under a relative name.
  entry->path = fs::absolute(path).string();
  entry->next = m_Head.load();
  while (!m_Head.compare_exchange_weak(entry->next, entry.get()))
  {}
  static_cast<void>(entry.release()); // owned by the list now
}

void
TemporaryRegistry::Forget(const fs::path & path)
{
  const std::string name = fs::absolute(path).string();
  for (Entry * entry = m_Head.load(); entry != nullptr; entry = entry->next)
  {
    if (entry->path == name)
    {
      entry->live = false;
    }
  }
}

void
TemporaryRegistry::RemoveAllNow() const
{
  for (const Entry * entry = m_Head.load(); entry != nullptr; entry = entry->next)
  {
    if (entry->live.load() && unlink(entry->path.c_str()) != 0)
    {
      rmdir(entry->path.c_str());
    }
  }
}

namespace
{

[[noreturn]] void
Refuse(const fs::path & path, const std::string & why)
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
OutputTransaction::Remember(const fs::path & path)
{
  if (m_Registry != nullptr)
  {
    m_Registry->Add(path);
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
  const fs::path clean = directory.has_filename() ? directory : directory.parent_path();
  if (clean.empty() || fs::is_directory(clean))
  {
    return;
  }
  MakeDirectory(DirectoryOf(clean));
  std::error_code error;
  if (!fs::create_directory(clean, error))
  {
    Refuse(clean, "cannot make this folder: " + (error ? error.message() : std::string("it is a file")));
  }
  m_Directories.push_back(clean);
  Remember(clean);
}

void
OutputTransaction::CheckTarget(const fs::path & target) const
{
  const fs::path directory = DirectoryOf(target);
  if (!fs::is_directory(directory))
  {
    Refuse(target, "cannot write: the folder " + directory.string() + " does not exist; make it first");
  }
  if (fs::is_directory(target))
  {
    Refuse(target, "cannot write: this is a folder; give a file name");
  }
  if (access(directory.c_str(), W_OK | X_OK) != 0)
  {
    Refuse(target, "cannot write into the folder " + directory.string() + ": " + std::strerror(errno));
  }
  for (const fs::path & input : m_Protected)
  {
    std::error_code notThere;
    if (fs::equivalent(input, target, notThere))
    {
      Refuse(target, "is the input; give another name for the output");
    }
  }
  if (!m_Force && fs::exists(fs::symlink_status(target)))
  {
    Refuse(target, "exists already; give --force to replace it, or another name");
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
  const fs::path temporary = TemporaryName(clean);
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
  Remember(directory);
  Remember(directory / clean.filename()); // added later, so removed earlier
  m_Items.push_back({ directory, clean, true });
  if (!fs::create_directory(directory, error))
  {
    Refuse(clean, "cannot write: " + (error ? error.message() : std::string("the temporary name is taken")));
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
  AddCompanions();
  std::vector<fs::path> fresh;
  const auto            undo = [&fresh] {
    std::error_code ignored;
    for (const fs::path & path : fresh)
    {
      fs::remove(path, ignored);
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
      Refuse(item.target, "appeared while the job ran; give --force to replace it, or another name");
    }
    fs::rename(item.temporary, item.target, error);
    if (error)
    {
      undo();
      Refuse(item.target, "cannot give the finished file its name: " + error.message());
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
      fs::remove_all(item.temporary, ignored);
    }
    Forget(item.temporary);
  }
  for (const fs::path & directory : m_Directories)
  {
    Forget(directory);
  }
  m_Items.clear();
  m_Directories.clear();
}

} // namespace voxelcore
