// The program voxelcore: parses, calls Options and its jobs, prints.

#include "Commands.h"
#include "MainStack.h"
#include "Signals.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/SystemCalls.h"
#include "voxelcore/Cohort/Admission.h"
#include "voxelcore/Jobs/OutputNames.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>
#include <new>
#include <omp.h>
#include <string>
#include <vector>

namespace
{

using namespace voxelcore; // NOLINT: a program speaks its library's language

/** One line for each file, or for each folder of many; then the time, which tables of cores say themselves. */
std::string
WrittenText(const std::vector<std::filesystem::path> & files, bool withTime, double seconds)
{
  constexpr std::size_t                        few = 6;
  std::map<std::filesystem::path, std::size_t> folders;
  std::string                                  text;
  for (const auto & file : files)
  {
    text += "wrote " + file.string() + "\n";
    ++folders[file.parent_path()];
  }
  if (files.size() > few)
  {
    text.clear();
    for (const auto & [folder, count] : folders)
    {
      text += "wrote " + std::to_string(count) + (count == 1 ? " file to " : " files to ") +
              (folder.empty() ? "." : folder.string()) + "\n";
    }
  }
  char time[80];
  static_cast<void>(std::snprintf(time, sizeof(time), "%.2f s, peak memory %.0f MB\n", seconds, PeakMemoryMb()));
  return text + (withTime ? time : "");
}

ProgressPrinter::Style
StyleOf(const CommandLine & line, bool quiet, const Console & console)
{
  const std::string word =
    line.values.contains("progress") ? ChoiceOf(line.values, *line.command, "progress") : std::string();
  if (word == "plain")
  {
    return ProgressPrinter::Style::Plain;
  }
  if (word == "json")
  {
    return ProgressPrinter::Style::Json;
  }
  return word != "none" && !quiet && console.ErrorIsTerminal() ? ProgressPrinter::Style::Bar
                                                               : ProgressPrinter::Style::None;
}

/** Whether the same command goes on from where this one stopped: batch does, and core and skeleton into a folder. */
bool
GoesOn(const CommandLine & line)
{
  return line.command == CommandId::Batch ||
         ((line.command == CommandId::Core || line.command == CommandId::Skeleton) &&
          IsFolderOutput(ValueOf(line.values, *line.command, "output")));
}

int
Main(int argc, char ** argv, const Console & console, TemporaryRegistry & temporaries)
{
  const CommandLine line = ParseCommandLine(argc, argv);
  if (!line.command)
  {
    console.Print(line.text);
    return kDone;
  }
  if (GoesOn(line))
  {
    SayThatIsLeft("what is done stays, and the same command goes on from there");
  }
  const bool quiet = line.values.contains("quiet");
  const int  threads = ThreadsFrom(line.values, *line.command);
  if (threads > 0)
  {
    omp_set_num_threads(threads);
  }
  ProgressPrinter printer(console, StyleOf(line, quiet, console));
  JobContext      context;
  context.temporaries = &temporaries;
  context.unitsInTables = line.values.contains("units");
  context.progress = [&printer](std::string_view stage, double fraction) {
    printer.Show(stage, fraction);
    return !WasInterrupted();
  };
  std::vector<std::filesystem::path> written;
  context.wrote = [&written](const std::vector<std::filesystem::path> & files) { written = files; };
  if (*line.command != CommandId::Batch)
  {
    context.admit = AdmissionFromEnvironment(WasInterrupted);
  }
  const auto start = std::chrono::steady_clock::now();
  const Run  run{ line, console, context, printer, quiet, omp_get_max_threads() };
  const int  code = RunCommand(run);
  if (!written.empty())
  {
    const bool tableSaysTime = *line.command == CommandId::Core || *line.command == CommandId::Prune;
    run.Print(WrittenText(written,
                          !tableSaysTime,
                          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()));
  }
  return code;
}

} // namespace

int
main(int argc, char ** argv)
{
  ReserveMainStack();
  static TemporaryRegistry temporaries; // a signal may come during exit, too
  const Console            console;
  HandleSignals(temporaries, console.ErrorDescriptor());
  const auto fail = [&console](int code, const std::string & message) {
    EndByItself();
    console.PrintError(message);
    return code;
  };
  try
  {
    const int code = RunWithStack([&] { return Main(argc, argv, console, temporaries); });
    if (const std::string error = console.OutputError(); code == kDone && !error.empty())
    {
      return fail(kFailed, "what was printed is cut off: " + error);
    }
    EndByItself();
    return code;
  }
  catch (const Cancelled &)
  {
    CallOffDeadline();
    console.PrintError(std::string("interrupted; ") + WhatIsLeft());
    std::_Exit(kInterrupted); // an engine's thread may still run: no destructors under its feet
  }
  catch (const UsageError & error)
  {
    return fail(kUsage, error.what());
  }
  catch (const InputError & error)
  {
    return fail(kInput, error.what());
  }
  catch (const CertificateError & error)
  {
    return fail(kDisagreement, error.what());
  }
  catch (const std::bad_alloc &)
  {
    return fail(kFailed,
                std::string("not enough memory for this scan; ") + WhatIsLeft() +
                  "; work on single --labels, or on another machine");
  }
  catch (const std::filesystem::filesystem_error & error)
  {
    return fail(kFailed, error.path1().string() + ": " + error.code().message());
  }
  catch (const std::exception & error)
  {
    return fail(kFailed, error.what());
  }
}
