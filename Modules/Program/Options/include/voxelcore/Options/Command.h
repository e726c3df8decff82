#pragma once
// A command of the program, as a street registers it: `voxelcore_command(STREET NAME)` in its CMakeLists.txt names the
// constant k<NAME>Command. The parser, help, manual, completion, Python and the web walk over Commands().

#include "voxelcore/Jobs/JobContext.h"
#include "voxelcore/Formats/ReadOptions.h"
#include "voxelcore/Options/Parameters.h"
#include "voxelcore/Report/CoreReport.h"

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace voxelcore
{

struct Command;

/** What a command gets. */
struct Invocation
{
  const ParameterValues &                 values;
  std::string                             whole;   ///< the command as a shell would take it again
  int                                     threads; ///< 1 and more
  const JobContext &                      context;
  std::span<const Command>                commands; ///< all there are
  std::function<void(const CoreReport &)> done;     ///< gets the report of a case of a batch; may be empty

  void
  Done(const CoreReport & report) const
  {
    if (done)
    {
      done(report);
    }
  }
};

/** What a command says when its job is done. */
struct Outcome
{
  std::vector<std::string> warnings = {};
  std::string              text = {};         ///< for standard output, with its line ends
  std::vector<std::string> notes = {};        ///< a line each, after the text
  std::string              failure = {};      ///< what failed nevertheless; the exit code is then 1
  std::string              disagreement = {}; ///< the same of a certificate: 4
  bool                     saysTime = false;  ///< the text has the time already
};

/** Where a batch has the results of one case: `folder`/`name`... */
struct CasePlace
{
  std::filesystem::path folder;
  std::string           name;
  bool                  bids = false; ///< volumes as BIDS has them

  std::string
  Stem() const
  {
    return (folder / name).string();
  }
};

/** What a case's options say of its files. */
struct CaseInput
{
  ReadOptions                        reading;
  std::vector<std::filesystem::path> masks; ///< read beside the scan
};

/** How `batch` runs a command on each of many scans. */
struct AsCase
{
  std::vector<std::string> (*arguments)(const CasePlace & place); ///< behind the scan
  /** \throws UsageError as the command does. */
  CaseInput (*understand)(const ParameterValues & values);
  std::string_view flag = {};               ///< of `batch`, that asks for it; empty: it is what batch runs
  std::string_view description = {};        ///< of that flag
  bool             drawsUnlessTold = false; ///< has a page unless --no-pictures; the others have --html
  bool             hasBids = true;          ///< its files have names in BIDS
  std::string_view beside = {};             ///< row of a second file; a manifest's column names it, case by case
};

/** Whether the same command line goes on from where it was stopped. */
enum class Resumes
{
  Never,
  IntoFolder, ///< if --output is a folder
  Always
};

/** More options of another street's command: `voxelcore_extension(STREET NAME)` names the constant k<NAME>Extension. */
struct Extension
{
  std::string_view           command; ///< its name
  std::span<const Parameter> rows;
  /** Whether it runs in that command's place. \throws UsageError, naming the option, for one that needs another */
  bool (*isAsked)(const ParameterValues & values);
  Outcome (*run)(const Invocation & call);
};

struct Command
{
  std::string_view           name;
  std::string_view           description = {}; ///< one line
  std::string_view           footer = {};      ///< examples, and what must be known to use it well
  int                        place = 0;        ///< in lists of commands, the least first
  std::span<const Parameter> rows;             ///< heading by heading; within one the most needed first
  Outcome (*run)(const Invocation & call) = nullptr;
  Resumes        resumes = Resumes::Never;
  const AsCase * asCase = nullptr;
  bool           runsCases = false;                   ///< its options are its own, and those of commands that are cases
  std::span<const Extension * const> extensions = {}; ///< put in by Commands()
};

/** All that streets have registered, in the order of their places. */
std::span<const Command>
Commands();

/** Runs the command, or the extension of it that is asked for. \throws UsageError where two are, and what jobs throw */
Outcome
RunCommand(const Command & command, const Invocation & call);

/** Null where there is none. */
const Parameter *
FindParameter(std::span<const Parameter> rows, std::string_view name);

/** The options of `core` and other commands that a batch takes for its cases: each name once. */
std::vector<Parameter>
OptionsOfCases(std::span<const Command> commands);

/** The value given, else the default of the command's row. */
std::string
ValueOf(const ParameterValues & values, const Command & command, std::string_view name);

/** The same of a choice. \throws UsageError, naming the option, unless it is one of its words. */
std::string
ChoiceOf(const ParameterValues & values, const Command & command, std::string_view name);

/** `--threads`: 0 means all processors.
 *  \throws UsageError unless it is a whole number from 0 to 4096 */
int
ThreadsFrom(const ParameterValues & values);

} // namespace voxelcore
