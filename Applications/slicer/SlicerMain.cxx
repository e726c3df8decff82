// A CLI module of 3D Slicer: what Slicer's command line means, progress in its tags, results where it asked for them.
// VOXELCORE_SLICER_COMMAND says which of the program's commands this is.

#include "Console.h"
#include "Signals.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Jobs/SkeletonJob.h"
#include "voxelcore/Options/SlicerModule.h"

#include <cstdio>
#include <cstdlib>
#include <omp.h>

namespace
{

using namespace voxelcore; // NOLINT: a program's only file speaks its library's language

constexpr CommandId kCommand = CommandId::VOXELCORE_SLICER_COMMAND;
constexpr int       kInterrupted = 130;

/** Lines that Slicer reads as they come; at most one a hundredth. */
class SlicerProgress
{
public:
  explicit SlicerProgress(const Console & console)
    : m_Console(console)
  {
    m_Console.Print(
      "<filter-start>\n<filter-name>VoxelCore</filter-name>\n<filter-comment>computing</filter-comment>\n"
      "</filter-start>\n");
  }

  void
  Show(double fraction)
  {
    const int step = static_cast<int>(fraction * 100);
    if (step != m_Step)
    {
      m_Step = step;
      char text[64];
      static_cast<void>(std::snprintf(text, sizeof(text), "<filter-progress>%.2f</filter-progress>\n", step / 100.0));
      m_Console.Print(text);
    }
  }

  void
  End(double seconds)
  {
    char text[160];
    static_cast<void>(std::snprintf(
      text,
      sizeof(text),
      "<filter-end>\n<filter-name>VoxelCore</filter-name>\n<filter-time>%.3f</filter-time>\n</filter-end>\n",
      seconds));
    m_Console.Print(text);
  }

private:
  const Console & m_Console;
  int             m_Step = -1;
};

CoreReport
RunCommand(const SlicerCall & call, const std::string & whole, const JobContext & context, const Console & console)
{
  std::vector<std::string> warnings;
  CoreReport               report;
  if constexpr (kCommand == CommandId::Core)
  {
    CoreOptions options = CoreOptionsFrom(call.values);
    options.command = whole;
    options.threads = omp_get_max_threads();
    CoreResult result = RunCoreJob(options, context);
    warnings = result.warnings;
    report = std::move(result.report);
  }
  else
  {
    SkeletonOptions options = SkeletonOptionsFrom(call.values);
    options.command = whole;
    options.threads = omp_get_max_threads();
    SkeletonResult result = RunSkeletonJob(options, context);
    warnings = result.warnings;
    report = std::move(result.report);
  }
  for (const std::string & warning : warnings)
  {
    console.Print("warning: " + warning + "\n"); // anything on stderr would be shown as an error
  }
  return report;
}

void
Main(const std::vector<std::string> & arguments, const Console & console, TemporaryRegistry & temporaries)
{
  const SlicerCall call = ParseSlicerCall(kCommand, arguments);
  if (call.wantsXml)
  {
    console.Print(SlicerXml(kCommand));
    return;
  }
  const int threads = ThreadsFrom(call.values, kCommand);
  if (threads > 0)
  {
    omp_set_num_threads(threads);
  }
  std::string whole = "VoxelCore module of 3D Slicer:";
  for (const std::string & word : arguments)
  {
    whole += " " + word;
  }
  SlicerProgress progress(console);
  JobContext     context;
  context.temporaries = &temporaries;
  context.progress = [&progress](std::string_view, double fraction) {
    progress.Show(fraction);
    return !WasInterrupted();
  };
  const CoreReport report = RunCommand(call, whole, context, console);
  if (call.returnParameterFile && !call.returnParameterFile->empty())
  {
    WriteTextFile(*call.returnParameterFile, SlicerReturnText(kCommand, report));
  }
  progress.End(report.seconds.total);
}

} // namespace

int
main(int argc, char ** argv)
{
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
    Main({ argv + 1, argv + argc }, console, temporaries);
    EndByItself();
    return 0;
  }
  catch (const Cancelled &)
  {
    CallOffDeadline();
    console.PrintError("interrupted; nothing was written");
    std::_Exit(kInterrupted); // an engine's thread may still run: no destructors under its feet
  }
  catch (const UsageError & error)
  {
    return fail(2, error.what());
  }
  catch (const InputError & error)
  {
    return fail(3, error.what());
  }
  catch (const CertificateError & error)
  {
    return fail(4, error.what());
  }
  catch (const std::bad_alloc &)
  {
    return fail(1, "not enough memory for this volume; nothing was written");
  }
  catch (const std::exception & error)
  {
    return fail(1, error.what());
  }
}
