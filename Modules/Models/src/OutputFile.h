#pragma once
// A file that is written completely or not at all.

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string_view>

namespace voxelcore
{

/** \throws OutputError with one line for `path`: what could not be done, why (of the system's error number) and what to
 *  do. A regular file at `path` is removed first. */
[[noreturn]] void
FailOutput(const std::filesystem::path & path, int errorNumber);

/** Throws OutputError when a file at `path` cannot be created, or when it is there and is no regular file. */
void
CheckWritable(const std::filesystem::path & path);

/** Buffered writing; whatever goes wrong, on whichever call, throws OutputError and leaves no file. */
class OutputFile
{
public:
  explicit OutputFile(const std::filesystem::path & path);
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
  /** Flushes and closes; the file is complete when this returns. */
  void
  Finish();

private:
  std::filesystem::path m_Path;
  std::FILE *           m_File;
};

} // namespace voxelcore
