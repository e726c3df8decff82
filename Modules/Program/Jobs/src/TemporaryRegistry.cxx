#include "voxelcore/Jobs/OutputTransaction.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <string>
#include <sys/syscall.h>
#include <unistd.h>

namespace voxelcore
{

namespace fs = std::filesystem;

struct TemporaryRegistry::Entry
{
  std::string       path;
  bool              withContents = false;
  std::atomic<bool> live{ true };
  Entry *           next = nullptr;
};

TemporaryRegistry::~TemporaryRegistry()
{
  for (Entry * entry = m_Head.exchange(nullptr); entry != nullptr;)
  {
    std::unique_ptr<Entry> owned(entry);
    entry = owned->next;
  }
}

void
TemporaryRegistry::Add(const fs::path & path, bool withContents)
{
  auto entry = std::make_unique<Entry>();
  entry->withContents = withContents;
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
    if (entry->live && entry->path == name) // mostly one of the youngest: a batch adds thousands
    {
      entry->live = false;
      return;
    }
  }
}

namespace
{

/** Removes what is in a directory, folders in it to a depth. What a signal handler may call, which readdir() is not. */
void
RemoveFilesIn(int parent, const char * path, int depth)
{
  // Of each linux_dirent64: where its length and its name stand.
  constexpr long lengthAt = 16;
  constexpr long nameAt = 19;
  const int      directory = openat(parent, path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (directory < 0)
  {
    return;
  }
  alignas(std::uint64_t) std::array<char, 4096> buffer;
  for (long size = 0; (size = syscall(SYS_getdents64, directory, buffer.data(), buffer.size())) > 0;)
  {
    std::uint16_t length = 0;
    for (long at = 0; at < size; at += length)
    {
      std::memcpy(&length, buffer.data() + at + lengthAt, sizeof(length));
      const char * name = buffer.data() + at + nameAt;
      const bool   itself = std::strcmp(name, ".") == 0 || std::strcmp(name, "..") == 0;
      if (!itself && unlinkat(directory, name, 0) != 0 && depth > 0)
      {
        RemoveFilesIn(directory, name, depth - 1);
        unlinkat(directory, name, AT_REMOVEDIR);
      }
    }
  }
  close(directory);
}

} // namespace

void
TemporaryRegistry::RemoveAllNow() const
{
  for (const Entry * entry = m_Head.load(); entry != nullptr; entry = entry->next)
  {
    if (entry->live.load() && unlink(entry->path.c_str()) != 0)
    {
      if (entry->withContents)
      {
        RemoveFilesIn(AT_FDCWD, entry->path.c_str(), 3);
      }
      rmdir(entry->path.c_str());
    }
  }
}

void
TemporaryRegistry::BeginCommit()
{
  ++m_Committing;
}

void
TemporaryRegistry::EndCommit(bool complete)
{
  if (complete)
  {
    m_HasCommitted = true;
  }
  --m_Committing;
}

bool
TemporaryRegistry::IsCommitting() const
{
  return m_Committing.load() > 0;
}

bool
TemporaryRegistry::HasCommitted() const
{
  return m_HasCommitted.load();
}

} // namespace voxelcore
