#pragma once
// What only the operating system can do or tell. src/LinuxSystem.cxx is for Linux, src/WindowsSystem.cxx for Windows;
// src/PortableSystem.cxx, taken with VOXELCORE_PORTABLE, does what can be done with the C++ standard library alone.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>

namespace voxelcore
{

/** This process among all others. */
struct ProcessFacts
{
  std::string   machine; ///< tells this machine from others
  std::string   space;   ///< tells this boot, and this space of process ids, from others
  std::int64_t  process = 0;
  std::uint64_t start = 0; ///< when it began, in the system's own ticks
};

/** The portable half draws a number for each process, as if it were alone on a machine of its own. */
ProcessFacts
ThisProcess();

/** Whether a process of this machine and space, which began at `start`, is certain to have ended. The portable half is
 *  certain of nothing. */
bool
HasProcessEnded(std::int64_t process, std::uint64_t start);

/** Whether threads can be started; a page's WebAssembly has one. */
bool
CanStartThreads();

/** How std::async() does what can be done beside: in a thread, or, where there are none, when it is asked for. */
inline std::launch
Beside()
{
  return CanStartThreads() ? std::launch::async : std::launch::deferred;
}

/** The most memory this process has had resident, in 2^20 bytes. The portable half knows only what WebAssembly has, and
 *  says 0 elsewhere. */
double
PeakMemoryMb();

/** What the machine can give now, with a tenth kept back, MB of 1e6 bytes; none where it does not say. */
std::optional<double>
AvailableMemoryMb();

/** Removes a file or an empty folder, `withContents` also what is in a folder and in folders in it. On Linux a signal
 *  handler may call it. */
void
RemoveNow(const std::filesystem::path::value_type * path, bool withContents);

/** An empty file to write to, and with `readsToo` to read from, which `isNew` must not be there yet; null, and the
 *  reason in errno. Others may give it another name or remove it while it is open. */
std::FILE *
OpenToWrite(const std::filesystem::path & path, bool isNew, bool readsToo);

/** Gives memory of an array back to the system, as far as it fills large pages. Until it is written again it holds
 *  anything. Returns how many bytes from its beginning on are done with: the next piece begins there. The portable half
 *  keeps all. */
std::size_t
ReleaseMemory(void * memory, std::size_t size);

/** A file to read from. Of its errors errno says the reason. */
class SystemFile
{
public:
  /** Opens it, at its beginning. */
  explicit SystemFile(const std::filesystem::path & path);
  ~SystemFile();
  SystemFile(const SystemFile &) = delete;
  SystemFile &
  operator=(const SystemFile &) = delete;

  bool
  IsOpen() const;

  /** How many bytes came, fewer than `count` only at the end of the file; -1: an error. */
  std::int64_t
  Read(std::byte * to, std::size_t count);

  /** Goes on so many bytes, also beyond the end. */
  void
  Skip(std::uint64_t count);

  /** Goes to this byte of the file, also beyond the end. */
  void
  MoveTo(std::uint64_t place);

  /** Tells that the `count` bytes `from` bytes on will be read, and of what lies between such pieces little: from the
   *  first call on the system reads ahead what is announced, and nothing else. It changes no byte. */
  void
  Announce(std::uint64_t from, std::uint64_t count);

private:
  struct Handle;
  std::unique_ptr<Handle> m_Handle;
};

} // namespace voxelcore
