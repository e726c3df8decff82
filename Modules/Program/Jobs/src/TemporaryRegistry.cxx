#include "voxelcore/Base/SystemCalls.h"
#include "voxelcore/Jobs/OutputTransaction.h"

#include <memory>

namespace voxelcore
{

namespace fs = std::filesystem;

struct TemporaryRegistry::Entry
{
  fs::path          path;
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
  entry->path = fs::absolute(path);
  entry->next = m_Head.load();
  while (!m_Head.compare_exchange_weak(entry->next, entry.get()))
  {}
  static_cast<void>(entry.release()); // owned by the list now
}

void
TemporaryRegistry::Forget(const fs::path & path)
{
  const fs::path name = fs::absolute(path);
  for (Entry * entry = m_Head.load(); entry != nullptr; entry = entry->next)
  {
    if (entry->live && entry->path.native() == name.native()) // mostly one of the youngest: a batch adds thousands
    {
      entry->live = false;
      return;
    }
  }
}

void
TemporaryRegistry::RemoveAllNow() const
{
  for (const Entry * entry = m_Head.load(); entry != nullptr; entry = entry->next)
  {
    if (entry->live.load())
    {
      RemoveNow(entry->path.c_str(), entry->withContents);
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
