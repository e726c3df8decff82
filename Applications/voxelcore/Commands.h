#pragma once
// The commands: each makes its options, calls its job, and prints what came out.

#include "CommandLine.h"
#include "Console.h"
#include "ProgressPrinter.h"
#include "voxelcore/Jobs/JobContext.h"

#include <string>
#include <vector>

namespace voxelcore
{

enum ExitCode
{
  kDone = 0,
  kFailed = 1,
  kUsage = 2,
  kInput = 3,
  kDisagreement = 4,
  kInterrupted = 130
};

/** What every command needs at hand. */
struct Run
{
  const CommandLine & line;
  const Console &     console;
  const JobContext &  context;
  ProgressPrinter &   progress;
  bool                quiet;
  int                 threads;

  void
  Print(const std::string & text) const
  {
    progress.Clear();
    if (!quiet)
    {
      console.Print(text);
    }
  }
  void
  Warn(const std::vector<std::string> & warnings) const
  {
    progress.Clear();
    for (const std::string & warning : warnings)
    {
      if (!quiet)
      {
        console.PrintError("warning: " + warning);
      }
    }
  }
  void
  PrintNotes(const std::vector<std::string> & notes) const
  {
    for (const std::string & note : notes)
    {
      Print(note + "\n");
    }
  }
};

/** Runs the command of the line. \returns an ExitCode \throws what its job throws */
int
RunCommand(const Run & run);

} // namespace voxelcore
