// The program voxelcore: parses, calls Options and its jobs, prints.

#include "CommandLine.h"
#include "Console.h"
#include "ProgressPrinter.h"
#include "Signals.h"
#include "voxelcore/Admission.h"
#include "voxelcore/BatchJob.h"
#include "voxelcore/Error.h"
#include "voxelcore/OutputNames.h"
#include "voxelcore/ReportTable.h"
#include "voxelcore/Thumbnail.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <new>
#include <omp.h>
#include <string>
#include <vector>

namespace
{

using namespace voxelcore; // NOLINT: a program's only file speaks its library's language

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

void
PrintCore(const Run & run, const CoreResult & result)
{
  run.Warn(result.warnings);
  run.Print(ReportTable(result.report));
  if (result.report.skeleton)
  {
    run.Print(SkeletonTable(result.report));
  }
  run.PrintNotes(result.notes);
}

int
RunStudy(const Run & run, const CoreOptions & options, const std::vector<std::int64_t> & resolutions)
{
  const StudyResult result = RunStudyJob(options, resolutions, run.context);
  for (std::size_t i = 0; i < resolutions.size(); ++i)
  {
    run.Print("resolution " + std::to_string(resolutions[i]) + "\n");
    PrintCore(run, result.runs[i]);
  }
  return kDone;
}

int
RunVoxelize(const Run & run)
{
  const VoxelizeResult result = RunVoxelizeJob(VoxelizeOptionsFrom(run.line.values), run.context);
  run.Warn(result.warnings);
  for (const std::string & line : result.lines)
  {
    run.Print(line + "\n");
  }
  return kDone;
}

int
RunCore(const Run & run)
{
  if (const auto block = BlockOptionsFrom(run.line.values))
  {
    const BlockResult result = RunBlockJob(*block, run.context);
    run.Warn(result.warnings);
    run.Print(BlockText(result, *block));
    return kDone;
  }
  CoreOptions options = CoreOptionsFrom(run.line.values);
  options.threads = run.threads;
  options.command = run.line.whole;
  if (const auto resolutions = ResolutionsFrom(run.line.values, CommandId::Core); resolutions.size() > 1)
  {
    return RunStudy(run, options, resolutions);
  }
  const CoreResult result = RunCoreJob(options, run.context);
  if (run.context.admit)
  {
    PaintCase(result.report); // for the batch's page
  }
  PrintCore(run, result);
  return kDone;
}

int
RunBatch(const Run & run)
{
  const BatchOptions options = BatchOptionsFrom(run.line.values);
  if (run.line.values.contains("list"))
  {
    run.Print(CaseList(options));
    return kDone;
  }
  const BatchResult result = RunBatchJob(options, run.context);
  run.Print(BatchText(result));
  if (!result.failed.empty())
  {
    run.console.PrintError(std::to_string(result.failed.size()) + " of " + std::to_string(result.cases) +
                           " cases failed, the first, " + result.failed.front().id + ": " +
                           result.failed.front().reason);
    return kFailed;
  }
  return kDone;
}

int
RunPrune(const Run & run)
{
  PruneOptions options = PruneOptionsFrom(run.line.values);
  options.threads = run.threads;
  options.command = run.line.whole;
  const PruneResult result = RunPruneJob(options, run.context);
  run.Warn(result.warnings);
  run.Print(ReportTable(result.report));
  run.PrintNotes(result.notes);
  return kDone;
}

int
RunInfo(const Run & run)
{
  const ScanInfo info = RunInfoJob(InfoOptionsFrom(run.line.values), run.context);
  run.Warn(info.warnings);
  run.Print(run.line.values.contains("json") ? InfoJson(info) : InfoText(info));
  return kDone;
}

int
RunVerify(const Run & run)
{
  const VerifyOptions options = VerifyOptionsFrom(run.line.values);
  const VerifyResult  result = RunVerifyJob(options, run.context);
  run.Warn(result.warnings);
  run.Print(VerifyText(result));
  if (!result.passed)
  {
    throw CertificateError(options.core.string() + ": does not agree with " + options.scan.string());
  }
  return kDone;
}

int
RunReconstruct(const Run & run)
{
  ReconstructOptions options = ReconstructOptionsFrom(run.line.values);
  options.command = run.line.whole;
  const ReconstructResult result = RunReconstructJob(options, run.context);
  run.Warn(result.warnings);
  run.Print(ReconstructText(result));
  run.PrintNotes(result.notes);
  return kDone;
}

int
RunPhantom(const Run & run)
{
  if (ValueOf(run.line.values, CommandId::Phantom, "kind") == "list")
  {
    run.Print(PhantomList());
    return kDone;
  }
  run.Print(RunPhantomJob(PhantomOptionsFrom(run.line.values), run.context) + "\n");
  return kDone;
}

int
PrintSkeleton(const Run & run, const SkeletonResult & result)
{
  run.Warn(result.warnings);
  run.Print(SkeletonTable(result.report));
  run.PrintNotes(result.notes);
  return kDone;
}

int
RunSkeleton(const Run & run)
{
  SkeletonOptions options = SkeletonOptionsFrom(run.line.values);
  options.threads = run.threads;
  options.command = run.line.whole;
  return PrintSkeleton(run, RunSkeletonJob(options, run.context));
}

int
RunRender(const Run & run)
{
  const RenderResult result = RunRenderJob(RenderOptionsFrom(run.line.values), run.context);
  run.Warn(result.warnings);
  run.PrintNotes(result.notes);
  return kDone;
}

int
Dispatch(const Run & run)
{
  switch (*run.line.command)
  {
    case CommandId::Core:
      return RunCore(run);
    case CommandId::Info:
      return RunInfo(run);
    case CommandId::Verify:
      return RunVerify(run);
    case CommandId::Prune:
      return RunPrune(run);
    case CommandId::Batch:
      return RunBatch(run);
    case CommandId::Reconstruct:
      return RunReconstruct(run);
    case CommandId::Phantom:
      return RunPhantom(run);
    case CommandId::Voxelize:
      return RunVoxelize(run);
    case CommandId::Skeleton:
      return RunSkeleton(run);
    case CommandId::Render:
      return RunRender(run);
    case CommandId::Measure:
      return PrintSkeleton(run, RunMeasureJob(MeasureOptionsFrom(run.line.values), run.context));
  }
  return kUsage;
}

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
  std::snprintf(time, sizeof(time), "%.2f s, peak memory %.0f MB\n", seconds, PeakMemoryMb());
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

int
Main(int argc, char ** argv, const Console & console, TemporaryRegistry & temporaries)
{
  const CommandLine line = ParseCommandLine(argc, argv);
  if (!line.command)
  {
    console.Print(line.text);
    return kDone;
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
  const int  code = Dispatch(run);
  if (!written.empty())
  {
    const bool tableSaysTime = *line.command == CommandId::Core || *line.command == CommandId::Prune;
    run.Print(WrittenText(written,
                          !tableSaysTime,
                          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()));
  }
  return code;
}

/** Whether the same command goes on from where this one stopped: batch does, and core and skeleton into a folder. */
bool
GoesOn(int argc, char ** argv)
{
  const std::vector<std::string> arguments(argv, argv + argc);
  const std::string              command = argc > 1 ? arguments[1] : std::string();
  auto                           output = std::find_if(arguments.begin(), arguments.end(), [](const std::string & one) {
    return one == "-o" || one == "--output";
  });
  const bool intoFolder = output != arguments.end() && ++output != arguments.end() && IsFolderOutput(*output);
  return command == "batch" || ((command == "core" || command == "skeleton") && intoFolder);
}

} // namespace

int
main(int argc, char ** argv)
{
  static TemporaryRegistry temporaries; // a signal may come during exit, too
  const Console            console;
  const char * const       whatIsLeft =
    GoesOn(argc, argv) ? "what is done stays, and the same command goes on from there" : "nothing was written";
  HandleSignals(temporaries, console.ErrorDescriptor(), whatIsLeft);
  const auto fail = [&console](int code, const std::string & message) {
    console.PrintError(message);
    return code;
  };
  try
  {
    return Main(argc, argv, console, temporaries);
  }
  catch (const Cancelled &)
  {
    CallOffDeadline();
    console.PrintError(std::string("interrupted; ") + whatIsLeft);
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
                "not enough memory for this scan; nothing was written; work on single --labels, or on another machine");
  }
  catch (const std::exception & error)
  {
    return fail(kFailed, error.what());
  }
}
