#pragma once
// A file that is written completely or not at all.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string_view>

namespace voxelcore
{

/** \throws OutputError with one line for `path`, by its final name: what could not be done, why (of the system's error
 *  number) and what to do. A regular file at `path` is removed first. */
[[noreturn]] void
FailOutput(const std::filesystem::path & path, int errorNumber);

/** Buffered writing; whatever goes wrong, on whichever call, throws OutputError with the system's reason and leaves no
 *  file. */
class OutputFile
{
public:
  explicit OutputFile(const std::filesystem::path & path, bool readsToo = false);
  OutputFile(const OutputFile &) = delete;
  OutputFile &
  operator=(const OutputFile &) = delete;
  /** Removes the file unless Finish was called. */
  ~OutputFile();

  void
  Write(const void * data, std::size_t bytes);
  void
  Write(std::string_view text)
  {
    Write(text.data(), text.size());
  }
  /** Of a file that `readsToo`, after MoveTo(): as many bytes as there are. Before the next Write() comes MoveTo(). */
  std::size_t
  Read(void * data, std::size_t bytes);
  /** Where the next byte goes, from the beginning. */
  std::uint64_t
  Place() const;
  void
  MoveTo(std::uint64_t place);
  /** Flushes and closes; the file is complete when this returns. */
  void
  Finish();

private:
  [[noreturn]] void
  Fail(int errorNumber);

  std::filesystem::path m_Path;
  std::FILE *           m_File;
};

/** Writes a file completely or throws OutputError and leaves none. */
void
WriteTextFile(const std::filesystem::path & path, std::string_view text);

} // namespace voxelcore
