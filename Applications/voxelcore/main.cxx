// The program voxelcore: parses, calls Options and its jobs, prints.

#include "CommandLine.h"
#include "Console.h"
#include "MainStack.h"
#include "ProgressPrinter.h"
#include "Signals.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/SystemCalls.h"
#include "voxelcore/Cohort/Admission.h"
#include "voxelcore/Cohort/Thumbnail.h"
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

enum ExitCode
{
  kDone = 0,
  kFailed = 1,
  kUsage = 2,
  kInput = 3,
  kDisagreement = 4,
  kInterrupted = 130
};

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

bool
GoesOn(const CommandLine & line)
{
  return line.command->resumes == Resumes::Always || (line.command->resumes == Resumes::IntoFolder &&
                                                      IsFolderOutput(ValueOf(line.values, *line.command, "output")));
}

/** Prints what a command says. \returns an ExitCode \throws CertificateError where it disagrees */
int
Say(const Outcome & outcome, const std::string & written, const Console & console, bool quiet)
{
  std::string text = outcome.text;
  for (const std::string & note : outcome.notes)
  {
    text += note + "\n";
  }
  if (!quiet)
  {
    for (const std::string & warning : outcome.warnings)
    {
      console.PrintError("warning: " + warning);
    }
    console.Print(text + written);
  }
  if (!outcome.disagreement.empty())
  {
    throw CertificateError(outcome.disagreement);
  }
  if (!outcome.failure.empty())
  {
    console.PrintError(outcome.failure);
    return kFailed;
  }
  return kDone;
}

int
Main(int argc, char ** argv, const Console & console, TemporaryRegistry & temporaries)
{
  const CommandLine line = ParseCommandLine(argc, argv);
  if (line.command == nullptr)
  {
    console.Print(line.text);
    return kDone;
  }
  if (GoesOn(line))
  {
    SayThatIsLeft("what is done stays, and the same command goes on from there");
  }
  const bool quiet = line.values.contains("quiet");
  const int  threads = ThreadsFrom(line.values);
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
  if (!line.command->runsCases)
  {
    context.admit = AdmissionFromEnvironment(WasInterrupted);
  }
  const auto paint = [&](const CoreReport & report) {
    if (context.admit)
    {
      PaintCase(report, context.temporaries); // for the batch's page
    }
  };
  const auto    start = std::chrono::steady_clock::now();
  const Outcome outcome =
    RunCommand(*line.command, { line.values, line.whole, omp_get_max_threads(), context, Commands(), paint });
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  printer.Clear();
  return Say(outcome, written.empty() ? "" : WrittenText(written, !outcome.saysTime, taken.count()), console, quiet);
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
